//! How an attempt counts, and its layout: before it is flown ([`AttemptTerms`]) and afterwards ([`FlightClaim`]).

mod claim;
mod reason;

pub use claim::{FlightClaim, SettledFlight, day_and_stake};
pub use reason::{AttemptRefusal, PracticeReason};

use super::daily::FRESH_SEEDS;
use super::{CareerStanding, ExamKey, MissionCourse, MissionStage, Stake, daily_seed, exam_seed};
use crate::mission::Mission;
use crate::mission::record::WithoutEnd;
use crate::scoring::{FlownBy, MissionFile, TryReport};
use crate::workshop::Design;

/// The seed of the first attempt if none is chosen and there is no profile.
const FIRST_SEED: u64 = 1;

/// An attempt at a mission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attempt {
    /// The seed of the mission's world.
    pub seed: u64,
    /// How the attempt counts in a career.
    pub stake: Stake,
    /// The requested stake, which the next attempt gets if possible.
    pub wanted: Stake,
}

/// The circumstances that decide how an attempt counts. Without a profile nothing is stored, and every mission may be
/// flown.
#[derive(Debug, Clone, Copy)]
pub struct AttemptTerms<'a> {
    /// The mission, under the rules of its stake ([`Mission::flown_for`]).
    pub mission: &'a Mission,
    pub wanted: Stake,
    /// The seed chosen by the user, if any.
    pub seed: Option<u64>,
    /// The seed that the desk of a class has drawn for an exam.
    pub drawn: Option<u64>,
    /// The trainee, if there is a profile.
    pub trainee: Option<AttemptTrainee<'a>>,
    pub means: AttemptMeans,
    /// The day of the flight, in days since 1970 (UTC).
    pub day: i64,
    /// A random number for a new layout; `None` if the system does not provide one.
    pub random: Option<u64>,
}

/// The career of the trainee who makes an attempt.
#[derive(Debug, Clone, Copy)]
pub struct AttemptTrainee<'a> {
    pub standing: &'a CareerStanding,
    /// The missions of the career.
    pub course: &'a MissionCourse,
    /// The key that makes the trainee's exams different from those of others.
    pub exams: ExamKey,
}

/// The circumstances of an attempt that decide how it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttemptMeans {
    /// How the mission file compares with that of the course.
    pub mission_file: MissionFile,
    /// The source of the commands.
    pub flown_by: FlownBy,
    /// Whether the user's own files replace the built-in airframes.
    pub has_own_airframes: bool,
    /// The speed-up of simulated time.
    pub speedup: f64,
    /// Whether a crew flies.
    pub has_crew: bool,
}

/// Whether a flight does not count as an attempt, because it is practice or was flown by a script.
/// Records without a source of commands were flown by hand.
pub fn is_practice(stake: Stake, flown_by: Option<FlownBy>) -> bool {
    stake == Stake::Practice || !flown_by.unwrap_or_default().is_by_hand()
}

/// How to score a flight whose record has no end: a flight that counts is scored as abandoned,
/// because the program was closed or killed.
pub fn without_end(stake: Stake, flown_by: Option<FlownBy>) -> WithoutEnd {
    if is_practice(stake, flown_by) {
        WithoutEnd::Over
    } else {
        WithoutEnd::Left
    }
}

/// The number of the attempt that follows `earlier`, from 1. Unfinished flights and practice do not
/// count, and use up no free hints.
pub fn next_try<'a>(earlier: impl IntoIterator<Item = &'a TryReport>) -> u32 {
    let finished = earlier
        .into_iter()
        .filter(|one| one.score.is_some() && !one.is_practice);
    u32::try_from(finished.count() + 1).unwrap_or(u32::MAX)
}

/// The stake requested for a script's flight: graded with a profile on a layout that the user has
/// not chosen, otherwise practice. A flight that would be graded still counts only as practice
/// ([`PracticeReason::Script`]).
pub fn script_stake(chosen_seed: Option<u64>, has_profile: bool) -> Stake {
    if chosen_seed.is_none() && has_profile {
        Stake::Graded
    } else {
        Stake::Practice
    }
}

impl Attempt {
    /// A practice flight without a mission.
    pub fn practice(seed: Option<u64>) -> Self {
        Self {
            seed: seed.unwrap_or(FIRST_SEED),
            stake: Stake::Practice,
            wanted: Stake::Practice,
        }
    }

    /// Whether the attempt counts for less than requested.
    pub fn is_reduced(&self) -> bool {
        self.stake != self.wanted
    }

    /// The same layout again. A layout seen before counts as practice; the layout of the day is
    /// limited to once a day in any case.
    #[must_use]
    pub fn repeated(self) -> Self {
        let stake = match self.stake {
            Stake::Daily => self.stake,
            Stake::Exam | Stake::Graded | Stake::Practice => Stake::Practice,
        };
        Self { stake, ..self }
    }
}

impl AttemptTerms<'_> {
    /// The stake and the layout of the first attempt.
    pub fn decide(&self) -> Attempt {
        self.with_seed(self.layout().unwrap_or(FIRST_SEED))
    }

    /// The stake and the layout of the next attempt. The layout is another one, unless the user
    /// chose it or it is the same for all trainees.
    pub fn decide_after(&self, previous: &Attempt) -> Attempt {
        self.with_seed(
            self.layout()
                .unwrap_or_else(|| previous.seed.wrapping_add(1)),
        )
    }

    /// Why the attempt counts only as practice; empty if it counts as requested.
    pub fn practice_reasons(&self) -> Vec<PracticeReason> {
        let mut reasons = Vec::new();
        if self.wanted == Stake::Graded && self.seed.is_some() {
            reasons.push(PracticeReason::ChosenSeed);
        }
        if let Some(trainee) = &self.trainee {
            reasons.extend(self.reasons_of(trainee));
        } else if self.drawn.is_some() {
            // The exam of a desk is flown under the same conditions by guests.
            reasons.extend(self.means.practice_reasons());
        }
        reasons
    }

    fn reasons_of(&self, trainee: &AttemptTrainee<'_>) -> Vec<PracticeReason> {
        let Some(offer) = trainee.course.offer(&self.mission.id) else {
            return vec![PracticeReason::OwnMission];
        };
        let mut reasons = Vec::new();
        let stage = trainee.course.stage(offer, trainee.standing, self.day);
        if let MissionStage::Locked(why) = stage {
            reasons.push(PracticeReason::Locked(why));
        }
        if self.means.has_crew && self.mission.seats.crew.is_empty() {
            reasons.push(PracticeReason::Crew);
        }
        let fleet = self.mission.fleet().iter();
        reasons.extend(fleet.filter_map(|design| trainee.missing_parts(design)));
        reasons.extend(self.means.practice_reasons());
        reasons
    }

    /// The seed that the circumstances require; `None` if any will do.
    fn layout(&self) -> Option<u64> {
        match self.wanted {
            Stake::Exam => Some(self.drawn.unwrap_or_else(|| self.exam_seed())),
            Stake::Daily => Some(daily_seed(self.day)),
            Stake::Graded => self.seed.or_else(|| self.fresh_seed()),
            Stake::Practice => self.seed,
        }
    }

    fn exam_seed(&self) -> u64 {
        let Mission { id, rev, .. } = self.mission;
        match &self.trainee {
            Some(trainee) => exam_seed(trainee.exams, id, *rev, trainee.standing.exams(id)),
            None => exam_seed(
                ExamKey::of_guest(self.random.unwrap_or_default()),
                id,
                *rev,
                0,
            ),
        }
    }

    /// A random layout, almost certainly new to the trainee; `None` without a profile, because
    /// layouts then follow a fixed sequence.
    fn fresh_seed(&self) -> Option<u64> {
        self.trainee?;
        self.random.map(|random| random % FRESH_SEEDS)
    }

    fn with_seed(&self, seed: u64) -> Attempt {
        let stake = if self.practice_reasons().is_empty() {
            self.wanted
        } else {
            Stake::Practice
        };
        Attempt {
            seed,
            stake,
            wanted: self.wanted,
        }
    }
}

impl AttemptMeans {
    fn practice_reasons(self) -> Vec<PracticeReason> {
        let is_slow = self.speedup < 1.0;
        let mut reasons = Vec::new();
        reasons.extend(PracticeReason::of_file(self.mission_file));
        reasons.extend((!self.flown_by.is_by_hand()).then_some(PracticeReason::Script));
        reasons.extend(
            self.has_own_airframes
                .then_some(PracticeReason::OwnAirframes),
        );
        reasons.extend(is_slow.then_some(PracticeReason::SlowMotion));
        reasons
    }
}

impl AttemptTrainee<'_> {
    fn missing_parts(&self, design: &Design) -> Option<PracticeReason> {
        let parts = self.standing.missing_parts(design, self.course);
        (!parts.is_empty()).then(|| PracticeReason::MissingParts {
            design: design.name.clone(),
            parts,
        })
    }
}

#[cfg(test)]
mod tests;
