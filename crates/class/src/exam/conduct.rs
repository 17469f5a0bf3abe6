//! An exam, and what follows in it for each trainee.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{
    Candidate, CandidateStage, CandidateTry, ExamDeed, ExamMission, ExamNote, ExamPlan, ExamSecret,
    ExamTry, TryEnd, TryHead, TryName,
};
use crate::{FlightReport, OrderId, OrderState, Outcome, Refusal, SeatRecord, Stage};

/// The time between two tries, in which the trainee sees how the last one ended, in seconds.
const BREAK: u64 = 20;
/// The time after which a seat that could not open a try is asked again, in seconds.
const AGAIN: u64 = 10;
/// The time without the try in the seat's reports after which it counts as left, in seconds.
const LEFT: u64 = 4;
/// How much later than its limit a try may end, in seconds: the seat ends it by itself, and orders take their time.
const GRACE: u64 = 15;
/// The least time between two heads of a try, in seconds.
const HEADS_EVERY: u64 = 5;

/// An exam that a desk holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Exam {
    pub(super) plan: Arc<ExamPlan>,
    secret: ExamSecret,
    /// When it began, in seconds since 1970.
    pub(super) begun: u64,
    /// The time since 1970 at which the desk's own clock was 0, in seconds.
    epoch: u64,
    pub(super) is_stopped: bool,
    pub(super) candidates: BTreeMap<String, Candidate>,
    /// The notes that were not taken to be written.
    unwritten: Vec<ExamNote>,
}

/// What follows for a trainee.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ExamMove {
    /// Ask the seat to open the try.
    Open(ExamTry),
    /// Ask the seat to end the flight.
    AskEnd,
    /// Note something.
    Note(ExamDeed),
    /// Another stage, which needs no note.
    Stage(CandidateStage),
}

impl Exam {
    /// An exam from its notes. `epoch` is the time since 1970 at which the desk's own clock was 0.
    pub fn of(plan: Arc<ExamPlan>, notes: &[ExamNote], epoch: u64) -> Option<Self> {
        let first = notes.first()?;
        let ExamDeed::Begun { secret, .. } = &first.what else {
            return None;
        };
        let mut exam = Self {
            plan,
            secret: secret.clone(),
            begun: first.at,
            epoch,
            is_stopped: false,
            candidates: BTreeMap::new(),
            unwritten: Vec::new(),
        };
        for note in &notes[1..] {
            exam.apply(note);
        }
        Some(exam)
    }

    /// Keeps a note that is part of the state already, to be written.
    pub fn keep(&mut self, note: ExamNote) {
        self.unwritten.push(note);
    }

    /// What is flown.
    pub fn plan(&self) -> &ExamPlan {
        &self.plan
    }

    /// When it began, in seconds since 1970.
    pub fn begun(&self) -> u64 {
        self.begun
    }

    /// Whether the instructor has ended it.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    /// A time of the desk's own clock, in seconds since 1970.
    pub fn at(&self, now: Duration) -> u64 {
        self.epoch.saturating_add(now.as_secs())
    }

    /// The trainees by user name.
    pub fn candidates(&self) -> &BTreeMap<String, Candidate> {
        &self.candidates
    }

    /// The notes since the last call, to be written.
    pub fn take_notes(&mut self) -> Vec<ExamNote> {
        std::mem::take(&mut self.unwritten)
    }

    /// The try that a user's record with a seed is of.
    pub fn try_of(&self, user: &str, seed: u64) -> Option<CandidateTry> {
        let candidate = self.candidates.get(user)?;
        let names = self.plan.missions.iter().flat_map(|mission| {
            let numbers = 1..=mission.tries;
            numbers.map(|number| self.name(mission, number))
        });
        let mut meant = names.filter(|name| self.seed(user, name) == seed);
        let name = meant.next()?;
        Some(candidate.flown(&name).cloned().unwrap_or(CandidateTry {
            name,
            opened: None,
            until: None,
            heads: Vec::new(),
            ended: None,
        }))
    }

    /// Whether a try has gone on for longer than it may: by the heads that the desk has seen, or because its record has
    /// more mission time than there was.
    pub fn is_late(flown: &CandidateTry, mission_time: Duration) -> bool {
        let Some(until) = flown.until else {
            return false;
        };
        let newest = flown.heads.last();
        let is_seen = newest.is_some_and(|it| it.at > until.saturating_add(GRACE + super::GAP));
        let ends = flown
            .opened
            .map(|opened| opened.saturating_add(mission_time.as_secs()));
        is_seen || ends.is_some_and(|ends| ends > until.saturating_add(GRACE))
    }

    fn name(&self, mission: &ExamMission, number: u32) -> TryName {
        TryName {
            exam: self.plan.name.clone(),
            begun: self.begun,
            mission: mission.mission.clone(),
            number,
        }
    }

    fn seed(&self, user: &str, name: &TryName) -> u64 {
        self.secret.seed(self.plan.layout, user, name)
    }

    fn apply(&mut self, note: &ExamNote) {
        let user = match &note.what {
            ExamDeed::Begun { .. } => return,
            ExamDeed::Stopped => {
                self.is_stopped = true;
                for candidate in self.candidates.values_mut() {
                    candidate.enter(CandidateStage::Closed, note.at);
                }
                return;
            }
            ExamDeed::Seated { user }
            | ExamDeed::Opened { user, .. }
            | ExamDeed::Head { user, .. }
            | ExamDeed::Ended { user, .. } => user,
        };
        let known = self.candidates.entry(user.clone());
        let candidate = known.or_insert_with(|| Candidate::new(note.at));
        candidate.apply(note, &self.plan);
    }

    pub(super) fn note(&mut self, at: u64, what: ExamDeed) {
        let note = ExamNote { at, what };
        self.apply(&note);
        self.unwritten.push(note);
    }

    /// What follows for a user at a seat, which may not be connected.
    pub(super) fn next(&self, user: &str, seat: Option<&SeatRecord>, at: u64) -> Option<ExamMove> {
        let candidate = self.candidates.get(user)?;
        let mission = self.plan.missions.get(candidate.mission)?;
        let name = self.name(mission, candidate.number);
        match candidate.stage {
            CandidateStage::Waits | CandidateStage::Blocked(_) if self.plan.is_closed_at(at) => {
                Some(ExamMove::Stage(CandidateStage::Closed))
            }
            CandidateStage::Waits | CandidateStage::Blocked(_) => {
                self.opening(candidate, mission, seat?, at)
            }
            CandidateStage::Ordered { id, until } => {
                let seat = seat?;
                if flight_of(seat, &name).is_some() {
                    return Some(opened(user, name, until));
                }
                ordered(user, name, outcome_of(seat, id)?, until)
            }
            CandidateStage::Flying { until } => flying(candidate, seat, &name, until, at)
                .map(|how| ended(user, name, how))
                .or_else(|| asks_end(candidate, seat?, until, at)),
            CandidateStage::Done | CandidateStage::Closed => None,
        }
    }

    /// The try that is due.
    fn opening(
        &self,
        candidate: &Candidate,
        mission: &ExamMission,
        seat: &SeatRecord,
        at: u64,
    ) -> Option<ExamMove> {
        let wait = match candidate.stage {
            CandidateStage::Blocked(_) => AGAIN,
            _ if candidate.tries().is_empty() => 0,
            _ => BREAK,
        };
        let is_due = self.plan.is_open_at(at) && at >= candidate.since.saturating_add(wait);
        if !is_due || seat.report.is_none() {
            return None;
        }
        let name = self.name(mission, candidate.number);
        let within = self.plan.until(mission, at).saturating_sub(at);
        Some(ExamMove::Open(ExamTry {
            seed: self.seed(&seat.user, &name),
            name,
            tries: mission.tries,
            within_s: u32::try_from(within).unwrap_or(u32::MAX),
        }))
    }

    /// Whether a head is new, and is noted.
    pub(super) fn witness(&mut self, user: &str, seen: &TryHead, at: u64) -> bool {
        let Some(candidate) = self.candidates.get(user) else {
            return false;
        };
        let Some(flown) = candidate.flown(&seen.name) else {
            return false;
        };
        // Only the newest try is still recorded.
        if candidate
            .tries()
            .last()
            .is_some_and(|it| it.name != seen.name)
        {
            return false;
        }
        match flown.heads.last() {
            Some(last) if last.head == seen.head => return true,
            Some(last) if at < last.at.saturating_add(HEADS_EVERY) => return false,
            // An earlier head again must not hide that the record does not grow.
            Some(last) if seen.head.bytes < last.head.bytes => return false,
            _ => {}
        }
        let (user, name) = (user.to_owned(), seen.name.clone());
        let head = seen.head.clone();
        self.note(at, ExamDeed::Head { user, name, head });
        true
    }
}

/// The flight of a seat, if it is that try.
fn flight_of<'a>(seat: &'a SeatRecord, name: &TryName) -> Option<&'a FlightReport> {
    let flight = seat.report.as_ref()?.flight.as_ref()?;
    let flown = flight.exam_try.as_ref()?;
    (seat.is_here() && flown.name == *name).then_some(flight)
}

fn outcome_of(seat: &SeatRecord, id: OrderId) -> Option<OrderState> {
    let order = seat.orders().find(|it| it.order.id == id);
    let state = order.map_or(OrderState::Unanswered, |it| it.state);
    (state != OrderState::Waiting).then_some(state)
}

fn opened(user: &str, name: TryName, until: u64) -> ExamMove {
    let user = user.to_owned();
    ExamMove::Note(ExamDeed::Opened { user, name, until })
}

fn ended(user: &str, name: TryName, how: TryEnd) -> ExamMove {
    let user = user.to_owned();
    ExamMove::Note(ExamDeed::Ended { user, name, how })
}

/// What follows from the answer of a seat that was to open a try.
fn ordered(user: &str, name: TryName, state: OrderState, until: u64) -> Option<ExamMove> {
    Some(match state {
        OrderState::Waiting => return None,
        OrderState::Ended(Outcome::Done) => opened(user, name, until),
        // The desk was away meanwhile.
        OrderState::Ended(Outcome::Refused(Refusal::Flown)) => ended(user, name, TryEnd::Left),
        OrderState::Ended(Outcome::Refused(refusal)) => {
            ExamMove::Stage(CandidateStage::Blocked(refusal))
        }
        OrderState::Ended(Outcome::NoEffect | Outcome::Armed | Outcome::Disarmed)
        | OrderState::Unanswered => ExamMove::Stage(CandidateStage::Blocked(Refusal::NotFlying)),
    })
}

/// How an open try has ended, if it has.
fn flying(
    candidate: &Candidate,
    seat: Option<&SeatRecord>,
    name: &TryName,
    until: u64,
    at: u64,
) -> Option<TryEnd> {
    let flight = seat.and_then(|seat| flight_of(seat, name));
    match flight {
        Some(flight) if flight.stage == Stage::Over => {
            let flown = flight.exam_try.as_ref();
            let is_passed = flown.is_some_and(|it| it.is_passed);
            return Some(if is_passed {
                TryEnd::Passed
            } else {
                TryEnd::Over
            });
        }
        Some(_) => {}
        None => {
            let is_missing = |since: u64| at >= since.saturating_add(LEFT);
            if candidate.missing_since.is_some_and(is_missing) {
                return Some(TryEnd::Left);
            }
        }
    }
    let is_gone = flight.is_none() && at >= until.saturating_add(GRACE);
    is_gone.then_some(TryEnd::Time)
}

fn asks_end(candidate: &Candidate, seat: &SeatRecord, until: u64, at: u64) -> Option<ExamMove> {
    let is_late = seat.is_here() && at >= until.saturating_add(GRACE);
    let was_asked = candidate.end_asked.is_some_and(|asked| at < asked + AGAIN);
    (is_late && !was_asked).then_some(ExamMove::AskEnd)
}
