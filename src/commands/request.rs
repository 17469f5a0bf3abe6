//! The messages of a command, and the answer to wait for.

use std::time::Duration;

use super::encode::{self, IntFields, LongFields};
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// What answers a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// `COMMAND_ACK` of this `MAV_CMD`.
    Ack(u16),
    /// `PARAM_VALUE` of this parameter.
    Parameter(String),
    /// Nothing ever comes (setpoints): only the effect tells.
    None,
}

/// What goes out for a command.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The messages, in order; usually one.
    pub messages: Vec<Outgoing>,
    /// The speeds that were asked for, sent again after the messages of each try. Their acknowledgements are ignored.
    pub speeds: Vec<Outgoing>,
    /// What to wait for.
    pub answer: Answer,
    /// Sent once when a [`Repeat`] is over: a velocity ends with a stop.
    pub closing: Option<Outgoing>,
}

impl Request {
    pub(super) fn new(message: Outgoing, answer: Answer) -> Self {
        Self {
            messages: vec![message],
            speeds: Vec::new(),
            answer,
            closing: None,
        }
    }

    pub(super) fn long(
        vehicle: &Vehicle,
        fields: &LongFields,
        confirmation: u8,
    ) -> Result<Self, Text> {
        let message = encode::long(vehicle, fields, confirmation)?;
        Ok(Self::new(message, Answer::Ack(fields.command)))
    }

    pub(super) fn int(vehicle: &Vehicle, fields: &IntFields) -> Result<Self, Text> {
        let message = encode::int(vehicle, fields)?;
        Ok(Self::new(message, Answer::Ack(fields.command)))
    }

    /// Prepares the next try: the same messages, with the confirmation of a `COMMAND_LONG` counted up.
    pub fn again(&mut self) {
        for message in &mut self.messages {
            encode::confirm_again(message);
        }
    }
}

/// Setpoints that have to be repeated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repeat {
    /// The time between two.
    pub every: Duration,
    pub lasting: Duration,
}
