//! Requests for messages.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{AVAILABLE_MODES_DATA, MavCmd};

use super::encode::LongFields;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum QueryCommand {
    /// Request a message at a rate on this link.
    Interval {
        message: u32,
        /// The rate in Hz; 0 stops the message.
        rate_hz: f64,
    },
    /// Request a message once.
    Request { message: u32 },
    /// Ask for the mode of an index, or with 0 for all modes.
    Modes { index: u8 },
}

impl QueryCommand {
    pub(super) fn fields(self) -> LongFields {
        match self {
            Self::Interval { message, rate_hz } => {
                let interval_us = if rate_hz > 0.0 { 1e6 / rate_hz } else { -1.0 };
                LongFields::new(
                    MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
                    &[message as f32, interval_us as f32],
                )
            }
            Self::Request { message } => {
                LongFields::new(MavCmd::MAV_CMD_REQUEST_MESSAGE, &[message as f32])
            }
            Self::Modes { index } => LongFields::new(
                MavCmd::MAV_CMD_REQUEST_MESSAGE,
                &[AVAILABLE_MODES_DATA::ID as f32, f32::from(index)],
            ),
        }
    }
}
