//! What a desk keeps of an exam.

use serde::{Deserialize, Serialize};

use super::{ExamSecret, RecordHead, TryEnd, TryName};

/// An entry of an exam's notes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExamNote {
    /// The time by the desk's clock, in seconds since 1970.
    pub at: u64,
    /// The deed that the desk has decided or seen.
    #[serde(flatten)]
    pub what: ExamDeed,
}

/// What happened in an exam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExamDeed {
    /// The exam began; the first note.
    Begun {
        /// The name of the exam.
        exam: String,
        /// The file of the exam, so that later changes of it do not matter.
        source: String,
        /// The secret of the seeds.
        secret: ExamSecret,
    },
    /// A trainee takes part.
    Seated {
        /// The trainee's user name.
        user: String,
    },
    /// A seat is about to be asked to open a try. Its seed may be known there from then on.
    Asked {
        /// The trainee's user name.
        user: String,
        /// Which try it is.
        #[serde(rename = "try")]
        name: TryName,
        /// The time at which it must end, in seconds since 1970.
        until: u64,
    },
    /// A seat shows the brief of a try.
    Opened {
        /// The trainee's user name.
        user: String,
        /// Which try it is.
        #[serde(rename = "try")]
        name: TryName,
    },
    /// The record of a try has grown so far.
    Head {
        /// The trainee's user name.
        user: String,
        /// Which try it is.
        #[serde(rename = "try")]
        name: TryName,
        /// The head of the record.
        #[serde(flatten)]
        head: RecordHead,
    },
    /// A try is over.
    Ended {
        /// The trainee's user name.
        user: String,
        /// Which try it was.
        #[serde(rename = "try")]
        name: TryName,
        /// Whether the mission was over, the trainee left, or the time was up.
        how: TryEnd,
    },
    /// A desk that was opened again goes on with the exam. What happened since the last note, nobody has seen.
    Resumed,
    /// The instructor has ended the exam. Only tries that were flown then have later notes.
    Stopped,
}
