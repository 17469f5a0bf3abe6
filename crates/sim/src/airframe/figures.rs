//! The values in an airframe file.

use glam::DVec3;

use super::layout::{self, Motor};
use crate::kinematics::GRAVITY_M_S2;

/// The figures of the file; names in backticks are its fields.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Figures {
    /// `mass`: ready to fly, in kilograms.
    pub(super) mass_kg: f64,
    /// `diagonal_size`: distance of the motors from the centre, metres.
    pub(super) diagonal_m: f64,
    /// `refSpd`, `refAngle`: a speed through still air and the lean that holds it.
    pub(super) reference_speed_m_s: f64,
    pub(super) reference_lean_deg: f64,
    /// `refVoltage`, `refCurrent`: voltage and current in the hover.
    pub(super) reference_voltage_v: f64,
    pub(super) reference_current_a: f64,
    /// `refAlt`: altitude of the hover measurement, metres above sea level.
    pub(super) reference_altitude_m: f64,
    /// `refBatRes`: resistance of the battery, in ohms.
    pub(super) battery_resistance_ohm: f64,
    /// `maxVoltage`: the voltage of the full battery.
    pub(super) full_voltage_v: f64,
    /// `battCapacityAh`; zero for a battery that never runs down.
    pub(super) battery_capacity_ah: f64,
    /// `hoverThrOut`, 0 to 1.
    pub(super) hover_throttle: f64,
    /// `propExpo`: the degree to which thrust follows the square of the command.
    pub(super) expo: f64,
    /// `refRotRate`, degrees per second.
    pub(super) rotation_rate_deg_s: f64,
    /// `pwmMin`, `pwmMax`, microseconds; `spin_min`, `spin_max`, shares of that range.
    pub(super) pwm_us: (f64, f64),
    pub(super) spin: (f64, f64),
    /// `slew_max`: greatest change of a command per second; zero for no limit.
    pub(super) slew_per_s: f64,
    /// `disc_area` of all rotors, square metres.
    pub(super) disc_area_m2: f64,
    /// `mdrag_coef`: the drag of the air that the rotors take in.
    pub(super) momentum_drag: f64,
    /// `moment_inertia`, in kilogram square metres; zero if it is to be estimated.
    pub(super) inertia_kg_m2: DVec3,
    pub(super) motors: Vec<Motor>,
}

impl Figures {
    /// The power of the hover in watts.
    pub(super) fn hover_power_w(&self) -> f64 {
        self.reference_current_a * self.reference_voltage_v
    }

    /// The speed of the air below the rotors in the hover, in metres per second, by momentum theory.
    pub(super) fn outflow_m_s(&self) -> f64 {
        2.0 * self.hover_power_w() / (self.mass_kg * GRAVITY_M_S2)
    }
}

impl Default for Figures {
    fn default() -> Self {
        Self {
            mass_kg: 3.0,
            diagonal_m: 0.35,
            reference_speed_m_s: 15.08,
            reference_lean_deg: 45.0,
            reference_voltage_v: 12.09,
            reference_current_a: 29.3,
            reference_altitude_m: 593.0,
            battery_resistance_ohm: 0.01,
            full_voltage_v: 12.6,
            battery_capacity_ah: 0.0,
            hover_throttle: 0.39,
            expo: 0.65,
            rotation_rate_deg_s: 120.0,
            pwm_us: (1000.0, 2000.0),
            spin: (0.15, 0.95),
            slew_per_s: 150.0,
            disc_area_m2: 0.385,
            momentum_drag: 0.2,
            inertia_kg_m2: DVec3::ZERO,
            motors: layout::standard(4, 0.35),
        }
    }
}
