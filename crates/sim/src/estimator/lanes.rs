//! Two cores of the estimator, each with its own accelerometer; one of them is in use.

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::{Estimator, NEGLIGIBLE_M, Surroundings};
use crate::kinematics::STEP_S;
use crate::texts;

/// The time to detect a stuck accelerometer, and the share of its error that enters the velocity
/// until then.
const LANE_PATIENCE: Duration = Duration::from_millis(300);
const STUCK_SHARE: f64 = 0.5;
/// The time constant with which the effect of a stuck accelerometer decays: the vehicle is
/// displaced by 1.4 m in total.
const CALM_S: f64 = 0.6;

impl Estimator {
    /// Models a stuck accelerometer, which misleads its core until the other core takes over.
    pub(super) fn watch_lanes(&mut self, around: &Surroundings<'_>, outbox: &mut Vec<MavMessage>) {
        let stuck = &around.faults.accelerometers_stuck_m_s2;
        let other_works = stuck[1 - self.lane] == 0.0;
        if stuck[self.lane] == 0.0 || !other_works {
            self.stuck_since = None;
            self.calm_down();
            return;
        }
        let since = *self.stuck_since.get_or_insert(around.now);
        let push = stuck[self.lane] * STUCK_SHARE * STEP_S;
        self.shake_m_s += DVec3::new(push, push, 0.0);
        if around.now >= since + LANE_PATIENCE {
            self.switch_lane(outbox);
            self.stuck_since = None;
        }
    }

    /// Lets the effect of a stuck accelerometer on the velocity decay.
    fn calm_down(&mut self) {
        self.shake_m_s *= 1.0 - STEP_S / CALM_S;
        if self.shake_m_s.length_squared() < NEGLIGIBLE_M {
            self.shake_m_s = DVec3::ZERO;
        }
    }

    pub(super) fn switch_lane(&mut self, outbox: &mut Vec<MavMessage>) {
        self.lane = 1 - self.lane;
        self.velocity_error_m_s = DVec3::ZERO;
        let text = format!("EKF3 lane switch {}", self.lane);
        texts::say(outbox, MavSeverity::MAV_SEVERITY_CRITICAL, &text);
        let text = format!("EKF primary changed:{}", self.lane);
        texts::say(outbox, MavSeverity::MAV_SEVERITY_WARNING, &text);
    }
}
