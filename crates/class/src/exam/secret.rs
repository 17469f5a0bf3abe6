//! The secret of an exam, from which its seeds follow.

use std::fmt::{self, Write as _};

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::{ExamLayout, TryName};

/// Seeds are below 2^53, so that every reader of JSON keeps them.
const SEED_BITS: u32 = 53;

/// A random number that only the desk knows.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ExamSecret([u8; 32]);

impl fmt::Debug for ExamSecret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ExamSecret")
    }
}

impl From<[u8; 32]> for ExamSecret {
    fn from(bytes: [u8; 32]) -> Self {
        Self(bytes)
    }
}

impl From<ExamSecret> for String {
    fn from(secret: ExamSecret) -> Self {
        hex(&secret.0)
    }
}

impl TryFrom<String> for ExamSecret {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let wrong = "a secret has 64 hexadecimal digits";
        if text.len() != 64 || !text.is_ascii() {
            return Err(wrong);
        }
        let mut bytes = [0; 32];
        for (at, byte) in bytes.iter_mut().enumerate() {
            *byte = u8::from_str_radix(&text[2 * at..2 * at + 2], 16).map_err(|_| wrong)?;
        }
        Ok(Self(bytes))
    }
}

impl ExamSecret {
    /// The seed of an opening of a user's try. That of an opening that a seat has refused may be known there, so the next opening has
    /// another one; one that all trainees share is known to all of them anyway.
    pub(super) fn seed(&self, layout: ExamLayout, user: &str, name: &TryName) -> u64 {
        let (whose, opening) = match layout {
            ExamLayout::Own => (user, name.opening),
            ExamLayout::Same => ("", 0),
        };
        let mut hash = Sha256::new();
        hash.update(self.0);
        // Lengths keep the texts apart.
        for text in [whose, name.exam.as_str(), name.mission.as_str()] {
            hash.update((text.len() as u64).to_le_bytes());
            hash.update(text);
        }
        hash.update(name.number.to_le_bytes());
        hash.update(opening.to_le_bytes());
        let digest = hash.finalize();
        let mut first = [0; 8];
        first.copy_from_slice(&digest[..8]);
        u64::from_le_bytes(first) >> (u64::BITS - SEED_BITS)
    }
}

/// Bytes in hexadecimal digits.
pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a text cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
