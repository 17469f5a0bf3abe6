//! The workshop: a drone on the bench, the parts that could go into it and what each would change; the designs that
//! there are; two designs side by side; and the seats of a mission's fleet.
//!
//! Everything may be tried on the bench. What a career does not own yet has to be bought before it flies. What lies on
//! the bench stays there when the room is left; what was changed is only replaced after a question, and even then it
//! can be brought back.

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

pub use bench::{Bench, Candidate, SlotRow, rows};
pub use files::{copied, exported, imported, read, renamed, saved_as};
pub use fit::{Fit, Stand, weigh};
pub use fleet::{Seat, bill, seats};
pub use licence::{Licence, lacking, licence};
pub use shelf::{Stored, heard, is_saved, lay, stored};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Workshop {
    /// What lies on the bench.
    pub(in crate::app) bench: Bench,
    pub(in crate::app) page: Page,
    /// Which list of the bench has the cursor.
    pub(in crate::app) pane: Pane,
    /// What is shown beside the lists.
    pub(in crate::app) view: View,
    /// The line under the cursor of the list of designs.
    pub(in crate::app) shelf: usize,
    /// The seat under the cursor.
    pub(in crate::app) seat: usize,
    /// The first line of the comparison.
    pub(in crate::app) scroll: usize,
    /// What the bench is compared with.
    pub(in crate::app) compared: Option<(Design, Sheet)>,
    /// How the bench stands to what the mission needs.
    pub(in crate::app) fit: Option<Fit>,
}

impl Workshop {
    /// The cursor goes to the other list of the bench.
    fn turn_pane(&mut self) {
        self.pane = match self.pane {
            Pane::Slots => Pane::Parts,
            Pane::Parts => Pane::Slots,
        };
    }

    /// What lies on the bench.
    pub fn bench(&self) -> &Bench {
        &self.bench
    }

    pub fn page(&self) -> Page {
        self.page
    }

    /// Which list of the bench has the cursor.
    pub fn pane(&self) -> Pane {
        self.pane
    }

    /// What is shown beside the lists.
    pub fn view(&self) -> View {
        self.view
    }

    /// The line under the cursor of the list of designs.
    pub fn shelf(&self) -> usize {
        self.shelf
    }

    /// The seat under the cursor.
    pub fn seat(&self) -> usize {
        self.seat
    }

    /// The first line of the comparison.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// What the bench is compared with.
    pub fn compared(&self) -> Option<&(Design, Sheet)> {
        self.compared.as_ref()
    }

    /// How the bench stands to what the mission needs.
    pub fn fit(&self) -> Option<&Fit> {
        self.fit.as_ref()
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Page {
    #[default]
    Bench,
    Designs,
    /// Another design beside the one on the bench.
    Compare,
    /// The seats of a mission's fleet.
    Fleet,
}

/// A list of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pane {
    /// What is built in.
    #[default]
    Slots,
    Parts,
}

/// What is shown beside the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum View {
    /// Figures, and what speaks against the design.
    #[default]
    Figures,
    Polar,
    /// Hover time by payload.
    Payload,
    /// What the mission needs, and what the design has.
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

/// The air that figures are stated for.
pub fn air() -> Air {
    Air::default()
}

/// The mission that is built for: the one that is flown, else the one under the cursor of the home screen.
pub fn mission(state: &State) -> Option<&Listing> {
    // What has been flown to its end is done: the bench is for the next one.
    let chosen = super::home::under_cursor(state).filter(|_| state.session.is_over());
    chosen.or_else(|| super::mission::shown(state))
}

/// From this width on everything is shown at a time.
pub const WIDE: u16 = 150;

/// The part that a deed of the bench is about: the one under the cursor.
fn part_under_cursor(state: &State) -> Option<&'static Part> {
    let room = &state.rooms.workshop;
    match room.pane {
        Pane::Slots => room.bench.rows().get(room.bench.row())?.part,
        Pane::Parts => room.bench.candidate().map(|candidate| candidate.part),
    }
}
