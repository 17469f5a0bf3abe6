//! Messages that the dialect of the mavlink crate lacks. Their frames are checked, and their payloads are read by hand.

use mavlink::Message as _;
use mavlink::dialects::ardupilotmega::MavMessage;

/// The id of `CONTROL_STATUS`: which ground stations control a system.
pub const CONTROL_STATUS: u32 = 512;

/// The messages beyond the dialect, with their CRC seeds.
const SEEDS: [(u32, u8); 1] = [(CONTROL_STATUS, 21)];

/// The CRC seed of a message; 0 if it is unknown.
pub(super) fn seed(id: u32) -> u8 {
    let beyond = SEEDS.iter().find(|(known, _)| *known == id);
    beyond.map_or_else(|| MavMessage::extra_crc(id), |(_, seed)| *seed)
}

/// Whether the dialect lacks a message whose seed is known here.
pub(super) fn is_beyond(id: u32) -> bool {
    SEEDS.iter().any(|(known, _)| *known == id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Content, Decoder, Encoder, Outgoing};

    #[test]
    fn the_table_has_only_messages_that_the_dialect_lacks() {
        for (id, _) in SEEDS {
            assert_eq!(MavMessage::extra_crc(id), 0, "{id}");
        }
    }

    #[test]
    fn a_message_beyond_the_dialect_is_checked_and_keeps_its_payload() {
        let mut bytes = Vec::new();
        let payload = vec![3, 250, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        let id = CONTROL_STATUS;
        Encoder::new(1, 1).encode(&Outgoing::Raw { id, payload }, &mut bytes);
        let mut decoder = Decoder::new();
        decoder.push(&bytes);
        let frame = decoder.next_frame().expect("a frame");
        assert!(frame.is_verified());
        let Content::Undecoded { id, payload } = frame.content else {
            panic!("read by hand");
        };
        assert_eq!((id, &payload[..3]), (CONTROL_STATUS, &[3, 250, 0][..]));
        assert_eq!(decoder.counters().unknown_messages, 0);
        bytes[10] ^= 1;
        let mut damaged = Decoder::new();
        damaged.push(&bytes);
        assert_eq!(damaged.next_frame(), None);
    }
}
