//! `AUTOPILOT_VERSION`: firmware, capabilities and the id of the board.

use mavlink::dialects::ardupilotmega::AUTOPILOT_VERSION_DATA;

use crate::vehicle::{AutopilotVersion, BoardId, Vehicle};

pub(super) fn apply(vehicle: &mut Vehicle, data: &AUTOPILOT_VERSION_DATA) {
    let [_, patch, minor, major] = data.flight_sw_version.to_le_bytes();
    vehicle.version = Some(AutopilotVersion {
        firmware: (major, minor, patch),
        capabilities: data.capabilities.bits(),
        board: BoardId::of(data.uid, &data.uid2),
        hash: data.flight_custom_version,
    });
}
