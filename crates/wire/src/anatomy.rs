//! A frame's bytes split into their parts, for display.

use mavlink::MavlinkVersion;

use super::checksum;
use super::decoder::{FLAG_SIGNED, SIGNATURE_LEN, STX_V1, STX_V2};
use super::{ComponentId, SystemId};

const V1_HEADER_LEN: usize = 6;
const V2_HEADER_LEN: usize = 10;
const CHECKSUM_LEN: usize = 2;

/// The parts of one frame; the payload is not decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Anatomy<'a> {
    /// MAVLink 1 or 2.
    pub version: MavlinkVersion,
    /// Whether a signature follows the checksum.
    pub signed: bool,
    /// The sender's system id.
    pub system: SystemId,
    /// The sender's component id.
    pub component: ComponentId,
    /// The sender's sequence number.
    pub sequence: u8,
    /// The message id: 0 to 255 in MAVLink 1, 24 bits in MAVLink 2.
    pub id: u32,
    /// The payload as it was sent: in MAVLink 2 without the zeros at its end.
    pub payload: &'a [u8],
    /// The bytes covered by the checksum, without the message's seed.
    covered: &'a [u8],
    checksum: u16,
}

/// The length of a whole frame in bytes, from its first three; `None` if they do not begin a frame.
pub fn frame_len(head: [u8; 3]) -> Option<usize> {
    let [start, payload_len, flags] = head;
    let (header_len, signature_len) = match start {
        STX_V1 => (V1_HEADER_LEN, 0),
        STX_V2 if flags & FLAG_SIGNED != 0 => (V2_HEADER_LEN, SIGNATURE_LEN),
        STX_V2 => (V2_HEADER_LEN, 0),
        _ => return None,
    };
    Some(header_len + usize::from(payload_len) + CHECKSUM_LEN + signature_len)
}

/// The bytes of a frame with zeros for its payload, to show a message with a secret. Bytes that are
/// not a frame are returned unchanged.
pub fn without_payload(bytes: &[u8]) -> Vec<u8> {
    let mut shown = bytes.to_vec();
    if let Some(frame) = Anatomy::of(bytes) {
        let header_len = match frame.version {
            MavlinkVersion::V1 => V1_HEADER_LEN,
            MavlinkVersion::V2 => V2_HEADER_LEN,
        };
        shown[header_len..header_len + frame.payload.len()].fill(0);
    }
    shown
}

impl<'a> Anatomy<'a> {
    /// Splits the bytes of exactly one frame; `None` if they are not a frame.
    pub fn of(bytes: &'a [u8]) -> Option<Self> {
        let (version, header_len, flags, id) = match *bytes {
            [STX_V1, _, _, _, _, id, ..] => (MavlinkVersion::V1, V1_HEADER_LEN, 0, u32::from(id)),
            [STX_V2, _, flags, _, _, _, _, id0, id1, id2, ..] => {
                let id = u32::from_le_bytes([id0, id1, id2, 0]);
                (MavlinkVersion::V2, V2_HEADER_LEN, flags, id)
            }
            _ => return None,
        };
        let signed = flags & FLAG_SIGNED != 0;
        let crc_at = header_len + usize::from(bytes[1]);
        if frame_len([bytes[0], bytes[1], bytes[2]]) != Some(bytes.len()) {
            return None;
        }
        let sender = match version {
            MavlinkVersion::V1 => &bytes[2..5],
            MavlinkVersion::V2 => &bytes[4..7],
        };
        Some(Self {
            version,
            signed,
            system: sender[1],
            component: sender[2],
            sequence: sender[0],
            id,
            payload: &bytes[header_len..crc_at],
            covered: &bytes[1..crc_at],
            checksum: u16::from_le_bytes([bytes[crc_at], bytes[crc_at + 1]]),
        })
    }

    /// Whether the checksum is right for a message with this seed (`CRC_EXTRA`).
    pub fn matches(&self, seed: u8) -> bool {
        checksum::of_frame(self.covered, seed) == self.checksum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Encoder, ground_station_heartbeat};

    #[test]
    fn a_frame_falls_into_its_parts_in_both_versions() {
        for version in [MavlinkVersion::V1, MavlinkVersion::V2] {
            let mut encoder = Encoder::new(7, 9);
            encoder.set_version(version);
            let mut bytes = Vec::new();
            encoder.encode(&ground_station_heartbeat(), &mut bytes);
            bytes.clear();
            encoder.encode(&ground_station_heartbeat(), &mut bytes);
            let frame = Anatomy::of(&bytes).expect("a frame");
            let said = (frame.system, frame.component, frame.sequence, frame.id);
            assert_eq!(said, (7, 9, 1, 0));
            assert_eq!((frame.version, frame.signed), (version, false));
            assert!(frame.matches(50), "HEARTBEAT's seed");
            assert!(!frame.matches(51));
            bytes.pop();
            assert_eq!(Anatomy::of(&bytes), None, "cut short");
        }
        assert_eq!(Anatomy::of(b""), None);
        assert_eq!(Anatomy::of(b"no frame"), None);
    }
}
