//! `ArduPilot`'s position control: a jerk- and acceleration-limited path towards the target (its square-root
//! controller, `AP_Math/control.cpp`), and the feedback control that follows the path.

use glam::{DVec2, DVec3};

use super::body::Body;
use super::kinematics::{STEP_S, square_root};

/// Gains of the feedback (`PSC_POSXY_P`, `PSC_VELXY_P`, `_I`, `_D`, `PSC_POSZ_P`, `PSC_VELZ_P`).
const POSITION_P: f64 = 1.0;
const VELOCITY_P: f64 = 2.0;
const VELOCITY_I: f64 = 1.0;
const VELOCITY_D: f64 = 0.5;
/// Share of a new slope in the filtered one in each step: `1 - exp(-2 pi f dt)` with a filter of 5 Hz.
const VELOCITY_D_BLEND: f64 = 0.269_597_308_951_354_36;
const HEIGHT_P: f64 = 1.0;
const CLIMB_P: f64 = 5.0;
/// The limit of the integrator (`PSC_VELXY_IMAX`).
const INTEGRAL_MAX_M_S2: f64 = 10.0;

/// The increase of vertical acceleration for a speed beyond its limit, per share of the limit.
const OVERSPEED_GAIN_Z: f64 = 2.0;

/// The maximum downward acceleration of a path, in m/s², regardless of its [`Limits`].
const FALL_MAX_M_S2: f64 = 7.5;

/// The limits of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub(super) speed_m_s: f64,
    pub(super) speed_up_m_s: f64,
    pub(super) speed_down_m_s: f64,
    pub(super) accel_m_s2: f64,
    pub(super) accel_z_m_s2: f64,
    pub(super) jerk_m_s3: f64,
    pub(super) jerk_z_m_s3: f64,
}

impl Limits {
    /// The limits for a path that climbs or descends too fast: its vertical speed may change faster
    /// (`POSCONTROL_OVERSPEED_GAIN_Z`), so a demanded velocity takes effect regardless of speed
    /// limits.
    pub(super) fn overspeed(self, down_m_s: f64) -> Self {
        let most = if down_m_s < 0.0 {
            self.speed_up_m_s
        } else {
            self.speed_down_m_s
        };
        let share = down_m_s.abs() / most.max(0.1);
        if share <= 1.0 {
            return self;
        }
        Self {
            accel_z_m_s2: self.accel_z_m_s2 * OVERSPEED_GAIN_Z * share,
            jerk_z_m_s3: self.jerk_z_m_s3 * OVERSPEED_GAIN_Z * share,
            ..self
        }
    }
}

/// The path and the state of the feedback control.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PositionControl {
    /// The position on the path, in metres north, east and down.
    pub(super) path_m: DVec3,
    /// The velocity on the path.
    pub(super) velocity_m_s: DVec3,
    accel_m_s2: DVec3,
    integral_m_s2: DVec2,
    last_error_m: DVec2,
    last_moving_m_s: DVec2,
    last_error_m_s: DVec2,
    slope_m_s2: DVec2,
    /// The demanded acceleration at the limit of the lean; otherwise zero.
    saturated: DVec2,
}

/// A horizontal motion, north and east.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlatMotion {
    pub(super) place_m: DVec2,
    pub(super) velocity_m_s: DVec2,
    pub(super) accel_m_s2: DVec2,
}

impl FlatMotion {
    /// A motion that keeps its velocity.
    pub(super) fn steady(place_m: DVec2, velocity_m_s: DVec2) -> Self {
        Self {
            place_m,
            velocity_m_s,
            accel_m_s2: DVec2::ZERO,
        }
    }
}

impl PositionControl {
    /// A path at the body's position, with its motion.
    pub(super) fn at(body: &Body) -> Self {
        let mut control = Self {
            path_m: body.position_m,
            velocity_m_s: body.velocity_m_s,
            accel_m_s2: DVec3::ZERO,
            integral_m_s2: DVec2::ZERO,
            last_error_m: DVec2::ZERO,
            last_moving_m_s: DVec2::ZERO,
            last_error_m_s: DVec2::ZERO,
            slope_m_s2: DVec2::ZERO,
            saturated: DVec2::ZERO,
        };
        control.take_over(body);
        control
    }

    /// Starts again from the body's current state, without a jolt in the lean: the integrator takes
    /// over the whole lean, and the path starts without acceleration (`init_xy_controller`).
    pub(super) fn take_over(&mut self, body: &Body) {
        self.path_m = body.position_m;
        self.velocity_m_s = body.velocity_m_s;
        self.accel_m_s2 = DVec3::ZERO;
        self.integral_m_s2 = body.lean_m_s2;
        self.last_error_m = DVec2::ZERO;
        self.last_error_m_s = DVec2::ZERO;
        self.slope_m_s2 = DVec2::ZERO;
        self.saturated = DVec2::ZERO;
    }

    /// Moves the path towards a point.
    pub(super) fn towards(&mut self, goal_m: DVec3, limits: &Limits) {
        let way = goal_m - self.path_m;
        let speeds = speeds_along(way, limits);
        let kv = 0.5 * limits.jerk_m_s3 / limits.accel_m_s2;
        let distance = way.truncate().length();
        let pace = square_root(distance, kv, 0.5 * limits.accel_m_s2).min(speeds.horizontal);
        let wanted = way.truncate().normalize_or_zero() * pace;
        let kv_z = 0.5 * limits.jerk_z_m_s3 / limits.accel_z_m_s2;
        let climb = square_root(way.z, kv_z, 0.5 * limits.accel_z_m_s2)
            .clamp(-speeds.vertical, speeds.vertical);
        self.at_velocity(wanted.extend(climb), limits);
    }

    /// Moves the path towards a point that itself moves: its velocity is added, and the path need not be straight
    /// (`input_pos_vel_accel_xy`, `_z`).
    pub(super) fn chase(&mut self, goal_m: DVec3, moving_m_s: DVec3, limits: &Limits) {
        let way = goal_m - self.path_m;
        let kv = 0.5 * limits.jerk_m_s3 / limits.accel_m_s2;
        let flat = way.truncate();
        let pace = square_root(flat.length(), kv, 0.5 * limits.accel_m_s2).min(limits.speed_m_s);
        let kv_z = 0.5 * limits.jerk_z_m_s3 / limits.accel_z_m_s2;
        let climb = square_root(way.z, kv_z, 0.5 * limits.accel_z_m_s2)
            .clamp(-limits.speed_up_m_s, limits.speed_down_m_s);
        let wanted = (flat.normalize_or_zero() * pace).extend(climb);
        self.at_velocity(wanted + moving_m_s, limits);
    }

    /// The stopping point of the path at the allowed deceleration, gentle at the end.
    pub(super) fn stopping_point(&self, limits: &Limits) -> DVec2 {
        let velocity = self.velocity_m_s.truncate();
        let speed = velocity.length();
        let slow = limits.accel_m_s2 / POSITION_P;
        let way_m = if speed < slow {
            speed / POSITION_P
        } else {
            (slow / POSITION_P + speed * speed / limits.accel_m_s2) * 0.5
        };
        self.path_m.truncate() + velocity.normalize_or_zero() * way_m
    }

    /// Brings the path to a velocity; vertical speed limits do not apply, as in `ArduPilot`.
    pub(super) fn at_velocity(&mut self, wanted_m_s: DVec3, limits: &Limits) {
        let error = wanted_m_s - self.velocity_m_s;
        let flat = error.truncate();
        let ka = limits.jerk_m_s3 / limits.accel_m_s2;
        let push = square_root(flat.length(), ka, limits.jerk_m_s3).min(limits.accel_m_s2);
        let ka_z = limits.jerk_z_m_s3 / limits.accel_z_m_s2;
        let lift = square_root(error.z, ka_z, limits.jerk_z_m_s3)
            .clamp(-limits.accel_z_m_s2, limits.accel_z_m_s2.min(FALL_MAX_M_S2));
        self.at_acceleration((flat.normalize_or_zero() * push).extend(lift), limits);
    }

    /// Brings the path to an acceleration.
    pub(super) fn at_acceleration(&mut self, wanted_m_s2: DVec3, limits: &Limits) {
        self.advance();
        let change = wanted_m_s2 - self.accel_m_s2;
        let flat = change
            .truncate()
            .clamp_length_max(limits.jerk_m_s3 * STEP_S);
        let z_max = limits.jerk_z_m_s3 * STEP_S;
        self.accel_m_s2 += flat.extend(change.z.clamp(-z_max, z_max));
    }

    /// Puts the horizontal path onto a planned trajectory and moves the height towards `down_m`.
    pub(super) fn along(&mut self, planned: &FlatMotion, down_m: f64, limits: &Limits) {
        let hold = self.path_m.truncate().extend(down_m);
        self.velocity_m_s = DVec2::ZERO.extend(self.velocity_m_s.z);
        self.accel_m_s2 = DVec2::ZERO.extend(self.accel_m_s2.z);
        self.towards(hold, limits);
        self.path_m = planned.place_m.extend(self.path_m.z);
        self.velocity_m_s = planned.velocity_m_s.extend(self.velocity_m_s.z);
        self.accel_m_s2 = planned.accel_m_s2.extend(self.accel_m_s2.z);
    }

    /// Puts the horizontal path where a pilot steers it (place, velocity, acceleration) and brings the height to a
    /// vertical speed, positive down.
    pub(super) fn steered(&mut self, planned: &FlatMotion, down_m_s: f64, limits: &Limits) {
        self.velocity_m_s = DVec2::ZERO.extend(self.velocity_m_s.z);
        self.accel_m_s2 = DVec2::ZERO.extend(self.accel_m_s2.z);
        self.at_velocity(DVec3::new(0.0, 0.0, down_m_s), limits);
        self.path_m = planned.place_m.extend(self.path_m.z);
        self.velocity_m_s = planned.velocity_m_s.extend(self.velocity_m_s.z);
        self.accel_m_s2 = planned.accel_m_s2.extend(self.accel_m_s2.z);
    }

    /// The downward acceleration that makes the body follow the path's height.
    pub(super) fn lift(&self, body: &Body) -> f64 {
        let off_m = self.path_m.z - body.position_m.z;
        let climb = self.velocity_m_s.z + off_m * HEIGHT_P - body.velocity_m_s.z;
        self.accel_m_s2.z + climb * CLIMB_P
    }

    /// The horizontal motion of the path.
    pub(super) fn flat_motion(&self) -> FlatMotion {
        FlatMotion {
            place_m: self.path_m.truncate(),
            velocity_m_s: self.velocity_m_s.truncate(),
            accel_m_s2: self.accel_m_s2.truncate(),
        }
    }

    /// Puts the path, with its motion, onto a planned one.
    pub(super) fn follow(&mut self, at_m: DVec3, velocity_m_s: DVec3, accel_m_s2: DVec3) {
        self.path_m = at_m;
        self.velocity_m_s = velocity_m_s;
        self.accel_m_s2 = accel_m_s2;
    }

    /// Brings the path nearer to a body that has been blown far away from it (`AC_P_2D::update_all`); returns by how much
    /// it moved.
    pub(super) fn drag_along(&mut self, body: &Body, limits: &Limits) -> Option<DVec3> {
        let off_m = (self.path_m - body.position_m).truncate();
        let furthest_m = furthest_m(limits);
        if off_m.length_squared() <= furthest_m * furthest_m {
            return None;
        }
        let shift_m = (off_m.clamp_length_max(furthest_m) - off_m).extend(0.0);
        self.path_m += shift_m;
        Some(shift_m)
    }

    /// The acceleration that makes the body follow the path, within the allowed lean. A large position error is
    /// corrected with a limited acceleration (`correction_m_s2`).
    pub(super) fn demand(
        &mut self,
        body: &Body,
        lean_max_m_s2: f64,
        correction_m_s2: f64,
    ) -> DVec3 {
        let error_m = self.path_m - body.position_m;
        let off_m = error_m.truncate();
        self.last_error_m = off_m;
        self.last_moving_m_s = body.velocity_m_s.truncate();
        let back = square_root(off_m.length(), POSITION_P, correction_m_s2);
        let wanted = self.velocity_m_s.truncate() + off_m.normalize_or_zero() * back;
        let error = wanted - body.velocity_m_s.truncate();
        let slope = (error - self.last_error_m_s) / STEP_S;
        self.slope_m_s2 += (slope - self.slope_m_s2) * VELOCITY_D_BLEND;
        self.last_error_m_s = error;
        // At the limit of the lean, the integrator may turn, but not grow.
        let most = if self.saturated.dot(error) > 0.0 {
            self.integral_m_s2.length().min(INTEGRAL_MAX_M_S2)
        } else {
            INTEGRAL_MAX_M_S2
        };
        self.integral_m_s2 =
            (self.integral_m_s2 + error * (VELOCITY_I * STEP_S)).clamp_length_max(most);
        let raw = self.accel_m_s2.truncate()
            + error * VELOCITY_P
            + self.integral_m_s2
            + self.slope_m_s2 * VELOCITY_D;
        let flat = if raw.length_squared() > lean_max_m_s2 * lean_max_m_s2 {
            self.saturated = raw;
            within(raw, self.velocity_m_s.truncate(), lean_max_m_s2)
        } else {
            self.saturated = DVec2::ZERO;
            raw
        };
        let climb = self.velocity_m_s.z + error_m.z * HEIGHT_P - body.velocity_m_s.z;
        flat.extend(self.accel_m_s2.z + climb * CLIMB_P)
    }

    /// The vertical part of the demand; horizontally the path stays with the body.
    pub(super) fn demand_level(&mut self, body: &Body) -> f64 {
        let (height_m, climb_m_s, lift_m_s2) =
            (self.path_m.z, self.velocity_m_s.z, self.accel_m_s2.z);
        self.take_over(body);
        self.path_m.z = height_m;
        self.velocity_m_s.z = climb_m_s;
        self.accel_m_s2 = DVec3::new(0.0, 0.0, lift_m_s2);
        self.integral_m_s2 = DVec2::ZERO;
        let climb = climb_m_s + (height_m - body.position_m.z) * HEIGHT_P - body.velocity_m_s.z;
        lift_m_s2 + climb * CLIMB_P
    }

    /// Advances the path. At the limit of the lean, the path waits for the body (`update_pos_vel_accel_xy`).
    fn advance(&mut self) {
        let mut delta_m_s = self.accel_m_s2 * STEP_S;
        let mut delta_m = self.velocity_m_s * STEP_S + self.accel_m_s2 * (0.5 * STEP_S * STEP_S);
        let along = |v: DVec2| v.dot(self.saturated);
        if along(delta_m.truncate()) > 0.0 && along(self.last_error_m) > 0.0 {
            // ArduPilot stops and starts in every step, so the path keeps its distance from the
            // body.
            let most_m = (self.last_moving_m_s.length() * STEP_S).min(delta_m.truncate().length());
            delta_m = (delta_m.truncate().normalize_or_zero() * most_m).extend(delta_m.z);
        }
        let faster = along(delta_m_s.truncate()) > 0.0;
        let forward = along(self.velocity_m_s.truncate()) >= 0.0;
        if faster && forward && along(self.last_error_m_s) > 0.0 {
            delta_m_s = DVec2::ZERO.extend(delta_m_s.z);
        }
        self.path_m += delta_m;
        self.velocity_m_s += delta_m_s;
    }
}

/// The distance from which the feedback would ask for more than the highest speed.
fn furthest_m(limits: &Limits) -> f64 {
    let linear_m_s = limits.accel_m_s2 / POSITION_P;
    if limits.speed_m_s <= linear_m_s {
        return limits.speed_m_s / POSITION_P;
    }
    let speed_2 = limits.speed_m_s * limits.speed_m_s;
    (linear_m_s / POSITION_P + speed_2 / limits.accel_m_s2) * 0.5
}

/// An acceleration limited to `most`: the part across the path takes precedence over the part along
/// it (`limit_accel_xy`).
fn within(accel: DVec2, moving: DVec2, most: f64) -> DVec2 {
    let Some(way) = moving.try_normalize() else {
        return accel.clamp_length_max(most);
    };
    let along = accel.dot(way);
    let across = (accel - way * along).clamp_length_max(most);
    let left = (most * most - across.length_squared()).max(0.0).sqrt();
    across + way * along.clamp(-left, left)
}

struct Speeds {
    horizontal: f64,
    vertical: f64,
}

/// The speeds for a straight path that stay within both the horizontal and the vertical limit.
fn speeds_along(way: DVec3, limits: &Limits) -> Speeds {
    let vertical_max = if way.z < 0.0 {
        limits.speed_up_m_s
    } else {
        limits.speed_down_m_s
    };
    let length = way.length();
    if length < 1e-6 {
        return Speeds {
            horizontal: limits.speed_m_s,
            vertical: vertical_max,
        };
    }
    let flat = way.truncate().length() / length;
    let steep = way.z.abs() / length;
    let by_flat = if flat > 1e-6 {
        limits.speed_m_s / flat
    } else {
        f64::INFINITY
    };
    let by_steep = if steep > 1e-6 {
        vertical_max / steep
    } else {
        f64::INFINITY
    };
    let speed = by_flat.min(by_steep);
    Speeds {
        horizontal: (speed * flat).max(0.01),
        vertical: (speed * steep).max(0.01),
    }
}
