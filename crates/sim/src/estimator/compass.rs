//! The compass in use, and its agreement with the estimator.

use std::time::Duration;

use super::faults::Faults;

/// A compass that fails or contradicts the estimate for this long is replaced by another one.
const PATIENCE: Duration = Duration::from_secs(10);
/// The time after its last reading at which a compass counts as unhealthy.
const UNHEALTHY_AFTER: Duration = Duration::from_millis(500);
/// The greatest error that passes the innovation test, in milligauss: 195 gave a test ratio of 1.286.
const GATE_MGAUSS: f64 = 151.6;
/// The test ratio of a good compass in flight.
pub(super) const GOOD: f64 = 0.03;

#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Compass {
    /// The compass in use, counted from 0.
    used: usize,
    /// The time at which the compass in use fell silent, or began to contradict the estimate.
    bad_since: Option<Duration>,
    /// The time at which the first compass, whose health is reported, fell silent.
    silent_since: Option<Duration>,
    pub(super) healthy: Option<bool>,
    /// The error compensated when the compass was chosen, in milligauss.
    learnt_mgauss: f64,
    all_failed: bool,
}

impl Compass {
    /// Checks the compasses; returns the number of a newly chosen one, if any.
    pub(super) fn step(&mut self, now: Duration, faults: &Faults) -> Option<usize> {
        self.watch_health(now, faults);
        let failed = &faults.compasses_failed;
        if failed.iter().all(|failed| *failed) {
            self.all_failed = true;
            return None;
        }
        if self.all_failed {
            self.all_failed = false;
            let first = failed.iter().position(|failed| !failed)?;
            return Some(self.turn_to(first, faults));
        }
        let bad = failed[self.used] || self.ratio(faults) >= 1.0;
        if !bad {
            self.bad_since = None;
            return None;
        }
        let since = *self.bad_since.get_or_insert(now);
        if now < since + PATIENCE {
            return None;
        }
        let next = (1..3)
            .map(|step| (self.used + step) % 3)
            .find(|&other| !failed[other])?;
        Some(self.turn_to(next, faults))
    }

    /// The test ratio of the compass in use.
    pub(super) fn ratio(&self, faults: &Faults) -> f64 {
        let off = faults.compass_errors_mgauss[self.used] - self.learnt_mgauss;
        GOOD + off.abs() / GATE_MGAUSS
    }

    /// The number of the compass in use, counted from 0; `None` if all have failed.
    pub(super) fn in_use(&self) -> Option<usize> {
        (!self.all_failed).then_some(self.used)
    }

    /// Whether no fault of a compass is under way.
    pub(super) fn is_settled(&self) -> bool {
        self.bad_since.is_none() && self.healthy != Some(false) && self.learnt_mgauss == 0.0
    }

    fn turn_to(&mut self, next: usize, faults: &Faults) -> usize {
        self.used = next;
        self.bad_since = None;
        self.learnt_mgauss = faults.compass_errors_mgauss[next];
        next
    }

    fn watch_health(&mut self, now: Duration, faults: &Faults) {
        if faults.compasses_failed[0] {
            let since = *self.silent_since.get_or_insert(now);
            self.healthy = Some(now < since + UNHEALTHY_AFTER);
        } else {
            self.silent_since = None;
            self.healthy = None;
        }
    }
}
