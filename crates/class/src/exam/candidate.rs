//! Where a trainee is in an exam.

use serde::{Deserialize, Serialize};

use super::{ExamDeed, ExamNote, ExamPlan, RecordHead, TryName};
use crate::OrderId;

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
    /// The index of the seat that opened the newest try; `None` if that was before this opening of the desk.
    pub(super) seat: Option<usize>,
    /// Since when that seat has not said that it flies the try.
    pub(super) missing_since: Option<u64>,
    /// When the seat was last asked to end the flight.
    pub(super) end_asked: Option<u64>,
}

/// What a trainee does in an exam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CandidateStage {
    /// The trainee waits for the next try.
    Waits,
    /// The desk asks the seat to open the try once its note is on disk.
    Asked {
        /// The number of the note, from 1.
        note: usize,
    },
    /// The seat was asked to open the try.
    Ordered(OrderId),
    /// The seat cannot open the try; it is asked again.
    Blocked,
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

/// A try that a seat was asked to open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CandidateTry {
    /// Which try it is.
    pub name: TryName,
    /// How often the seat was asked to open it.
    pub openings: u32,
    /// When the desk saw that it was open, in seconds since 1970.
    pub opened: Option<u64>,
    /// When it had to end, in seconds since 1970.
    pub until: u64,
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
            seat: None,
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

    /// A try, if a seat was asked to open it.
    pub(super) fn asked(&self, name: &TryName) -> Option<&CandidateTry> {
        self.tries.iter().find(|it| it.name == *name)
    }

    fn asked_mut(&mut self, name: &TryName) -> Option<&mut CandidateTry> {
        self.tries.iter_mut().find(|it| it.name == *name)
    }

    fn ask(&mut self, name: &TryName, opening: u32, until: u64) {
        match self.asked_mut(name) {
            Some(known) => (known.openings, known.until) = (opening, until),
            None => self.tries.push(CandidateTry {
                name: name.clone(),
                openings: opening,
                opened: None,
                until,
                heads: Vec::new(),
                ended: None,
            }),
        }
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
            ExamDeed::Asked {
                name,
                opening,
                until,
                ..
            } => {
                self.ask(name, *opening, *until);
                self.go_to(name, plan);
                // If the desk ends before it has asked, it asks anew.
                self.enter(CandidateStage::Waits, at);
            }
            ExamDeed::Opened { name, .. } => {
                let Some(flown) = self.asked_mut(name) else {
                    return;
                };
                flown.opened = flown.opened.or(Some(at));
                let until = flown.until;
                self.enter(CandidateStage::Flying { until }, at);
            }
            ExamDeed::Head { name, head, .. } => {
                let head = head.clone();
                if let Some(flown) = self.asked_mut(name) {
                    flown.heads.push(TimedHead { at, head });
                }
            }
            ExamDeed::Ended { name, how, .. } => {
                if let Some(flown) = self.asked_mut(name) {
                    flown.ended = Some((at, *how));
                }
                self.go_to(name, plan);
                let stage = self.go_on(*how, plan);
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

    /// Goes to the try after one that has ended; returns the stage that follows.
    fn go_on(&mut self, how: TryEnd, plan: &ExamPlan) -> CandidateStage {
        let tries = plan.missions.get(self.mission).map_or(0, |it| it.tries);
        if how == TryEnd::Passed || self.number >= tries {
            (self.mission, self.number) = (self.mission + 1, 1);
        } else {
            self.number += 1;
        }
        if self.mission >= plan.missions.len() {
            CandidateStage::Done
        } else {
            CandidateStage::Waits
        }
    }
}
