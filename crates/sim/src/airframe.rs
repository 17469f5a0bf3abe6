//! The airframe of a multirotor, described as in `ArduPilot`'s `SIM_Frame` by figures of a
//! reference flight. Drag, thrust and current follow from them by the relations of `SIM_Frame`, so
//! one file gives both simulators the same drone. A built ground robot or boat has its running gear instead.

mod figures;
mod file;
mod layout;
mod standard;

use std::sync::Arc;

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::MavType;
use serde_json::Value;

pub(super) use figures::Figures;
pub use file::AirframeError;
pub(super) use layout::Motor;

use super::kinematics::GRAVITY_M_S2;
use super::wheels::RunningGear;
use sortie_geo::maths;

/// Density of the standard atmosphere at sea level, in kilograms per cubic metre.
pub const SEA_LEVEL_DENSITY: f64 = 1.225;
/// The share of the required throttle that remains after the autopilot's compensation for density
/// and voltage: fitted to 36 % in the hover of the default quad, whose `hoverThrOut` is 39 % at 593
/// m.
const COMPENSATED: f64 = 0.9777;
/// The decay rate of rotation is this value divided by the frame's `refRotRate`, as in `SIM_Frame`.
const ROTATION_DRAG_DEG_S: f64 = 400.0;
/// The share of the full voltage below which the battery cannot turn the motors.
const DEAD_VOLTAGE_SHARE: f64 = 0.1;
/// The width across the propellers of SITL's default quad, by the distance of its motors from the centre.
const WIDTH_PER_DIAGONAL: f64 = 0.5 / 0.35;

/// A kind of multirotor, shared among vehicles by its `Arc`.
#[derive(Debug, Clone, PartialEq)]
pub struct Airframe {
    figures: Figures,
    /// The frame file as plain JSON; `None` for the default quad.
    file: Option<Value>,
    /// Initial parameters of vehicles with this airframe, besides those that follow from its
    /// figures.
    parameters: Vec<(&'static str, f64)>,
    /// Drag coefficients per mass and density: the body's, multiplied by the square of the speed,
    /// and that of the rotors' inflow, multiplied by the root of the thrust.
    form_drag: f64,
    momentum_drag: f64,
    reference_density: f64,
    hover_power_w: f64,
    /// Speed of the rotors' outflow in the hover, metres per second.
    outflow_m_s: f64,
    hover_throttle_at_reference: f64,
    /// What drives a ground robot or boat; `None` for a multirotor.
    gear: Option<RunningGear>,
}

/// The state of the air and of the battery that affects thrust and drag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Conditions {
    /// Velocity of the air, north, east and down, in m/s.
    pub(super) wind_m_s: DVec3,
    /// Kilograms per cubic metre.
    pub(super) air_density: f64,
    /// The share of the full voltage, 0 to slightly above 1.
    pub(super) voltage_share: f64,
}

impl Default for Airframe {
    /// The quadcopter of SITL without a frame file; its battery never runs down. It serves for
    /// comparison with recordings; flights use [`Airframe::standard`].
    fn default() -> Self {
        Self::derived(Figures::default())
    }
}

impl Airframe {
    /// Reads a frame file (`SIM_Frame` JSON, `#` starts a comment). Fields that are absent keep the
    /// value of the default quad. Also returns warnings about fields that no simulator reads.
    ///
    /// # Errors
    /// The file is not JSON, has a value of a wrong type, or is physically impossible; the error
    /// contains the line and column.
    pub fn from_json(text: &str) -> Result<(Self, Vec<AirframeError>), AirframeError> {
        let (figures, warnings) = file::read(text)?;
        let airframe = Self {
            file: Some(file::json(text)?),
            ..Self::derived(figures)
        };
        Ok((airframe, warnings))
    }

    /// The airframe with these initial parameters, which can be changed later.
    #[must_use]
    pub fn with_parameters(self, parameters: Vec<(&'static str, f64)>) -> Self {
        Self { parameters, ..self }
    }

    /// A ground robot or boat with this running gear. It has no frame file.
    pub fn driven(gear: RunningGear) -> Self {
        let figures = Figures {
            mass_kg: gear.mass_kg,
            diagonal_m: gear.length_m / WIDTH_PER_DIAGONAL,
            full_voltage_v: gear.full_voltage_v,
            battery_capacity_ah: gear.battery_capacity_ah,
            battery_resistance_ohm: gear.battery_resistance_ohm,
            ..Figures::default()
        };
        Self {
            gear: Some(gear),
            ..Self::derived(figures)
        }
    }

    /// What drives a ground robot or boat; `None` for a multirotor.
    pub fn gear(&self) -> Option<&RunningGear> {
        self.gear.as_ref()
    }

    /// Whether the battery can still turn the motors.
    pub(super) fn has_power(voltage_share: f64) -> bool {
        voltage_share >= DEAD_VOLTAGE_SHARE
    }

    /// The frame file as plain JSON, without comments: the input for ArduPilot's SITL. The default
    /// quad has none.
    pub fn file(&self) -> Option<&Value> {
        self.file.as_ref()
    }

    /// Initial parameters of vehicles with this airframe, besides those that follow from its
    /// figures.
    pub fn parameters(&self) -> &[(&'static str, f64)] {
        &self.parameters
    }

    /// The default quad, to be shared among vehicles.
    pub fn shared_default() -> Arc<Self> {
        Arc::new(Self::default())
    }

    /// The number of motors: 4, 6, 8, 10 or 12.
    pub fn motors(&self) -> usize {
        self.figures.motors.len()
    }

    /// Takeoff mass in kilograms (`mass` of the frame file).
    pub fn mass_kg(&self) -> f64 {
        self.figures.mass_kg
    }

    /// The distance of the motors from the centre, in metres (`diagonal_size`, which `SIM_Frame` takes as their lever
    /// arm).
    pub fn diagonal_m(&self) -> f64 {
        self.figures.diagonal_m
    }

    /// The degree to which thrust follows the square of a motor's command, 0 to 1 (`propExpo`).
    pub fn thrust_expo(&self) -> f64 {
        self.figures.expo
    }

    /// The width across the propellers, in metres. They reach beyond the motors: SITL's default quad of 0.35 m is half
    /// a metre wide.
    pub fn size_m(&self) -> f64 {
        self.figures.diagonal_m * WIDTH_PER_DIAGONAL
    }

    /// The drag coefficients that balance the reference flight (`SIM_Frame`'s `init`).
    fn derived(figures: Figures) -> Self {
        let (sin, cos) = maths::sin_cos(figures.reference_lean_deg.to_radians());
        let density = air_density(figures.reference_altitude_m);
        let speed = figures.reference_speed_m_s;
        let weight_n = figures.mass_kg * GRAVITY_M_S2;
        let drag_n = weight_n * sin / cos;
        let mut coefficient = figures.momentum_drag;
        let inflow_n = cos
            * coefficient
            * speed
            * cos
            * (weight_n / cos * density * figures.disc_area_m2).sqrt();
        let mut form_n = drag_n - inflow_n;
        if form_n < 0.0 {
            coefficient *= drag_n / inflow_n;
            form_n = 0.0;
        }
        Self {
            form_drag: form_n / (density * speed * speed * figures.mass_kg),
            momentum_drag: coefficient * (figures.disc_area_m2 / figures.mass_kg).sqrt(),
            reference_density: density,
            hover_power_w: figures.hover_power_w(),
            outflow_m_s: figures.outflow_m_s(),
            hover_throttle_at_reference: COMPENSATED * figures.hover_throttle * density
                / SEA_LEVEL_DENSITY,
            figures,
            file: None,
            parameters: Vec::new(),
            gear: None,
        }
    }

    /// The vehicle type in a heartbeat.
    pub(super) fn vehicle_type(&self) -> MavType {
        match self.motors() {
            6 => MavType::MAV_TYPE_HEXAROTOR,
            8 => MavType::MAV_TYPE_OCTOROTOR,
            10 => MavType::MAV_TYPE_DECAROTOR,
            12 => MavType::MAV_TYPE_DODECAROTOR,
            _ => MavType::MAV_TYPE_QUADROTOR,
        }
    }

    /// The value of `FRAME_CLASS` for the number of motors.
    pub(super) fn frame_class(&self) -> f32 {
        match self.motors() {
            6 => 2.0,
            8 => 3.0,
            10 => 14.0,
            12 => 12.0,
            _ => 1.0,
        }
    }

    /// The voltage of the full battery, in volts.
    pub fn full_voltage_v(&self) -> f64 {
        self.figures.full_voltage_v
    }

    /// The capacity in ampere hours; zero for a battery that never runs down.
    pub fn battery_capacity_ah(&self) -> f64 {
        self.figures.battery_capacity_ah
    }

    pub(super) fn battery_resistance_ohm(&self) -> f64 {
        self.figures.battery_resistance_ohm
    }

    /// The maximum thrust per mass, with air flowing into the rotors at `inflow_m_s`.
    pub(super) fn thrust_max(&self, inflow_m_s: f64, conditions: &Conditions) -> f64 {
        let full = self.motor_thrust(1.0, inflow_m_s, conditions);
        full.max(0.0)
    }

    /// Thrust per mass with all motors at one share of their thrust range.
    pub(super) fn motor_thrust(&self, share: f64, inflow_m_s: f64, conditions: &Conditions) -> f64 {
        if conditions.voltage_share < DEAD_VOLTAGE_SHARE {
            return 0.0;
        }
        let inflow = inflow_m_s.max(0.0) / self.outflow_m_s;
        let out = share * maths::powi(conditions.voltage_share, 2) / self.figures.hover_throttle;
        GRAVITY_M_S2 * conditions.air_density / self.reference_density * (out - inflow * inflow)
    }

    /// The throttle, 0 to 1, with which the autopilot produces a thrust per mass. The autopilot
    /// compensates for thin air fully, and for a sagging voltage by half (37 % at 12.0 V, 41 % at
    /// 11.0 V and 45 % at 10.24 V were measured).
    pub(super) fn throttle_for(
        &self,
        thrust: f64,
        inflow_m_s: f64,
        conditions: &Conditions,
    ) -> f64 {
        let inflow = inflow_m_s.max(0.0) / self.outflow_m_s;
        let share = thrust / GRAVITY_M_S2
            + inflow * inflow * conditions.air_density / self.reference_density;
        let voltage = conditions.voltage_share.max(DEAD_VOLTAGE_SHARE);
        (self.hover_throttle_at_reference * share / voltage).clamp(0.0, 1.0)
    }

    /// The thrust per mass of a throttle: the inverse of [`throttle_for`](Self::throttle_for).
    pub(super) fn thrust_for(
        &self,
        throttle: f64,
        inflow_m_s: f64,
        conditions: &Conditions,
    ) -> f64 {
        let inflow = inflow_m_s.max(0.0) / self.outflow_m_s;
        let share = throttle * conditions.voltage_share / self.hover_throttle_at_reference
            - inflow * inflow * conditions.air_density / self.reference_density;
        (share * GRAVITY_M_S2).clamp(0.0, self.thrust_max(inflow_m_s, conditions))
    }

    /// The power for a thrust per mass, in watts.
    pub(super) fn power_w(&self, thrust: f64) -> f64 {
        self.hover_power_w * thrust.abs() / GRAVITY_M_S2
    }

    /// The body's drag per mass along its axes, from the air's velocity along them.
    pub(super) fn form_drag(&self, along_m_s: DVec3, air_density: f64) -> DVec3 {
        along_m_s * along_m_s.abs() * (self.form_drag * air_density)
    }

    /// The drag of the rotors' inflow per mass and speed: the same in every direction.
    pub(super) fn momentum_drag(&self, thrust: f64, air_density: f64) -> f64 {
        self.momentum_drag * (thrust.max(0.0) * air_density).sqrt()
    }

    /// The positions and the spin of the motors.
    pub(super) fn layout(&self) -> &[Motor] {
        &self.figures.motors
    }

    /// The rotors' yaw torque per thrust and command, in metres.
    pub(super) fn yaw_arm_m(&self) -> f64 {
        0.05 * self.figures.diagonal_m
    }

    /// Moments of inertia per mass, in square metres. If the file has no figure, half the mass is
    /// assumed to be on a ring.
    pub(super) fn inertia_m2(&self) -> DVec3 {
        let given = self.figures.inertia_kg_m2;
        if given.min_element() > 0.0 {
            return given / self.figures.mass_kg;
        }
        let ring = maths::powi(self.figures.diagonal_m * 0.5, 2);
        DVec3::new(0.25 * ring, 0.25 * ring, 0.5 * ring)
    }

    /// The decay rate of rotation, per second.
    pub(super) fn rotation_drag_per_s(&self) -> f64 {
        if self.figures.rotation_rate_deg_s > 0.0 {
            ROTATION_DRAG_DEG_S.to_radians() / self.figures.rotation_rate_deg_s
        } else {
            0.0
        }
    }

    /// The maximum change of a motor's command within `seconds`.
    pub(super) fn slew(&self, seconds: f64) -> f64 {
        if self.figures.slew_per_s > 0.0 {
            self.figures.slew_per_s * seconds
        } else {
            1.0
        }
    }

    /// The share of the thrust range that remains of `share` after a fault: `multiplier` reduces the motor's pulse.
    pub(super) fn share_after_fault(&self, share: f64, multiplier: f64) -> f64 {
        let pulse_us = 1000.0 + (self.pulse_us(share) - 1000.0) * multiplier;
        let (low, high) = self.figures.pwm_us;
        let (spin_min, spin_max) = self.figures.spin;
        let spin = (pulse_us - low) / (high - low);
        let command = ((spin - spin_min) / (spin_max - spin_min)).clamp(0.0, 1.0);
        (1.0 - self.figures.expo) * command + self.figures.expo * command * command
    }

    /// The pulse that the autopilot sends for a share of the thrust range, in microseconds.
    pub(super) fn pulse_us(&self, share: f64) -> f64 {
        let (low, high) = self.figures.pwm_us;
        let (spin_min, spin_max) = self.figures.spin;
        low + (high - low) * (spin_min + (spin_max - spin_min) * self.command(share))
    }

    /// The command, 0 to 1, for a share of the thrust range.
    pub(super) fn command(&self, share: f64) -> f64 {
        let (expo, share) = (self.figures.expo, share.clamp(0.0, 1.0));
        if expo < 1e-3 {
            return share;
        }
        let linear = 1.0 - expo;
        ((linear * linear + 4.0 * expo * share).sqrt() - linear) / (2.0 * expo)
    }

    /// Share of the thrust range that carries the weight in the conditions of the reference flight.
    pub fn hover_share(&self) -> f64 {
        self.figures.hover_throttle
    }
}

/// Density of the standard atmosphere (1976, troposphere) at an altitude above mean sea level, in kg/m³.
pub(super) fn air_density(altitude_m: f64) -> f64 {
    let warmth = 1.0 - 0.0065 / 288.15 * altitude_m.clamp(-5000.0, 11_000.0);
    SEA_LEVEL_DENSITY * maths::powf(warmth, 4.2559)
}

/// The body's axes in the world, from the direction of the nose and of the thrust: forward, right, up.
pub(super) fn axes(heading: DVec2, up: DVec3) -> [DVec3; 3] {
    let right = heading.extend(0.0).cross(up).normalize_or(DVec3::Y);
    [up.cross(right), right, up]
}

#[cfg(test)]
pub(super) mod tests;
