//! Where a trainee is in an exam.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::conduct::GRACE;
use super::{ExamDeed, ExamMission, ExamNote, ExamPlan, RecordHead, TryName};
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
    /// Whether a head of the newest try was noted after its flight.
    pub(super) is_end_noted: bool,
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

impl CandidateStage {
    /// Whether the next thing that happens is that a seat opens a try.
    pub(super) fn awaits_opening(self) -> bool {
        match self {
            Self::Waits | Self::Asked { .. } | Self::Ordered(_) | Self::Blocked => true,
            Self::Flying { .. } | Self::Done | Self::Closed => false,
        }
    }
}

/// A try that a seat was asked to open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CandidateTry {
    /// Which try it is, with the opening that is flown; before that, the newest one.
    pub name: TryName,
    /// The times at which the seat was asked to open it, by their numbers.
    pub openings: BTreeMap<u32, TryOpening>,
    /// When the desk saw that it was open, in seconds since 1970.
    pub opened: Option<u64>,
    /// The heads of its record, in the order in which they came.
    pub heads: Vec<TimedHead>,
    /// When and how it ended.
    pub ended: Option<(u64, TryEnd)>,
    /// Whether the desk was away after the last head while the try was not over for it, so that it may have missed the
    /// end.
    pub was_desk_away: bool,
}

/// A time at which a seat was asked to open a try.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TryOpening {
    /// When the desk noted that it asks, in seconds since 1970.
    pub asked: u64,
    /// When the try had to end, in seconds since 1970.
    pub until: u64,
}

impl CandidateTry {
    /// The opening that is flown; before that, the newest one.
    pub fn opening(&self) -> TryOpening {
        let known = self.openings.get(&self.name.opening);
        known.copied().unwrap_or_default()
    }

    /// What has become of it, by what the desk has seen. It does not depend on when the exam was stopped.
    pub fn verdict(&self, at: u64) -> TryVerdict {
        let until = self.opening().until;
        match self.ended {
            Some((_, TryEnd::Passed)) => TryVerdict::Passed,
            // The clocks of desk and seat count whole seconds.
            Some((ended, TryEnd::Over)) if ended.saturating_add(1) >= until => TryVerdict::TimeUp,
            Some((_, TryEnd::Over)) => TryVerdict::Failed,
            Some((_, TryEnd::Left)) => TryVerdict::Left,
            None if at < until.saturating_add(GRACE) => TryVerdict::Open,
            Some((_, TryEnd::Time)) | None => TryVerdict::Unseen,
        }
    }

    /// Whether a name is that of one of its openings.
    pub(super) fn was_asked(&self, name: &TryName) -> bool {
        self.name.is_same_try(name) && self.openings.contains_key(&name.opening)
    }

    /// Whether a head is that of a record of this length as a whole.
    pub fn has_end_seen(&self, length: u64) -> bool {
        self.heads.iter().any(|it| it.head.bytes == length)
    }
}

/// A head, and when it came.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TimedHead {
    /// The time by the desk's clock, in seconds since 1970.
    pub at: u64,
    /// The length of the record at that time, and its hash.
    pub head: RecordHead,
}

/// What has become of a try.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TryVerdict {
    /// It is under way, or may be: its time is not up.
    Open,
    /// The mission was over and passed.
    Passed,
    /// The mission was over and not passed.
    Failed,
    /// The trainee left it, or the console ended.
    Left,
    /// Its time, or that of the exam, was up before the mission was passed.
    TimeUp,
    /// The desk has not seen how it ended.
    Unseen,
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
    /// Its time was up, and the desk has not seen its end.
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
            is_end_noted: false,
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

    /// The try at a mission that is due, if a seat was asked to open it.
    pub(super) fn due(&self, mission: &ExamMission) -> Option<&CandidateTry> {
        let is_due = |it: &&CandidateTry| {
            it.name.mission == mission.mission && it.name.number == self.number
        };
        self.tries.iter().find(is_due)
    }

    fn asked_mut(&mut self, name: &TryName) -> Option<&mut CandidateTry> {
        self.tries.iter_mut().find(|it| it.name.is_same_try(name))
    }

    fn ask(&mut self, name: &TryName, opening: TryOpening) {
        self.is_end_noted = false;
        if let Some(known) = self.asked_mut(name) {
            known.name = name.clone();
            known.openings.insert(name.opening, opening);
        } else {
            self.tries.push(CandidateTry {
                name: name.clone(),
                openings: BTreeMap::from([(name.opening, opening)]),
                opened: None,
                heads: Vec::new(),
                ended: None,
                was_desk_away: false,
            });
        }
    }

    /// The exam is stopped: no more tries are opened, and one that is flown or being opened goes on.
    pub(super) fn stop(&mut self, at: u64) {
        let goes_on = matches!(
            self.stage,
            CandidateStage::Ordered(_) | CandidateStage::Flying { .. } | CandidateStage::Done
        );
        if !goes_on {
            self.enter(CandidateStage::Closed, at);
        }
    }

    /// Whether a try may be flown at this time.
    pub(super) fn flies_at(&self, at: u64) -> bool {
        match self.stage {
            CandidateStage::Ordered(_) => true,
            CandidateStage::Flying { until } => at < until.saturating_add(GRACE),
            _ => false,
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
            ExamDeed::Asked { name, until, .. } => {
                let (asked, until) = (at, *until);
                self.ask(name, TryOpening { asked, until });
                self.go_to(name, plan);
                // If the desk ends before it has asked, it asks anew.
                self.enter(CandidateStage::Waits, at);
            }
            ExamDeed::Opened { name, .. } => {
                let asked = self.asked_mut(name).filter(|it| it.was_asked(name));
                let Some(flown) = asked else {
                    return;
                };
                if flown.opened.is_none() {
                    (flown.name, flown.opened) = (name.clone(), Some(at));
                }
                let until = flown.opening().until;
                self.enter(CandidateStage::Flying { until }, at);
            }
            ExamDeed::Head { name, head, .. } => {
                let head = head.clone();
                if let Some(flown) = self.asked_mut(name) {
                    flown.heads.push(TimedHead { at, head });
                    flown.was_desk_away = false;
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
            ExamDeed::Begun { .. }
            | ExamDeed::Seated { .. }
            | ExamDeed::Resumed
            | ExamDeed::Stopped => {}
        }
    }

    /// A desk goes on with the exam after it was away.
    pub(super) fn resume(&mut self) {
        if let Some(newest) = self.tries.last_mut() {
            newest.was_desk_away |= newest.ended.is_none();
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
