//! Raw MAVLink commands.

use super::arming::risk_of_number;
use super::encode::{IntFields, LongFields};
use super::request::Request;
use crate::ledger::Risk;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// Commands sent as typed, without interpretation.
#[derive(Debug, Clone, Copy, PartialEq)]
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
}

impl RawCommand {
    pub(super) fn request(self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        match self {
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

    pub(super) fn risk(self) -> Risk {
        match self {
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
