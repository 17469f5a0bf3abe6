//! How a finished flight counts according to its record or report, which are not trusted.

use super::{AttemptMeans, AttemptTerms, AttemptTrainee, PracticeReason};
use crate::campaign::{Stake, daily_seed};
use crate::mission::Mission;
use crate::scoring::{FlownBy, MissionFile};

/// The claims of a record or a report about a finished flight.
#[derive(Debug, Clone, Copy)]
pub struct FlightClaim<'a> {
    /// The mission as it was flown.
    pub mission: &'a Mission,
    pub stake: Stake,
    pub seed: u64,
    /// How the mission file compares with that of the course; old reports lack this, and count as
    /// they claim.
    pub mission_file: Option<MissionFile>,
    /// The source of the commands; old records do not contain it, and count as they claim.
    pub flown_by: Option<FlownBy>,
    /// The day on which the flight ended, in days since 1970 (UTC).
    pub ended: i64,
    /// Whether a repeated flight matches the record; also true for a report, which has no record.
    pub is_confirmed: bool,
}

/// How a finished flight counts.
#[derive(Debug, Clone, PartialEq)]
pub struct SettledFlight {
    pub stake: Stake,
    /// The day to which the flight belongs, in days since 1970 (UTC).
    pub day: i64,
    /// Why the flight counts only as practice although more was claimed; empty if it counts as
    /// claimed.
    pub reduced: Vec<PracticeReason>,
}

impl FlightClaim<'_> {
    /// How the flight counts, given the state of the career before it. Practice stays practice; any other flight
    /// must be one that the career would have allowed, with the seed of its exam or its day.
    pub fn settle(&self, trainee: AttemptTrainee<'_>) -> SettledFlight {
        let (day, stake) = day_and_stake(self.stake, self.seed, self.ended);
        if self.stake == Stake::Practice {
            return SettledFlight {
                stake,
                day,
                reduced: Vec::new(),
            };
        }
        let terms = self.terms(trainee, day);
        let mut reduced = terms.practice_reasons();
        let is_other_exam = self.stake == Stake::Exam && terms.layout() != Some(self.seed);
        let has_other_seed = is_other_exam || stake != self.stake;
        reduced.extend(has_other_seed.then_some(PracticeReason::ChosenSeed));
        reduced.extend((!self.is_confirmed).then_some(PracticeReason::UnconfirmedRecord));
        let stake = if reduced.is_empty() {
            stake
        } else {
            Stake::Practice
        };
        SettledFlight {
            stake,
            day,
            reduced,
        }
    }

    fn terms<'t>(&'t self, trainee: AttemptTrainee<'t>, day: i64) -> AttemptTerms<'t> {
        AttemptTerms {
            drawn: None,
            mission: self.mission,
            wanted: self.stake,
            seed: None,
            trainee: Some(trainee),
            means: AttemptMeans {
                mission_file: self.mission_file.unwrap_or(MissionFile::Course),
                flown_by: self.flown_by.unwrap_or_default(),
                has_own_airframes: false,
                speedup: 1.0,
                // Such a flight was recorded as practice.
                has_crew: false,
            },
            day,
            random: None,
        }
    }
}

/// The day of a finished flight, and its stake. A daily flight belongs to the day of its seed, even
/// if it ends on the next day; with any other seed it is practice.
pub fn day_and_stake(stake: Stake, seed: u64, ended: i64) -> (i64, Stake) {
    if stake != Stake::Daily {
        return (ended, stake);
    }
    let mut days = [ended, ended - 1].into_iter();
    let of_seed = days.find(|&day| daily_seed(day) == seed);
    of_seed.map_or((ended, Stake::Practice), |day| (day, Stake::Daily))
}
