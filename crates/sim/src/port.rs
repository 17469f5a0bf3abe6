//! A vehicle's serial ports, and the ground stations on them.
//!
//! A serial port has one [`Link`]: the rates requested on it stay after the requesting ground
//! station has gone. A real port has room for one ground station; here any number can share it.
//! Each of them gets the same streams and texts; an answer (and a parameter list) goes only to the
//! requester.

use mavlink::dialects::ardupilotmega::MavMessage;

use super::autopilot::Autopilot;
use super::link::{Link, LinkNumber};
use super::signing::Signing;
use super::transfer::Transfers;
use super::vehicle::Vehicle;
use super::{Serial, inbound, transfer};
use sortie_wire::{AUTOPILOT_COMPONENT, Decoder, Encoder, Frame, Outgoing};

/// The maximum number of bytes that wait for a reader.
const PENDING_MAX: usize = 256 * 1024;
/// If more bytes than this wait, telemetry is dropped and only answers are kept.
const TELEMETRY_MAX: usize = PENDING_MAX - 32 * 1024;
/// A buffer that has grown beyond this is freed once it is empty.
const PENDING_KEPT: usize = 4096;
/// If more bytes than this wait, transfers pause.
const TRANSFERS_MAX: usize = PENDING_MAX / 2;
/// Incoming bytes are decoded in pieces of this length, so that a flood does not accumulate in
/// memory.
const PIECE: usize = 4096;
/// After a pause of this many steps, an incomplete frame will no longer be completed (a frame takes far less).
const PAUSE_STEPS: u32 = 50;
/// Parameters sent per step while a list is under way (2300 per second).
const PARAMETERS_PER_STEP: u16 = 23;

/// The serial ports of one vehicle.
#[derive(Debug, Clone)]
pub(super) struct Serials {
    pub(super) links: [Link; Serial::ALL.len()],
    pub(super) signing: Signing,
    pub(super) transfers: Box<Transfers>,
    /// Whether a transfer is under way; kept here, so that a step without one does not read the transfers.
    pub(super) transferring: bool,
}

impl Serials {
    /// The serial ports after a boot.
    pub(super) fn booted(vehicle: &Vehicle, signing: Signing, transfers: Box<Transfers>) -> Self {
        let now = vehicle.uptime();
        Self {
            links: Serial::ALL.map(|serial| Link::new(serial, &vehicle.parameters, now)),
            signing,
            transferring: !transfers.is_idle(),
            transfers,
        }
    }

    pub(super) fn link_mut(&mut self, serial: Serial) -> &mut Link {
        &mut self.links[serial.index()]
    }
}

/// One ground station on a serial port.
#[derive(Debug, Clone)]
pub(super) struct Port {
    pub(super) serial: Serial,
    pub(super) open: bool,
    decoder: Decoder,
    encoder: Encoder,
    pending: Vec<u8>,
    /// The next parameter of a list that is being sent.
    listing: Option<u16>,
    /// The number of this ground station in transfers.
    transfer: LinkNumber,
    quiet_steps: u32,
}

impl Port {
    pub(super) fn new(system: u8, serial: Serial) -> Self {
        Self {
            serial,
            open: true,
            decoder: Decoder::new(),
            encoder: Encoder::new(system, AUTOPILOT_COMPONENT),
            pending: Vec::new(),
            listing: None,
            transfer: LinkNumber::default(),
            quiet_steps: 0,
        }
    }

    /// Handles bytes and answers their requests. Broadcast messages are returned for the other
    /// ground stations; this one gets them in order with its answers.
    pub(super) fn receive(
        &mut self,
        autopilot: &mut Autopilot,
        serials: &mut Serials,
        bytes: &[u8],
    ) -> Vec<MavMessage> {
        let mut for_others = Vec::new();
        self.quiet_steps = 0;
        for piece in bytes.chunks(PIECE) {
            self.decoder.push(piece);
            while let Some(frame) = self.decoder.next_frame() {
                for_others.extend(self.handle(autopilot, serials, &frame));
            }
        }
        for_others
    }

    /// Counts a step without bytes; true once the pause is long enough to release frames behind a false start: see
    /// [`Port::end_of_burst`].
    pub(super) fn is_pause(&mut self) -> bool {
        self.quiet_steps = self.quiet_steps.saturating_add(1);
        self.quiet_steps == PAUSE_STEPS && self.decoder.has_tail()
    }

    /// Handles frames that were hidden behind a false start, as [`Port::receive`] does.
    pub(super) fn end_of_burst(
        &mut self,
        autopilot: &mut Autopilot,
        serials: &mut Serials,
    ) -> Vec<MavMessage> {
        let mut for_others = Vec::new();
        while let Some(frame) = self.decoder.next_frame_at_end() {
            for_others.extend(self.handle(autopilot, serials, &frame));
        }
        for_others
    }

    fn handle(
        &mut self,
        autopilot: &mut Autopilot,
        serials: &mut Serials,
        frame: &Frame,
    ) -> Vec<MavMessage> {
        let bytes = self.decoder.bytes_of(frame);
        if !frame.is_verified() || !serials.signing.admits(self.serial, frame, bytes) {
            return Vec::new();
        }
        let Serials {
            links,
            signing,
            transfers,
            transferring,
        } = serials;
        let link = &mut links[self.serial.index()];
        link.heard = true;
        link.transfer = self.transfer;
        inbound::handle(autopilot, transfers, link, frame);
        *transferring = !transfers.is_idle();
        self.transfer = link.transfer;
        if let Some((key, timestamp)) = link.key.take() {
            signing.load(key, timestamp);
        }
        self.listing = link.listing.take().or(self.listing);
        for reply in link.replies.drain(..) {
            self.answer(&reply, signing);
        }
        let said = std::mem::take(&mut autopilot.vehicle.outbox);
        self.broadcast(&said, serials);
        said
    }

    /// Sends messages that go to every ground station.
    pub(super) fn broadcast(&mut self, messages: &[MavMessage], serials: &mut Serials) {
        let heard = serials.link_mut(self.serial).heard;
        for message in messages {
            let unasked = matches!(
                message,
                MavMessage::HEARTBEAT(_)
                    | MavMessage::TIMESYNC(_)
                    | MavMessage::HOME_POSITION(_)
                    | MavMessage::GPS_GLOBAL_ORIGIN(_)
            );
            if heard || unasked {
                self.say(message, &mut serials.signing, PENDING_MAX);
            }
        }
    }

    /// Sends plain text between the frames.
    pub(super) fn print(&mut self, text: &str) {
        if self.pending.len() + text.len() <= TELEMETRY_MAX {
            self.pending.extend_from_slice(text.as_bytes());
        }
    }

    /// Sends telemetry; answers take precedence if the client does not read.
    pub(super) fn stream(&mut self, message: &MavMessage, signing: &mut Signing) {
        self.say(message, signing, TELEMETRY_MAX);
    }

    /// Continues a list of parameters.
    pub(super) fn list(&mut self, autopilot: &Autopilot, signing: &mut Signing) {
        let Some(first) = self.listing else {
            return;
        };
        let count = autopilot.vehicle.parameters.count();
        let next = (first + PARAMETERS_PER_STEP).min(count);
        for index in first..next {
            if let Some(parameter) = autopilot.vehicle.parameters.at(index) {
                let value = autopilot.vehicle.parameters.message(&parameter);
                self.say(&value, signing, PENDING_MAX);
            }
        }
        self.listing = (next < count).then_some(next);
    }

    /// Continues transfers; they pause for a slow reader.
    pub(super) fn transfer(&mut self, autopilot: &mut Autopilot, serials: &mut Serials) {
        if !serials.transferring || self.pending.len() >= TRANSFERS_MAX {
            return;
        }
        let Serials {
            links,
            signing,
            transfers,
            transferring,
        } = serials;
        let link = &mut links[self.serial.index()];
        link.transfer = self.transfer;
        transfer::step(transfers, autopilot, link);
        *transferring = !transfers.is_idle();
        for reply in link.replies.drain(..) {
            self.answer(&reply, signing);
        }
    }

    /// Moves the waiting bytes to the end of `into`.
    pub(super) fn take_output(&mut self, into: &mut Vec<u8>) {
        into.append(&mut self.pending);
        if self.pending.capacity() > PENDING_KEPT {
            self.pending = Vec::new();
        }
    }

    /// Sends a message that is not telemetry.
    pub(super) fn answer(&mut self, outgoing: &Outgoing, signing: &mut Signing) {
        self.seal(signing);
        let before = self.pending.len();
        self.encoder.encode(outgoing, &mut self.pending);
        self.keep_within(PENDING_MAX, before);
    }

    fn say(&mut self, message: &MavMessage, signing: &mut Signing, room: usize) {
        self.seal(signing);
        let before = self.pending.len();
        self.encoder.encode_message(message, &mut self.pending);
        self.keep_within(room, before);
    }

    fn seal(&mut self, signing: &mut Signing) {
        if let Some((key, stamp)) = signing.seal(self.serial) {
            self.encoder.sign_next(&key, stamp);
        }
    }

    /// Drops a frame that does not fit; the gap in the sequence numbers then shows the loss.
    fn keep_within(&mut self, room: usize, before: usize) {
        if self.pending.len() > room {
            self.pending.truncate(before);
        }
    }
}
