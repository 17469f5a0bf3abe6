//! The estimate: variances, lost positions, glitches.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Failsafe, FailsafeInputs};
use crate::estimator::Estimator;
use crate::mode::ModeId;
use crate::reaction::Reaction;

/// The number of bad checks (at 10 Hz) that trigger the failsafe, and of good ones that end it.
pub(super) const LOOKS: u8 = 10;
/// The minimum time between two texts `EKF variance`.
const WARNED_EVERY: Duration = Duration::from_secs(30);

/// The state of the EKF check.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct EkfWatch {
    pub(super) failures: u8,
    pub(super) bad: bool,
    /// Whether the failsafe changed the mode; if so, its end is reported.
    acted: bool,
    warned: Option<Duration>,
    glitching: bool,
}

impl EkfWatch {
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
        if !inputs.is_booted || (good && self.ekf.is_idle()) {
            return Vec::new();
        }
        let mut reactions = Vec::new();
        reactions.extend(self.ekf.watch_glitches(estimator.is_glitching()));
        if threshold <= 0.0 {
            self.ekf.failures = 0;
            reactions.extend(self.ekf.end());
            return reactions;
        }
        if trusted {
            self.ekf.failures = self.ekf.failures.saturating_sub(1);
            if self.ekf.failures == 0 {
                reactions.extend(self.ekf.end());
            }
        } else if !self.ekf.bad {
            self.ekf.failures += 1;
            if self.ekf.failures >= LOOKS {
                self.ekf.bad = true;
                reactions.extend(self.ekf.say_variance(inputs.now));
                reactions.extend(self.begin_ekf_failsafe(inputs));
            }
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

    fn end(&mut self) -> Option<Reaction> {
        self.bad = false;
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
