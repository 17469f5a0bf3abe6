//! One peer of a link: its decoder, its numbering, its protocol version.

use std::collections::BTreeSet;

use mavlink::MavlinkVersion;

use super::meter::LinkMeter;
use super::{LinkConfig, LinkPeer, Parcel};
use crate::forward::receiver_of;
use crate::wire::{Decoder, Encoder, Frame, LossMeter, Outgoing, SystemId, is_frame_start};

/// The state of a peer. Each has its own encoder, so that messages to other peers leave no gaps in its sequence
/// numbers.
#[derive(Debug)]
pub(super) struct PeerStream {
    peer: LinkPeer,
    decoder: Decoder,
    loss: LossMeter,
    encoder: Encoder,
    speaks_v2: bool,
    /// The systems heard from the peer, which determine the keys of messages for everyone.
    systems: BTreeSet<SystemId>,
}

/// Whether an incomplete frame may continue in the next bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StreamEnding {
    /// A stream: it may end inside a frame.
    Open,
    /// A datagram: it may end inside a frame, since serial-to-UDP bridges split frames, but a later
    /// datagram that begins with a frame does not continue it.
    Datagram,
    /// A stream or a sender of datagrams after a pause.
    Closed,
}

impl PeerStream {
    pub(super) fn new(config: &LinkConfig, peer: LinkPeer) -> Self {
        Self {
            peer,
            decoder: Decoder::new(),
            loss: LossMeter::default(),
            encoder: Encoder::new(config.system, config.component),
            speaks_v2: false,
            systems: BTreeSet::new(),
        }
    }

    /// Finds the frames in received bytes.
    pub(super) fn receive(
        &mut self,
        bytes: &[u8],
        ending: StreamEnding,
        meter: &mut LinkMeter,
    ) -> Vec<Frame> {
        let before = self.decoder.counters();
        let mut frames = Vec::new();
        if ending == StreamEnding::Datagram && bytes.first().copied().is_some_and(is_frame_start) {
            self.take_frames(StreamEnding::Closed, meter, &mut frames);
        }
        self.decoder.push(bytes);
        self.take_frames(ending, meter, &mut frames);
        meter.decoded(before, self.decoder.counters());
        if frames.is_empty() && !bytes.is_empty() {
            meter.tap.noise(bytes);
        }
        frames
    }

    fn take_frames(
        &mut self,
        ending: StreamEnding,
        meter: &mut LinkMeter,
        frames: &mut Vec<Frame>,
    ) {
        while let Some(mut frame) = match ending {
            StreamEnding::Open | StreamEnding::Datagram => self.decoder.next_frame(),
            StreamEnding::Closed => self.decoder.next_frame_at_end(),
        } {
            let step = self.loss.note(&frame);
            let bytes = self.decoder.bytes_of(&frame);
            let mut is_admitted = true;
            if let Some(signing) = meter.tap.signing() {
                frame.seal = signing.check(&frame, bytes);
                is_admitted = signing.admits(frame.seal);
            }
            meter.numbered(&frame, step);
            meter.tap.received(self.peer, bytes, &frame);
            if frame.is_verified() {
                self.answer_in(frame.version);
                self.systems.insert(frame.system);
            }
            if is_admitted {
                frames.push(frame);
            }
        }
    }

    /// Whether the last bytes may be an incomplete frame.
    pub(super) fn has_tail(&self) -> bool {
        self.decoder.has_tail()
    }

    /// Chooses the version of answers: MAVLink 1 for a peer that has sent only MAVLink 1, otherwise
    /// MAVLink 2.
    fn answer_in(&mut self, heard: MavlinkVersion) {
        self.speaks_v2 |= heard == MavlinkVersion::V2;
        self.encoder.set_version(if self.speaks_v2 {
            MavlinkVersion::V2
        } else {
            MavlinkVersion::V1
        });
    }

    /// Switches to another peer for the next frames.
    pub(super) fn belongs_to(&mut self, peer: LinkPeer) {
        self.peer = peer;
    }

    /// Appends the frame of a parcel to the output.
    pub(super) fn encode(&mut self, parcel: &Parcel, bytes: &mut Vec<u8>, meter: &LinkMeter) {
        match parcel {
            Parcel::Message(outgoing) => self.encode_own(outgoing, bytes, meter),
            Parcel::Frame(frame) => {
                bytes.extend_from_slice(frame);
                meter.tap.sent(self.peer, frame);
            }
        }
    }

    /// Appends the frames of a message of the console: one for each key of its receivers, or an unsigned one.
    fn encode_own(&mut self, outgoing: &Outgoing, bytes: &mut Vec<u8>, meter: &LinkMeter) {
        let seals = match meter.tap.signing() {
            Some(signing) => {
                let to = receiver_of(outgoing).map(|receiver| receiver.system);
                signing.seal(to, self.systems.iter().copied())
            }
            None => Vec::new(),
        };
        for at in 0..seals.len().max(1) {
            let from = bytes.len();
            if let Some((key, stamp)) = seals.get(at) {
                self.encoder.sign_next(key, *stamp);
            }
            self.encoder.encode(outgoing, bytes);
            meter.tap.sent_own(&bytes[from..]);
            meter.tap.sent(self.peer, &bytes[from..]);
        }
    }
}
