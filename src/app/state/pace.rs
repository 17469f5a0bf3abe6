//! The speed-up of simulated time.

use crate::text::figure;

/// The speed-up of simulated time over the wall clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessionPace {
    /// The speed-up at the start of the session.
    pub usual: f64,
    pub now: f64,
}

impl SessionPace {
    /// A pace with this speed-up as the usual one.
    pub fn new(usual: f64) -> Self {
        Self { usual, now: usual }
    }

    /// Whether time runs faster than at the start.
    pub fn is_fast(self) -> bool {
        self.now > self.usual
    }
}

impl Default for SessionPace {
    fn default() -> Self {
        Self::new(1.0)
    }
}

/// A rate without trailing zeros: `4`, `0.5`.
pub fn rate(speedup: f64) -> String {
    let is_broken = speedup.fract() != 0.0;
    figure(speedup, usize::from(is_broken))
}
