//! A turn to a heading while driving at a speed (`NAV_SET_YAW_SPEED` in a mission).

use std::ops::RangeInclusive;

use crate::helm::{Course, HelmRules};
use sortie_geo::wrap_180;

/// The heading counts as reached within this angle, in degrees.
const REACHED_DEG: f64 = 5.0;
const REACHABLE_DEG: RangeInclusive<f64> = 0.0..=360.0;

/// A heading to turn to, and a speed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DriveHeading {
    /// Outside 0 to 360 degrees it is never reached, as on the real vehicle.
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

    /// A heading that lies to the right of another one; in the western half it is negative.
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
        let off_deg = wrap_180(self.heading_deg - yaw_deg).abs();
        self.is_reached = REACHABLE_DEG.contains(&self.heading_deg) && off_deg < REACHED_DEG;
        Course::Heading {
            heading_deg: wrap_180(self.heading_deg),
            speed_m_s: self.speed_m_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Chassis;
    use crate::kind::VehicleKind;
    use crate::parameters::Parameters;

    #[test]
    fn a_heading_is_reached_from_either_side_unless_it_is_negative() {
        let all = Parameters::new(VehicleKind::Rover(Chassis::Ackermann), 1);
        let rules = HelmRules::read(&all);
        let is_reached = |mut drive: DriveHeading, yaw_deg: f64| {
            drive.course(yaw_deg);
            drive.is_reached()
        };
        for yaw_deg in [358.0, -2.0, 2.0] {
            assert!(is_reached(DriveHeading::new(0.0, 1.0, &rules), yaw_deg));
            assert!(is_reached(DriveHeading::new(360.0, 1.0, &rules), yaw_deg));
        }
        assert!(!is_reached(DriveHeading::new(0.0, 1.0, &rules), 270.0));
        let west = DriveHeading::relative(0.0, -90.0, 1.0, &rules);
        assert!(!is_reached(west, 270.0));
    }
}
