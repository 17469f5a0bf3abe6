//! Raw MAVLink commands.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMMAND_INT_DATA, COMMAND_LONG_DATA};

use super::arming::risk_of_number;
use super::encode::{IntFields, LongFields};
use super::mav_cmd::command_name;
use super::request::{Answer, Request};
use crate::inspector::WrittenPayload;
use crate::ledger::Risk;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// The position of the `MAV_CMD` in `COMMAND_LONG` and `COMMAND_INT`.
const COMMAND_OFFSET: usize = 28;

/// Any message of the dialect, with its fields as typed.
#[derive(Debug, Clone, PartialEq)]
pub struct RawMessage {
    pub id: u32,
    pub name: &'static str,
    /// The fields as typed; empty if all are 0.
    pub fields: String,
    pub payload: WrittenPayload,
}

/// Commands sent as typed, without interpretation.
#[derive(Debug, Clone, PartialEq)]
pub enum RawCommand {
    /// Any `MAV_CMD` as `COMMAND_LONG`.
    Long {
        command: u16,
        /// Parameters 1 to 7.
        params: [f32; 7],
    },
    /// Any `MAV_CMD` as `COMMAND_INT`.
    Int {
        command: u16,
        /// `MAV_FRAME`, known to the dialect or not.
        frame: u8,
        /// Parameters 1 to 4.
        params: [f32; 4],
        /// Parameter 5: latitude in degrees times 1e7, or as the command defines.
        x: i32,
        /// Parameter 6: longitude in degrees times 1e7, or as the command defines.
        y: i32,
        /// Parameter 7: height in metres, or as the command defines.
        z: f32,
    },
    /// Any message; no answer is awaited.
    Message(RawMessage),
}

impl RawCommand {
    pub(super) fn request(&self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        match *self {
            Self::Message(ref message) => Ok(message.request(vehicle)),
            Self::Long { command, params } => {
                let fields = LongFields { command, params };
                Request::long(vehicle, &fields, confirmation)
            }
            Self::Int {
                command,
                frame,
                params,
                x,
                y,
                z,
            } => {
                let fields = IntFields {
                    command,
                    frame,
                    params,
                    x,
                    y,
                    z,
                };
                Request::int(vehicle, &fields)
            }
        }
    }

    /// A description of what is sent, for the question before.
    pub(super) fn hazard(&self) -> Text {
        match self {
            Self::Message(RawMessage { name, fields, .. }) if fields.is_empty() => {
                text!("hazard-message-empty", message = *name)
            }
            Self::Message(RawMessage { name, fields, .. }) => {
                text!("hazard-message", message = *name, fields = fields)
            }
            Self::Long { command, params } => hazard_of_command(*command, &params.map(f64::from)),
            Self::Int {
                command,
                params: [p1, p2, p3, p4],
                x,
                y,
                z,
                ..
            } => {
                let mut all = [*p1, *p2, *p3, *p4, 0.0, 0.0, *z].map(f64::from);
                (all[4], all[5]) = (f64::from(*x), f64::from(*y));
                hazard_of_command(*command, &all)
            }
        }
    }

    pub(super) fn risk(&self) -> Risk {
        match *self {
            Self::Message(ref message) => message.risk(),
            Self::Long {
                command,
                params: [first, second, ..],
            }
            | Self::Int {
                command,
                params: [first, second, ..],
                ..
            } => risk_of_number(command, first, second),
        }
    }
}

/// The name of a `MAV_CMD` and its parameters, without the zeros at the end.
fn hazard_of_command(command: u16, params: &[f64; 7]) -> Text {
    let name = command_name(command).map_or_else(|| command.to_string(), str::to_owned);
    let is_given = |param: &f64| param.is_nan() || param.abs() > 0.0;
    let count = params.iter().rposition(is_given).map_or(0, |last| last + 1);
    let given = params.iter().take(count).map(f64::to_string);
    let words: Vec<String> = std::iter::once(name).chain(given).collect();
    text!("hazard-command", command = words.join(" "))
}

impl RawMessage {
    fn request(&self, vehicle: &Vehicle) -> Request {
        let payload = self.payload.addressed(vehicle.system, vehicle.component);
        let message = Outgoing::Raw {
            id: self.id,
            payload,
        };
        Request::new(message, Answer::NotAwaited(self.command()))
    }

    /// The `MAV_CMD` in the message, if it is a command.
    fn command(&self) -> Option<u16> {
        let is_command = [COMMAND_LONG_DATA::ID, COMMAND_INT_DATA::ID].contains(&self.id);
        let number = self.payload.bytes.get(COMMAND_OFFSET..COMMAND_OFFSET + 2);
        let number = number.filter(|_| is_command)?;
        Some(u16::from_le_bytes(number.try_into().ok()?))
    }

    /// A parameter of a command, counted from 0.
    fn param(&self, index: usize) -> f32 {
        let bytes = self.payload.bytes.get(4 * index..4 * index + 4);
        let bytes = bytes.and_then(|bytes| bytes.try_into().ok());
        bytes.map_or(0.0, f32::from_le_bytes)
    }

    fn risk(&self) -> Risk {
        let command = self.command();
        command.map_or(Risk::None, |command| {
            risk_of_number(command, self.param(0), self.param(1))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_question_names_the_command_and_its_parameters() {
        let long = RawCommand::Long {
            command: 209,
            params: [1.0, 0.0, 20.5, 2.0, 0.0, 0.0, 0.0],
        };
        let asked = long.hazard().to_string();
        assert!(asked.contains("DO_MOTOR_TEST 1 0 20.5 2"), "{asked}");
        assert!(!asked.contains("2 0"), "{asked}");
        let int = RawCommand::Int {
            command: 192,
            frame: 6,
            params: [0.0; 4],
            x: 504_500_001,
            y: 305_200_000,
            z: 20.0,
        };
        let asked = int.hazard().to_string();
        assert!(
            asked.contains("DO_REPOSITION 0 0 0 0 504500001 305200000 20"),
            "{asked}"
        );
    }
}
