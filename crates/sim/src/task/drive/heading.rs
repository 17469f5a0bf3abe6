//! A turn to a heading while driving at a speed (`NAV_SET_YAW_SPEED` in a mission).

use crate::helm::{Course, HelmRules};
use sortie_geo::wrap_180;

/// The heading counts as reached within this angle, in degrees.
const REACHED_DEG: f64 = 5.0;

/// A heading to turn to, and a speed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DriveHeading {
    /// From 0 to 360 degrees for one that is reached. As on the real vehicle, a relative heading in the western half is
    /// negative, and is driven along for ever.
    heading_deg: f64,
    speed_m_s: f64,
    is_reached: bool,
}

impl DriveHeading {
    pub(crate) fn new(heading_deg: f64, speed_m_s: f64, rules: &HelmRules) -> Self {
        Self {
            heading_deg,
            speed_m_s: speed_m_s.clamp(-rules.speed_max_m_s, rules.speed_max_m_s),
            is_reached: false,
        }
    }

    /// A heading that lies to the right of another one.
    pub(crate) fn relative(
        from_deg: f64,
        right_deg: f64,
        speed_m_s: f64,
        rules: &HelmRules,
    ) -> Self {
        Self::new(wrap_180(from_deg + right_deg), speed_m_s, rules)
    }

    pub(crate) fn is_reached(&self) -> bool {
        self.is_reached
    }

    /// Sets another speed, whatever it is.
    pub(crate) fn set_speed(&mut self, speed_m_s: f64) {
        self.speed_m_s = speed_m_s;
    }

    /// The course from the vehicle's heading.
    pub(super) fn course(&mut self, yaw_deg: f64) -> Course {
        if self.is_reached {
            return Course::Stop;
        }
        self.is_reached = (self.heading_deg - yaw_deg.rem_euclid(360.0)).abs() < REACHED_DEG;
        Course::Heading {
            heading_deg: wrap_180(self.heading_deg),
            speed_m_s: self.speed_m_s,
        }
    }
}
