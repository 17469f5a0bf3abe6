//! The figures of the last trial, in place of the items.

use super::Drawing;
use crate::draft::{Draft, TrialFlight};

impl Drawing {
    /// The flights of the last trial of the drafts as they are.
    pub fn flight(&self) -> Option<&TrialFlight> {
        self.tried.as_ref()?.flight.as_ref()
    }

    /// The flights to show in place of the items, and the first line of them to show.
    pub fn figures(&self) -> Option<(&TrialFlight, usize)> {
        Some((self.flight()?, self.figures_top?))
    }

    /// The number of a draft's vehicle, otherwise the name of the draft; for a draft of a trial by its index.
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

    /// The [pilots](Self::pilot) of all drafts of a trial, in their order.
    pub fn pilots(&self) -> Vec<String> {
        let count = self.flight().map_or(0, |flight| flight.pilots.len());
        (0..count).map(|index| self.pilot(index)).collect()
    }

    /// Shows or hides the figures; false if there are none.
    pub(super) fn turn_figures(&mut self) -> bool {
        self.figures_top = match self.figures_top {
            None => self.flight().map(|_| 0),
            Some(_) => None,
        };
        self.flight().is_some()
    }

    /// Scrolls the figures by a line; false while the items are shown.
    pub(super) fn scroll_figures(&mut self, forward: bool) -> bool {
        let Some((flight, top)) = self.figures() else {
            return false;
        };
        let last = (flight.pilots.len() + flight.closest.len()).saturating_sub(1);
        self.figures_top = Some(if forward {
            (top + 1).min(last)
        } else {
            top.saturating_sub(1)
        });
        true
    }
}
