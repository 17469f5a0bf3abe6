//! How fast simulated time passes.

use crate::text::figure;

/// How many times as fast as the clock on the wall simulated time passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessionPace {
    /// As the session began.
    pub usual: f64,
    pub now: f64,
}

impl SessionPace {
    /// A pace that is the usual one.
    pub fn new(usual: f64) -> Self {
        Self { usual, now: usual }
    }

    /// Whether time passes faster than the session began.
    pub fn is_fast(self) -> bool {
        self.now > self.usual
    }
}

impl Default for SessionPace {
    fn default() -> Self {
        Self::new(1.0)
    }
}

/// A rate without needless digits: `4`, `0.5`.
pub fn rate(speedup: f64) -> String {
    let is_broken = speedup.fract() != 0.0;
    figure(speedup, usize::from(is_broken))
}
