//! What desk and seat say about a try.

use serde::{Deserialize, Serialize};

use super::secret::hex;
use crate::{RecordName, Words};

/// The number of digits of a hash.
const DIGITS: usize = 64;

/// Which try of which exam.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TryName {
    /// The name of the exam.
    pub exam: Words,
    /// When the desk began the exam, in seconds since 1970: the same exam may be held several times.
    pub begun: u64,
    /// The id of the mission.
    pub mission: Words,
    /// The number of the try at this mission, from 1.
    pub number: u32,
    /// How often the seat was asked to open this try so far, with this time; from 1. Each has a seed of its own.
    pub opening: u32,
}

impl TryName {
    /// Whether it is the same try, whichever opening of it.
    pub fn is_same_try(&self, other: &Self) -> bool {
        let opening = self.opening;
        *self
            == Self {
                opening,
                ..other.clone()
            }
    }
}

/// A try that the desk opens at a seat.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ExamTry {
    /// Which try it is.
    #[serde(flatten)]
    pub name: TryName,
    /// What trainees call the exam, in English; empty in records of earlier versions.
    #[serde(default, skip_serializing_if = "Words::is_empty")]
    pub title: Words,
    /// What they call it in Ukrainian, if the exam has such a title.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title_uk: Option<Words>,
    /// The number of tries at this mission.
    pub tries: u32,
    /// The seed of the mission's world.
    pub seed: u64,
    /// The time for the try in seconds, so that the clocks of the machines do not matter.
    pub within_s: u32,
}

/// The try that a seat flies.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FlownTry {
    /// Which try it is.
    #[serde(flatten)]
    pub name: TryName,
    /// Whether the mission is over and was passed, as the seat says.
    pub is_passed: bool,
}

/// How far a record has grown, and the hash of that much of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordHead {
    /// The name of the record.
    pub record: RecordName,
    /// The length of the record of the mission, in bytes.
    pub bytes: u64,
    /// The hash of these bytes.
    pub sha256: ContentHash,
}

/// A SHA-256 hash, in 64 hexadecimal digits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String")]
pub struct ContentHash(String);

impl ContentHash {
    /// The hash in 64 hexadecimal digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl From<[u8; 32]> for ContentHash {
    fn from(digest: [u8; 32]) -> Self {
        Self(hex(&digest))
    }
}

impl TryFrom<String> for ContentHash {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let is_digit = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'a'..=b'f');
        let is_hash = text.len() == DIGITS && text.bytes().all(is_digit);
        is_hash
            .then_some(Self(text))
            .ok_or("a hash has 64 hexadecimal digits")
    }
}

/// The head of a try's record.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TryHead {
    /// Which try is recorded.
    #[serde(rename = "try")]
    pub name: TryName,
    /// Whether the flight is over, so that the record grows no more.
    #[serde(default)]
    pub is_over: bool,
    /// The length of the record so far, and its hash.
    #[serde(flatten)]
    pub head: RecordHead,
}
