//! The speed-up of simulated time.

use crate::text::figure;

/// The speed-up of simulated time over the wall clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessionPace {
    /// The speed-up at the start of the session, to which the pace returns.
    pub usual: f64,
    pub now: f64,
}

impl SessionPace {
    /// A pace whose current and usual speed-up have this value.
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

/// A speed-up without trailing zeros: `4`, `0.5`, `0.25`.
pub fn rate(speedup: f64) -> String {
    let exact = figure(speedup, 2);
    match exact.split_once('.') {
        Some(_) => exact.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => exact,
    }
}
