//! A number of turns around a place (`AC_Circle`).

use glam::{DVec2, DVec3};

use super::super::{Act, Cockpit};
use crate::control::FlatMotion;
use crate::kinematics::STEP_S;
use crate::parameters::Parameters;
use crate::yaw::YawDemand;
use sortie_geo::maths;

/// A circle reaches its rate within a second, but with at least this acceleration (degrees per second squared).
const LEAST_SPIN_UP_DEG_S2: f64 = 2.0;

/// A circle under way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Orbit {
    centre_m: DVec3,
    radius_m: f64,
    /// The requested angular speed in radians per second, clockwise positive.
    wanted_rad_s: f64,
    rate_rad_s: f64,
    angle_rad: f64,
    turned_rad: f64,
}

impl Orbit {
    /// A circle that has not begun, at `CIRCLE_RATE`. With a radius of 0 the vehicle turns in
    /// place, regardless of `CIRCLE_RADIUS`, as a real vehicle did.
    pub(crate) fn around(
        centre_m: DVec3,
        radius_m: f64,
        counterclockwise: bool,
        all: &Parameters,
    ) -> Self {
        let rate = all.value("CIRCLE_RATE").clamp(-90.0, 90.0).abs();
        Self {
            centre_m,
            radius_m,
            wanted_rad_s: if counterclockwise { -rate } else { rate }.to_radians(),
            rate_rad_s: 0.0,
            angle_rad: 0.0,
            turned_rad: 0.0,
        }
    }

    /// The nearest point of the circle, at the height of its centre.
    pub(crate) fn nearest_m(&self, from_m: DVec3) -> DVec3 {
        self.centre_m + (self.outwards(from_m) * self.radius_m).extend(0.0)
    }

    /// Whether a place is so far outside that the nose may turn on the way to the circle.
    pub(crate) fn is_outside(&self, place_m: DVec3) -> bool {
        let off_m = (place_m - self.centre_m).truncate().length();
        off_m > self.radius_m && off_m > 5.0
    }

    /// Begins the circle at the vehicle's position.
    pub(crate) fn begin(&mut self, from_m: DVec3) {
        let outwards = self.outwards(from_m);
        self.angle_rad = maths::atan2(outwards.y, outwards.x);
    }

    /// The demand on the heading: towards the centre, or a turn in place.
    pub(crate) fn yaw(&self) -> YawDemand {
        if self.radius_m > 0.0 {
            YawDemand::Towards(self.centre_m.truncate())
        } else {
            YawDemand::Rate(self.wanted_rad_s.to_degrees())
        }
    }

    /// The number of turns flown.
    pub(crate) fn turns(&self) -> f64 {
        self.turned_rad.abs() / std::f64::consts::TAU
    }

    fn outwards(&self, from_m: DVec3) -> DVec2 {
        let way = (from_m - self.centre_m).truncate();
        way.try_normalize().unwrap_or(DVec2::X)
    }

    pub(in crate::task) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        if cockpit.body.on_ground {
            return Act::Idle;
        }
        let limits = cockpit.limits;
        let most_m_s = limits
            .speed_m_s
            .min((0.5 * limits.accel_m_s2 * self.radius_m).sqrt());
        let most = if self.radius_m > 0.0 {
            most_m_s / self.radius_m
        } else {
            f64::INFINITY
        };
        let wanted = self.wanted_rad_s.clamp(-most, most);
        let spin_up = wanted.abs().max(LEAST_SPIN_UP_DEG_S2.to_radians()) * STEP_S;
        self.rate_rad_s += (wanted - self.rate_rad_s).clamp(-spin_up, spin_up);
        self.angle_rad += self.rate_rad_s * STEP_S;
        self.turned_rad += self.rate_rad_s * STEP_S;
        let (sin, cos) = maths::sin_cos(self.angle_rad);
        let outwards = DVec2::new(cos, sin) * self.radius_m;
        let planned = FlatMotion {
            place_m: self.centre_m.truncate() + outwards,
            velocity_m_s: DVec2::new(-outwards.y, outwards.x) * self.rate_rad_s,
            accel_m_s2: -outwards * (self.rate_rad_s * self.rate_rad_s),
        };
        cockpit.control.along(&planned, self.centre_m.z, &limits);
        Act::Fly
    }
}
