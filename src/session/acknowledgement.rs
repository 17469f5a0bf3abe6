//! `COMMAND_ACK`, including acknowledgements of commands unknown to the dialect.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMMAND_ACK_DATA, MavMessage};

use crate::commands::AckResult;
use crate::wire::{Content, Frame, SystemId};

const COMMAND_ACK: u32 = COMMAND_ACK_DATA::ID;

/// A vehicle's answer to a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Acknowledgement {
    /// The `MAV_CMD` that the message acknowledges.
    pub command: u16,
    pub result: AckResult,
    /// The progress, 0 to 100; 255 if unknown.
    pub progress: u8,
}

impl Acknowledgement {
    /// The acknowledgement in a frame, unless it was meant for another ground station than `station`.
    pub fn from_frame(frame: &Frame, station: SystemId) -> Option<Self> {
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
            Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => {
                return None;
            }
        };
        (target == 0 || target == station).then_some(ack)
    }
}

/// Acknowledgements that may still arrive for commands that no longer wait for them. If they were
/// not tracked, the late answer to an arm command would be mistaken for the answer to the kill that
/// replaced it: both have the same `MAV_CMD`.
#[derive(Debug, Clone, Default)]
pub(super) struct OwedAcks(Vec<(u16, Duration)>);

/// How long an acknowledgement may still arrive: vehicles answer within milliseconds, links within a second.
const OWED_FOR: Duration = Duration::from_secs(2);

impl OwedAcks {
    /// Adds acknowledgements that may still arrive for a command.
    pub fn add(&mut self, command: u16, count: u8, now: Duration) {
        self.0.extend((0..count).map(|_| (command, now + OWED_FOR)));
    }

    /// Removes an expected acknowledgement; returns whether there was one.
    pub fn take(&mut self, command: u16, now: Duration) -> bool {
        self.0.retain(|(_, until)| now < *until);
        let owed = self.0.iter().position(|(owed, _)| *owed == command);
        if let Some(at) = owed {
            self.0.remove(at);
        }
        owed.is_some()
    }
}
