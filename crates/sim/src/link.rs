//! The state of one serial port on the vehicle.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;
use sortie_wire::{Outgoing, SigningKey};

use super::Serial;
use super::parameters::Parameters;
use super::schedule::Schedule;

/// The number of a ground station in transfers, from its first request on; 0 before that.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct LinkNumber(pub(super) u32);

/// The state of one serial port, and the answers to the frame that is being handled.
#[derive(Debug, Clone)]
pub(super) struct Link {
    pub(super) serial: Serial,
    pub(super) schedule: Schedule,
    /// The transfer number of the ground station that is being answered.
    pub(super) transfer: LinkNumber,
    /// Whether anything was received; until then, the vehicle sends little.
    pub(super) heard: bool,
    /// The index of the first parameter of a requested list.
    pub(super) listing: Option<u16>,
    /// Answers for the sender of the frame alone.
    pub(super) replies: Vec<Outgoing>,
    /// A signing key that was received, with the timestamp from which it is valid.
    pub(super) key: Option<(SigningKey, u64)>,
}

impl Link {
    pub(super) fn new(serial: Serial, parameters: &Parameters, now: Duration) -> Self {
        Self {
            serial,
            schedule: Schedule::booted(serial, parameters, now),
            transfer: LinkNumber::default(),
            heard: false,
            listing: None,
            replies: Vec::new(),
            key: None,
        }
    }

    pub(super) fn reply(&mut self, message: MavMessage) {
        self.replies.push(message.into());
    }
}
