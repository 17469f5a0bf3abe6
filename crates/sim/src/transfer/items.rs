//! The vehicle's answers to items that it cannot keep.

use mavlink::dialects::ardupilotmega::MavMissionResult::{
    self, MAV_MISSION_INVALID, MAV_MISSION_INVALID_PARAM1, MAV_MISSION_INVALID_PARAM2,
    MAV_MISSION_INVALID_PARAM3, MAV_MISSION_INVALID_PARAM4, MAV_MISSION_INVALID_PARAM5_X,
    MAV_MISSION_INVALID_PARAM6_Y, MAV_MISSION_INVALID_PARAM7, MAV_MISSION_UNSUPPORTED,
    MAV_MISSION_UNSUPPORTED_FRAME,
};
use sortie_plan::board::{self, Refusal};

use crate::plan::{Item, ListKind};

/// An item of a list as the vehicle keeps it, or the reason to refuse it. A fence as a whole is checked when it is
/// complete.
pub(super) fn kept(kind: ListKind, item: &Item) -> Result<Item, MavMissionResult> {
    let kept = match kind {
        ListKind::Plan => board::plan_item(item),
        ListKind::Fence => board::fence_item(item),
        ListKind::Rally => board::rally_item(item),
    };
    kept.map_err(|refusal| match refusal {
        Refusal::Invalid => MAV_MISSION_INVALID,
        Refusal::Command => MAV_MISSION_UNSUPPORTED,
        Refusal::Frame => MAV_MISSION_UNSUPPORTED_FRAME,
        Refusal::Parameter(1) => MAV_MISSION_INVALID_PARAM1,
        Refusal::Parameter(2) => MAV_MISSION_INVALID_PARAM2,
        Refusal::Parameter(3) => MAV_MISSION_INVALID_PARAM3,
        Refusal::Parameter(4) => MAV_MISSION_INVALID_PARAM4,
        Refusal::Parameter(5) => MAV_MISSION_INVALID_PARAM5_X,
        Refusal::Parameter(6) => MAV_MISSION_INVALID_PARAM6_Y,
        Refusal::Parameter(_) => MAV_MISSION_INVALID_PARAM7,
    })
}
