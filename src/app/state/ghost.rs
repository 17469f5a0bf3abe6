//! A ghost: another flight of the same mission, shown beside the current one.

use std::sync::Arc;
use std::time::Duration;

use crate::comparison::{Anchors, ComparedFlight};
use crate::moment::Alignment;

/// Another flight, and how its time is aligned with the current flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Ghost {
    pub other: Arc<ComparedFlight>,
    /// The whole replayed flight; `None` during a live one.
    pub own: Option<Arc<ComparedFlight>>,
    alignment: Alignment,
}

impl Ghost {
    /// A ghost that starts together with the current flight.
    pub fn new(other: Arc<ComparedFlight>, own: Option<Arc<ComparedFlight>>) -> Self {
        Self {
            other,
            own,
            alignment: Alignment::default(),
        }
    }

    /// How the times of both flights are aligned.
    pub fn alignment(&self) -> Alignment {
        self.alignment
    }

    /// Changes the alignment; returns false if the aligning event is missing in one of the flights.
    pub fn align(&mut self, alignment: Alignment) -> bool {
        let is_in_both = self.anchors(alignment).is_some();
        if is_in_both {
            self.alignment = alignment;
        }
        is_in_both
    }

    /// The ghost's time at a time of the current flight; `None` before the ghost's start.
    pub fn time(&self, elapsed: Duration) -> Option<Duration> {
        let anchors = self.anchors(self.alignment)?;
        (elapsed + anchors.other).checked_sub(anchors.own)
    }

    /// The times of the aligning event in both flights; `None` if one of them lacks it.
    fn anchors(&self, alignment: Alignment) -> Option<Anchors> {
        match &self.own {
            Some(own) => ComparedFlight::anchors(own, &self.other, alignment),
            // For a flight under way, only the start is known for certain.
            None if alignment == Alignment::Start => Some(Anchors {
                own: Duration::ZERO,
                other: Duration::ZERO,
            }),
            None => None,
        }
    }
}
