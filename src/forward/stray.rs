//! Answers of a vehicle that are addressed to the console, but to commands that the console has not
//! sent: another ground station uses the console's system and component id.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMMAND_INT_DATA, COMMAND_LONG_DATA, MavMessage};

use super::commands::named;
use crate::wire::{Content, MavAddress, Outgoing};

/// How long an answer may take, with repetitions and over a radio that delays it.
const ANSWERED_WITHIN: Duration = Duration::from_secs(60);

/// The commands that the console has sent to one vehicle.
#[derive(Debug, Clone, Default)]
pub struct SentCommands {
    /// When each command was sent last, by its number.
    sent: BTreeMap<u16, Duration>,
}

impl SentCommands {
    /// Records the command in a message sent to the vehicle, if the message contains one.
    pub fn note(&mut self, message: &Outgoing, now: Duration) {
        let command = match message {
            Outgoing::Message(MavMessage::COMMAND_LONG(data)) => data.command as u16,
            Outgoing::Message(MavMessage::COMMAND_INT(data)) => data.command as u16,
            Outgoing::Raw { id, payload } if is_command(*id) && payload.len() >= 30 => {
                u16::from_le_bytes([payload[28], payload[29]])
            }
            Outgoing::Message(_) | Outgoing::Raw { .. } => return,
        };
        self.sent.insert(command, now);
    }

    /// The name of another station's command, if this message is the vehicle's answer to it, sent
    /// to the console's address; `None` for any other message, and for commands that only request
    /// messages.
    pub fn stray(&self, content: &Content, own: MavAddress, now: Duration) -> Option<String> {
        let Content::Message(MavMessage::COMMAND_ACK(ack)) = content else {
            return None;
        };
        let is_to_us = (ack.target_system, ack.target_component) == (own.system, own.component);
        let is_ours = self
            .sent
            .get(&(ack.command as u16))
            .is_some_and(|&at| now.saturating_sub(at) < ANSWERED_WITHIN);
        if is_ours || !is_to_us {
            return None;
        }
        named(ack.command).map(|command| command.name)
    }
}

fn is_command(id: u32) -> bool {
    [COMMAND_LONG_DATA::ID, COMMAND_INT_DATA::ID].contains(&id)
}

#[cfg(test)]
mod tests {
    use mavlink::dialects::ardupilotmega::{COMMAND_ACK_DATA, MavCmd};

    use super::*;

    const OWN: MavAddress = MavAddress {
        system: 255,
        component: 190,
    };

    fn ack(command: MavCmd, system: u8, component: u8) -> Content {
        Content::Message(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command,
            target_system: system,
            target_component: component,
            ..COMMAND_ACK_DATA::default()
        }))
    }

    #[test]
    fn an_answer_to_a_command_that_was_not_sent_is_stray() {
        let mut sent = SentCommands::default();
        let second = Duration::from_secs;
        let land = COMMAND_LONG_DATA {
            command: MavCmd::MAV_CMD_NAV_LAND,
            ..COMMAND_LONG_DATA::default()
        };
        sent.note(&MavMessage::COMMAND_LONG(land).into(), second(1));
        let mut payload = vec![0; 33];
        payload[28..30].copy_from_slice(&(MavCmd::MAV_CMD_USER_1 as u16).to_le_bytes());
        let id = COMMAND_LONG_DATA::ID;
        sent.note(&Outgoing::Raw { id, payload }, second(1));
        for (content, expected) in [
            (ack(MavCmd::MAV_CMD_NAV_LAND, 255, 190), None),
            (ack(MavCmd::MAV_CMD_USER_1, 255, 190), None),
            (
                ack(MavCmd::MAV_CMD_NAV_TAKEOFF, 255, 190),
                Some("NAV_TAKEOFF"),
            ),
            (ack(MavCmd::MAV_CMD_NAV_TAKEOFF, 255, 230), None),
            (ack(MavCmd::MAV_CMD_NAV_TAKEOFF, 255, 0), None),
            (ack(MavCmd::MAV_CMD_NAV_TAKEOFF, 0, 0), None),
            (ack(MavCmd::MAV_CMD_REQUEST_MESSAGE, 255, 190), None),
        ] {
            let stray = sent.stray(&content, OWN, second(5));
            assert_eq!(stray.as_deref(), expected, "{content:?}");
        }
        // A command from an hour ago is no longer answered.
        let late = sent.stray(&ack(MavCmd::MAV_CMD_NAV_LAND, 255, 190), OWN, second(3600));
        assert_eq!(late.as_deref(), Some("NAV_LAND"));
    }
}
