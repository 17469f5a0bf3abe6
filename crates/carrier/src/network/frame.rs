//! Signed frames.

use ring::rand::{SecureRandom as _, SystemRandom};
use ring::signature::{ED25519, Ed25519KeyPair, UnparsedPublicKey};
use sortie_class::protocol::LONGEST_LINE;

use crate::fault::NetworkFault;

/// The number of bytes of a signature.
const SIGNATURE: usize = 64;
/// The number of bytes of a frame's numbers.
const COUNTER: usize = 8;
/// The number of bytes of a frame without its body.
const HEAD: usize = SIGNATURE + 1 + 2 * COUNTER;
/// The maximum length of a frame, with room for a line that is too long, so that it can be called that.
pub(super) const LONGEST_FRAME: usize = LONGEST_LINE + 1024;
/// What separates these signatures from all others that the same key makes.
const PURPOSE: &[u8] = b"sortie class frame 1\0";

/// What a frame is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FrameKind {
    /// The first frame of a seat.
    Hello = 1,
    /// The answer of the desk, with the name of the instructor.
    Open = 2,
    /// A line of the protocol.
    Line = 3,
    /// Nothing but the sender's counters.
    KeepAlive = 4,
    /// The sender ends the connection.
    Bye = 5,
}

impl FrameKind {
    fn read(byte: u8) -> Option<Self> {
        let all = [
            Self::Hello,
            Self::Open,
            Self::Line,
            Self::KeepAlive,
            Self::Bye,
        ];
        all.into_iter().find(|kind| *kind as u8 == byte)
    }
}

/// One message of a connection.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Frame {
    pub kind: FrameKind,
    /// The number of frames that the sender has sent before.
    pub number: u64,
    /// The number of the other side's lines that the sender has taken.
    pub taken: u64,
    pub body: Vec<u8>,
}

impl Frame {
    /// The frame as bytes, signed for the key on which it is sent.
    pub fn seal(&self, signer: &Ed25519KeyPair, key: &str) -> Vec<u8> {
        let mut bytes = vec![0; SIGNATURE];
        bytes.push(self.kind as u8);
        bytes.extend(self.number.to_be_bytes());
        bytes.extend(self.taken.to_be_bytes());
        bytes.extend(&self.body);
        let signature = signer.sign(&signed(key, &bytes[SIGNATURE..]));
        bytes[..SIGNATURE].copy_from_slice(signature.as_ref());
        bytes
    }

    /// Reads a frame that was received on a key; `None` if it is not of this sender.
    pub fn open(bytes: &[u8], sender: &[u8], key: &str) -> Option<Self> {
        if bytes.len() < HEAD || bytes.len() > LONGEST_FRAME {
            return None;
        }
        let (signature, content) = bytes.split_at(SIGNATURE);
        let sender = UnparsedPublicKey::new(&ED25519, sender);
        sender.verify(&signed(key, content), signature).ok()?;
        let (head, body) = content.split_at(HEAD - SIGNATURE);
        let (kind, counters) = head.split_first()?;
        let (number, taken) = counters.split_at(COUNTER);
        Some(Self {
            kind: FrameKind::read(*kind)?,
            number: u64::from_be_bytes(number.try_into().ok()?),
            taken: u64::from_be_bytes(taken.try_into().ok()?),
            body: body.to_vec(),
        })
    }

    /// The beginning of a frame says that it may be a greeting; whether it is one says its signature.
    pub fn may_be_hello(bytes: &[u8]) -> bool {
        bytes.get(SIGNATURE) == Some(&(FrameKind::Hello as u8)) && bytes.len() == HEAD
    }

    /// The same of a line.
    pub fn may_be_line(bytes: &[u8]) -> bool {
        bytes.get(SIGNATURE) == Some(&(FrameKind::Line as u8))
    }
}

fn signed(key: &str, content: &[u8]) -> Vec<u8> {
    [PURPOSE, key.as_bytes(), b"\0", content].concat()
}

/// Reads a secret key.
pub(super) fn signer(pkcs8: &[u8]) -> Result<Ed25519KeyPair, NetworkFault> {
    Ed25519KeyPair::from_pkcs8(pkcs8).map_err(|fault| NetworkFault::Crypto(fault.to_string()))
}

/// The number of hexadecimal digits of the number of a connection.
const NUMBER: usize = 32;

/// Whether a text is the number of a connection.
pub(super) fn is_number(text: &str) -> bool {
    let is_digit = |c: u8| c.is_ascii_digit() || (b'a'..=b'f').contains(&c);
    text.len() == NUMBER && text.bytes().all(is_digit)
}

/// A number that nobody has used before, in hexadecimal digits.
pub(super) fn fresh_number() -> Result<String, NetworkFault> {
    let mut bytes = [0; 16];
    let filled = SystemRandom::new().fill(&mut bytes);
    filled.map_err(|_| NetworkFault::Crypto("no random numbers".to_owned()))?;
    Ok(format!("{:0NUMBER$x}", u128::from_be_bytes(bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ring::signature::KeyPair as _;

    fn key() -> Ed25519KeyPair {
        let pkcs8 = Ed25519KeyPair::generate_pkcs8(&SystemRandom::new()).expect("a key");
        signer(pkcs8.as_ref()).expect("a key")
    }

    fn frame() -> Frame {
        Frame {
            kind: FrameKind::Line,
            number: 7,
            taken: 3,
            body: b"{\"here\":1}\n".to_vec(),
        }
    }

    #[test]
    fn a_frame_is_read_only_as_it_was_signed_and_on_its_key() {
        let own = key();
        let sender = own.public_key().as_ref();
        let bytes = frame().seal(&own, "sortie/1/9-A/seat-01/5/down");
        let read = |bytes: &[u8], key: &str| Frame::open(bytes, sender, key);
        let right = "sortie/1/9-A/seat-01/5/down";
        assert_eq!(read(&bytes, right), Some(frame()));
        for other in [
            "sortie/1/9-A/seat-02/5/down",
            "sortie/1/9-A/seat-01/6/down",
            "sortie/1/9-A/seat-01/5/up",
            "sortie/1/9-B/seat-01/5/down",
        ] {
            assert_eq!(read(&bytes, other), None, "{other}");
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            assert_eq!(read(&changed, right), None, "byte {at}");
        }
        assert_eq!(read(&bytes[..HEAD - 1], right), None);
        let other = key();
        let bytes = frame().seal(&other, right);
        assert_eq!(read(&bytes, right), None, "another key");
    }

    #[test]
    fn numbers_of_connections_differ() {
        let number = || fresh_number().expect("random numbers");
        assert_ne!(number(), number());
        assert!(is_number(&number()));
    }
}
