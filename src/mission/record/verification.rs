//! Verification: a record is flown again in the embedded simulator, from its inputs.
//!
//! The simulated vehicles get the same frames after the same steps. The record's content must then follow: each
//! fingerprint of their state, every state that the mission saw, the refusals of commands, and the score.

use std::time::Duration;

use super::{Rescored, Stored, WithoutEnd};
use crate::mission::Stake;
use crate::record::{Head as JournalHead, JournalFit, JournalNeighbours, StoredInputs};
use crate::scoring::FlightBackend;
use crate::sim::WorldConfig;
use crate::text;
use crate::text::Text;

mod check;
mod reflight;
#[cfg(test)]
mod tests;

use check::RecordCheck;
pub use reflight::Divergence;
use reflight::{Reflight, differs};

/// The result of a verification.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// The first difference between the flight and its record; `None` if there is none.
    pub difference: Option<Divergence>,
    /// How much of the flight was compared.
    pub extent: RecordExtent,
    /// The score that follows from the record.
    pub rescored: Rescored,
}

/// How much of a flight its record covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordExtent {
    /// The flight to its end, with its score.
    Whole,
    /// A flight without an end, and so without a score.
    Part {
        /// The mission time up to which record and flight were compared.
        to: Duration,
        /// Whether the vehicles flew on after the record's last line, so that the record lacks more
        /// than the last second.
        went_on: bool,
    },
}

impl Stored {
    /// Looks for a sign that the record was changed after the flight, without flying it again: a
    /// wrong checksum, an input log of the embedded simulator beside a flight of a different
    /// simulator, or a mission, program or profile that the journal beside it names differently;
    /// `None` if there is no such sign.
    pub fn misstatement(
        &self,
        journal: Option<&JournalHead>,
        inputs: Option<&StoredInputs>,
    ) -> Option<Text> {
        if self.is_altered() {
            return Some(text!("verify-altered"));
        }
        if inputs.is_some() && self.head.backend != FlightBackend::Embedded {
            return Some(text!("verify-other-backend"));
        }
        let journal = journal?;
        if let Some(other) = self.journal_fit(journal, None).fault() {
            return Some(other);
        }
        if journal.program != self.head.program {
            return Some(other_program(&self.head.program, &journal.program));
        }
        (journal.profile != self.head.profile).then(|| text!("verify-other-profile"))
    }

    /// Whether a journal fits the record; `first_unix_us` is the time of the first frame beside the
    /// record, in microseconds since 1970 (UTC), if known.
    pub fn journal_fit(&self, journal: &JournalHead, first_unix_us: Option<u64>) -> JournalFit {
        let beside = JournalNeighbours {
            mission: Some(&self.head.mission),
            first_unix_us,
        };
        JournalFit::of(journal, beside)
    }

    /// Whether the record follows from the files beside it: its checksum is right, they do not contradict it, and the
    /// repeated flight matches it. A flight with ArduPilot cannot be repeated, so its record is not confirmed.
    pub fn is_confirmed(
        &self,
        journal: Option<&JournalHead>,
        inputs: Option<&StoredInputs>,
    ) -> bool {
        if !self.has_checksum() || self.misstatement(journal, inputs).is_some() {
            return false;
        }
        match self.head.backend {
            FlightBackend::Embedded => inputs.is_some_and(|inputs| {
                let again = self.verify(inputs);
                again.is_ok_and(|it| it.difference.is_none() && it.extent == RecordExtent::Whole)
            }),
            FlightBackend::ArduPilot => false,
        }
    }

    /// Flies the record again from the inputs of its simulated vehicles.
    ///
    /// # Errors
    ///
    /// This program cannot read the mission in the record.
    pub fn verify(&self, inputs: &StoredInputs) -> Result<Verification, Text> {
        let mission = self.head.flown()?;
        let mut config = mission.world(self.head.seed);
        let rescored = self.rescore(WithoutEnd::Over)?;
        // Airframes other than the mission's own are for practice: a flight that counts has none.
        if !inputs.head.airframes.is_empty() && self.head.stake != Stake::Practice {
            let what = text!("verify-own-airframes");
            return Ok(Verification {
                difference: Some(differs(Duration::ZERO, None, what)),
                extent: RecordExtent::Whole,
                rescored,
            });
        }
        let mut check = match Reflight::new(&mut config, inputs) {
            Ok(reflight) => RecordCheck::new(self.reenact()?, reflight),
            Err(what) => {
                return Ok(Verification {
                    difference: Some(differs(Duration::ZERO, None, what)),
                    extent: RecordExtent::Whole,
                    rescored,
                });
            }
        };
        let difference = check
            .run(self)
            .and_then(|()| check.compare_end(self, &rescored))
            .and_then(|()| check.compare_programs(self, inputs))
            .err();
        Ok(Verification {
            difference,
            extent: check.extent(self),
            rescored,
        })
    }
}

/// Repeats a flight without a mission; returns the first difference from its log.
pub fn refly(config: &mut WorldConfig, inputs: &StoredInputs) -> Option<Divergence> {
    match Reflight::new(config, inputs) {
        Ok(mut reflight) => {
            // A truncated log is compared as far as it goes.
            reflight.damage.take_if(|_| inputs.is_cut());
            reflight.finish().err()
        }
        Err(what) => Some(differs(Duration::ZERO, None, what)),
    }
}

fn other_program(one: &str, other: &str) -> Text {
    text!("verify-programs", one = one, other = other)
}
