//! The stake of a flight: practice, graded, exam.

use serde::{Deserialize, Serialize};

use super::Mission;

/// How a flight counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stake {
    /// For medals, credits and experience, on a layout of its own.
    Graded,
    /// With a seed that the trainee chose: for practice only. So counts whatever does not say: records that are older than
    /// careers.
    #[default]
    Practice,
    /// With the seed of the exam, in real time, without hints and pauses.
    Exam,
    /// With the seed that everybody has in common on a day. It counts once a day: who has seen the layout only practises.
    Daily,
}

impl Mission {
    /// The mission under the rules of what it is flown for: an exam has neither advice nor pauses, and runs in real time.
    #[must_use]
    pub fn flown_for(self, stake: Stake) -> Self {
        match stake {
            Stake::Exam => Self {
                pausable: false,
                gives_hints: false,
                most_speedup: 1.0,
                hints: Vec::new(),
                clues: Vec::new(),
                lesson: Vec::new(),
                ..self
            },
            Stake::Graded | Stake::Practice | Stake::Daily => self,
        }
    }
}
