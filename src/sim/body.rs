//! The airframe as a point mass whose lean follows what the autopilot asks with a lag.

use glam::{DVec2, DVec3};

/// Standard gravity, in metres per second squared.
pub(super) const GRAVITY_M_S2: f64 = 9.806_65;
/// The step of the simulation, in seconds.
pub(super) const STEP_S: f64 = 0.01;
/// Lag of the lean behind its demand (`ArduPilot`'s `ATC_INPUT_TC`).
const LEAN_LAG_S: f64 = 0.15;
/// Lag of the vertical acceleration behind its demand.
const THRUST_LAG_S: f64 = 0.08;
/// Drag per mass is `MOMENTUM_DRAG v + FORM_DRAG v²`. Fitted to a SITL quad that needs 11.65° of lean at 5 m/s and
/// 29.1° at 10.05 m/s. The first part comes from the rotors' inflow and is absent when they stand still.
const MOMENTUM_DRAG_PER_S: f64 = 0.266;
const FORM_DRAG_PER_M: f64 = 0.0276;
/// Most thrust, in weights (the inverse of the hover throttle).
const THRUST_MAX_G: f64 = 2.7;
/// Throttle that holds the vehicle in the air, and what climbing adds by the inflow into the rotors, per square of
/// the climb rate: fitted to 39 % at 2.5 m/s and 72 % at 8.27 m/s.
const HOVER_THROTTLE: f64 = 0.36;
const THROTTLE_PER_CLIMB2: f64 = 0.0042;

/// What the autopilot asks of the airframe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Demand {
    /// Motors stand still or idle without lifting.
    Off,
    /// An acceleration (north, east, down) by leaning and by thrust; gravity is not part of it.
    Acceleration(DVec3),
    /// A share of the full throttle, 0 to 1, level: a pilot's stick in a manual mode.
    Throttle(f64),
}

/// Position, motion and attitude: the truth of one vehicle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    /// Metres north, east and down from the start.
    pub(super) position_m: DVec3,
    /// Metres per second.
    pub(super) velocity_m_s: DVec3,
    /// Metres per second squared, as it really was in the last step.
    pub(super) accel_m_s2: DVec3,
    /// The horizontal acceleration that the present lean makes.
    pub(super) lean_m_s2: DVec2,
    lift_m_s2: f64,
    /// Where the nose points, in degrees clockwise from north, unwrapped.
    pub(super) yaw_deg: f64,
    pub(super) yaw_rate_deg_s: f64,
    pub(super) on_ground: bool,
    /// The propellers are broken: the motors no longer lift.
    pub(super) wrecked: bool,
    /// 0 to 1.
    pub(super) throttle: f64,
    previous_angles_rad: (f64, f64),
    /// Roll and pitch rates, radians per second.
    pub(super) angle_rates_rad_s: (f64, f64),
}

impl Body {
    /// At rest on the ground.
    pub(super) fn resting(yaw_deg: f64) -> Self {
        Self {
            position_m: DVec3::ZERO,
            velocity_m_s: DVec3::ZERO,
            accel_m_s2: DVec3::ZERO,
            lean_m_s2: DVec2::ZERO,
            lift_m_s2: 0.0,
            yaw_deg,
            yaw_rate_deg_s: 0.0,
            on_ground: true,
            wrecked: false,
            throttle: 0.0,
            previous_angles_rad: (0.0, 0.0),
            angle_rates_rad_s: (0.0, 0.0),
        }
    }

    /// Height above the start, in metres.
    pub(super) fn height_m(&self) -> f64 {
        -self.position_m.z
    }

    /// Roll and pitch in radians: the lean turned into the body's axes.
    pub(super) fn roll_pitch_rad(&self) -> (f64, f64) {
        if self.lean_m_s2 == DVec2::ZERO {
            return (0.0, 0.0);
        }
        let (sin, cos) = self.yaw_deg.to_radians().sin_cos();
        let forward = self.lean_m_s2.x * cos + self.lean_m_s2.y * sin;
        let right = -self.lean_m_s2.x * sin + self.lean_m_s2.y * cos;
        let pitch = -(forward / GRAVITY_M_S2).atan();
        (((right * pitch.cos()) / GRAVITY_M_S2).atan(), pitch)
    }

    /// Moves on by one step through air that moves with `wind_m_s`. Returns the speed of a touchdown.
    pub(super) fn step(&mut self, demand: Demand, wind_m_s: DVec3) -> Option<f64> {
        let demand = if self.wrecked { Demand::Off } else { demand };
        if self.on_ground && demand == Demand::Off {
            self.rest();
            return None;
        }
        let airspeed = self.velocity_m_s - wind_m_s;
        let powered = demand != Demand::Off;
        let drag = self.drag(airspeed, powered);
        let lift_up = self.lift(demand, drag);
        self.lean(demand);
        let accel = DVec3::new(
            self.lean_m_s2.x - drag.x,
            self.lean_m_s2.y - drag.y,
            GRAVITY_M_S2 - lift_up - drag.z,
        );
        self.accel_m_s2 = accel;
        self.velocity_m_s += accel * STEP_S;
        self.position_m += self.velocity_m_s * STEP_S;
        self.note_angles();
        self.touch_ground()
    }

    /// Turns the nose: `rate_deg_s` is what the autopilot wants now.
    pub(super) fn turn(&mut self, rate_deg_s: f64) {
        self.yaw_rate_deg_s = rate_deg_s;
        self.yaw_deg += rate_deg_s * STEP_S;
        if self.yaw_deg.abs() > 720.0 {
            self.yaw_deg = self.yaw_deg.rem_euclid(360.0);
        }
    }

    /// A collision: the velocity changes by so much, and the propellers break.
    pub(super) fn hit(&mut self, change_m_s: DVec3) {
        self.velocity_m_s += change_m_s;
        self.wrecked = true;
    }

    fn rest(&mut self) {
        self.accel_m_s2 = DVec3::ZERO;
        self.velocity_m_s = DVec3::ZERO;
        self.lean_m_s2 = DVec2::ZERO;
        self.lift_m_s2 = 0.0;
        self.throttle = 0.0;
        self.previous_angles_rad = (0.0, 0.0);
        self.angle_rates_rad_s = (0.0, 0.0);
    }

    fn drag(&self, airspeed: DVec3, powered: bool) -> DVec3 {
        if self.on_ground {
            return DVec3::ZERO;
        }
        let momentum = if powered { MOMENTUM_DRAG_PER_S } else { 0.0 };
        (airspeed.truncate() * momentum).extend(0.0)
            + airspeed * (FORM_DRAG_PER_M * airspeed.length())
    }

    /// The thrust upwards per mass after lag and saturation; also sets the throttle.
    fn lift(&mut self, demand: Demand, drag: DVec3) -> f64 {
        match demand {
            Demand::Off => {
                self.lift_m_s2 = 0.0;
                self.throttle = 0.0;
                0.0
            }
            Demand::Throttle(throttle) => {
                self.throttle = throttle;
                self.lift_m_s2 = 0.0;
                throttle / HOVER_THROTTLE * GRAVITY_M_S2
            }
            Demand::Acceleration(wanted) => {
                let blend = STEP_S / (STEP_S + THRUST_LAG_S);
                self.lift_m_s2 += (-wanted.z - self.lift_m_s2) * blend;
                let wanted_up = GRAVITY_M_S2 + self.lift_m_s2 - drag.z;
                let sideways = self.lean_m_s2.length_squared();
                let most = (THRUST_MAX_G * GRAVITY_M_S2).powi(2) - sideways;
                let up = wanted_up.clamp(0.0, most.max(0.0).sqrt());
                let thrust_g = (up * up + sideways).sqrt() / GRAVITY_M_S2;
                let climb = -self.velocity_m_s.z;
                self.throttle = (HOVER_THROTTLE * thrust_g
                    + THROTTLE_PER_CLIMB2 * climb * climb.abs())
                .clamp(0.01, 1.0);
                up
            }
        }
    }

    fn lean(&mut self, demand: Demand) {
        let wanted = match demand {
            Demand::Acceleration(accel) => accel.truncate(),
            Demand::Off | Demand::Throttle(_) => DVec2::ZERO,
        };
        self.lean_m_s2 += (wanted - self.lean_m_s2) * (STEP_S / (STEP_S + LEAN_LAG_S));
    }

    fn note_angles(&mut self) {
        let (roll, pitch) = self.roll_pitch_rad();
        let (old_roll, old_pitch) = self.previous_angles_rad;
        self.angle_rates_rad_s = ((roll - old_roll) / STEP_S, (pitch - old_pitch) / STEP_S);
        self.previous_angles_rad = (roll, pitch);
    }

    /// Stops at the ground; the speed of the impact if the vehicle was in the air.
    fn touch_ground(&mut self) -> Option<f64> {
        if self.position_m.z < 0.0 {
            if self.position_m.z < -0.02 {
                self.on_ground = false;
            }
            return None;
        }
        let impact = (!self.on_ground).then_some(self.velocity_m_s.z);
        self.position_m.z = 0.0;
        self.velocity_m_s = DVec3::ZERO;
        self.lean_m_s2 = DVec2::ZERO;
        self.accel_m_s2 = DVec3::ZERO;
        self.on_ground = true;
        impact
    }
}
