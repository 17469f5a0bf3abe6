//! The workshop: a design on the bench with the parts that fit and the effect of each; all designs;
//! a comparison of two designs; and the seats of a mission's fleet.
//!
//! Any part may be tried on the bench; parts that the career does not own must be bought before
//! they fly. The design stays on the bench when the room is left. Unsaved changes are replaced only
//! after a question, and the replacement can be undone.

use crate::app::State;
use crate::mission::Listing;
use crate::workshop::{Air, Design, Part, Sheet};

pub(super) mod act;
mod bench;
mod files;
mod fit;
mod fleet;
mod footer;
mod licence;
mod shelf;
#[cfg(test)]
mod tests;

pub use bench::{Bench, Candidate, Curves, SlotRow, rows};
pub use files::{copied, exported, imported, read, renamed, saved_as};
pub use fit::{Fit, Stand, weigh};
pub use fleet::{Seat, bill, seats};
pub use licence::{Licence, lacking, licence};
pub use shelf::{Stored, heard, is_saved, lay, stored};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Workshop {
    /// The design on the bench.
    pub(in crate::app) bench: Bench,
    pub(in crate::app) page: Page,
    /// The bench's list that has the cursor.
    pub(in crate::app) pane: Pane,
    /// The view beside the lists.
    pub(in crate::app) view: View,
    /// The index of the line under the cursor in the list of designs.
    pub(in crate::app) shelf: usize,
    /// The index of the seat under the cursor.
    pub(in crate::app) seat: usize,
    /// The first line shown of the comparison.
    pub(in crate::app) scroll: usize,
    /// The design that the bench is compared with.
    pub(in crate::app) compared: Option<(Design, Sheet)>,
    /// How well the design on the bench meets the mission's needs.
    pub(in crate::app) fit: Option<Fit>,
}

impl Workshop {
    fn turn_pane(&mut self) {
        self.pane = match self.pane {
            Pane::Slots => Pane::Parts,
            Pane::Parts => Pane::Slots,
        };
    }

    /// The design on the bench.
    pub fn bench(&self) -> &Bench {
        &self.bench
    }

    pub fn page(&self) -> Page {
        self.page
    }

    /// The bench's list that has the cursor.
    pub fn pane(&self) -> Pane {
        self.pane
    }

    /// The view beside the lists.
    pub fn view(&self) -> View {
        self.view
    }

    /// The index of the line under the cursor in the list of designs.
    pub fn shelf(&self) -> usize {
        self.shelf
    }

    /// The index of the seat under the cursor.
    pub fn seat(&self) -> usize {
        self.seat
    }

    /// The first line shown of the comparison.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// The design that the bench is compared with.
    pub fn compared(&self) -> Option<&(Design, Sheet)> {
        self.compared.as_ref()
    }

    /// How well the design on the bench meets the mission's needs.
    pub fn fit(&self) -> Option<&Fit> {
        self.fit.as_ref()
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Page {
    #[default]
    Bench,
    Designs,
    /// A comparison of another design with the one on the bench.
    Compare,
    /// The seats of a mission's fleet.
    Fleet,
}

/// A list of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pane {
    /// The slots with their parts.
    #[default]
    Slots,
    Parts,
}

/// The view beside the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum View {
    /// The design's figures and problems.
    #[default]
    Figures,
    Polar,
    /// Hover time by payload.
    Payload,
    /// The mission's needs, and the design's values for them.
    Mission,
}

impl View {
    fn next(self) -> Self {
        match self {
            Self::Figures => Self::Polar,
            Self::Polar => Self::Payload,
            Self::Payload => Self::Mission,
            Self::Mission => Self::Figures,
        }
    }
}

/// The air conditions for which figures are computed.
pub fn air() -> Air {
    Air::default()
}

/// The mission to build for: the one in flight, otherwise the mission under the home screen's
/// cursor.
pub fn mission(state: &State) -> Option<&Listing> {
    // After a finished flight, the bench is for the next one.
    let chosen = super::home::under_cursor(state).filter(|_| state.session.is_over());
    chosen.or_else(|| super::mission::shown(state))
}

/// The minimum width to show everything at once.
pub const WIDE: u16 = 150;

fn part_under_cursor(state: &State) -> Option<&'static Part> {
    let room = &state.rooms.workshop;
    match room.pane {
        Pane::Slots => room.bench.rows().get(room.bench.row())?.part,
        Pane::Parts => room.bench.candidate().map(|candidate| candidate.part),
    }
}
