//! From bytes to frames, counting all dropped bytes.

use mavlink::dialects::ardupilotmega::MavMessage;
use mavlink::error::ParserError;
use mavlink::{MavlinkVersion, Message as _};

use super::beyond;
use super::checksum;
use super::{Content, Frame, Seal};

#[cfg(test)]
mod tests;

pub(super) const STX_V1: u8 = 0xFE;
pub(super) const STX_V2: u8 = 0xFD;
/// The only incompatibility flag that this program supports: the frame is signed.
pub(super) const FLAG_SIGNED: u8 = 0x01;
pub(super) const SIGNATURE_LEN: usize = 13;
/// Consumed bytes are removed from the buffer once this many have accumulated.
const COMPACT_AT: usize = 4096;

/// Whether a frame can begin with this byte.
pub fn is_frame_start(byte: u8) -> bool {
    matches!(byte, STX_V1 | STX_V2)
}

/// The counters of a decoder since its creation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// All bytes, good or bad.
    pub bytes: u64,
    /// Intact frames of the dialect.
    pub frames: u64,
    /// Complete frames with a wrong checksum.
    pub crc_errors: u64,
    /// Bytes that belonged to no frame.
    pub skipped_bytes: u64,
    /// Frames with a message id that the dialect lacks; their checksum cannot be verified. Not in `frames`.
    pub unknown_messages: u64,
    /// Frames whose payload holds an enum value that the dialect lacks.
    pub undecoded: u64,
}

/// Finds frames in a byte stream. A false start costs one byte, never an intact frame behind it.
#[derive(Debug, Clone, Default)]
pub struct Decoder {
    buffer: Vec<u8>,
    /// The position in the buffer at which the search continues.
    position: usize,
    /// The end of the last frame that was dropped for its checksum: its bytes are not counted as noise too.
    dropped_until: usize,
    counters: Counters,
}

/// The position of a frame in the buffer, from its header.
struct FrameLayout {
    version: MavlinkVersion,
    header_len: usize,
    payload_len: usize,
    signed: bool,
    id: u32,
}

impl FrameLayout {
    fn end(&self) -> usize {
        self.header_len + self.payload_len + 2 + if self.signed { SIGNATURE_LEN } else { 0 }
    }
}

enum FrameCandidate {
    Frame(FrameLayout),
    Incomplete,
    NotAFrame,
}

impl Decoder {
    /// A decoder that has seen no bytes: all counters are zero.
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends bytes in the order in which they arrived.
    pub fn push(&mut self, bytes: &[u8]) {
        if self.position >= COMPACT_AT || self.position == self.buffer.len() {
            self.buffer.drain(..self.position);
            self.dropped_until = self.dropped_until.saturating_sub(self.position);
            self.position = 0;
        }
        self.counters.bytes += bytes.len() as u64;
        self.buffer.extend_from_slice(bytes);
    }

    /// The counters so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// Whether the buffer holds bytes that may begin a frame. Call it when [`Self::next_frame`] has
    /// returned `None`.
    pub fn has_tail(&self) -> bool {
        self.position < self.buffer.len()
    }

    /// The next frame, intact or of an unknown message, or `None` until more bytes arrive.
    pub fn next_frame(&mut self) -> Option<Frame> {
        loop {
            self.seek_start();
            match self.candidate() {
                FrameCandidate::Incomplete => return None,
                FrameCandidate::NotAFrame => self.skip(1),
                FrameCandidate::Frame(layout) => {
                    if let Some(frame) = self.accept(&layout) {
                        return Some(frame);
                    }
                }
            }
        }
    }

    /// Marks the end of the bytes so far: the end of a datagram, or a pause on a stream. Returns a frame that was
    /// hidden behind a false start; call it until it returns `None`.
    pub fn next_frame_at_end(&mut self) -> Option<Frame> {
        loop {
            if let Some(frame) = self.next_frame() {
                return Some(frame);
            }
            if self.position == self.buffer.len() {
                return None;
            }
            self.skip(1);
        }
    }

    /// The bytes of a frame that has just been returned, valid until the next call of the decoder.
    pub fn bytes_of(&self, frame: &Frame) -> &[u8] {
        let from = self.position.saturating_sub(usize::from(frame.wire_len));
        &self.buffer[from..self.position]
    }

    fn seek_start(&mut self) {
        let rest = &self.buffer[self.position..];
        let gap = rest
            .iter()
            .position(|&byte| is_frame_start(byte))
            .unwrap_or(rest.len());
        self.skip(gap);
    }

    fn skip(&mut self, count: usize) {
        let to = self.position + count;
        let uncounted = self.dropped_until.clamp(self.position, to) - self.position;
        self.counters.skipped_bytes += (count - uncounted) as u64;
        self.position = to;
    }

    fn candidate(&self) -> FrameCandidate {
        let rest = &self.buffer[self.position..];
        let layout = match *rest {
            [STX_V1, len, _, _, _, id, ..] => FrameLayout {
                version: MavlinkVersion::V1,
                header_len: 6,
                payload_len: usize::from(len),
                signed: false,
                id: u32::from(id),
            },
            [STX_V2, _, flags, ..] if flags & !FLAG_SIGNED != 0 => {
                return FrameCandidate::NotAFrame;
            }
            [STX_V2, len, flags, _, _, _, _, id0, id1, id2, ..] => FrameLayout {
                version: MavlinkVersion::V2,
                header_len: 10,
                payload_len: usize::from(len),
                signed: flags & FLAG_SIGNED != 0,
                id: u32::from_le_bytes([id0, id1, id2, 0]),
            },
            _ => return FrameCandidate::Incomplete,
        };
        if rest.len() < layout.end() {
            return FrameCandidate::Incomplete;
        }
        FrameCandidate::Frame(layout)
    }

    /// Checks a complete candidate and skips it, or only its first byte if it turns out to be no frame.
    fn accept(&mut self, layout: &FrameLayout) -> Option<Frame> {
        let end = layout.end();
        let bytes = &self.buffer[self.position..self.position + end];
        let crc_at = layout.header_len + layout.payload_len;
        let followed_by_start = self
            .buffer
            .get(self.position + end)
            .is_none_or(|&byte| is_frame_start(byte));
        if !is_known(layout.id) {
            // Without a CRC seed, only the neighbouring bytes distinguish an unknown message from noise.
            if !followed_by_start {
                self.skip(1);
                return None;
            }
            let frame = self.unknown(layout);
            self.position += end;
            return Some(frame);
        }
        let crc = checksum::of_frame(&bytes[1..crc_at], beyond::seed(layout.id));
        if crc.to_le_bytes() != bytes[crc_at..crc_at + 2] {
            let counted_already = self.position < self.dropped_until;
            if followed_by_start && !counted_already {
                self.counters.crc_errors += 1;
                self.dropped_until = self.position + end;
            }
            self.skip(1);
            return None;
        }
        let frame = self.parse(layout);
        self.position += end;
        Some(frame)
    }

    fn parse(&mut self, layout: &FrameLayout) -> Frame {
        let bytes = &self.buffer[self.position..];
        let payload = &bytes[layout.header_len..layout.header_len + layout.payload_len];
        if beyond::is_beyond(layout.id) {
            let content = by_hand(layout.id, payload);
            self.counters.frames += 1;
            return self.frame(layout, content);
        }
        let content = match MavMessage::parse(layout.version, layout.id, payload) {
            Ok(message) => Content::Message(message),
            Err(ParserError::InvalidEnum { .. }) => {
                self.counters.undecoded += 1;
                by_hand(layout.id, payload)
            }
            Err(_) => {
                // Longer than the dialect's definition: a newer revision of the message.
                return self.unknown(layout);
            }
        };
        self.counters.frames += 1;
        self.frame(layout, content)
    }

    fn unknown(&mut self, layout: &FrameLayout) -> Frame {
        self.counters.unknown_messages += 1;
        self.frame(layout, Content::Unknown { id: layout.id })
    }

    fn frame(&self, layout: &FrameLayout, content: Content) -> Frame {
        let bytes = &self.buffer[self.position..];
        let sender = match layout.version {
            MavlinkVersion::V1 => &bytes[2..5],
            MavlinkVersion::V2 => &bytes[4..7],
        };
        Frame {
            system: sender[1],
            component: sender[2],
            sequence: sender[0],
            version: layout.version,
            seal: if layout.signed {
                Seal::Foreign
            } else {
                Seal::Unsigned
            },
            wire_len: layout.end() as u16,
            content,
        }
    }
}

/// The content of a frame whose payload is read by hand.
fn by_hand(id: u32, payload: &[u8]) -> Content {
    let mut extended = Box::new([0; 255]);
    extended[..payload.len()].copy_from_slice(payload);
    Content::Undecoded {
        id,
        payload: extended,
    }
}

/// Whether the message can be checked. `seed` returns 0 for unknown messages, and one known message has the
/// seed 0.
fn is_known(id: u32) -> bool {
    /// The id of `COMPONENT_INFORMATION`.
    const SEED_IS_ZERO: u32 = 395;
    beyond::seed(id) != 0 || id == SEED_IS_ZERO
}
