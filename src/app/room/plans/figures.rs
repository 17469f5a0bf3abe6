//! The figures of the last trial, in place of the items.

use super::Drawing;
use super::view::PlansLayout;
use crate::draft::{Draft, TrialFlight};
use crate::rehearsal::FlightEnding;

/// The minimum width of the figures, in columns, at which a draft's line also shows the end of its
/// flight.
pub const FIGURES_WITH_END: usize = 58;

/// A line of the figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureRow {
    DraftHeading,
    /// The draft with this index in the trial.
    Draft(usize),
    /// The end of the flight of the draft with this index, on narrow screens, unless it is a
    /// landing.
    End(usize),
    PairHeading,
    /// The pair with this index among the closest approaches.
    Pair(usize),
}

impl FigureRow {
    /// All lines of a trial's figures at a width of `columns`.
    pub fn of(flight: &TrialFlight, columns: usize) -> Vec<Self> {
        let mut rows = vec![Self::DraftHeading];
        for (at, pilot) in flight.pilots.iter().enumerate() {
            rows.push(Self::Draft(at));
            if columns < FIGURES_WITH_END && pilot.flown.ending != FlightEnding::Landed {
                rows.push(Self::End(at));
            }
        }
        if !flight.closest.is_empty() {
            rows.push(Self::PairHeading);
            rows.extend((0..flight.closest.len()).map(Self::Pair));
        }
        rows
    }
}

impl Drawing {
    /// The flights of the last trial of the unchanged drafts, if there are any.
    pub fn flight(&self) -> Option<&TrialFlight> {
        self.tried.as_ref()?.flight.as_ref()
    }

    /// The flights to show in place of the items, and the first visible line of their figures;
    /// `None` while the items are shown.
    pub fn figures(&self) -> Option<(&TrialFlight, usize)> {
        Some((self.flight()?, self.figures_top?))
    }

    /// The vehicle number of the trial's draft with this index; the draft's name if it has no
    /// vehicle.
    fn pilot(&self, index: usize) -> String {
        let pilots = self.flight().map(|flight| flight.pilots.as_slice());
        let Some(pilot) = pilots.and_then(|pilots| pilots.get(index)) else {
            return String::new();
        };
        let draft = self.drafts.all().iter().find(|it| it.name() == pilot.name);
        let vehicle = pilot.sharer.or_else(|| draft.and_then(Draft::vehicle));
        match (vehicle, draft) {
            (Some(vehicle), _) => vehicle.to_string(),
            (None, Some(draft)) => draft.short_name().to_owned(),
            (None, None) => pilot.name.clone(),
        }
    }

    /// The names of all drafts of a trial, in their order.
    pub fn pilots(&self) -> Vec<String> {
        let count = self.flight().map_or(0, |flight| flight.pilots.len());
        (0..count).map(|index| self.pilot(index)).collect()
    }

    /// Shows or hides the figures; returns false if there are none.
    pub(super) fn turn_figures(&mut self) -> bool {
        self.figures_top = match self.figures_top {
            None => self.flight().map(|_| 0),
            Some(_) => None,
        };
        self.flight().is_some()
    }

    /// Scrolls the figures by a line, at most until the last line is at the bottom; returns false
    /// while the items are shown.
    pub(super) fn scroll_figures(&mut self, sizes: PlansLayout, forward: bool) -> bool {
        let Some((flight, top)) = self.figures() else {
            return false;
        };
        let rows = FigureRow::of(flight, usize::from(sizes.list)).len();
        let last = rows.saturating_sub(usize::from(sizes.canvas.rows));
        self.figures_top = Some(if forward {
            (top + 1).min(last)
        } else {
            top.min(last).saturating_sub(1)
        });
        true
    }
}
