//! Plans and files: the vehicle has none and says so.

use mavlink::dialects::ardupilotmega::MavMissionResult::{
    MAV_MISSION_ACCEPTED, MAV_MISSION_ERROR, MAV_MISSION_UNSUPPORTED,
};
use mavlink::dialects::ardupilotmega::{
    FILE_TRANSFER_PROTOCOL_DATA, MISSION_ACK_DATA, MISSION_COUNT_DATA, MavMessage,
};

use crate::wire::Frame;

/// FTP: the answer's opcode for a refusal, and its reason (`MAVLink` FTP: NAK, `FileNotFound`).
const FTP_REFUSED: u8 = 129;
const FTP_FILE_NOT_FOUND: u8 = 10;
/// Where the opcode stands in an FTP payload, where its size and request opcode, and where the data begins.
const FTP_OPCODE: usize = 3;
const FTP_SIZE: usize = 4;
const FTP_REQUEST_OPCODE: usize = 5;
const FTP_DATA: usize = 12;

/// The answer to a message of the mission or file transfer protocol.
#[expect(
    deprecated,
    reason = "ground stations in use still send what the dialect calls superseded"
)]
pub(super) fn answer(system: u8, message: &MavMessage, frame: &Frame) -> Option<MavMessage> {
    let own = |target: u8| target == 0 || target == system;
    let (target, mission_type, result) = match message {
        MavMessage::MISSION_REQUEST_LIST(data) if own(data.target_system) => {
            return Some(MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
                count: 0,
                target_system: frame.system,
                target_component: frame.component,
                mission_type: data.mission_type,
                opaque_id: 0,
            }));
        }
        MavMessage::FILE_TRANSFER_PROTOCOL(data) if own(data.target_system) => {
            return Some(MavMessage::FILE_TRANSFER_PROTOCOL(refusal(data, frame)));
        }
        // Nothing to store is stored at once; anything else cannot be.
        MavMessage::MISSION_COUNT(data) if data.count == 0 => {
            (data.target_system, data.mission_type, MAV_MISSION_ACCEPTED)
        }
        MavMessage::MISSION_COUNT(data) => (
            data.target_system,
            data.mission_type,
            MAV_MISSION_UNSUPPORTED,
        ),
        MavMessage::MISSION_WRITE_PARTIAL_LIST(data) => (
            data.target_system,
            data.mission_type,
            MAV_MISSION_UNSUPPORTED,
        ),
        MavMessage::MISSION_CLEAR_ALL(data) => {
            (data.target_system, data.mission_type, MAV_MISSION_ACCEPTED)
        }
        MavMessage::MISSION_REQUEST_INT(data) => {
            (data.target_system, data.mission_type, MAV_MISSION_ERROR)
        }
        MavMessage::MISSION_REQUEST(data) => {
            (data.target_system, data.mission_type, MAV_MISSION_ERROR)
        }
        _ => return None,
    };
    own(target).then_some(MavMessage::MISSION_ACK(MISSION_ACK_DATA {
        target_system: frame.system,
        target_component: frame.component,
        mavtype: result,
        mission_type,
        opaque_id: 0,
    }))
}

fn refusal(request: &FILE_TRANSFER_PROTOCOL_DATA, frame: &Frame) -> FILE_TRANSFER_PROTOCOL_DATA {
    let mut payload = [0; 251];
    let sequence = u16::from_le_bytes([request.payload[0], request.payload[1]]).wrapping_add(1);
    payload[..2].copy_from_slice(&sequence.to_le_bytes());
    payload[2] = request.payload[2];
    payload[FTP_OPCODE] = FTP_REFUSED;
    payload[FTP_SIZE] = 1;
    payload[FTP_REQUEST_OPCODE] = request.payload[FTP_OPCODE];
    payload[FTP_DATA] = FTP_FILE_NOT_FOUND;
    FILE_TRANSFER_PROTOCOL_DATA {
        target_network: 0,
        target_system: frame.system,
        target_component: frame.component,
        payload,
    }
}
