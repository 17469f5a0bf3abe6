//! One ground station's connection to one vehicle.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::autopilot::Autopilot;
use super::schedule::Schedule;
use super::{inbound, telemetry};
use crate::wire::{AUTOPILOT_COMPONENT, Decoder, Encoder, Frame, Outgoing};

/// Bytes that wait for a reader at most.
const PENDING_MAX: usize = 256 * 1024;
/// Beyond this only answers are still kept, no telemetry.
const TELEMETRY_MAX: usize = PENDING_MAX - 32 * 1024;
/// Incoming bytes are decoded in pieces, so that a flood does not gather in memory.
const PIECE: usize = 4096;
/// After a pause of this many steps nothing more belongs to the bytes that have come (a frame takes far less).
const PAUSE_STEPS: u32 = 50;
/// Parameters sent per step while a list is under way (2300 per second).
const PARAMETERS_PER_STEP: u16 = 23;

/// What the vehicle keeps for one link.
#[derive(Debug)]
pub(super) struct Link {
    pub(super) schedule: Schedule,
    /// The next parameter of a list that is being sent.
    pub(super) listing: Option<u16>,
    /// Whether anything was ever received: until then the vehicle says little.
    pub(super) heard: bool,
    /// Answers to this ground station alone.
    pub(super) replies: Vec<Outgoing>,
}

impl Link {
    /// Queues an answer.
    pub(super) fn reply(&mut self, message: MavMessage) {
        self.replies.push(message.into());
    }
}

/// A link with its bytes.
#[derive(Debug)]
pub(super) struct Port {
    link: Link,
    decoder: Decoder,
    encoder: Encoder,
    pending: Vec<u8>,
    quiet_steps: u32,
    pub(super) open: bool,
}

impl Port {
    pub(super) fn new(system: u8, now: Duration) -> Self {
        Self {
            link: Link {
                schedule: Schedule::new(now),
                listing: None,
                heard: false,
                replies: Vec::new(),
            },
            decoder: Decoder::new(),
            encoder: Encoder::new(system, AUTOPILOT_COMPONENT),
            pending: Vec::new(),
            quiet_steps: 0,
            open: true,
        }
    }

    /// Takes in bytes and answers what they ask. What the vehicle has to say to everybody is left in its outbox
    /// except for this link, which gets it in order with its answers.
    pub(super) fn receive(&mut self, autopilot: &mut Autopilot, bytes: &[u8]) -> Vec<MavMessage> {
        let mut for_others = Vec::new();
        self.quiet_steps = 0;
        for piece in bytes.chunks(PIECE) {
            self.decoder.push(piece);
            while let Some(frame) = self.decoder.next_frame() {
                for_others.extend(self.handle(autopilot, &frame));
            }
        }
        for_others
    }

    /// Counts the pause since the last bytes; when it is long enough, frames behind a false start come out.
    pub(super) fn end_of_burst(&mut self, autopilot: &mut Autopilot) -> Vec<MavMessage> {
        let mut for_others = Vec::new();
        self.quiet_steps = self.quiet_steps.saturating_add(1);
        if self.quiet_steps == PAUSE_STEPS {
            while let Some(frame) = self.decoder.next_frame_at_end() {
                for_others.extend(self.handle(autopilot, &frame));
            }
        }
        for_others
    }

    fn handle(&mut self, autopilot: &mut Autopilot, frame: &Frame) -> Vec<MavMessage> {
        self.link.heard |= frame.is_verified();
        inbound::handle(autopilot, &mut self.link, frame);
        for reply in std::mem::take(&mut self.link.replies) {
            self.answer(&reply);
        }
        let said = std::mem::take(&mut autopilot.outbox);
        self.broadcast(&said);
        said
    }

    /// Sends what every ground station hears.
    pub(super) fn broadcast(&mut self, messages: &[MavMessage]) {
        for message in messages {
            let unasked = matches!(
                message,
                MavMessage::HEARTBEAT(_)
                    | MavMessage::TIMESYNC(_)
                    | MavMessage::HOME_POSITION(_)
                    | MavMessage::GPS_GLOBAL_ORIGIN(_)
            );
            if self.link.heard || unasked {
                self.answer(&Outgoing::Message(message.clone()));
            }
        }
    }

    /// Sends plain text between the frames.
    pub(super) fn print(&mut self, text: &str) {
        if self.pending.len() + text.len() <= TELEMETRY_MAX {
            self.pending.extend_from_slice(text.as_bytes());
        }
    }

    /// Sends what is due.
    pub(super) fn step(&mut self, autopilot: &Autopilot) {
        let (pending, encoder) = (&mut self.pending, &mut self.encoder);
        self.link.schedule.each_due(autopilot.uptime(), |id| {
            if autopilot.boot.holds_back(id) {
                return;
            }
            if let Some(message) = telemetry::message(id, autopilot) {
                append(pending, encoder, &message.into(), TELEMETRY_MAX);
            }
        });
        if let Some(first) = self.link.listing {
            let next = (first + PARAMETERS_PER_STEP).min(autopilot.parameters.count());
            for index in first..next {
                if let Some(parameter) = autopilot.parameters.at(index) {
                    self.answer(&inbound::parameter_value(autopilot, &parameter).into());
                }
            }
            self.link.listing = (next < autopilot.parameters.count()).then_some(next);
        }
    }

    /// Moves the bytes that wait.
    pub(super) fn take_output(&mut self, into: &mut Vec<u8>) {
        into.append(&mut self.pending);
    }

    fn answer(&mut self, outgoing: &Outgoing) {
        append(&mut self.pending, &mut self.encoder, outgoing, PENDING_MAX);
    }
}

/// Appends a frame unless that would exceed the room; the gap in the sequence numbers then tells of the loss.
fn append(pending: &mut Vec<u8>, encoder: &mut Encoder, outgoing: &Outgoing, room: usize) {
    let before = pending.len();
    encoder.encode(outgoing, pending);
    if pending.len() > room {
        pending.truncate(before);
    }
}
