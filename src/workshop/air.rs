//! The air around a vehicle.

use crate::geo::maths;
use crate::sim::SEA_LEVEL_DENSITY;

/// The air that a drone flies in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Altitude above sea level, in metres.
    pub altitude_m: f64,
    /// The temperature of the air in degrees Celsius.
    pub temperature_c: f64,
    /// The battery's temperature in degrees Celsius: packs are warm at launch, unless a mission sets another value.
    pub battery_c: f64,
}

impl Default for Air {
    /// The standard atmosphere at sea level.
    fn default() -> Self {
        Self {
            altitude_m: 0.0,
            temperature_c: 15.0,
            battery_c: 25.0,
        }
    }
}

impl Air {
    /// The density in kilograms per cubic metre (standard atmosphere, corrected for the temperature).
    pub fn density(&self) -> f64 {
        let standard = SEA_LEVEL_DENSITY * maths::powf(1.0 - 2.255_77e-5 * self.altitude_m, 5.2559);
        standard * 288.15 / (273.15 + self.temperature_c)
    }
}
