//! Rotation as a rigid body, for a vehicle that has lost the full use of its motors: the force of
//! each motor, and the attitude control that tries to keep the vehicle upright. Vehicles in normal
//! flight do not use this model. In aviation, an upset is an unintended attitude.

use glam::{DMat3, DQuat, DVec3};

use super::airframe::{Airframe, Conditions};
use super::kinematics::square_root;
use super::kinematics::{GRAVITY_M_S2, STEP_S};
use super::mixer::{MOTORS_MAX, Mixer};
use sortie_geo::maths;

/// Rounds of the attitude control in one step of the simulation.
const ROUNDS: usize = 4;
const ROUND_S: f64 = STEP_S / ROUNDS as f64;
/// The defaults of `ATC_ANG_RLL_P` and `ATC_ACCEL_R_MAX`.
const ANGLE_P: f64 = 4.5;
const TURN_ACCEL_RAD_S2: f64 = 19.2;
/// `ATC_RAT_RLL_*` and `ATC_RAT_YAW_*` of the default quad; the filters in hertz.
const RATE_P: DVec3 = DVec3::new(0.135, 0.135, 0.3);
const RATE_I: DVec3 = DVec3::new(0.135, 0.135, 0.02);
const RATE_D: DVec3 = DVec3::new(0.0036, 0.0036, 0.0);
const INTEGRAL_MAX: f64 = 0.5;
const SLOPE_FILTER_HZ: f64 = 20.0;
/// Above this lean error, in radians, heading control is reduced; above twice this error, it is
/// off.
const YAW_FREE_RAD: f64 = std::f64::consts::FRAC_PI_6;
/// Near full throttle, less lean is allowed: the share of the full throttle that may be spent on
/// leaning, the minimum lean, and the time this takes (`ATC_ANG_LIM_TC`).
const LEAN_THROTTLE: f64 = 0.8;
const LEAN_LEAST_RAD: f64 = 0.175;
const LEAN_LIMIT_S: f64 = 1.0;
/// The integrator of the climb, per second: `PSC_ACCZ_I` in accelerations.
const CLIMB_I_PER_S: f64 = 2.7;
/// The motors' approximate share of the thrust range at the beginning; they reach any other share
/// within a few rounds.
const HOVER_SHARE: f64 = 0.4;
/// The greatest rotation rate (as in `SIM_Aircraft`), in radians per second.
const TURN_MAX_RAD_S: f64 = 34.9;
/// The lean error and the rotation rate below which a vehicle has recovered.
const CALM_RAD: f64 = 0.1;
const CALM_RAD_S: f64 = 0.4;

/// A motor with a fault (`SIM_ENGINE_FAIL`, `SIM_ENGINE_MUL`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MotorFault {
    /// The motor that fails, counted from 0.
    pub(super) motor: usize,
    /// The factor on its pulse.
    pub(super) multiplier: f64,
}

/// A vehicle that may have lost its attitude: attitude, rotation, and the state of the controllers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Upset {
    attitude: DQuat,
    /// Radians per second about the body's axes.
    pub(super) rates_rad_s: DVec3,
    pub(super) mixer: Mixer,
    /// The angle between the wanted and the real direction of the thrust, in radians.
    pub(super) error_rad: f64,
    /// The thrust of all motors together per mass, from which the power follows.
    pub(super) thrust_m_s2: f64,
    /// The thrust per mass that the autopilot demands of all motors.
    pub(super) asked_m_s2: f64,
    /// The greatest lean at the current throttle, in radians.
    lean_max_rad: f64,
    /// The wanted direction of the thrust in the last step.
    last_up: DVec3,
    integral: DVec3,
    last_error: DVec3,
    slope: DVec3,
    climb_integral_m_s2: f64,
    real_shares: [f64; MOTORS_MAX],
}

/// The target of the attitude control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WantedTurn {
    /// The direction of the thrust in the world, of length 1.
    pub(super) up: DVec3,
    pub(super) yaw_rate_rad_s: f64,
    /// Thrust per mass, upwards; `None` with the motors off.
    pub(super) lift_m_s2: Option<f64>,
}

/// The airframe, the conditions and the faults that determine the motors' effect.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drive<'a> {
    pub(super) airframe: &'a Airframe,
    pub(super) conditions: &'a Conditions,
    pub(super) fault: Option<MotorFault>,
    /// Whether all propellers are broken.
    pub(super) wrecked: bool,
}

impl Upset {
    /// The beginning of an upset: the attitude of a healthy vehicle, given by its forward, right
    /// and up axes, and its rotation rates.
    pub(super) fn new(axes: [DVec3; 3], rates_rad_s: DVec3) -> Self {
        let [forward, right, up] = axes;
        Self {
            attitude: DQuat::from_mat3(&DMat3::from_cols(forward, right, -up)).normalize(),
            rates_rad_s,
            mixer: Mixer::default(),
            error_rad: 0.0,
            thrust_m_s2: 0.0,
            asked_m_s2: 0.0,
            lean_max_rad: 1.0,
            last_up: up,
            integral: DVec3::ZERO,
            last_error: DVec3::ZERO,
            slope: DVec3::ZERO,
            climb_integral_m_s2: 0.0,
            real_shares: [HOVER_SHARE; MOTORS_MAX],
        }
    }

    /// The body's axes: forward, right and up.
    pub(super) fn axes(&self) -> [DVec3; 3] {
        let turn = DMat3::from_quat(self.attitude);
        [turn.x_axis, turn.y_axis, -turn.z_axis]
    }

    /// Roll, pitch and yaw, radians.
    pub(super) fn angles_rad(&self) -> (f64, f64, f64) {
        let [forward, right, up] = self.axes();
        let pitch = maths::asin((-forward.z).clamp(-1.0, 1.0));
        (
            maths::atan2(right.z, -up.z),
            pitch,
            maths::atan2(forward.y, forward.x),
        )
    }

    /// The greatest lean for a throttle, in radians; the limit follows a change of throttle with a lag.
    pub(super) fn lean_limit_rad(&mut self, throttle: f64) -> f64 {
        let left = maths::acos((throttle / LEAN_THROTTLE).clamp(0.0, 1.0));
        self.lean_max_rad += (left - self.lean_max_rad) * (STEP_S / (STEP_S + LEAN_LIMIT_S));
        self.lean_max_rad.clamp(LEAN_LEAST_RAD, 1.4)
    }

    /// Puts the vehicle upright with the same heading.
    pub(super) fn settle(&mut self) {
        let (_, _, yaw) = self.angles_rad();
        self.attitude = DQuat::from_rotation_z(yaw);
        self.rates_rad_s = DVec3::ZERO;
    }

    /// Stops the rotation in the current attitude.
    pub(super) fn lie(&mut self) {
        self.rates_rad_s = DVec3::ZERO;
    }

    /// Whether the vehicle has recovered.
    pub(super) fn is_calm(&self) -> bool {
        self.error_rad < CALM_RAD && self.rates_rad_s.length() < CALM_RAD_S
    }

    /// One step; returns the motors' force and their inflow's drag per mass, in the world. `velocity_m_s` is the
    /// velocity through the air, `lifting_m_s2` the actual acceleration upwards.
    pub(super) fn step(
        &mut self,
        wanted: &WantedTurn,
        velocity_m_s: DVec3,
        lifting_m_s2: f64,
        drive: &Drive<'_>,
    ) -> DVec3 {
        let throttle = self.throttle(wanted, lifting_m_s2, drive);
        let mut force = DVec3::ZERO;
        self.thrust_m_s2 = 0.0;
        let following = self.last_up.cross(wanted.up) / STEP_S;
        self.last_up = wanted.up;
        for _ in 0..ROUNDS {
            let turn = self.control(wanted, following, drive);
            self.mixer
                .mix(drive.airframe.layout(), turn, throttle, ROUND_S);
            if wanted.lift_m_s2.is_none() {
                self.mixer.shares = [0.0; MOTORS_MAX];
            }
            let along = self.attitude.inverse() * velocity_m_s;
            let (pushed, turned) = self.motors(along, drive);
            force += self.attitude * pushed / ROUNDS as f64;
            self.rotate(turned, drive.airframe);
        }
        force
    }

    /// The share of the thrust range for the climb; it is raised while the effect is too small.
    fn throttle(&mut self, wanted: &WantedTurn, lifting_m_s2: f64, drive: &Drive<'_>) -> f64 {
        let Some(lift) = wanted.lift_m_s2 else {
            self.climb_integral_m_s2 = 0.0;
            self.asked_m_s2 = 0.0;
            return 0.0;
        };
        let missing = lift - lifting_m_s2;
        if !(self.mixer.limited.throttle && missing > 0.0) {
            self.climb_integral_m_s2 = (self.climb_integral_m_s2
                + missing * CLIMB_I_PER_S * STEP_S)
                .clamp(-GRAVITY_M_S2, 2.0 * GRAVITY_M_S2);
        }
        let up = -(self.attitude * DVec3::NEG_Z).z;
        let upright = (10.0 * up).clamp(0.0, 1.0);
        let boosted = (lift + self.climb_integral_m_s2) * upright / (-wanted.up.z).max(0.1);
        let full = drive.airframe.thrust_max(0.0, drive.conditions).max(0.1);
        self.asked_m_s2 = boosted.clamp(0.0, full);
        self.asked_m_s2 / full
    }

    /// Roll, pitch and yaw for the mixer. `following` is the rotation rate of the wanted direction.
    fn control(&mut self, wanted: &WantedTurn, following: DVec3, drive: &Drive<'_>) -> DVec3 {
        let up = self.attitude * DVec3::NEG_Z;
        let across = up.cross(wanted.up);
        self.error_rad = maths::atan2(across.length(), up.dot(wanted.up));
        let axis = across
            .try_normalize()
            .unwrap_or_else(|| self.attitude * DVec3::X);
        let pace = square_root(self.error_rad, ANGLE_P, TURN_ACCEL_RAD_S2);
        let mut rates = self.attitude.inverse() * (axis * pace + following);
        // A vehicle far off its lean corrects that first and lets the nose turn.
        let hold_yaw = (2.0 - self.error_rad / YAW_FREE_RAD).clamp(0.0, 1.0);
        rates.z = self.rates_rad_s.z + (wanted.yaw_rate_rad_s - self.rates_rad_s.z) * hold_yaw;
        let error = rates - self.rates_rad_s;
        let blend = ROUND_S / (ROUND_S + 1.0 / (std::f64::consts::TAU * SLOPE_FILTER_HZ));
        self.slope += ((error - self.last_error) / ROUND_S - self.slope) * blend;
        self.last_error = error;
        let limited = self.mixer.limited;
        let next = (self.integral + error * RATE_I * ROUND_S)
            .clamp(DVec3::splat(-INTEGRAL_MAX), DVec3::splat(INTEGRAL_MAX));
        for axis in 0..3 {
            let held = if axis == 2 { limited.yaw } else { limited.lean };
            // A limited integrator may only shrink.
            if !held || next[axis].abs() < self.integral[axis].abs() {
                self.integral[axis] = next[axis];
            }
        }
        let gain = drive.airframe.hover_share()
            / drive
                .airframe
                .throttle_for(GRAVITY_M_S2, 0.0, drive.conditions)
                .max(0.01);
        let asked = error * RATE_P + self.integral + self.slope * RATE_D;
        asked.clamp(DVec3::NEG_ONE, DVec3::ONE) * gain
    }

    /// Force and torque per mass in the body's axes, after `SIM_Motor`.
    fn motors(&mut self, along_m_s: DVec3, drive: &Drive<'_>) -> (DVec3, DVec3) {
        let (airframe, conditions) = (drive.airframe, drive.conditions);
        let motors = airframe.layout();
        let count = motors.len() as f64;
        let slew = airframe.slew(ROUND_S);
        let (mut force, mut torque) = (DVec3::ZERO, DVec3::ZERO);
        for (place, motor) in motors.iter().enumerate() {
            let asked = self.mixer.shares[place];
            let share = match drive.fault {
                _ if drive.wrecked => 0.0,
                Some(fault) if fault.motor == place => {
                    airframe.share_after_fault(asked, fault.multiplier)
                }
                _ => asked,
            };
            let before = self.real_shares[place];
            let share = share.clamp(before - slew, before + slew);
            self.real_shares[place] = share;
            let passing = along_m_s + self.rates_rad_s.cross(motor.position_m);
            let inflow = passing.dot(motor.thrust);
            let thrust = if drive.wrecked {
                0.0
            } else {
                airframe.motor_thrust(share, inflow, conditions) / count
            };
            let drag = airframe.momentum_drag(thrust, conditions.air_density) / count.sqrt();
            let push = motor.thrust * thrust - passing * drag.min(1.0 / STEP_S);
            let twist = airframe.yaw_arm_m() * airframe.command(share) * thrust * motor.spin;
            force += push;
            torque += motor.position_m.cross(push) - motor.thrust * twist;
            self.thrust_m_s2 += thrust.abs() / ROUNDS as f64;
        }
        (force, torque)
    }

    fn rotate(&mut self, torque: DVec3, airframe: &Airframe) {
        let braked = self.rates_rad_s * airframe.rotation_drag_per_s();
        let turned = self.rates_rad_s + (torque / airframe.inertia_m2() - braked) * ROUND_S;
        let most = DVec3::splat(TURN_MAX_RAD_S);
        self.rates_rad_s = turned.clamp(-most, most);
        let attitude = self.attitude * DQuat::from_scaled_axis(self.rates_rad_s * ROUND_S);
        self.attitude = attitude.normalize();
    }
}
