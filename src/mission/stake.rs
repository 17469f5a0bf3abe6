//! The stake of a flight: practice, graded, exam.

use serde::{Deserialize, Serialize};

use super::{FlightRules, Mission, MissionAdvice};

/// The purpose of a flight, which determines how it counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stake {
    /// Counts for medals, credits and experience, with a random layout.
    Graded,
    /// Practice with a seed of the trainee's choice. Records from before careers existed count as
    /// practice.
    #[default]
    Practice,
    /// An exam, with the exam's seed, in real time, without hints or pauses.
    Exam,
    /// A flight with the seed of the day, which is the same for everyone. It counts once a day; repeats are practice.
    Daily,
}

impl Mission {
    /// Returns the mission under the rules of a stake: an exam has no hints or pauses, and runs in real time.
    #[must_use]
    pub fn flown_for(self, stake: Stake) -> Self {
        match stake {
            Stake::Exam => Self {
                rules: FlightRules {
                    pausable: false,
                    most_speedup: 1.0,
                    ..self.rules
                },
                advice: MissionAdvice::default(),
                ..self
            },
            Stake::Graded | Stake::Practice | Stake::Daily => self,
        }
    }
}
