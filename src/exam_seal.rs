//! The result of an exam's try, as the desk seals it.

use serde::{Deserialize, Serialize};

use crate::class::{SubmittedPart, Witness};
use crate::text;
use crate::text::{Text, clock};

/// The version of the format.
pub const SEAL: u32 = 1;

/// The result of a try, with the hashes of its record. A signature of the desk's key is beside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Seal {
    /// The version of the format.
    pub sortie_seal: u32,
    /// The name of the class.
    pub class: String,
    /// The name of the exam.
    pub exam: String,
    /// The SHA-256 hash of the exam's file.
    pub exam_sha256: String,
    /// When the exam began, in UTC.
    pub begun: String,
    /// The user who handed the record in, by the word of the kernel.
    pub user: String,
    /// The id of the mission.
    pub mission: String,
    /// The number of the try, from 1.
    pub number: u32,
    /// The number of tries.
    pub tries: u32,
    /// How often the seat was asked to open this one.
    pub openings: u32,
    /// The seed that the desk drew.
    pub seed: u64,
    /// The name of the record.
    pub record: String,
    /// The files of the record, with their hashes.
    pub files: Vec<SubmittedPart>,
    pub score: u16,
    pub passed: bool,
    /// When the desk saw that the try was open, in UTC.
    pub opened: Option<String>,
    /// When it had to end, in UTC.
    pub until: String,
    /// When the desk saw that it was over, in UTC.
    pub ended: Option<String>,
    /// When the record was complete at the desk, in UTC.
    pub handed_in: String,
    /// What the desk has seen of the record while it was written.
    pub witness: Witness,
    /// Why the try does not count; empty if it does.
    pub reasons: Vec<TryReason>,
    /// The public key, in the format of minisign.
    pub public_key: String,
}

/// Why a try does not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TryReason {
    /// It was not flown as an exam.
    NoExam,
    /// A script or a program gave the commands.
    Script,
    /// The mission is not that of the course.
    Mission,
    /// It was flown with designs of the trainee instead of the mission's vehicles.
    Fleet,
    /// The flight was paused after the mission's time had begun.
    Paused,
    /// The record has no inputs, so the flight cannot be flown again.
    NoInputs,
    /// Its record went on growing after its time.
    Late,
    /// The desk has seen nothing of it while it was flown.
    Unseen,
    /// The record is not the one that the desk has seen being written.
    Rewritten,
    /// The trainee left the flight, or the console ended, before the mission was over.
    Left,
    /// The desk was there, but has not seen the end of the record before it was handed in.
    EndUnseen,
    /// The end of the record has no checksum, as this program always writes one.
    NoChecksum,
}

impl From<TryReason> for Text {
    fn from(reason: TryReason) -> Self {
        match reason {
            TryReason::NoExam => text!("seal-reason-no-exam"),
            TryReason::Script => text!("seal-reason-script"),
            TryReason::Mission => text!("seal-reason-mission"),
            TryReason::Fleet => text!("seal-reason-fleet"),
            TryReason::Paused => text!("seal-reason-paused"),
            TryReason::NoInputs => text!("seal-reason-no-inputs"),
            TryReason::Late => text!("seal-reason-late"),
            TryReason::Unseen => text!("seal-reason-unseen"),
            TryReason::Rewritten => text!("seal-reason-rewritten"),
            TryReason::Left => text!("seal-reason-left"),
            TryReason::EndUnseen => text!("seal-reason-end-unseen"),
            TryReason::NoChecksum => text!("seal-reason-no-checksum"),
        }
    }
}

/// What is wrong with a seal.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SealFault {
    /// The record of a try has no seal.
    None,
    /// It cannot be read.
    Unreadable(String),
    /// It is not a seal.
    Damaged,
    /// It has no signature.
    Unsigned,
    /// Its signature does not fit: the seal was changed, or signed with another key than the one in it.
    Signature,
    /// It was made with another key than the expected one.
    OtherKey,
    /// It is the seal of another record.
    OtherRecord(String),
    /// It is the seal of another user's try.
    OtherUser(String),
    /// It is the seal of a try in another class.
    OtherClass(String),
    /// The flight that was flown again has another result.
    OtherResult,
    /// A file of the record was not sealed: it was added afterwards.
    NotSealed(String),
    /// A file of the record is not the one that was sealed.
    Changed(String),
    /// A file of the record is missing.
    Missing(String),
}

impl From<&SealFault> for Text {
    fn from(fault: &SealFault) -> Self {
        match fault {
            SealFault::None => text!("seal-none"),
            SealFault::Unreadable(error) => text!("seal-unreadable", error = error.as_str()),
            SealFault::Damaged => text!("seal-damaged"),
            SealFault::Unsigned => text!("seal-unsigned"),
            SealFault::Signature => text!("seal-signature"),
            SealFault::OtherKey => text!("seal-other-key"),
            SealFault::OtherRecord(record) => text!("seal-other-record", record = record.as_str()),
            SealFault::OtherUser(user) => text!("seal-other-user", user = user.as_str()),
            SealFault::OtherClass(class) => text!("seal-other-class", class = class.as_str()),
            SealFault::OtherResult => text!("seal-other-result"),
            SealFault::NotSealed(file) => text!("seal-not-sealed", file = file.as_str()),
            SealFault::Changed(file) => text!("seal-changed", file = file.as_str()),
            SealFault::Missing(file) => text!("seal-missing", file = file.as_str()),
        }
    }
}

/// A sealed flight that was flown again.
#[derive(Debug, Clone, Copy)]
pub struct FlownAgain<'a> {
    /// The id of the mission.
    pub mission: &'a str,
    pub seed: u64,
    /// The score; `None` if the flight has no end.
    pub score: Option<u16>,
}

/// A seal that was checked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SealCheck {
    /// The seal, if it can be read.
    pub seal: Option<Seal>,
    /// The fingerprint of the key that is in it.
    pub fingerprint: Option<String>,
    /// Whether the key is the expected one; `None` if none was expected.
    pub is_known_key: Option<bool>,
    /// What is wrong with it; `None` if it fits the record.
    pub fault: Option<SealFault>,
}

impl SealCheck {
    /// A try without a seal.
    pub fn missing() -> Self {
        Self::faulty(SealFault::None)
    }

    /// A seal that cannot be read.
    pub fn faulty(fault: SealFault) -> Self {
        Self {
            seal: None,
            fingerprint: None,
            is_known_key: None,
            fault: Some(fault),
        }
    }

    /// Compares the result in the seal with that of the flight that was flown again.
    pub fn compare(&mut self, again: &FlownAgain<'_>) {
        let Some(seal) = self.seal.as_ref().filter(|_| self.fault.is_none()) else {
            return;
        };
        let is_same = seal.mission == again.mission
            && seal.seed == again.seed
            && again.score.is_none_or(|score| score == seal.score);
        if !is_same {
            self.fault = Some(SealFault::OtherResult);
        }
    }

    /// Whether the try counts for certain: its seal fits the record, and was made with the expected key.
    pub fn counts(&self) -> bool {
        let seal = self.seal.as_ref();
        let is_valid = self.fault.is_none() && self.is_known_key == Some(true);
        is_valid && seal.is_some_and(|seal| seal.reasons.is_empty())
    }

    /// Whether the seal is that of a try which has a result, counted or not: one that was left has none.
    pub fn has_result(&self) -> bool {
        let seal = self.seal.as_ref();
        !seal.is_some_and(|seal| seal.reasons.contains(&TryReason::Left))
    }

    /// The check in one line: whether the try counts, or why not.
    pub fn standing(&self) -> Text {
        if let Some(fault) = &self.fault {
            return fault.into();
        }
        let reasons = self.seal.iter().flat_map(|it| &it.reasons);
        let reasons: Vec<Text> = reasons.map(|&reason| reason.into()).collect();
        if !reasons.is_empty() {
            text!("seal-counts-not", reasons = Text::joined("; ", reasons))
        } else if self.is_known_key.is_none() {
            text!("seal-key-not-compared")
        } else {
            text!("seal-counts")
        }
    }

    /// The check in words.
    pub fn text(&self) -> Text {
        let mut lines = Vec::new();
        if let Some(fault) = &self.fault {
            lines.push(text!("seal-bad", fault = Text::from(fault)));
        }
        if let Some(seal) = &self.seal {
            lines.push(text!(
                "seal-of",
                class = seal.class.as_str(),
                exam = seal.exam.as_str(),
                user = seal.user.as_str(),
                mission = seal.mission.as_str(),
                number = seal.number,
                tries = seal.tries,
                score = seal.score
            ));
            if self.fault.is_none() {
                lines.push(self.standing());
                lines.push(witness_text(&seal.witness));
            }
        }
        if let Some(key) = self.fingerprint.as_deref() {
            lines.push(match self.is_known_key {
                Some(true) => text!("seal-key-known", key = key),
                Some(false) => text!("seal-key-other", key = key),
                None => text!("seal-key-unknown", key = key),
            });
        }
        Text::joined("\n", lines)
    }
}

/// What the desk has seen of a record, in words.
pub fn witness_text(witness: &Witness) -> Text {
    match witness {
        Witness::Whole { heads } => text!("witness-whole", heads = *heads),
        Witness::Part { heads, gap_s } => {
            let gap = clock(std::time::Duration::from_secs(*gap_s));
            text!("witness-part", heads = *heads, gap = gap)
        }
        Witness::Stopped { heads, stopped_s } => {
            let stopped = clock(std::time::Duration::from_secs(*stopped_s));
            text!("witness-stopped", heads = *heads, stopped = stopped)
        }
        Witness::Unseen => text!("witness-unseen"),
        Witness::OtherRecord { record } => text!("witness-other", record = record.as_str()),
        Witness::Rewritten { bytes, .. } => text!("witness-rewritten", bytes = *bytes),
    }
}
