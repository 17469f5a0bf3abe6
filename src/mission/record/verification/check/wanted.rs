//! The values that a mission demands of a simulator's parameter.

use std::collections::VecDeque;
use std::time::Duration;

/// The maximum time between a demand of the mission and the change of the parameter.
const SET_WITHIN: Duration = Duration::from_secs(10);

/// A parameter's demanded values that it may still have.
#[derive(Debug, Default)]
pub(super) struct WantedParameter {
    /// Values with the times of their demands, the oldest first.
    values: VecDeque<(Duration, f64)>,
}

impl WantedParameter {
    /// Notes that the mission demands a value.
    pub fn want(&mut self, value: f64, at: Duration) {
        self.values.push_back((at, value));
    }

    /// Forgets the values that were replaced too long ago for the parameter to have them still.
    pub fn forget(&mut self, now: Duration) {
        let settled = now.saturating_sub(SET_WITHIN);
        while self.values.get(1).is_some_and(|(at, _)| *at <= settled) {
            self.values.pop_front();
        }
    }

    /// Whether the parameter may have this value: a demand is met within a time, until then any value may be set.
    pub fn permits(&self, value: f64, now: Duration) -> bool {
        let settled = now.saturating_sub(SET_WITHIN);
        let is_same = |wanted: f64| (value - wanted).abs() <= 1e-5 * wanted.abs().max(1.0);
        let due = self.values.iter().rposition(|(at, _)| *at <= settled);
        due.is_none_or(|first| {
            let mut possible = self.values.range(first..);
            possible.any(|(_, wanted)| is_same(*wanted))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(s: u64) -> Duration {
        Duration::from_secs(s)
    }

    #[test]
    fn a_demand_has_to_be_met_in_time() {
        let mut wanted = WantedParameter::default();
        wanted.want(4.0, seconds(1));
        assert!(wanted.permits(0.0, seconds(10)), "not yet");
        assert!(!wanted.permits(0.0, seconds(11)));
        assert!(wanted.permits(4.0, seconds(11)));
    }

    /// In gusts the mission changes the wind twice a second, and a console that left the wind out was once not noticed.
    #[test]
    fn with_new_demands_all_the_time_only_recent_ones_are_permitted() {
        let mut wanted = WantedParameter::default();
        for s in 0..60 {
            wanted.want(s as f64, seconds(s));
            wanted.forget(seconds(s));
        }
        assert!(!wanted.permits(-1.0, seconds(59)), "never demanded");
        assert!(!wanted.permits(20.0, seconds(59)), "too old");
        assert!(wanted.permits(52.0, seconds(59)), "on its way");
        assert!(wanted.permits(59.0, seconds(59)));
        assert!(!wanted.permits(52.0, seconds(80)));
        assert!(wanted.permits(59.0, seconds(80)));
    }
}
