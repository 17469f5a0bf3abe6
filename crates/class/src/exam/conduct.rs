//! What a desk does for the trainees of an exam.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::{
    Candidate, CandidateStage, CandidateTry, ExamDeed, ExamMission, ExamNote, ExamPlan, ExamSecret,
    ExamTry, TryEnd, TryHead, TryName,
};
use crate::{
    Deed, Desk, FlightReport, OrderId, OrderState, Outcome, Refusal, SeatRecord, Stage, Words,
};

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
    plan: Arc<ExamPlan>,
    secret: ExamSecret,
    /// When it began, in seconds since 1970.
    begun: u64,
    /// The time since 1970 at which the desk's own clock was 0, in seconds.
    epoch: u64,
    is_stopped: bool,
    candidates: BTreeMap<String, Candidate>,
    /// The notes that were not taken to be written.
    unwritten: Vec<ExamNote>,
}

/// Why an exam cannot be held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExamFault {
    /// The desk holds another exam.
    Other,
    /// The desk holds no exam.
    None,
}

/// What follows for a trainee.
#[derive(Debug, Clone, PartialEq)]
enum ExamMove {
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

    /// Whether a try has gone on for longer than it may, as far as the desk has seen.
    pub fn is_late(flown: &CandidateTry) -> bool {
        let Some(until) = flown.until else {
            return false;
        };
        let newest = flown.heads.last();
        newest.is_some_and(|it| it.at > until.saturating_add(GRACE + super::GAP))
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

    fn note(&mut self, at: u64, what: ExamDeed) {
        let note = ExamNote { at, what };
        self.apply(&note);
        self.unwritten.push(note);
    }

    /// What follows for a user at a seat, which may not be connected.
    fn next(&self, user: &str, seat: Option<&SeatRecord>, at: u64) -> Option<ExamMove> {
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
    fn witness(&mut self, user: &str, seen: &TryHead, at: u64) -> bool {
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

impl Desk {
    /// Holds an exam, which is new or was found in its notes.
    ///
    /// # Errors
    /// The desk holds another one.
    pub fn hold(&mut self, exam: Exam) -> Result<(), ExamFault> {
        if self.exam().is_some_and(|it| !it.is_stopped()) {
            return Err(ExamFault::Other);
        }
        self.exam = Some(exam);
        Ok(())
    }

    /// The exam that the desk holds, or that was held last.
    pub fn exam(&self) -> Option<&Exam> {
        self.exam.as_ref()
    }

    /// The notes of the exam since the last call, to be written.
    pub fn take_exam_notes(&mut self) -> Vec<ExamNote> {
        self.exam.as_mut().map_or_else(Vec::new, Exam::take_notes)
    }

    /// Where the user of a seat is in the exam.
    pub fn candidate(&self, seat: &SeatRecord) -> Option<&Candidate> {
        self.exam.as_ref()?.candidates.get(&seat.user)
    }

    /// Lets the users of seats take part in the exam; those who do already are not changed.
    ///
    /// # Errors
    /// There is no exam.
    pub fn seat_candidates(&mut self, seats: &[usize], now: Duration) -> Result<(), ExamFault> {
        let exam = self.exam.as_mut().filter(|it| !it.is_stopped);
        let exam = exam.ok_or(ExamFault::None)?;
        let at = exam.at(now);
        for seat in seats.iter().filter_map(|&seat| self.seats.get(seat)) {
            if !exam.candidates.contains_key(&seat.user) {
                let user = seat.user.clone();
                exam.note(at, ExamDeed::Seated { user });
            }
        }
        Ok(())
    }

    /// Ends the exam: no try is opened any more. Flights go on.
    ///
    /// # Errors
    /// There is no exam.
    pub fn stop_exam(&mut self, now: Duration) -> Result<Words, ExamFault> {
        let exam = self.exam.as_mut().filter(|it| !it.is_stopped);
        let exam = exam.ok_or(ExamFault::None)?;
        let at = exam.at(now);
        exam.note(at, ExamDeed::Stopped);
        Ok(exam.plan.name.clone())
    }

    /// Goes on with the exam of all trainees; returns whether anything has changed.
    pub fn examine(&mut self, now: Duration) -> bool {
        let Some(mut exam) = self.exam.take() else {
            return false;
        };
        let at = exam.at(now);
        let users: Vec<String> = exam.candidates.keys().cloned().collect();
        let mut has_changed = false;
        for user in users {
            let seat = self.exam_seat(&exam, &user);
            self.watch_candidate(&mut exam, &user, seat, at);
            let record = seat.map(|seat| &self.seats[seat]);
            if let Some(next) = exam.next(&user, record, at) {
                has_changed = true;
                self.make_exam_move(&mut exam, &user, seat, next, now);
            }
        }
        self.exam = Some(exam);
        has_changed
    }

    /// The connected seat of a user: of several, the one that flies a try of the exam, otherwise the first.
    fn exam_seat(&self, exam: &Exam, user: &str) -> Option<usize> {
        let is_candidate = |it: &(usize, &SeatRecord)| it.1.user == user && it.1.is_here();
        let flies = |it: &(usize, &SeatRecord)| {
            let flight = it.1.report.as_ref().and_then(|it| it.flight.as_ref());
            let flown = flight.and_then(|it| it.exam_try.as_ref());
            flown.is_some_and(|it| it.name.begun == exam.begun)
        };
        let mut seats = self.seats.iter().enumerate().filter(is_candidate);
        let first = seats.clone().next();
        seats.find(flies).or(first).map(|(index, _)| index)
    }

    /// Notes since when a seat has not said that it flies its try.
    fn watch_candidate(&self, exam: &mut Exam, user: &str, seat: Option<usize>, at: u64) {
        let plan = Arc::clone(&exam.plan);
        let begun = exam.begun;
        let Some(candidate) = exam.candidates.get_mut(user) else {
            return;
        };
        let seat = seat.map(|seat| &self.seats[seat]);
        let is_reporting = seat.is_some_and(|seat| seat.report.is_some());
        let is_flown = seat.is_some_and(|seat| {
            let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
            let flown = flight.and_then(|it| it.exam_try.as_ref());
            let mission = plan.missions.get(candidate.mission);
            flown.zip(mission).is_some_and(|(flown, mission)| {
                flown.name.begun == begun
                    && flown.name.mission == mission.mission
                    && flown.name.number == candidate.number
            })
        });
        candidate.missing_since = if is_flown || !is_reporting {
            None
        } else {
            candidate.missing_since.or(Some(at))
        };
    }

    fn make_exam_move(
        &mut self,
        exam: &mut Exam,
        user: &str,
        seat: Option<usize>,
        next: ExamMove,
        now: Duration,
    ) {
        let at = exam.at(now);
        match (next, seat) {
            (ExamMove::Note(what), _) => exam.note(at, what),
            (ExamMove::Open(opened), Some(seat)) => {
                let until = at.saturating_add(opened.within_s.into());
                let id = self.order(seat, Deed::Examine(opened), now);
                if let Some(candidate) = exam.candidates.get_mut(user) {
                    candidate.enter(CandidateStage::Ordered { id, until }, at);
                }
            }
            (ExamMove::AskEnd, Some(seat)) => {
                self.order(seat, Deed::End, now);
                if let Some(candidate) = exam.candidates.get_mut(user) {
                    candidate.end_asked = Some(at);
                }
            }
            (ExamMove::Open(_) | ExamMove::AskEnd, None) => {}
            (ExamMove::Stage(stage), _) => {
                if let Some(candidate) = exam.candidates.get_mut(user) {
                    candidate.enter(stage, at);
                }
            }
        }
    }

    /// Notes the head of a record that a user's seat reports; whether it is noted now, so that the seat is told.
    pub(crate) fn witness(&mut self, seat: usize, head: &TryHead, now: Duration) -> bool {
        let Some(user) = self.seats.get(seat).map(|seat| seat.user.clone()) else {
            return false;
        };
        let Some(exam) = self.exam.as_mut() else {
            return false;
        };
        let at = exam.at(now);
        exam.witness(&user, head, at)
    }
}
