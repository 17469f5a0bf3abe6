//! CIRCLE of a rover: around the place where the mode begins (`ModeCircle`).

use glam::DVec2;

use super::Cockpit;
use crate::control::FlatMotion;
use crate::helm::{CircleRules, Course};
use crate::kinematics::STEP_S;
use sortie_geo::maths;

/// The circle counts as reached within this distance, in metres, or within the turning circle.
const REACHED_M: f64 = 0.2;

/// A requested circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CirclePlace {
    pub(crate) centre_m: DVec2,
    pub(crate) radius_m: f64,
    pub(crate) is_counterclockwise: bool,
}

/// A circle that a rover drives.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DriveCircle {
    pub(crate) centre_m: DVec2,
    radius_m: f64,
    is_counterclockwise: bool,
    speed_m_s: f64,
    /// The limit of the speed with which the vehicle catches up.
    fastest_m_s: f64,
    /// The speed and the direction from the centre of the point that the vehicle follows.
    moving_m_s: f64,
    angle_rad: f64,
    turned_rad: f64,
    is_reached: bool,
}

impl DriveCircle {
    /// A circle around the vehicle, which it joins ahead.
    pub(super) fn here(cockpit: &Cockpit<'_>, rules: &CircleRules) -> Self {
        let speed_m_s = rules.speed_m_s();
        Self {
            centre_m: cockpit.body.position_m.truncate(),
            radius_m: rules.radius_m(),
            is_counterclockwise: rules.is_counterclockwise,
            speed_m_s,
            fastest_m_s: speed_m_s,
            moving_m_s: 0.0,
            angle_rad: cockpit.body.yaw_deg.to_radians(),
            turned_rad: 0.0,
            is_reached: false,
        }
    }

    /// A circle around a place, which the vehicle joins where it is nearest. The speed is that of CIRCLE.
    pub(crate) fn around(place: CirclePlace, cockpit: &Cockpit<'_>, rules: &CircleRules) -> Self {
        let from_centre_m = cockpit.body.position_m.truncate() - place.centre_m;
        let mut circle = Self::here(cockpit, rules);
        if from_centre_m != DVec2::ZERO {
            circle.angle_rad = maths::atan2(from_centre_m.y, from_centre_m.x);
        }
        Self {
            centre_m: place.centre_m,
            radius_m: rules.possible_radius_m(place.radius_m),
            is_counterclockwise: place.is_counterclockwise,
            ..circle
        }
    }

    /// How often the point that the vehicle follows has gone around.
    pub(crate) fn turns(&self) -> f64 {
        self.turned_rad / std::f64::consts::TAU
    }

    /// Sets another speed, or the highest one that the circle allows.
    pub(crate) fn set_speed(&mut self, speed_m_s: f64, rules: &CircleRules) {
        self.speed_m_s = speed_m_s.min(rules.fastest_m_s());
        self.fastest_m_s = self.fastest_m_s.max(self.speed_m_s);
    }

    pub(super) fn course(&mut self, cockpit: &Cockpit<'_>, rules: &CircleRules) -> Course {
        let from_centre_m = cockpit.body.position_m.truncate().distance(self.centre_m);
        let off_m = (from_centre_m - self.radius_m).abs();
        self.is_reached |= off_m <= rules.turn_radius_m.max(REACHED_M);
        let wanted = if self.is_reached { self.speed_m_s } else { 0.0 };
        let most = rules.accel_m_s2 * 0.5 * STEP_S;
        let faster = (wanted - self.moving_m_s).clamp(-most, most);
        self.moving_m_s += faster;
        let turn = self.moving_m_s / self.radius_m * STEP_S;
        self.turned_rad += turn;
        self.angle_rad += if self.is_counterclockwise {
            -turn
        } else {
            turn
        };
        Course::Follow {
            point: self.point(faster / STEP_S),
            fastest_m_s: self.fastest_m_s,
            backwards: false,
        }
    }

    /// The point to follow. Its velocity is that of a clockwise circle in either direction, as in `ArduRover`: a
    /// vehicle that circles counterclockwise is led by the place of the point alone.
    fn point(&self, faster_m_s2: f64) -> FlatMotion {
        let (sin, cos) = maths::sin_cos(self.angle_rad);
        let outwards = DVec2::new(cos, sin);
        let along = DVec2::new(-sin, cos);
        let towards_centre = self.moving_m_s * self.moving_m_s / self.radius_m;
        FlatMotion {
            place_m: self.centre_m + outwards * self.radius_m,
            velocity_m_s: along * self.moving_m_s,
            accel_m_s2: along * faster_m_s2 - outwards * towards_centre,
        }
    }
}
