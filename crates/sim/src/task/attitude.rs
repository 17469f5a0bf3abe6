//! `SET_ATTITUDE_TARGET` in GUIDED: a lean, a heading or turning rate, and a climb or thrust.

use std::time::Duration;

use glam::DVec2;

use super::{Act, Cockpit};
use crate::control::FlatMotion;
use crate::kinematics::{GRAVITY_M_S2, STEP_S};
use sortie_geo::maths;

/// The greatest lean that is flown: beyond it, the horizontal part of the thrust would grow without bound.
const LEAN_MAX_RAD: f64 = 75.0 * std::f64::consts::PI / 180.0;

/// The control of the lift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Lift {
    /// A climb rate, metres per second upwards.
    Climb(f64),
    /// A share of the full thrust, if `GUID_OPTIONS` selects that.
    Thrust(f64),
}

/// An attitude requested by a ground station.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Attitude {
    /// Forward and right lean in radians; a setpoint that gives rates instead of an attitude
    /// changes it.
    pub(crate) lean_rad: DVec2,
    pub(crate) rates_rad_s: DVec2,
    pub(crate) lift: Lift,
    /// The time after which the vehicle levels and holds its height, without braking.
    pub(crate) until: Duration,
}

impl Attitude {
    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        if cockpit.now > self.until {
            self.lean_rad = DVec2::ZERO;
            self.rates_rad_s = DVec2::ZERO;
            self.lift = Lift::Climb(0.0);
        }
        let up = match self.lift {
            Lift::Climb(climb) | Lift::Thrust(climb) => climb,
        };
        if cockpit.body.on_ground && up <= 0.0 {
            return Act::Idle;
        }
        self.lean_rad = (self.lean_rad + self.rates_rad_s * STEP_S).clamp_length_max(LEAN_MAX_RAD);
        let lean =
            DVec2::new(maths::tan(self.lean_rad.x), maths::tan(self.lean_rad.y)) * GRAVITY_M_S2;
        let (sin, cos) = maths::sin_cos(cockpit.body.yaw_deg.to_radians());
        let flat = DVec2::new(lean.x * cos - lean.y * sin, lean.x * sin + lean.y * cos);
        let moving = cockpit.body.velocity_m_s.truncate();
        let here = cockpit.body.position_m.truncate();
        let limits = cockpit.limits;
        let climb = match self.lift {
            Lift::Climb(climb) => climb.clamp(-limits.speed_down_m_s, limits.speed_up_m_s),
            Lift::Thrust(_) => -cockpit.body.velocity_m_s.z,
        };
        cockpit
            .control
            .steered(&FlatMotion::steady(here, moving), -climb, &limits);
        if let Lift::Thrust(share) = self.lift
            && self.lean_rad == DVec2::ZERO
        {
            return Act::Throttle {
                share: share.max(0.0),
                lean_m_s2: DVec2::ZERO,
            };
        }
        let down = match self.lift {
            Lift::Climb(_) => cockpit.control.lift(cockpit.body),
            Lift::Thrust(share) => GRAVITY_M_S2 * (1.0 - share / cockpit.tuning.pilot.hover()),
        };
        Act::Accelerate(flat.extend(down))
    }
}
