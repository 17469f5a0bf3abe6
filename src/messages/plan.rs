//! Progress through the plan on board.

use mavlink::dialects::ardupilotmega::{MISSION_CURRENT_DATA, MissionState};

use crate::vehicle::Vehicle;

/// Applies `MISSION_CURRENT`. Its total is 0 both from senders that do not set it and from `ArduPilot` without a plan;
/// the mission state distinguishes them. 65535 means no plan.
pub(super) fn apply_current(vehicle: &mut Vehicle, data: &MISSION_CURRENT_DATA) {
    let total = match data.total {
        0 if data.mission_state == MissionState::MISSION_STATE_UNKNOWN => None,
        u16::MAX => Some(0),
        items => Some(items),
    };
    if vehicle.plan.total != total {
        // A new plan: the item reached in the old one does not apply.
        vehicle.plan.reached = None;
    }
    vehicle.plan.current = data.seq;
    vehicle.plan.total = total;
}
