//! The courses of a pilot's sticks.

use glam::DVec2;

use super::Cockpit;
use crate::helm::{Course, HelmRules, bearing_deg};
use crate::wheels::Outputs;

/// The steering and the throttle of a pilot's sticks.
pub(crate) fn of(cockpit: &Cockpit<'_>) -> Outputs {
    let [steering, _, throttle, _] = &cockpit.tuning.radio.sticks;
    let channels = &cockpit.sticks.channels_us;
    Outputs {
        steering: steering.off_centre(channels[0]),
        throttle: throttle.off_centre(channels[2]),
    }
}

pub(super) fn simple(sticks: Outputs, ahead_deg: f64, rules: &HelmRules) -> Course {
    let pointed = DVec2::new(sticks.throttle, sticks.steering);
    Course::Heading {
        heading_deg: ahead_deg + bearing_deg(DVec2::ZERO, pointed),
        speed_m_s: pointed.length().min(1.0) * rules.pilot_speed_m_s(),
    }
}

pub(super) fn acro(sticks: Outputs, rules: &HelmRules) -> Course {
    Course::Turn {
        rate_deg_s: sticks.steering * rules.acro_turn_deg_s,
        speed_m_s: sticks.throttle * rules.pilot_speed_m_s(),
    }
}

pub(super) fn steering(sticks: Outputs, cockpit: &Cockpit<'_>, rules: &HelmRules) -> Course {
    let speed_m_s = sticks.throttle * rules.pilot_speed_m_s();
    let moving = cockpit.body.velocity_m_s.truncate().length();
    let lateral = sticks.steering * rules.lateral_m_s2;
    Course::Turn {
        rate_deg_s: (lateral / moving.max(1.0)).to_degrees(),
        speed_m_s,
    }
}
