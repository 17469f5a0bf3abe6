//! `MAVLink` 2 signatures: proof that a holder of the key sent a frame, on this link, at this time.

use mavlink::MAVLinkV2MessageRaw;

use super::decoder::SIGNATURE_LEN;

/// The secret that a vehicle and its ground stations share.
pub type SigningKey = [u8; 32];

/// The length of a timestamp (48 bits), in bytes.
const TIMESTAMP_LEN: usize = 6;

/// The part of a signature that is unique per sender.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// The link id; a sender uses a different one for each of its links.
    pub link: u8,
    /// Units of 10 microseconds since the beginning of 2015 (UTC); it never decreases.
    pub timestamp: u64,
}

/// The result of checking a frame's signature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seal {
    /// The frame has no signature.
    Unsigned,
    /// The frame was not signed with a key that the receiver has, or the signature has not been
    /// verified.
    Foreign,
    /// The frame was signed with the right key, but its stamp is this many units of 10 microseconds
    /// too old to count as new: it may have been replayed.
    Old(u64),
    /// The frame was signed with the sender's key, at a new time.
    Right,
    /// Like [`Seal::Right`], but signed with the key that is about to replace the sender's key.
    RightWithNext,
}

impl Seal {
    /// Whether a signature followed the frame, right or wrong.
    pub fn is_signature(self) -> bool {
        match self {
            Self::Unsigned => false,
            Self::Foreign | Self::Old(_) | Self::Right | Self::RightWithNext => true,
        }
    }

    /// Whether the signature proves that a holder of the key has sent the frame just now.
    pub fn is_right(self) -> bool {
        match self {
            Self::Right | Self::RightWithNext => true,
            Self::Unsigned | Self::Foreign | Self::Old(_) => false,
        }
    }
}

impl Stamp {
    /// The stamp of a signed frame, from its bytes as sent. `None` if it is too short to be signed.
    pub fn of(frame: &[u8]) -> Option<Self> {
        let (_, signature) = frame.split_last_chunk::<SIGNATURE_LEN>()?;
        let mut timestamp = [0; 8];
        timestamp[..TIMESTAMP_LEN].copy_from_slice(&signature[1..=TIMESTAMP_LEN]);
        Some(Self {
            link: signature[0],
            timestamp: u64::from_le_bytes(timestamp),
        })
    }

    pub(super) fn append_to(self, bytes: &mut Vec<u8>) {
        bytes.push(self.link);
        bytes.extend_from_slice(&self.timestamp.to_le_bytes()[..TIMESTAMP_LEN]);
    }
}

/// Whether a signed frame, given as its bytes on the wire, was signed with this key.
pub fn is_signed_with(key: &SigningKey, frame: &[u8]) -> bool {
    hash(key, frame).is_some_and(|hash| frame.ends_with(&hash))
}

/// The signature of a frame, which is its last 6 bytes; they need not be there yet.
pub(super) fn hash(key: &SigningKey, frame: &[u8]) -> Option<[u8; 6]> {
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.as_mut_slice()
        .get_mut(..frame.len())?
        .copy_from_slice(frame);
    let mut hash = [0; 6];
    raw.calculate_signature(key, &mut hash);
    Some(hash)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Decoder, Encoder, ground_station_heartbeat};

    /// Made with pymavlink 2.4.50: a ground station's heartbeat, key 0 to 31, link 7, timestamp 123456789012.
    const REFERENCE: &[u8] = &[
        0xFD, 0x09, 0x01, 0x00, 0x00, 0xFF, 0xBE, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06,
        0x08, 0x00, 0x04, 0x03, 0xDA, 0xB0, 0x07, 0x14, 0x1A, 0x99, 0xBE, 0x1C, 0x00, 0xCF, 0x33,
        0xCE, 0x6C, 0x1F, 0x27,
    ];

    fn key() -> SigningKey {
        std::array::from_fn(|place| place as u8)
    }

    fn signed(link: u8, timestamp: u64) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(255, 190);
        encoder.sign_next(&key(), Stamp { link, timestamp });
        let len = encoder.encode(&ground_station_heartbeat(), &mut bytes);
        assert_eq!(len, bytes.len());
        bytes
    }

    #[test]
    fn a_signed_frame_is_the_one_that_others_make() {
        assert_eq!(signed(7, 123_456_789_012), REFERENCE);
    }

    #[test]
    fn only_the_key_and_the_unchanged_frame_verify() {
        let bytes = signed(3, 99);
        assert!(is_signed_with(&key(), &bytes));
        assert!(!is_signed_with(&[1; 32], &bytes));
        for place in 1..bytes.len() {
            let mut changed = bytes.clone();
            changed[place] ^= 1;
            assert!(!is_signed_with(&key(), &changed), "byte {place}");
        }
        assert!(!is_signed_with(&key(), &[]));
        assert!(!is_signed_with(&key(), &[0xFD; 400]));
    }

    #[test]
    fn the_decoder_gives_back_a_signed_frame_with_its_stamp() {
        let bytes = signed(5, 0x0001_0203_0405);
        let mut decoder = Decoder::new();
        decoder.push(&bytes);
        let frame = decoder.next_frame().expect("intact");
        assert_eq!(frame.seal, Seal::Foreign);
        assert_eq!(decoder.bytes_of(&frame), bytes);
        let stamp = Stamp::of(decoder.bytes_of(&frame)).expect("signed");
        assert_eq!((stamp.link, stamp.timestamp), (5, 0x0001_0203_0405));
    }
}
