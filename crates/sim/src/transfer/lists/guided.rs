//! Mission items as immediate targets: an old method that ground stations still use in GUIDED.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::MavMissionResult::{
    self, MAV_MISSION_ACCEPTED, MAV_MISSION_ERROR,
};

use crate::autopilot::Autopilot;
use crate::cmd;
use crate::guided::{self, Setpoint, TargetPoint};
use crate::mask::POSITION_ONLY;
use crate::mode::ModeId;
use crate::plan::{Item, ListKind};
use crate::transfer::items;
use sortie_geo::LatLon;

/// Values of the `current` field of an item: fly there now; change the height.
const GO_THERE: u8 = 2;
const CHANGE_HEIGHT: u8 = 3;

/// Whether an item with this `current` field is an immediate target, not part of the mission.
pub(super) fn is_meant(current: u8) -> bool {
    matches!(current, GO_THERE | CHANGE_HEIGHT)
}

/// Flies to an item in GUIDED. A copter accepts a change of height without effect.
pub(super) fn go(autopilot: &mut Autopilot, item: &Item, current: u8) -> MavMissionResult {
    let item = match items::kept(ListKind::Plan, item) {
        Ok(item) => item,
        Err(reason) => return reason,
    };
    if current == CHANGE_HEIGHT {
        return MAV_MISSION_ACCEPTED;
    }
    if autopilot.vehicle.flight.mode.id != ModeId::Guided || item.command != cmd::NAV_WAYPOINT {
        return MAV_MISSION_ERROR;
    }
    guided::take_setpoint(
        autopilot,
        &Setpoint {
            point: TargetPoint::Global {
                at: LatLon::from_e7(item.x, item.y),
                height_m: f64::from(item.z),
            },
            velocity_m_s: DVec3::ZERO,
            accel_m_s2: DVec3::ZERO,
            yaw_rad: 0.0,
            yaw_rate_rad_s: 0.0,
            mask: POSITION_ONLY,
            frame: item.frame,
        },
    );
    MAV_MISSION_ACCEPTED
}
