//! FOLLOW of a rover: behind another vehicle, or beside it (`ModeFollow`).

use glam::DVec2;

use super::Cockpit;
use crate::helm::{Course, bearing_deg};

/// The course to the place that the vehicle keeps to its leader. Without a leader it stops.
pub(super) fn course(cockpit: &Cockpit<'_>, fastest_m_s: f64) -> Course {
    let wanted_m_s = cockpit
        .tuning
        .follow
        .zip(cockpit.leader)
        .and_then(|(rules, leader)| {
            let way_m = leader.way_m(cockpit.body, &rules, cockpit.now)?;
            let offset_m = leader.offset_m(&rules, cockpit.now)?;
            Some(leader.velocity_m_s + (way_m.truncate() + offset_m) * rules.position_p)
        });
    match wanted_m_s {
        Some(wanted) if wanted != DVec2::ZERO => Course::Heading {
            heading_deg: bearing_deg(DVec2::ZERO, wanted),
            speed_m_s: wanted.length().min(fastest_m_s),
        },
        _ => Course::Stop,
    }
}
