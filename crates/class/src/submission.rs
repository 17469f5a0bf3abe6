//! The record of a flight on its way from a seat to the desk.
//!
//! A seat offers a record as a [`Submission`]: its name, and the size and the hash of each of its files. The desk asks
//! for the files piece by piece ([`PieceRequest`]), so the desk sets the pace, and after a broken connection it goes on
//! where the last one ended.

use ct_codecs::{Base64, Decoder as _, Encoder as _};
use serde::{Deserialize, Serialize};

/// The maximum length of a piece, in bytes. As Base64, it fits into a line.
pub const PIECE: usize = 32 * 1024;
/// The maximum size of one file, in bytes. A seat leaves out larger ones.
pub const LARGEST_PART: u64 = 64 * 1024 * 1024;
/// The maximum length of a record's name, in bytes.
const LONGEST_NAME: usize = 120;

/// The name of a record: that of its files, without suffix. It cannot lead out of a folder.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String")]
pub struct RecordName(String);

impl TryFrom<String> for RecordName {
    type Error = &'static str;

    fn try_from(name: String) -> Result<Self, Self::Error> {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        let is_name = !name.is_empty()
            && name.len() <= LONGEST_NAME
            && !name.starts_with(['.', '-'])
            && name.chars().all(is_plain);
        is_name.then_some(Self(name)).ok_or("no name of a record")
    }
}

impl RecordName {
    /// The name as it is written in messages and folders.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// A file of a record. The order is that in which files are handed in: the first one decides the score.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RecordPart {
    /// The record of the mission, from which the score is derived.
    Run,
    /// The inputs of the simulated vehicles, with which the flight can be repeated.
    Inputs,
    /// The journal of the console.
    Journal,
    /// The frames of all links.
    Frames,
}

impl RecordPart {
    /// All parts, in the order in which they are handed in.
    pub const ALL: [Self; 4] = [Self::Run, Self::Inputs, Self::Journal, Self::Frames];
}

/// A file that is handed in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SubmittedPart {
    /// Which file it is.
    pub part: RecordPart,
    /// Its size, in bytes.
    pub bytes: u64,
    /// The SHA-256 hash of its content, in hexadecimal digits.
    pub sha256: String,
}

/// A record that a seat hands in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Submission {
    /// The name of the record.
    pub record: RecordName,
    /// Its files, in the order of [`RecordPart::ALL`].
    pub parts: Vec<SubmittedPart>,
}

impl Submission {
    /// The size of all files, in bytes.
    pub fn bytes(&self) -> u64 {
        let bytes = self.parts.iter().map(|it| it.bytes);
        bytes.fold(0, u64::saturating_add)
    }

    /// Whether the list of files is possible: the record of the mission and at most one of each other kind, none too
    /// large.
    pub fn is_possible(&self) -> bool {
        let is_ordered = self.parts.is_sorted_by(|a, b| a.part < b.part);
        let has_run = self.parts.first().map(|it| it.part) == Some(RecordPart::Run);
        is_ordered && has_run && self.parts.iter().all(|it| it.bytes <= LARGEST_PART)
    }

    /// A file of the record, if it is handed in.
    pub fn part(&self, part: RecordPart) -> Option<&SubmittedPart> {
        self.parts.iter().find(|it| it.part == part)
    }
}

/// The desk's question for the next piece of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PieceRequest {
    /// The record that the piece is from.
    pub record: RecordName,
    /// The file of the record that the piece is from.
    pub part: RecordPart,
    /// The number of bytes that the desk has.
    pub from: u64,
}

/// A piece of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Piece {
    /// What was asked for.
    #[serde(flatten)]
    pub of: PieceRequest,
    /// The bytes, at most [`PIECE`].
    pub data: PieceBytes,
}

/// Bytes that are sent as Base64.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PieceBytes(pub Vec<u8>);

impl TryFrom<String> for PieceBytes {
    type Error = String;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let bytes = Base64::decode_to_vec(text, None).map_err(|error| error.to_string())?;
        if bytes.len() > PIECE {
            return Err("the piece is too long".to_owned());
        }
        Ok(Self(bytes))
    }
}

impl From<PieceBytes> for String {
    fn from(bytes: PieceBytes) -> Self {
        // Only a length near the limit of memory cannot be encoded.
        Base64::encode_to_string(bytes.0).unwrap_or_default()
    }
}

/// How a submission ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SubmissionEnd {
    /// The desk keeps the record.
    Kept,
    /// The desk does not have the record.
    Refused(SubmissionRefusal),
}

/// Why the desk does not have a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SubmissionRefusal {
    /// The disk of the desk is full, or not available.
    Unwritable,
    /// A file does not have the hash that the seat has stated.
    Damaged,
    /// The trainee's records at the desk would be too large together.
    Share,
    /// A file is too large, or the record of the mission is missing.
    Impossible,
    /// The desk keeps another record of the same trainee under this name.
    Different,
}

impl SubmissionRefusal {
    /// Whether the same submission may succeed later.
    pub fn is_passing(self) -> bool {
        matches!(self, Self::Unwritable | Self::Damaged)
    }
}
