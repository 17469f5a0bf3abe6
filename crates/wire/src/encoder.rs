//! Encodes messages as frames.

use mavlink::dialects::ardupilotmega::MavMessage;
use mavlink::{MavlinkVersion, Message as _};

use super::beyond;
use super::checksum;
use super::decoder::{FLAG_SIGNED, STX_V1, STX_V2};
use super::signature::{self, SigningKey, Stamp};
use super::{ComponentId, SystemId};

/// A message to send.
#[derive(Debug, Clone, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "nearly every item is a message; boxing it would cost an allocation per packet"
)]
pub enum Outgoing {
    /// A message of the dialect.
    Message(MavMessage),
    /// A message of the dialect whose payload was laid out by hand, because one of its enum fields carries a
    /// number that the dialect has no name for (any `MAV_CMD` by number).
    Raw {
        /// The message id; it must be one of the dialect's, or [`CONTROL_STATUS`](super::CONTROL_STATUS).
        id: u32,
        /// The payload in wire order, little-endian, extension fields included.
        payload: Vec<u8>,
    },
}

impl Outgoing {
    /// The message id for the frame's header.
    pub fn id(&self) -> u32 {
        match self {
            Self::Message(message) => message.message_id(),
            Self::Raw { id, .. } => *id,
        }
    }
}

impl From<MavMessage> for Outgoing {
    fn from(message: MavMessage) -> Self {
        Self::Message(message)
    }
}

/// Turns the messages of one sender into numbered frames.
#[derive(Debug, Clone)]
pub struct Encoder {
    system: SystemId,
    component: ComponentId,
    sequence: u8,
    version: MavlinkVersion,
    /// The key and the time for signing the next frame.
    seal: Option<(SigningKey, Stamp)>,
}

impl Encoder {
    /// An encoder for a sender; it starts with MAVLink 2.
    pub fn new(system: SystemId, component: ComponentId) -> Self {
        Self {
            system,
            component,
            sequence: 0,
            version: MavlinkVersion::V2,
            seal: None,
        }
    }

    /// The sender's system id.
    pub fn system(&self) -> SystemId {
        self.system
    }

    /// Sets the MAVLink version of the next frames.
    pub fn set_version(&mut self, version: MavlinkVersion) {
        self.version = version;
    }

    /// Signs the next frame, if it is a `MAVLink` 2 one.
    pub fn sign_next(&mut self, key: &SigningKey, stamp: Stamp) {
        self.seal = Some((*key, stamp));
    }

    /// Appends one frame to `bytes` and returns its length. A message id above 255 does not exist in MAVLink 1 and is
    /// sent as MAVLink 2.
    pub fn encode(&mut self, outgoing: &Outgoing, bytes: &mut Vec<u8>) -> usize {
        match outgoing {
            Outgoing::Message(message) => self.encode_message(message, bytes),
            Outgoing::Raw { id, payload: raw } => {
                let version = self.version_for(*id);
                let payload = &raw[..raw.len().min(255)];
                let len = match version {
                    MavlinkVersion::V1 => payload.len(),
                    MavlinkVersion::V2 => without_trailing_zeros(payload),
                };
                // An empty payload still has one byte in MAVLink 2.
                let payload = payload.get(..len).unwrap_or(&[0]);
                self.frame(version, *id, payload, bytes)
            }
        }
    }

    /// [`Encoder::encode`] for a borrowed message.
    pub fn encode_message(&mut self, message: &MavMessage, bytes: &mut Vec<u8>) -> usize {
        let id = message.message_id();
        let version = self.version_for(id);
        let mut payload = [0u8; 255];
        let len = message.ser(version, &mut payload);
        self.frame(version, id, &payload[..len], bytes)
    }

    fn version_for(&self, id: u32) -> MavlinkVersion {
        if id > 255 {
            MavlinkVersion::V2
        } else {
            self.version
        }
    }

    fn frame(
        &mut self,
        version: MavlinkVersion,
        id: u32,
        payload: &[u8],
        bytes: &mut Vec<u8>,
    ) -> usize {
        let seal = self.seal.take().filter(|_| version == MavlinkVersion::V2);
        let start = bytes.len();
        let head = HeaderFields {
            version,
            id,
            signed: seal.is_some(),
            length: payload.len() as u8,
        };
        self.head(head, bytes);
        bytes.extend_from_slice(payload);
        let crc = checksum::of_frame(&bytes[start + 1..], beyond::seed(id));
        bytes.extend_from_slice(&crc.to_le_bytes());
        if let Some((key, stamp)) = seal {
            stamp.append_to(bytes);
            let hash = signature::hash(&key, &bytes[start..]);
            bytes.extend_from_slice(&hash.unwrap_or_default());
        }
        self.sequence = self.sequence.wrapping_add(1);
        bytes.len() - start
    }

    fn head(&self, head: HeaderFields, bytes: &mut Vec<u8>) {
        let len = head.length;
        let sender = [self.sequence, self.system, self.component];
        let [id0, id1, id2, _] = head.id.to_le_bytes();
        match head.version {
            MavlinkVersion::V1 => {
                bytes.extend_from_slice(&[STX_V1, len]);
                bytes.extend_from_slice(&sender);
                bytes.push(id0);
            }
            MavlinkVersion::V2 => {
                let flags = if head.signed { FLAG_SIGNED } else { 0 };
                bytes.extend_from_slice(&[STX_V2, len, flags, 0]);
                bytes.extend_from_slice(&sender);
                bytes.extend_from_slice(&[id0, id1, id2]);
            }
        }
    }
}

/// The fields of a frame's header, except the sender.
#[derive(Debug, Clone, Copy)]
struct HeaderFields {
    version: MavlinkVersion,
    id: u32,
    signed: bool,
    /// Length of the payload in bytes.
    length: u8,
}

/// The length of a payload without its trailing zeros; MAVLink 2 keeps at least one byte.
fn without_trailing_zeros(payload: &[u8]) -> usize {
    payload
        .iter()
        .rposition(|&byte| byte != 0)
        .map_or(1, |last| last + 1)
}
