//! `AUTOPILOT_VERSION`: firmware, capabilities and the id of the board.

use mavlink::dialects::ardupilotmega::AUTOPILOT_VERSION_DATA;

use crate::hash::fnv1a;
use crate::vehicle::{AutopilotVersion, Vehicle};

pub(super) fn apply(vehicle: &mut Vehicle, data: &AUTOPILOT_VERSION_DATA) {
    let [_, patch, minor, major] = data.flight_sw_version.to_le_bytes();
    vehicle.version = Some(AutopilotVersion {
        firmware: (major, minor, patch),
        capabilities: data.capabilities.bits(),
        uid: match data.uid {
            0 => folded(&data.uid2),
            uid => uid,
        },
        hash: data.flight_custom_version,
    });
}

/// A hash of the long id, 0 if there is none: `ArduPilot` sets only the long id.
fn folded(uid2: &[u8; 18]) -> u64 {
    if uid2.iter().all(|&byte| byte == 0) {
        return 0;
    }
    fnv1a(uid2)
}
