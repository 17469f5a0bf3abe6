//! Another flight of the same mission, shown beside the one that is flown or replayed.

use std::sync::Arc;
use std::time::Duration;

use crate::comparison::ComparedFlight;
use crate::moment::Alignment;

/// Another flight, and how its time is laid upon that of the one that is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Ghost {
    pub other: Arc<ComparedFlight>,
    /// The flight that is replayed, all of it; `None` while one is flown.
    pub own: Option<Arc<ComparedFlight>>,
    alignment: Alignment,
}

impl Ghost {
    /// One that begins together with the flight that is shown.
    pub fn new(other: Arc<ComparedFlight>, own: Option<Arc<ComparedFlight>>) -> Self {
        Self {
            other,
            own,
            alignment: Alignment::default(),
        }
    }

    /// What the times are laid upon each other by.
    pub fn alignment(&self) -> Alignment {
        self.alignment
    }

    /// Lays the times upon each other by something else; returns whether it happened in both flights.
    pub fn align(&mut self, alignment: Alignment) -> bool {
        let is_in_both = self.anchors(alignment).is_some();
        if is_in_both {
            self.alignment = alignment;
        }
        is_in_both
    }

    /// The other flight's time when the one that is shown has flown for so long; nothing before its start.
    pub fn time(&self, elapsed: Duration) -> Option<Duration> {
        let anchors = self.anchors(self.alignment)?;
        (elapsed + anchors.other).checked_sub(anchors.own)
    }

    /// When both flights were at what they are aligned by.
    fn anchors(&self, alignment: Alignment) -> Option<Anchors> {
        let own = match &self.own {
            Some(own) => own.anchor(alignment)?,
            // Of a flight under way only the start is known for certain.
            None if alignment == Alignment::Start => Duration::ZERO,
            None => return None,
        };
        let other = self.other.anchor(alignment)?;
        Some(Anchors { own, other })
    }
}

/// Times at which two flights are laid upon each other.
struct Anchors {
    own: Duration,
    other: Duration,
}
