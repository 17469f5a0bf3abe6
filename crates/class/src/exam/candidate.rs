//! Where a trainee is in an exam.

use serde::{Deserialize, Serialize};

use super::{ExamDeed, ExamNote, ExamPlan, RecordHead, TryName};
use crate::{OrderId, Refusal};

/// A trainee in an exam.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Candidate {
    /// The index of the mission; that after the last one when all are done.
    pub(super) mission: usize,
    /// The number of the try at it, from 1.
    pub(super) number: u32,
    /// When the stage began, in seconds since 1970.
    pub(super) since: u64,
    pub(super) stage: CandidateStage,
    tries: Vec<CandidateTry>,
    /// Since when the seat has not said that it flies the try.
    pub(super) missing_since: Option<u64>,
    /// When the seat was last asked to end the flight.
    pub(super) end_asked: Option<u64>,
}

/// What a trainee does in an exam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CandidateStage {
    /// The trainee waits for the next try.
    Waits,
    /// The seat was asked to open the try, which must end at a time.
    Ordered {
        /// The order.
        id: OrderId,
        /// The time at which the try must end, in seconds since 1970.
        until: u64,
    },
    /// The seat cannot open the try; it is asked again.
    Blocked(Refusal),
    /// The try is open.
    Flying {
        /// The time at which it must end, in seconds since 1970.
        until: u64,
    },
    /// All missions are done.
    Done,
    /// The exam is over.
    Closed,
}

/// A try that was opened, or whose record was seen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CandidateTry {
    /// Which try it is.
    pub name: TryName,
    /// When the desk saw that it was open, in seconds since 1970.
    pub opened: Option<u64>,
    /// When it had to end, in seconds since 1970.
    pub until: Option<u64>,
    /// The heads of its record, in the order in which they came.
    pub heads: Vec<TimedHead>,
    /// When and how it ended.
    pub ended: Option<(u64, TryEnd)>,
}

/// A head, and when it came.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TimedHead {
    /// The time by the desk's clock, in seconds since 1970.
    pub at: u64,
    /// The head.
    pub head: RecordHead,
}

/// How a try ended, as far as the desk has seen it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TryEnd {
    /// The mission was over, and passed as the seat says.
    Passed,
    /// The mission was over.
    Over,
    /// The trainee left the flight, or the console ended.
    Left,
    /// Its time was up.
    Time,
}

impl Candidate {
    pub(super) fn new(at: u64) -> Self {
        Self {
            mission: 0,
            number: 1,
            since: at,
            stage: CandidateStage::Waits,
            tries: Vec::new(),
            missing_since: None,
            end_asked: None,
        }
    }

    /// The index of the mission; the number of missions when all are done.
    pub fn mission(&self) -> usize {
        self.mission
    }

    /// The number of the try, from 1.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// What the trainee does.
    pub fn stage(&self) -> CandidateStage {
        self.stage
    }

    /// The tries so far, oldest first.
    pub fn tries(&self) -> &[CandidateTry] {
        &self.tries
    }

    /// A try, if it was opened.
    pub(super) fn flown(&self, name: &TryName) -> Option<&CandidateTry> {
        self.tries.iter().find(|it| it.name == *name)
    }

    fn flown_mut(&mut self, name: &TryName) -> &mut CandidateTry {
        let known = self.tries.iter().position(|it| it.name == *name);
        let index = known.unwrap_or_else(|| {
            self.tries.push(CandidateTry {
                name: name.clone(),
                opened: None,
                until: None,
                heads: Vec::new(),
                ended: None,
            });
            self.tries.len() - 1
        });
        &mut self.tries[index]
    }

    pub(super) fn enter(&mut self, stage: CandidateStage, at: u64) {
        self.stage = stage;
        self.since = at;
        (self.missing_since, self.end_asked) = (None, None);
    }

    /// Takes in a note about this trainee.
    pub(super) fn apply(&mut self, note: &ExamNote, plan: &ExamPlan) {
        let at = note.at;
        match &note.what {
            ExamDeed::Opened { name, until, .. } => {
                let flown = self.flown_mut(name);
                flown.opened = flown.opened.or(Some(at));
                flown.until = Some(*until);
                self.go_to(name, plan);
                self.enter(CandidateStage::Flying { until: *until }, at);
            }
            ExamDeed::Head { name, head, .. } => {
                let head = head.clone();
                self.flown_mut(name).heads.push(TimedHead { at, head });
            }
            ExamDeed::Ended { name, how, .. } => {
                self.flown_mut(name).ended = Some((at, *how));
                self.go_to(name, plan);
                self.go_on(*how, plan);
                let is_done = self.mission >= plan.missions.len();
                let stage = if is_done {
                    CandidateStage::Done
                } else {
                    CandidateStage::Waits
                };
                self.enter(stage, at);
            }
            ExamDeed::Begun { .. } | ExamDeed::Seated { .. } | ExamDeed::Stopped => {}
        }
    }

    fn go_to(&mut self, name: &TryName, plan: &ExamPlan) {
        let mut missions = plan.missions.iter();
        if let Some(mission) = missions.position(|it| it.mission == name.mission) {
            (self.mission, self.number) = (mission, name.number);
        }
    }

    /// The try after one that has ended.
    fn go_on(&mut self, how: TryEnd, plan: &ExamPlan) {
        let tries = plan.missions.get(self.mission).map_or(0, |it| it.tries);
        if how == TryEnd::Passed || self.number >= tries {
            (self.mission, self.number) = (self.mission + 1, 1);
        } else {
            self.number += 1;
        }
    }
}
