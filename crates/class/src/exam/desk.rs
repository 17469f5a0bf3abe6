//! What a desk does for its exam.

use std::sync::Arc;
use std::time::Duration;

use super::conduct::{CandidateSight, Exam, ExamMove};
use super::{Candidate, CandidateStage, ExamDeed, ExamNote, ExamPlan, TryHead};
use crate::{Deed, Desk, OrderState, SeatRecord};

impl Desk {
    /// Holds an exam, which is new or was found in its notes; not while another one is held. Tries of exams that were held
    /// before are still seen. Returns whether it does.
    pub fn hold(&mut self, exam: Exam) -> bool {
        let is_free = self.exam().is_none_or(Exam::is_stopped);
        if is_free {
            self.exams.push(resumed(exam));
        }
        is_free
    }

    /// Sees how the tries of an exam end that was found in its notes and is stopped, whatever exam is held.
    pub fn see_out(&mut self, stopped: Exam) {
        self.exams.insert(0, resumed(stopped));
    }

    /// The exam that the desk holds, or that was held last.
    pub fn exam(&self) -> Option<&Exam> {
        self.exams.last()
    }

    /// The exams that are held, or of which a try is still flown at a time of the desk's clock; oldest first.
    pub fn watched_exams(&self, now: Duration) -> impl Iterator<Item = &Exam> {
        self.exams
            .iter()
            .filter(move |it| it.is_watched(it.at(now)))
    }

    /// The notes of exams since the last call, to be written, with the time at which the exam began.
    pub fn take_exam_notes(&mut self) -> Vec<(u64, Vec<ExamNote>)> {
        let taken = self.exams.iter_mut().map(|it| (it.begun, it.take_notes()));
        taken.filter(|(_, notes)| !notes.is_empty()).collect()
    }

    /// Notes of the exam that began at a time are on disk now. Returns whether the exam begins by that.
    pub fn exam_notes_kept(&mut self, begun: u64, count: usize) -> bool {
        let exam = self.exams.iter_mut().find(|it| it.begun == begun);
        exam.is_some_and(|exam| exam.note_kept(count))
    }

    /// Where the user of a seat is in the exam of which a try is flown there at a time of the desk's clock; otherwise in
    /// the one that is held, or was held last.
    pub fn candidacy(&self, seat: &SeatRecord, now: Duration) -> Option<(&Exam, &Candidate)> {
        let flown = self.exams.iter().find(|it| it.is_flown_by(&seat.user, now));
        let exam = flown.or_else(|| self.exam())?;
        let candidate = exam.candidates.get(&seat.user)?;
        Some((exam, candidate))
    }

    /// Lets the users of seats take part in the exam; those who do already are not changed. Returns whether there is one.
    pub fn seat_candidates(&mut self, seats: &[usize], now: Duration) -> bool {
        let Some(exam) = self.exams.last_mut().filter(|it| !it.is_stopped) else {
            return false;
        };
        let at = exam.at(now);
        for seat in seats.iter().filter_map(|&seat| self.seats.get(seat)) {
            if !exam.candidates.contains_key(&seat.user) {
                let user = seat.user.clone();
                exam.note(at, ExamDeed::Seated { user });
            }
        }
        true
    }

    /// Ends the exam: no try is opened any more. Flights go on, and the desk sees how they end. Returns its plan; `None` without one.
    pub fn stop_exam(&mut self, now: Duration) -> Option<&ExamPlan> {
        let exam = self.exams.last_mut().filter(|it| !it.is_stopped)?;
        let at = exam.at(now);
        exam.note(at, ExamDeed::Stopped);
        Some(&exam.plan)
    }

    /// Goes on with the exams of all trainees; returns whether anything has changed.
    pub fn examine(&mut self, now: Duration) -> bool {
        let mut exams = std::mem::take(&mut self.exams);
        let mut has_changed = false;
        for index in 0..exams.len() {
            let (before, rest) = exams.split_at_mut(index);
            has_changed |= self.examine_in(&mut rest[0], before, now);
        }
        self.exams = exams;
        has_changed
    }

    /// Goes on with one exam. `before` are those of which tries may still be flown.
    fn examine_in(&mut self, exam: &mut Exam, before: &[Exam], now: Duration) -> bool {
        let at = exam.at(now);
        let users: Vec<String> = exam.candidates.keys().cloned().collect();
        let mut has_changed = false;
        for user in users {
            let seat = self.exam_seat(exam, &user);
            self.watch_candidate(exam, &user, seat, at);
            let next = exam.next(CandidateSight {
                user: &user,
                seat: seat.map(|seat| &self.seats[seat]),
                order: self.order_of(exam, &user),
                is_busy: before.iter().any(|it| it.keeps_busy(&user, now)),
                at,
            });
            if let Some(next) = next {
                has_changed = true;
                self.make_exam_move(exam, &user, seat, next, now);
            }
        }
        // Otherwise it would be the exam of the next lesson.
        if exam.ends_itself(at) {
            exam.note(at, ExamDeed::Stopped);
            has_changed = true;
        }
        has_changed
    }

    /// The connected seat of a user: of several, the one that flies a try of the exam. While one is opened or open, otherwise only
    /// the seat that opened it, else the first.
    fn exam_seat(&self, exam: &Exam, user: &str) -> Option<usize> {
        let is_candidate = |it: &(usize, &SeatRecord)| it.1.user == user && it.1.is_here();
        let flies = |it: &(usize, &SeatRecord)| {
            let flight = it.1.report.as_ref().and_then(|it| it.flight.as_ref());
            let flown = flight.and_then(|it| it.exam_try.as_ref());
            flown.is_some_and(|it| it.name.begun == exam.begun)
        };
        let candidate = exam.candidates.get(user);
        let open = candidate.filter(|it| {
            matches!(
                it.stage,
                CandidateStage::Ordered(_) | CandidateStage::Flying { .. }
            )
        });
        let opener = open.and_then(|it| it.seat);
        let mut seats = self.seats.iter().enumerate().filter(is_candidate);
        let first = seats
            .clone()
            .find(|(index, _)| opener.is_none_or(|opener| opener == *index));
        seats.find(flies).or(first).map(|(index, _)| index)
    }

    /// What has become of the order to open a try; that of an earlier opening of the desk is not known.
    fn order_of(&self, exam: &Exam, user: &str) -> OrderState {
        let stage = exam.candidates.get(user).map(|it| it.stage);
        let Some(CandidateStage::Ordered(id)) = stage else {
            return OrderState::Unanswered;
        };
        let mut orders = self.seats.iter().flat_map(SeatRecord::orders);
        let order = orders.find(|it| it.order.id == id);
        order.map_or(OrderState::Unanswered, |it| it.state)
    }

    /// Notes since when a seat has not said that it flies its try.
    fn watch_candidate(&self, exam: &mut Exam, user: &str, seat: Option<usize>, at: u64) {
        let plan = Arc::clone(&exam.plan);
        let Some(candidate) = exam.candidates.get_mut(user) else {
            return;
        };
        let seat = seat.map(|seat| &self.seats[seat]);
        let is_reporting = seat.is_some_and(|seat| seat.report.is_some());
        let is_flown = seat.is_some_and(|seat| {
            let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
            let flown = flight.and_then(|it| it.exam_try.as_ref());
            let mission = plan.missions.get(candidate.mission);
            let due = mission.and_then(|mission| candidate.due(mission));
            flown
                .zip(due)
                .is_some_and(|(flown, due)| flown.name == due.name)
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
            (ExamMove::Note(what), _) => {
                if let (ExamDeed::Opened { .. }, Some(candidate)) =
                    (&what, exam.candidates.get_mut(user))
                {
                    candidate.seat = seat.or(candidate.seat);
                }
                exam.note(at, what);
            }
            (ExamMove::Ask(what), _) => {
                exam.note(at, what);
                let stage = CandidateStage::Asked { note: exam.notes };
                exam.enter(user, stage, at);
            }
            (ExamMove::Open(opened), Some(seat)) => {
                let id = self.order(seat, Deed::Examine(opened), now);
                if let Some(candidate) = exam.candidates.get_mut(user) {
                    candidate.seat = Some(seat);
                }
                exam.enter(user, CandidateStage::Ordered(id), at);
            }
            (ExamMove::AskEnd, Some(seat)) => {
                self.order(seat, Deed::End, now);
                if let Some(candidate) = exam.candidates.get_mut(user) {
                    candidate.end_asked = Some(at);
                }
            }
            (ExamMove::Open(_) | ExamMove::AskEnd, None) => {}
            (ExamMove::Stage(stage), _) => exam.enter(user, stage, at),
        }
    }

    /// Notes the head of a record that a user's seat reports; whether it is noted now, so that the seat is told.
    pub(crate) fn witness(&mut self, seat: usize, head: &TryHead, now: Duration) -> bool {
        let Some(user) = self.seats.get(seat).map(|seat| seat.user.clone()) else {
            return false;
        };
        self.exams.iter_mut().any(|exam| {
            let at = exam.at(now);
            exam.witness(&user, head, at)
        })
    }
}

/// An exam with which this opening of the desk goes on: what happened since its last note, nobody has seen.
fn resumed(mut exam: Exam) -> Exam {
    let at = exam.at(Duration::ZERO);
    if exam.has_begun() && exam.is_watched(at) {
        exam.note(at, ExamDeed::Resumed);
    }
    exam
}
