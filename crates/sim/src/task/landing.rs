//! The descent of a landing, and its touchdown.

use std::time::Duration;

use super::{Act, Cockpit, piloted};
use crate::kinematics::square_root;

/// The delay from touchdown to the stop of the motors.
const MOTORS_OFF_AFTER: Duration = Duration::from_millis(700);

/// A landing under way.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Landing {
    /// When the vehicle touched the ground.
    pub(crate) touched: Option<Duration>,
    /// The time at which the descent begins.
    pub(crate) waits_until: Option<Duration>,
}

impl Landing {
    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        if cockpit.body.on_ground {
            let touched = *self.touched.get_or_insert(cockpit.now);
            if cockpit.now >= touched + MOTORS_OFF_AFTER {
                return Act::Idle;
            }
        } else {
            self.touched = None;
        }
        let tuning = cockpit.tuning;
        let above_low_m = cockpit.body.height_m() - tuning.land_altitude_low_m;
        // Below LAND_ALT_LOW the slow speed applies; the descent to it slows down like any other approach.
        let sink = square_root(above_low_m, 1.0, tuning.accel_z_m_s2).clamp(
            tuning.land_speed_m_s,
            tuning.land_speed_high_m_s.max(tuning.land_speed_m_s),
        );
        let moved = piloted::moved_landing(cockpit, 0.5 * cockpit.limits.accel_m_s2);
        let mut wanted = moved.extend(sink);
        if cockpit.body.on_ground || self.waits_until.is_some_and(|until| cockpit.now < until) {
            wanted.z = 0.0;
        }
        let limits = cockpit.limits;
        cockpit.control.at_velocity(wanted, &limits);
        if cockpit.has_position {
            Act::Fly
        } else {
            Act::Level
        }
    }
}
