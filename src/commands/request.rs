//! The messages of a command, and the answer to wait for.

use std::time::Duration;

use super::encode::{self, IntFields, LongFields};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// The message that answers a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// `COMMAND_ACK` of this `MAV_CMD`.
    Ack(u16),
    /// `PARAM_VALUE` of this parameter.
    Parameter(String),
    /// No answer (setpoints): success is visible only in the effect.
    None,
    /// Nothing is awaited, neither an answer nor an effect. A `COMMAND_ACK` of this `MAV_CMD` may still arrive.
    NotAwaited(Option<u16>),
}

/// The messages of a command.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The messages, in order; usually one.
    pub messages: Vec<Outgoing>,
    /// The commanded speeds, sent again after the messages of each attempt. Their acknowledgements are ignored.
    pub speeds: Vec<Outgoing>,
    /// The answer to wait for.
    pub answer: Answer,
    /// The message sent once after a [`Repeat`], such as the stop after a velocity.
    pub closing: Option<Outgoing>,
    /// The setpoints of a request that holds only in OFFBOARD.
    pub offboard: Option<Box<Offboard>>,
    /// The request that follows once this one is accepted.
    pub next: Option<Box<Request>>,
}

impl Request {
    pub(super) fn new(message: Outgoing, answer: Answer) -> Self {
        Self {
            messages: vec![message],
            speeds: Vec::new(),
            answer,
            closing: None,
            offboard: None,
            next: None,
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

    /// Commands in order, each sent once the previous one is accepted. There must be at least one.
    pub(super) fn chain(
        vehicle: &Vehicle,
        steps: &[LongFields],
        confirmation: u8,
    ) -> Result<Self, Text> {
        let mut chain: Option<Self> = None;
        for fields in steps.iter().rev() {
            let mut step = Self::long(vehicle, fields, confirmation)?;
            step.next = chain.map(Box::new);
            chain = Some(step);
        }
        chain.ok_or_else(|| text!("refused-plan-here"))
    }

    pub(super) fn int(vehicle: &Vehicle, fields: &IntFields) -> Result<Self, Text> {
        let message = encode::int(vehicle, fields)?;
        Ok(Self::new(message, Answer::Ack(fields.command)))
    }

    /// Prepares the next attempt: the same messages, with an incremented confirmation in a `COMMAND_LONG`.
    pub fn again(&mut self) {
        for message in &mut self.messages {
            encode::confirm_again(message);
        }
    }
}

/// Setpoints for PX4, which accepts them only in OFFBOARD, and enters that mode only while they arrive. The messages of
/// the request change the mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Offboard {
    /// The setpoint, sent before, while and after the mode changes.
    pub setpoint: Outgoing,
    /// How long setpoints must arrive before the mode can change; zero if the vehicle is in OFFBOARD already.
    pub lead: Duration,
    /// The setpoint to stop, sent until the vehicle has left OFFBOARD.
    pub standstill: Outgoing,
    /// The command that leaves OFFBOARD for AUTO.LOITER.
    pub leave: Outgoing,
    /// The number of that command.
    pub leave_command: u16,
}

/// Setpoints that must be repeated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repeat {
    pub every: Duration,
    pub lasting: Duration,
}
