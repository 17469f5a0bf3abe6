//! The commanded speeds of a vehicle.

use strum::{EnumString, VariantNames};

/// The speed that a `DO_CHANGE_SPEED` changes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, EnumString, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SpeedAxis {
    /// The speed over ground.
    #[default]
    Ground,
    Climb,
    Descend,
}

/// The accepted speed limits, in m/s. ArduCopter stores a single limit for both vertical
/// directions: setting the climb resets the descent to its parameter, and vice versa.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AskedSpeeds {
    ground_m_s: Option<f64>,
    vertical: Option<(SpeedAxis, f64)>,
}

impl AskedSpeeds {
    /// Notes a speed that the vehicle has accepted.
    pub fn ask(&mut self, axis: SpeedAxis, speed_m_s: f64) {
        match axis {
            SpeedAxis::Ground => self.ground_m_s = Some(speed_m_s),
            SpeedAxis::Climb | SpeedAxis::Descend => self.vertical = Some((axis, speed_m_s)),
        }
    }

    /// The commanded speed over ground, in m/s, if any.
    pub fn ground_m_s(&self) -> Option<f64> {
        self.ground_m_s
    }

    pub fn all(&self) -> impl Iterator<Item = (SpeedAxis, f64)> {
        let ground = self.ground_m_s.map(|speed| (SpeedAxis::Ground, speed));
        ground.into_iter().chain(self.vertical)
    }
}
