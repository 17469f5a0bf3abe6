//! The estimate: variances, lost positions, glitches.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Failsafe, FailsafeInputs};
use crate::estimator::Estimator;
use crate::mode::ModeId;
use crate::reaction::Reaction;

/// The number of bad checks (at 10 Hz) that trigger the failsafe, and of good ones that end it.
const LOOKS: u8 = 10;
/// The minimum time between two texts `EKF variance`.
const WARNED_EVERY: Duration = Duration::from_secs(30);

/// The state of the EKF check.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own, and any may hold beside any other"
)]
pub(super) struct EkfWatch {
    failures: u8,
    bad: bool,
    /// Whether a check of a copter has passed since boot; before, none counts as bad.
    has_passed: bool,
    /// Whether the failsafe changed the mode; if so, its end is reported.
    acted: bool,
    warned: Option<Duration>,
    glitching: bool,
}

/// What a check changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EkfChange {
    /// The estimate is bad from now on.
    Begins,
    Ends,
}

impl EkfWatch {
    /// Counts a check.
    pub(super) fn count(&mut self, passed: bool) -> Option<EkfChange> {
        if passed {
            self.failures = self.failures.saturating_sub(1);
            return if self.failures == 0 {
                self.reset()
            } else {
                None
            };
        }
        if self.bad {
            return None;
        }
        self.failures += 1;
        self.bad = self.failures >= LOOKS;
        self.bad.then_some(EkfChange::Begins)
    }

    /// Forgets the failed checks, while none are made.
    pub(super) fn reset(&mut self) -> Option<EkfChange> {
        self.failures = 0;
        std::mem::take(&mut self.bad).then_some(EkfChange::Ends)
    }

    pub(super) fn is_bad(&self) -> bool {
        self.bad
    }

    /// Whether no failed check, failsafe or glitch is under way.
    fn is_idle(&self) -> bool {
        self.failures == 0 && !self.bad && !self.glitching
    }
}

impl Failsafe {
    pub(crate) fn watch_estimate(&mut self, inputs: &FailsafeInputs<'_>) -> Vec<Reaction> {
        let estimator = inputs.estimator;
        let threshold = inputs.rules.ekf_threshold;
        let trusted = estimator.has_position() && !is_over(estimator, threshold);
        let good = trusted && estimator.fix().is_none();
        self.ekf.has_passed |= trusted && inputs.is_booted;
        if !inputs.is_booted || (good && self.ekf.is_idle()) {
            return Vec::new();
        }
        let mut reactions = Vec::new();
        reactions.extend(self.ekf.watch_glitches(estimator.is_glitching()));
        let change = if threshold <= 0.0 {
            self.ekf.reset()
        } else {
            self.ekf.count(trusted || !self.ekf.has_passed)
        };
        match change {
            Some(EkfChange::Begins) => {
                reactions.extend(self.ekf.say_variance(inputs.now));
                reactions.extend(self.begin_ekf_failsafe(inputs));
            }
            Some(EkfChange::Ends) => reactions.extend(self.ekf.say_cleared()),
            None => {}
        }
        reactions
    }

    /// Ends modes that need a position; others continue unless `FS_EKF_ACTION` is 3.
    fn begin_ekf_failsafe(&mut self, inputs: &FailsafeInputs<'_>) -> Option<Reaction> {
        let action = inputs.rules.ekf_action;
        let concerned = inputs.mode.needs_position() || action == 3;
        if !inputs.armed || inputs.mode.id == ModeId::Land || !concerned {
            return None;
        }
        self.ekf.acted = true;
        Some(Reaction::LeavePosition {
            holds_height: action == 2 && !self.radio_is_lost(),
        })
    }
}

impl EkfWatch {
    pub(super) fn say_variance(&mut self, now: Duration) -> Option<Reaction> {
        let again = self.warned.map(|at| at + WARNED_EVERY);
        again.is_none_or(|again| now > again).then(|| {
            self.warned = Some(now);
            Reaction::say(MavSeverity::MAV_SEVERITY_CRITICAL, "EKF variance")
        })
    }

    fn say_cleared(&mut self) -> Option<Reaction> {
        std::mem::take(&mut self.acted)
            .then(|| Reaction::say(MavSeverity::MAV_SEVERITY_CRITICAL, "EKF Failsafe Cleared"))
    }

    fn watch_glitches(&mut self, glitching: bool) -> Option<Reaction> {
        if glitching == self.glitching {
            return None;
        }
        self.glitching = glitching;
        let text = if glitching {
            "GPS Glitch or Compass error"
        } else {
            "Glitch cleared"
        };
        Some(Reaction::say(MavSeverity::MAV_SEVERITY_CRITICAL, text))
    }
}

/// Whether two of compass, velocity and position are beyond the threshold, or the velocity is beyond twice the
/// threshold.
pub(crate) fn is_over(estimator: &Estimator, threshold: f64) -> bool {
    let ratios = estimator.ratios();
    let mut over = u8::from(ratios.compass >= threshold);
    if ratios.velocity >= 2.0 * threshold {
        over += 2;
    } else if ratios.velocity >= threshold {
        over += 1;
    }
    (ratios.position >= threshold && over >= 1) || over >= 2
}
