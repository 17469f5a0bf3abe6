//! The estimate: variances, lost positions, glitches.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use crate::autopilot::Autopilot;
use crate::mode;

/// So many bad looks (at 10 Hz) make a failsafe, so many good ones end it.
const LOOKS: u8 = 10;
/// `EKF variance` is said this often at most.
const WARNED_EVERY: Duration = Duration::from_secs(30);

/// What was seen of the estimate.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct EkfWatch {
    failures: u8,
    bad: bool,
    /// Whether it made the vehicle change its mode: then its end is told.
    acted: bool,
    warned: Option<Duration>,
    glitching: bool,
}

impl EkfWatch {
    pub(super) fn is_bad(&self) -> bool {
        self.bad
    }

    /// Whether there is nothing to look after.
    fn is_idle(&self) -> bool {
        self.failures == 0 && !self.bad && !self.glitching
    }
}

impl Autopilot {
    pub(super) fn watch_estimate(&mut self) {
        let good = self.estimator.has_position() && self.estimator.fix().is_none();
        if !self.boot.is_over() || (good && self.failsafe.ekf.is_idle()) {
            return;
        }
        self.watch_glitches();
        let threshold = self.tuning.failsafes.ekf_threshold;
        if threshold <= 0.0 {
            self.failsafe.ekf.failures = 0;
            self.end_ekf_failsafe();
            return;
        }
        let passed = self.estimator.has_position() && !self.is_over(threshold);
        let watch = &mut self.failsafe.ekf;
        if passed {
            watch.failures = watch.failures.saturating_sub(1);
            if watch.failures == 0 {
                self.end_ekf_failsafe();
            }
        } else if !watch.bad {
            watch.failures += 1;
            if watch.failures >= LOOKS {
                watch.bad = true;
                self.say_variance();
                self.begin_ekf_failsafe();
            }
        }
    }

    /// Two of compass, velocity and position beyond the threshold, or the velocity beyond twice the threshold.
    fn is_over(&self, threshold: f64) -> bool {
        let ratios = self.estimator.ratios();
        let mut over = u8::from(ratios.compass >= threshold);
        if ratios.velocity >= 2.0 * threshold {
            over += 2;
        } else if ratios.velocity >= threshold {
            over += 1;
        }
        (ratios.position >= threshold && over >= 1) || over >= 2
    }

    fn say_variance(&mut self) {
        let now = self.uptime();
        let again = self.failsafe.ekf.warned.map(|at| at + WARNED_EVERY);
        if again.is_none_or(|again| now > again) {
            self.failsafe.ekf.warned = Some(now);
            self.say(MavSeverity::MAV_SEVERITY_CRITICAL, "EKF variance");
        }
    }

    /// Modes that need a position end; the others go on unless `FS_EKF_ACTION` is 3.
    fn begin_ekf_failsafe(&mut self) {
        let action = self.tuning.failsafes.ekf_action;
        let concerned = self.mode.needs_position() || action == 3;
        if !self.safety.armed || self.mode.number == mode::LAND || !concerned {
            return;
        }
        let held = action == 2 && !self.failsafe.radio_is_lost() && self.set_mode(mode::ALT_HOLD);
        if !held {
            self.land_after_pause();
        }
        self.failsafe.ekf.acted = true;
        let text = format!("EKF Failsafe: changed to {} Mode", self.mode.name);
        self.say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
    }

    fn end_ekf_failsafe(&mut self) {
        self.failsafe.ekf.bad = false;
        if std::mem::take(&mut self.failsafe.ekf.acted) {
            self.say(MavSeverity::MAV_SEVERITY_CRITICAL, "EKF Failsafe Cleared");
        }
    }

    fn watch_glitches(&mut self) {
        let glitching = self.estimator.is_glitching();
        if glitching == self.failsafe.ekf.glitching {
            return;
        }
        self.failsafe.ekf.glitching = glitching;
        let text = if glitching {
            "GPS Glitch or Compass error"
        } else {
            "Glitch cleared"
        };
        self.say(MavSeverity::MAV_SEVERITY_CRITICAL, text);
    }
}
