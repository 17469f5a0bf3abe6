//! What desk and seat say about a try.

use serde::{Deserialize, Serialize};

use crate::{RecordName, Words};

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
}

/// A try that the desk opens at a seat.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ExamTry {
    /// Which try it is.
    #[serde(flatten)]
    pub name: TryName,
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
    /// The SHA-256 hash of these bytes, in hexadecimal digits.
    pub sha256: String,
}

/// The head of a try's record.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TryHead {
    /// Which try is recorded.
    #[serde(rename = "try")]
    pub name: TryName,
    /// The head.
    #[serde(flatten)]
    pub head: RecordHead,
}
