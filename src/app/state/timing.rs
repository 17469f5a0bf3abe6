//! How a session's time passes.

use std::time::Duration;

use super::{SessionPace, SessionTime};

/// Whether a session's time runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TimeFlow {
    #[default]
    Passes,
    /// The session is paused.
    Paused,
    /// The mission has not begun: its brief is still shown.
    AwaitsReader,
}

/// A session's start, clock and pace.
#[derive(Debug, Clone, Default)]
pub struct Timing {
    /// When the session began, on the program's clock.
    pub(in crate::app) began_at: Duration,
    /// Session time by the program's clock; in a mission, mission time.
    pub(in crate::app) clock: SessionTime,
    /// Whether time passes, and if not, why.
    pub(in crate::app) flow: TimeFlow,
    /// The speed-up of simulated time.
    pub(in crate::app) pace: SessionPace,
}

impl Timing {
    /// Converts a time on the program's clock to session time; in a mission, to mission time.
    pub(super) fn at(&self, then: Duration) -> Duration {
        let clock = self.clock.at(then);
        clock.unwrap_or_else(|| then.saturating_sub(self.began_at))
    }

    /// Starts the clock of a session without a mission at zero.
    pub(super) fn restart(&mut self, now: Duration) {
        self.clock = SessionTime::default();
        self.clock.go(now, self.pace.now);
    }
}
