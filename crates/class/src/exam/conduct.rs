//! An exam, and what follows in it for each trainee.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use sha2::{Digest as _, Sha256};

use super::witness::GAP;
use super::{
    Candidate, CandidateStage, CandidateTry, ContentHash, ExamDeed, ExamMission, ExamNote,
    ExamPlan, ExamSecret, ExamTry, TryEnd, TryHead, TryName, TryOpening,
};
use crate::{FlightReport, OrderState, Outcome, Refusal, SeatRecord, Stage};

/// The time between two tries, in which the trainee sees how the last one ended, in seconds.
const BREAK: u64 = 20;
/// The time after which a seat that could not open a try is asked again, in seconds.
const AGAIN: u64 = 10;
/// The time without the try in the seat's reports after which it counts as left, in seconds.
const LEFT: u64 = 4;
/// How much later than its limit a try may end, in seconds: the seat ends it by itself, and orders take their time.
pub(super) const GRACE: u64 = 15;
/// The least time between two heads of a try, in seconds.
const HEADS_EVERY: u64 = 5;

/// An exam that a desk holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Exam {
    pub(super) plan: Arc<ExamPlan>,
    secret: ExamSecret,
    /// The hash of its file.
    file: ContentHash,
    /// When it began, in seconds since 1970.
    pub(super) begun: u64,
    /// The time since 1970 at which the desk's own clock was 0, in seconds.
    epoch: u64,
    pub(super) is_stopped: bool,
    pub(super) candidates: BTreeMap<String, Candidate>,
    /// The notes that were not taken to be written.
    unwritten: Vec<ExamNote>,
    /// The number of all notes.
    pub(super) notes: usize,
    /// The number of notes that are on disk.
    kept: usize,
}

/// What a desk sees of a trainee in an exam.
#[derive(Debug, Clone, Copy)]
pub(super) struct CandidateSight<'a> {
    pub user: &'a str,
    /// The trainee's seat, if it is connected.
    pub seat: Option<&'a SeatRecord>,
    /// What has become of the order to open the try.
    pub order: OrderState,
    /// Whether a try of another exam keeps the trainee from this one.
    pub is_busy: bool,
    /// The time, in seconds since 1970.
    pub at: u64,
}

/// What follows for a trainee.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ExamMove {
    /// Note that the seat is asked to open a try.
    Ask(ExamDeed),
    /// Ask the seat to open the try.
    Open(ExamTry),
    /// Ask the seat to end the flight.
    AskEnd,
    /// A deed that has to be noted on the disk.
    Note(ExamDeed),
    /// Another stage, which needs no note.
    Stage(CandidateStage),
}

impl Exam {
    /// An exam from its notes. `epoch` is the time since 1970 at which the desk's own clock was 0.
    pub fn of(plan: Arc<ExamPlan>, notes: &[ExamNote], epoch: u64) -> Option<Self> {
        let first = notes.first()?;
        let ExamDeed::Begun { secret, source, .. } = &first.what else {
            return None;
        };
        let mut exam = Self {
            plan,
            secret: secret.clone(),
            file: <[u8; 32]>::from(Sha256::digest(source)).into(),
            begun: first.at,
            epoch,
            is_stopped: false,
            candidates: BTreeMap::new(),
            unwritten: Vec::new(),
            notes: notes.len(),
            kept: notes.len(),
        };
        for note in &notes[1..] {
            exam.apply(note);
        }
        Some(exam)
    }

    /// An exam that begins with a note that is not written yet. `epoch` is the time since 1970 at which the desk's own
    /// clock was 0.
    pub fn begin(plan: Arc<ExamPlan>, first: ExamNote, epoch: u64) -> Option<Self> {
        let mut exam = Self::of(plan, std::slice::from_ref(&first), epoch)?;
        exam.unwritten.push(first);
        exam.kept = 0;
        Some(exam)
    }

    /// The missions, tries and times of the exam.
    pub fn plan(&self) -> &ExamPlan {
        &self.plan
    }

    /// The hash of its file.
    pub fn file(&self) -> &ContentHash {
        &self.file
    }

    /// When it began, in seconds since 1970.
    pub fn begun(&self) -> u64 {
        self.begun
    }

    /// Whether the instructor has ended it.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    /// Whether the time of the exam is over, and nobody flies a try any more.
    pub(super) fn ends_itself(&self, at: u64) -> bool {
        let is_over = |candidate: &Candidate| {
            let stage = candidate.stage();
            matches!(stage, CandidateStage::Done | CandidateStage::Closed)
        };
        self.has_begun()
            && !self.is_stopped
            && self.plan.is_closed_at(at)
            && self.candidates.values().all(is_over)
    }

    /// Whether tries are opened, or may still be flown at this time in seconds since 1970.
    pub fn is_watched(&self, at: u64) -> bool {
        let mut candidates = self.candidates.values();
        !self.is_stopped || candidates.any(|it| it.flies_at(at))
    }

    /// Whether a user may fly a try of it at a time of the desk's own clock.
    pub(super) fn is_flown_by(&self, user: &str, now: Duration) -> bool {
        let candidate = self.candidates.get(user);
        candidate.is_some_and(|it| it.flies_at(self.at(now)))
    }

    /// Whether a try of it keeps a user from tries of other exams at a time of the desk's own clock: it is flown, or the
    /// trainee still sees how it has ended.
    pub(super) fn keeps_busy(&self, user: &str, now: Duration) -> bool {
        let newest = self.candidates.get(user).and_then(|it| it.tries().last());
        let ended = newest.and_then(|it| it.ended);
        let has_just_ended = ended.is_some_and(|(at, _)| self.at(now) < at.saturating_add(BREAK));
        has_just_ended || self.is_flown_by(user, now)
    }

    /// The trainees who may fly a try of it at a time in seconds since 1970, by user name.
    pub fn flown_at(&self, at: u64) -> impl Iterator<Item = &str> {
        let flying = self.candidates.iter().filter(move |it| it.1.flies_at(at));
        flying.map(|(user, _)| user.as_str())
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

    /// Some more of its notes, the oldest that were not, are on disk now. Returns whether the exam begins by that.
    pub fn note_kept(&mut self, count: usize) -> bool {
        let begins = self.kept == 0 && count > 0;
        self.kept += count;
        begins
    }

    /// Whether its first note is on disk, so that the desk can continue it after any end.
    pub fn has_begun(&self) -> bool {
        self.kept > 0
    }

    /// The try that a user's record with a seed is of.
    pub fn try_of(&self, user: &str, seed: u64) -> Option<&CandidateTry> {
        let mut tries = self.candidates.get(user)?.tries().iter();
        tries.find(|it| self.seed(user, &it.name) == seed)
    }

    /// Whether a try has gone on for longer than it may: by the heads that the desk has seen, or because its record has
    /// more mission time than there was. `length` is that of its record, in bytes.
    pub fn is_late(flown: &CandidateTry, length: u64, mission_time: Duration) -> bool {
        let TryOpening { asked, until } = flown.opening();
        // The whole record may be seen long after the flight: a new connection begins with its head.
        let mut growing = flown.heads.iter().filter(|it| it.head.bytes < length);
        let is_seen = growing.any(|it| it.at > until.saturating_add(GRACE + GAP));
        // Not from when the desk saw that it was open: it may have been away until then.
        let ends = asked.saturating_add(mission_time.as_secs());
        is_seen || ends > until.saturating_add(GRACE)
    }

    fn seed(&self, user: &str, name: &TryName) -> u64 {
        self.secret.seed(self.plan.layout, user, name)
    }

    /// Takes in a note that is on disk.
    pub fn take_in(&mut self, note: &ExamNote) {
        self.apply(note);
        self.notes += 1;
        self.kept += 1;
    }

    fn apply(&mut self, note: &ExamNote) {
        let user = match &note.what {
            ExamDeed::Begun { .. } => return,
            ExamDeed::Resumed => {
                self.candidates.values_mut().for_each(Candidate::resume);
                return;
            }
            ExamDeed::Stopped => {
                self.is_stopped = true;
                for candidate in self.candidates.values_mut() {
                    candidate.stop(note.at);
                }
                return;
            }
            ExamDeed::Seated { user }
            | ExamDeed::Asked { user, .. }
            | ExamDeed::Opened { user, .. }
            | ExamDeed::Head { user, .. }
            | ExamDeed::Ended { user, .. } => user,
        };
        let known = self.candidates.entry(user.clone());
        let candidate = known.or_insert_with(|| Candidate::new(note.at));
        candidate.apply(note, &self.plan);
        if self.is_stopped {
            candidate.stop(note.at);
        }
    }

    pub(super) fn enter(&mut self, user: &str, stage: CandidateStage, at: u64) {
        if let Some(candidate) = self.candidates.get_mut(user) {
            candidate.enter(stage, at);
        }
    }

    pub(super) fn note(&mut self, at: u64, what: ExamDeed) {
        let note = ExamNote { at, what };
        self.apply(&note);
        self.unwritten.push(note);
        self.notes += 1;
    }

    /// What follows for a trainee.
    pub(super) fn next(&self, sight: CandidateSight<'_>) -> Option<ExamMove> {
        let candidate = self.candidates.get(sight.user)?;
        let mission = self.plan.missions.get(candidate.mission)?;
        let due = candidate.due(mission);
        if candidate.stage.awaits_opening()
            && let Some((_, name)) = sight.seat.and_then(flight_of)
            && due.is_some_and(|it| it.was_asked(name))
        {
            // Also an earlier opening: the seat may answer late.
            return Some(opened(sight.user, name.clone()));
        }
        match candidate.stage {
            CandidateStage::Waits | CandidateStage::Asked { .. } | CandidateStage::Blocked
                if self.is_stopped || self.plan.is_closed_at(sight.at) =>
            {
                Some(ExamMove::Stage(CandidateStage::Closed))
            }
            CandidateStage::Waits | CandidateStage::Blocked => {
                self.asking(candidate, mission, sight)
            }
            CandidateStage::Asked { note } if note > self.kept => None,
            CandidateStage::Asked { .. } => self.opening(due?, mission, sight),
            CandidateStage::Ordered(_) => ordered(sight.user, due?.name.clone(), sight.order),
            CandidateStage::Flying { until } => {
                let name = &due?.name;
                let end = flying(candidate, name, until, sight);
                end.map(|how| ended(sight.user, name.clone(), how))
                    .or_else(|| asks_end(candidate, sight.seat?, until, sight.at))
            }
            CandidateStage::Done | CandidateStage::Closed => None,
        }
    }

    /// The note that the seat is asked to open the try that is due.
    fn asking(
        &self,
        candidate: &Candidate,
        mission: &ExamMission,
        sight: CandidateSight<'_>,
    ) -> Option<ExamMove> {
        let wait = match candidate.stage {
            CandidateStage::Blocked => AGAIN,
            _ if candidate.tries().is_empty() => 0,
            _ => BREAK,
        };
        let at = sight.at;
        let is_due = self.plan.is_open_at(at) && at >= candidate.since.saturating_add(wait);
        if !is_due || sight.is_busy || sight.seat?.report.is_none() {
            return None;
        }
        let due = candidate.due(mission);
        let newest = due.and_then(|it| it.openings.keys().next_back().copied());
        Some(ExamMove::Ask(ExamDeed::Asked {
            user: sight.user.to_owned(),
            name: TryName {
                exam: self.plan.name.clone(),
                begun: self.begun,
                mission: mission.mission.clone(),
                number: candidate.number,
                opening: newest.unwrap_or_default().saturating_add(1),
            },
            until: self.plan.until(mission, at),
        }))
    }

    /// The order to open a try, once its note is on disk. If that took the whole time of the try, it is asked for anew.
    fn opening(
        &self,
        asked: &CandidateTry,
        mission: &ExamMission,
        sight: CandidateSight<'_>,
    ) -> Option<ExamMove> {
        let within = asked.opening().until.saturating_sub(sight.at);
        if within == 0 {
            return Some(ExamMove::Stage(CandidateStage::Waits));
        }
        sight.seat?;
        Some(ExamMove::Open(ExamTry {
            seed: self.seed(sight.user, &asked.name),
            name: asked.name.clone(),
            title: self.plan.title.clone(),
            title_uk: self.plan.title_uk.clone(),
            tries: mission.tries,
            within_s: u32::try_from(within).unwrap_or(u32::MAX),
        }))
    }

    /// Whether a head is new, and is noted.
    pub(super) fn witness(&mut self, user: &str, seen: &TryHead, at: u64) -> bool {
        let Some(candidate) = self.candidates.get(user) else {
            return false;
        };
        // Only the newest try is still recorded.
        let newest = candidate.tries().last();
        let Some(flown) = newest.filter(|it| it.opened.is_some() && it.name == seen.name) else {
            return false;
        };
        // The trainee may leave, and the record be handed in, right after the flight.
        let is_end = seen.is_over && !candidate.is_end_noted;
        match flown.heads.last() {
            Some(last) if last.head == seen.head => return true,
            Some(last) if !is_end && at < last.at.saturating_add(HEADS_EVERY) => return false,
            // An earlier head again must not hide that the record does not grow.
            Some(last) if seen.head.bytes < last.head.bytes => return false,
            _ => {}
        }
        let (user, name) = (user.to_owned(), seen.name.clone());
        let head = seen.head.clone();
        if let Some(candidate) = self.candidates.get_mut(&user) {
            candidate.is_end_noted |= seen.is_over;
        }
        self.note(at, ExamDeed::Head { user, name, head });
        true
    }
}

/// The flight of a seat, and which try it is.
fn flight_of(seat: &SeatRecord) -> Option<(&FlightReport, &TryName)> {
    let flight = seat.report.as_ref()?.flight.as_ref()?;
    let flown = flight.exam_try.as_ref()?;
    seat.is_here().then_some((flight, &flown.name))
}

fn opened(user: &str, name: TryName) -> ExamMove {
    let user = user.to_owned();
    ExamMove::Note(ExamDeed::Opened { user, name })
}

fn ended(user: &str, name: TryName, how: TryEnd) -> ExamMove {
    let user = user.to_owned();
    ExamMove::Note(ExamDeed::Ended { user, name, how })
}

/// What follows from the answer of a seat that was to open a try.
fn ordered(user: &str, name: TryName, state: OrderState) -> Option<ExamMove> {
    Some(match state {
        OrderState::Waiting => return None,
        OrderState::Ended(Outcome::Done) => opened(user, name),
        // The desk was away meanwhile.
        OrderState::Ended(Outcome::Refused(Refusal::Flown)) => ended(user, name, TryEnd::Left),
        OrderState::Ended(
            Outcome::Refused(_)
            | Outcome::NoEffect
            | Outcome::Armed
            | Outcome::UnderWay
            | Outcome::Disarmed,
        )
        | OrderState::Unanswered => ExamMove::Stage(CandidateStage::Blocked),
    })
}

/// How an open try has ended, if it has.
fn flying(
    candidate: &Candidate,
    name: &TryName,
    until: u64,
    sight: CandidateSight<'_>,
) -> Option<TryEnd> {
    let flight = sight.seat.and_then(flight_of);
    let Some((flight, _)) = flight.filter(|(_, flown)| *flown == name) else {
        let is_missing = |since: u64| sight.at >= since.saturating_add(LEFT);
        if candidate.missing_since.is_some_and(is_missing) {
            return Some(TryEnd::Left);
        }
        let is_gone = sight.at >= until.saturating_add(GRACE);
        return is_gone.then_some(TryEnd::Time);
    };
    let is_passed = flight.exam_try.as_ref().is_some_and(|it| it.is_passed);
    let how = if is_passed {
        TryEnd::Passed
    } else {
        TryEnd::Over
    };
    (flight.stage == Stage::Over).then_some(how)
}

fn asks_end(candidate: &Candidate, seat: &SeatRecord, until: u64, at: u64) -> Option<ExamMove> {
    let is_late = seat.is_here() && at >= until.saturating_add(GRACE);
    let was_asked = candidate.end_asked.is_some_and(|asked| at < asked + AGAIN);
    (is_late && !was_asked).then_some(ExamMove::AskEnd)
}
