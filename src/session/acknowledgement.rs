//! `COMMAND_ACK`, also where its command is newer than the dialect.

use mavlink::dialects::ardupilotmega::MavMessage;

use crate::commands::AckResult;
use crate::wire::{Content, Frame, GROUND_STATION_SYSTEM};

/// MAVLink id of `COMMAND_ACK`.
const COMMAND_ACK: u32 = 77;

/// What a vehicle answered to a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Acknowledgement {
    /// The `MAV_CMD` that it answers.
    pub command: u16,
    /// The answer.
    pub result: AckResult,
    /// How far it is with it, 0 to 100; 255 where it does not say.
    pub progress: u8,
}

impl Acknowledgement {
    /// The acknowledgement in a frame, unless it was meant for another ground station.
    pub fn from_frame(frame: &Frame) -> Option<Self> {
        let (ack, target) = match &frame.content {
            Content::Message(MavMessage::COMMAND_ACK(ack)) => (
                Self {
                    command: ack.command as u16,
                    result: AckResult::from_wire(ack.result as u8),
                    progress: ack.progress,
                },
                ack.target_system,
            ),
            Content::Undecoded { id, payload } if *id == COMMAND_ACK => (
                Self {
                    command: u16::from_le_bytes([payload[0], payload[1]]),
                    result: AckResult::from_wire(payload[2]),
                    progress: payload[3],
                },
                payload[8],
            ),
            _ => return None,
        };
        (target == 0 || target == GROUND_STATION_SYSTEM).then_some(ack)
    }
}
