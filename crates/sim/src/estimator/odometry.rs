//! The small errors of a rover's estimate that need no fault: its heading is off by a degree, so that every change of
//! speed enters the estimated velocity in a slightly wrong direction, until the GPS corrects it. The figures were fitted to
//! the estimate of `ArduRover`'s EKF3 beside the true motion of its models.

use glam::DVec2;

use crate::body::Body;
use crate::kinematics::STEP_S;

/// The estimated heading, less the true one, and how much more it is off before the first drive.
const HEADING_OFF_DEG: f64 = 1.2;
const UNLEARNED_DEG: f64 = 1.0;
/// The time of driving, faster than a speed, in which the estimator learns that much of the heading.
const LEARNS_S: f64 = 4.5;
const LEARNS_FROM_M_S: f64 = 0.3;
/// The estimated velocity runs ahead of a steady acceleration by this time.
const AHEAD_S: f64 = 0.035;
/// The corrections by the GPS: how fast an error of the velocity decays, and the square of the frequency with which it
/// swings around zero.
const DECAY_PER_S: f64 = 0.45;
const SWING_PER_S2: f64 = 0.32;
/// The error of the position for each metre per second of the velocity's.
const POSITION_ERROR_S: f64 = 1.0;
/// The error of the velocity after the boot, north and east, which lasts until the vehicle moves.
const BOOT_ERROR_M_S: DVec2 = DVec2::new(-0.02, 0.017);

/// The errors of a rover's estimate.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Odometry {
    velocity_error_m_s: DVec2,
    /// The part of its change that has built up.
    drift_m_s2: DVec2,
    unlearned_deg: f64,
    has_moved: bool,
}

impl Default for Odometry {
    fn default() -> Self {
        Self {
            velocity_error_m_s: BOOT_ERROR_M_S,
            drift_m_s2: BOOT_ERROR_M_S * DECAY_PER_S,
            unlearned_deg: UNLEARNED_DEG,
            has_moved: false,
        }
    }
}

impl Odometry {
    /// Advances by one step with the true motion.
    pub(crate) fn step(&mut self, truth: &Body) {
        let speed_m_s = truth.velocity_m_s.length();
        self.has_moved |= speed_m_s > 0.0;
        if !self.has_moved {
            return;
        }
        if speed_m_s > LEARNS_FROM_M_S {
            self.unlearned_deg -= self.unlearned_deg * (STEP_S / LEARNS_S);
        }
        let accel = truth.accel_m_s2.truncate();
        let astray = accel.perp() * self.heading_off_deg().to_radians();
        let error = self.velocity_error_m_s;
        self.velocity_error_m_s += (astray + self.drift_m_s2 - error * DECAY_PER_S) * STEP_S;
        self.drift_m_s2 += (accel * AHEAD_S - error) * (SWING_PER_S2 * STEP_S);
    }

    /// Adds the errors to a body.
    pub(super) fn blur(&self, body: &mut Body) {
        body.position_m += (self.velocity_error_m_s * POSITION_ERROR_S).extend(0.0);
        body.velocity_m_s += self.velocity_error_m_s.extend(0.0);
        body.turn_by(self.heading_off_deg());
    }

    fn heading_off_deg(&self) -> f64 {
        HEADING_OFF_DEG + self.unlearned_deg
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body that drives north for a time with an acceleration, and the errors of its velocity forwards and to the right.
    fn driven(odometry: &mut Odometry, body: &mut Body, accel_m_s2: f64, seconds: f64) -> [f64; 2] {
        body.accel_m_s2.x = accel_m_s2;
        for _ in 0..(seconds / STEP_S) as u32 {
            body.velocity_m_s.x += accel_m_s2 * STEP_S;
            odometry.step(body);
        }
        odometry.velocity_error_m_s.to_array()
    }

    /// As measured on a real rover that gains 5 m/s in 5 s, drives on, brakes in 5 s and stands.
    #[test]
    fn a_changing_speed_puts_the_velocity_off_and_the_gps_corrects_it() {
        let (mut odometry, mut body) = (Odometry::default(), Body::resting(0.0));
        driven(&mut odometry, &mut body, 0.0, 60.0);
        assert_eq!(odometry, Odometry::default(), "it lasts");
        let [_, right] = driven(&mut odometry, &mut body, 1.0, 2.5);
        assert!((right - 0.03).abs() < 0.015, "{right}");
        driven(&mut odometry, &mut body, 1.0, 2.5);
        let [ahead, right] = driven(&mut odometry, &mut body, 0.0, 20.0);
        assert!(ahead.abs() < 0.005 && right.abs() < 0.005);
        let [behind, _] = driven(&mut odometry, &mut body, -1.0, 5.0);
        assert!((behind + 0.05).abs() < 0.025, "{behind}");
        let [_, right] = driven(&mut odometry, &mut body, 0.0, 2.0);
        assert!((right - 0.04).abs() < 0.02, "{right}");
    }

    #[test]
    fn the_heading_is_learned_while_driving_but_for_a_degree() {
        let (mut odometry, mut body) = (Odometry::default(), Body::resting(0.0));
        let off = |odometry: &Odometry| {
            let mut seen = Body::resting(90.0);
            odometry.blur(&mut seen);
            seen.yaw_deg - 90.0
        };
        driven(&mut odometry, &mut body, 0.0, 60.0);
        assert!((off(&odometry) - 2.2).abs() < 0.1);
        driven(&mut odometry, &mut body, 1.0, 5.0);
        assert!((off(&odometry) - 1.6).abs() < 0.2);
        driven(&mut odometry, &mut body, 0.0, 15.0);
        assert!((off(&odometry) - 1.2).abs() < 0.1);
    }
}
