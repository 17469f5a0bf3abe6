//! Messages to bytes.

use mavlink::dialects::ardupilotmega::MavMessage;
use mavlink::{MavlinkVersion, Message as _, calculate_crc};

use super::{ComponentId, SystemId};

/// What can be sent.
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
        /// The message id; it must be one of the dialect's.
        id: u32,
        /// The payload in wire order, little-endian, extension fields included.
        payload: Vec<u8>,
    },
}

impl Outgoing {
    /// The message id.
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

/// Turns messages of one sender into frames, numbering them.
#[derive(Debug, Clone)]
pub struct Encoder {
    system: SystemId,
    component: ComponentId,
    sequence: u8,
    version: MavlinkVersion,
}

impl Encoder {
    /// An encoder for a sender; MAVLink 2.
    pub fn new(system: SystemId, component: ComponentId) -> Self {
        Self {
            system,
            component,
            sequence: 0,
            version: MavlinkVersion::V2,
        }
    }

    /// The sender's system id.
    pub fn system(&self) -> SystemId {
        self.system
    }

    /// Speaks MAVLink 1 or 2 from now on.
    pub fn set_version(&mut self, version: MavlinkVersion) {
        self.version = version;
    }

    /// Appends one frame to `bytes` and returns its length. A message id above 255 cannot be said in
    /// MAVLink 1 and is sent as MAVLink 2.
    pub fn encode(&mut self, outgoing: &Outgoing, bytes: &mut Vec<u8>) -> usize {
        let id = outgoing.id();
        let version = if id > 255 {
            MavlinkVersion::V2
        } else {
            self.version
        };
        let mut payload = [0u8; 255];
        let len = match outgoing {
            Outgoing::Message(message) => message.ser(version, &mut payload),
            Outgoing::Raw { payload: raw, .. } => {
                let len = raw.len().min(payload.len());
                payload[..len].copy_from_slice(&raw[..len]);
                match version {
                    MavlinkVersion::V1 => len,
                    MavlinkVersion::V2 => without_trailing_zeros(&payload[..len]),
                }
            }
        };
        let start = bytes.len();
        self.head(version, id, len as u8, bytes);
        bytes.extend_from_slice(&payload[..len]);
        let crc = calculate_crc(&bytes[start + 1..], MavMessage::extra_crc(id));
        bytes.extend_from_slice(&crc.to_le_bytes());
        self.sequence = self.sequence.wrapping_add(1);
        bytes.len() - start
    }

    fn head(&self, version: MavlinkVersion, id: u32, len: u8, bytes: &mut Vec<u8>) {
        let sender = [self.sequence, self.system, self.component];
        let [id0, id1, id2, _] = id.to_le_bytes();
        match version {
            MavlinkVersion::V1 => {
                bytes.extend_from_slice(&[0xFE, len]);
                bytes.extend_from_slice(&sender);
                bytes.push(id0);
            }
            MavlinkVersion::V2 => {
                bytes.extend_from_slice(&[0xFD, len, 0, 0]);
                bytes.extend_from_slice(&sender);
                bytes.extend_from_slice(&[id0, id1, id2]);
            }
        }
    }
}

/// The length of a payload without its trailing zeros; MAVLink 2 keeps at least one byte.
fn without_trailing_zeros(payload: &[u8]) -> usize {
    payload
        .iter()
        .rposition(|&byte| byte != 0)
        .map_or(1, |last| last + 1)
}
