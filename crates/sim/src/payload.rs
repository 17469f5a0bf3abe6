//! Payloads read by offset and written in wire order, so that numbers without a name in the dialect keep their value.

use mavlink::{MavlinkVersion, Message as _};

use sortie_wire::Content;

const LONGEST: usize = 255;

/// A received payload; bytes beyond its end read as zero.
#[derive(Debug, Clone)]
pub(super) struct Payload([u8; LONGEST]);

impl Payload {
    /// The payload of a frame; `None` if the frame is not verified.
    pub(super) fn of(content: &Content) -> Option<Self> {
        let mut bytes = [0; LONGEST];
        match content {
            Content::Message(message) => {
                message.ser(MavlinkVersion::V2, &mut bytes);
            }
            Content::Undecoded { payload, .. } => bytes = **payload,
            Content::Unknown { .. } => return None,
        }
        Some(Self(bytes))
    }

    /// A payload from bytes in the same layout, such as those of a file.
    pub(super) fn new(payload: &[u8]) -> Self {
        let mut bytes = [0; LONGEST];
        let len = payload.len().min(LONGEST);
        bytes[..len].copy_from_slice(&payload[..len]);
        Self(bytes)
    }

    pub(super) fn byte(&self, at: usize) -> u8 {
        self.0.get(at).copied().unwrap_or(0)
    }

    pub(super) fn short(&self, at: usize) -> u16 {
        u16::from_le_bytes([self.byte(at), self.byte(at + 1)])
    }

    pub(super) fn word(&self, at: usize) -> u32 {
        u32::from_le_bytes([at, at + 1, at + 2, at + 3].map(|i| self.byte(i)))
    }

    pub(super) fn integer(&self, at: usize) -> i32 {
        self.word(at).cast_signed()
    }

    pub(super) fn float(&self, at: usize) -> f32 {
        f32::from_bits(self.word(at))
    }

    /// The bytes from an offset on.
    pub(super) fn from(&self, at: usize) -> &[u8] {
        self.0.get(at..).unwrap_or_default()
    }
}

/// A payload that is being written.
#[derive(Debug, Clone, Default)]
pub(super) struct Writer(Vec<u8>);

impl Writer {
    pub(super) fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    pub(super) fn short(self, value: u16) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    pub(super) fn word(self, value: u32) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    pub(super) fn float(self, value: f32) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    pub(super) fn done(self) -> Vec<u8> {
        self.0
    }
}
