//! The results and the counters of the decoder.

use super::*;
use crate::{Encoder, Outgoing};
use mavlink::dialects::ardupilotmega::{ATTITUDE_DATA, HEARTBEAT_DATA};
use proptest::prelude::*;

fn heartbeat() -> Outgoing {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()).into()
}

fn frames(decoder: &mut Decoder) -> Vec<Frame> {
    std::iter::from_fn(|| decoder.next_frame()).collect()
}

fn encoded(count: usize, version: MavlinkVersion) -> Vec<u8> {
    let mut encoder = Encoder::new(7, 1);
    encoder.set_version(version);
    let mut bytes = Vec::new();
    for _ in 0..count {
        encoder.encode(&heartbeat(), &mut bytes);
    }
    bytes
}

#[test]
fn both_protocol_versions_are_read_mixed() {
    let mut decoder = Decoder::new();
    decoder.push(&encoded(1, MavlinkVersion::V1));
    decoder.push(&encoded(1, MavlinkVersion::V2));
    let read = frames(&mut decoder);
    assert_eq!(read.len(), 2);
    assert_eq!(read[0].version, MavlinkVersion::V1);
    assert_eq!(read[1].version, MavlinkVersion::V2);
    assert_eq!(read[0].content, read[1].content);
    assert_eq!(decoder.counters().skipped_bytes, 0);
}

#[test]
fn text_between_frames_costs_only_a_counter() {
    let text = b"Init Gyro**\n";
    let mut decoder = Decoder::new();
    decoder.push(text);
    decoder.push(&encoded(1, MavlinkVersion::V2));
    decoder.push(text);
    decoder.push(&encoded(1, MavlinkVersion::V2));
    assert_eq!(frames(&mut decoder).len(), 2);
    assert_eq!(decoder.counters().skipped_bytes, 2 * text.len() as u64);
    assert_eq!(decoder.counters().crc_errors, 0);
}

#[test]
fn a_flipped_bit_is_counted_as_one_bad_checksum() {
    let mut bytes = encoded(3, MavlinkVersion::V2);
    let second = bytes.len() / 3;
    bytes[second + 12] ^= 0x10;
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    assert_eq!(frames(&mut decoder).len(), 2);
    assert_eq!(decoder.counters().crc_errors, 1);
    assert_eq!(decoder.counters().skipped_bytes, 0);
}

#[test]
fn a_false_start_at_the_end_of_a_datagram_hides_nothing() {
    let mut decoder = Decoder::new();
    decoder.push(&[STX_V2, 0xFF, 0x00]);
    decoder.push(&encoded(2, MavlinkVersion::V2));
    assert_eq!(
        decoder.next_frame(),
        None,
        "the false start claims 255 bytes"
    );
    let rescued = std::iter::from_fn(|| decoder.next_frame_at_end()).count();
    assert_eq!(rescued, 2);
    assert_eq!(decoder.counters().skipped_bytes, 3);
}

#[test]
fn a_foreign_message_is_delivered_unverified_and_not_counted_as_intact() {
    let mut foreign = vec![STX_V2, 2, 0, 0, 5, 9, 1, 0xFF, 0xFF, 0xFE, 1, 2, 3, 4];
    foreign.extend(encoded(1, MavlinkVersion::V2));
    let mut decoder = Decoder::new();
    decoder.push(&foreign);
    let read = frames(&mut decoder);
    assert_eq!(read.len(), 2);
    assert_eq!(read[0].content, Content::Unknown { id: 0x00FE_FFFF });
    assert_eq!(
        (read[0].system, read[0].component, read[0].sequence),
        (9, 1, 5)
    );
    assert!(!read[0].is_verified() && read[1].is_verified());
    let counters = decoder.counters();
    assert_eq!((counters.unknown_messages, counters.frames), (1, 1));
    assert_eq!(counters.skipped_bytes, 0);
}

#[test]
fn an_unknown_vehicle_type_is_delivered_undecoded() {
    let mut payload = vec![0; 9];
    payload[4] = 200;
    payload[8] = 3;
    let mut bytes = Vec::new();
    Encoder::new(9, 1).encode(&Outgoing::Raw { id: 0, payload }, &mut bytes);
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    let frame = decoder.next_frame().expect("the frame is intact");
    assert!(matches!(frame.content, Content::Undecoded { id: 0, payload } if payload[4] == 200));
    assert_eq!(decoder.counters().undecoded, 1);
}

proptest! {
    #[test]
    fn no_intact_frame_is_lost_in_noise(
        noise in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..40), 1..12),
        chunk in 1usize..64,
    ) {
        let mut encoder = Encoder::new(3, 1);
        let mut stream = Vec::new();
        for piece in &noise {
            stream.extend_from_slice(piece);
            encoder.encode(&MavMessage::ATTITUDE(ATTITUDE_DATA { roll: 0.3, ..Default::default() }).into(), &mut stream);
        }
        let mut decoder = Decoder::new();
        let mut found = 0;
        for piece in stream.chunks(chunk) {
            decoder.push(piece);
            found += frames(&mut decoder).iter().filter(|f| f.is_verified()).count();
        }
        found += std::iter::from_fn(|| decoder.next_frame_at_end())
                .filter(Frame::is_verified)
                .count();
        // Noise may look like an unknown message and hide the frames that it covers, but no others.
        let foreign = decoder.counters().unknown_messages;
        prop_assert!(found >= noise.len() || foreign > 0, "{found} of {}", noise.len());
        let c = decoder.counters();
        prop_assert_eq!(c.bytes, stream.len() as u64);
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        let mut decoder = Decoder::new();
        decoder.push(&bytes);
        while decoder.next_frame_at_end().is_some() {}
        prop_assert!(decoder.counters().skipped_bytes <= bytes.len() as u64);
    }
}
