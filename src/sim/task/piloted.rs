//! Modes that listen to a pilot's sticks (LOITER, `ALT_HOLD`, POSHOLD and their like).

use glam::DVec3;

use super::{Act, Cockpit};
use crate::sim::control::Limits;

/// The middle of the throttle stick within which the height is held (`THR_DZ`), in microseconds.
const DEAD_BAND_US: f64 = 100.0;
const CENTRE_US: f64 = 1500.0;
const TRAVEL_US: f64 = 500.0;
/// Sticks this close to the centre are at the centre.
const CENTRED_US: f64 = 20.0;
/// Top speed with the stick fully over, with drag: what `ANGLE_MAX` allows.
const STICK_SPEED_M_S: f64 = 10.0;

/// Pulse widths of roll, pitch, throttle and yaw, in microseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct Sticks {
    pub(in crate::sim) channels_us: [u16; 8],
}

impl Sticks {
    /// Sticks centred and throttle down, as a SITL without a transmitter sees them.
    pub(in crate::sim) const RELEASED: Self = Self {
        channels_us: [1500, 1500, 1000, 1500, 1800, 1000, 1000, 1800],
    };

    /// The throttle, 0 to 1.
    pub(in crate::sim) fn throttle(&self) -> f64 {
        ((f64::from(self.channels_us[2]) - 1000.0) / 1000.0).clamp(0.0, 1.0)
    }

    /// Whether the throttle is all the way down.
    pub(in crate::sim) fn throttle_is_low(&self) -> bool {
        self.channels_us[2] <= 1050
    }

    fn share(&self, channel: usize) -> f64 {
        let off = f64::from(self.channels_us[channel]) - CENTRE_US;
        if off.abs() <= CENTRED_US {
            0.0
        } else {
            (off / TRAVEL_US).clamp(-1.0, 1.0)
        }
    }
}

pub(super) fn step(cockpit: &mut Cockpit<'_>) -> Act {
    let tuning = cockpit.tuning;
    let off = f64::from(cockpit.sticks.channels_us[2]) - CENTRE_US;
    let share = ((off.abs() - DEAD_BAND_US) / (TRAVEL_US - DEAD_BAND_US)).clamp(0.0, 1.0);
    let climb = if off > 0.0 {
        share * tuning.pilot_up_m_s
    } else {
        -share * tuning.pilot_down_m_s
    };
    if cockpit.body.on_ground && climb <= 0.0 {
        return Act::Idle;
    }
    let (sin, cos) = cockpit.body.yaw_deg.to_radians().sin_cos();
    let right = cockpit.sticks.share(0) * STICK_SPEED_M_S;
    let forward = -cockpit.sticks.share(1) * STICK_SPEED_M_S;
    let wanted = DVec3::new(
        forward * cos - right * sin,
        forward * sin + right * cos,
        -climb,
    );
    let wanted = cockpit.keep_inside(wanted);
    let limits = Limits {
        accel_z_m_s2: tuning.pilot_accel_z_m_s2,
        accel_m_s2: tuning.brake_accel_m_s2,
        ..cockpit.limits
    };
    cockpit.control.at_velocity(wanted, &limits);
    Act::Fly
}
