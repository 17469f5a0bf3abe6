//! A clock that runs faster or slower than the program's.

use std::time::Duration;

/// A clock that follows another one at a rate that may change: it never jumps and never goes back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PacedClock {
    /// Seconds of this clock per second of the other one.
    rate: f64,
    /// The other clock's time when the rate was set, and this clock's time then.
    since: Duration,
    reached: Duration,
}

impl PacedClock {
    /// A clock at zero when the other one is at `since`.
    pub fn new(rate: f64, since: Duration) -> Self {
        Self {
            rate,
            since,
            reached: Duration::ZERO,
        }
    }

    /// The time of this clock at a time of the other clock.
    pub fn at(&self, now: Duration) -> Duration {
        self.reached + now.saturating_sub(self.since).mul_f64(self.rate)
    }

    /// Changes the rate from now on.
    pub fn set_rate(&mut self, rate: f64, now: Duration) {
        self.reached = self.at(now);
        self.since = now;
        self.rate = rate;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn s(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    #[test]
    fn another_rate_changes_what_is_ahead_and_nothing_of_what_was() {
        let mut clock = PacedClock::new(1.0, s(5));
        assert_eq!(clock.at(s(15)), s(10));
        clock.set_rate(4.0, s(15));
        assert_eq!(clock.at(s(15)), s(10));
        assert_eq!(clock.at(s(20)), s(30));
        clock.set_rate(0.5, s(20));
        assert_eq!(clock.at(s(30)), s(35));
    }
}
