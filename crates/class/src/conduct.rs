//! What a desk does for the lessons of its seats.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use super::lesson::{FoundPosition, GivenDeed, LessonMove, lesson_in, position_in};
use super::{Desk, LessonPlan, LessonPosition, SeatRecord, StepTarget, Words};

/// How long a desk waits after a seat's position was found in its journal before a step of all seats starts: the
/// other seats connect again within 4 s.
const GATHERING: Duration = Duration::from_secs(10);

/// What an instructor does in a lesson.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LessonDirection {
    /// Let the step start, whatever it waits for.
    Next,
    /// Go to the next step without the orders of this one.
    Skip,
    /// Go back to the step before.
    Back,
    /// End the lesson at the seat.
    Stop,
}

/// Why an instructor's direction is not possible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LessonFault {
    /// The seat has no lesson.
    NoLesson,
    /// The orders of the step are being carried out, or the lesson has ended.
    NotWaiting,
    /// There is no step before.
    First,
}

impl Desk {
    /// Begins a lesson at seats, at its first step.
    pub fn teach(&mut self, plan: &Arc<LessonPlan>, seats: &[usize], now: Duration) {
        for &seat in seats {
            if let Some(record) = self.seats.get_mut(seat) {
                record.lesson = Some(LessonPosition::new(Arc::clone(plan), now));
                record.lesson_found_at = None;
                record.is_lesson_known = true;
            }
        }
    }

    /// Goes on with the lessons of all connected seats; returns whether anything has changed.
    pub fn conduct(&mut self, now: Duration) -> bool {
        let due: Vec<(usize, LessonMove)> = (0..self.seats.len())
            .filter_map(|seat| Some((seat, self.lesson_move(seat, now)?)))
            .collect();
        for &(seat, next) in &due {
            self.make(seat, next, now);
        }
        !due.is_empty()
    }

    fn lesson_move(&self, seat: usize, now: Duration) -> Option<LessonMove> {
        let record = self.seats.get(seat).filter(|it| it.is_here())?;
        let position = record.lesson.as_ref()?;
        position.next(self.are_together(position, now), now)
    }

    /// Whether all connected seats of the lesson are ready for a seat's step, past it, or on a way that does not lead to
    /// it.
    fn are_together(&self, position: &LessonPosition, now: Duration) -> bool {
        let step = position.step_index();
        let visit = position.times_left(step);
        let is_there = |other: &LessonPosition| {
            let is_past = !other.may_come_to(step) || other.times_left(step) > visit;
            is_past || other.step_index() == step && other.is_ready()
        };
        let is_gathering = |it: &SeatRecord| {
            let found = it.lesson_found_at;
            found.is_some_and(|found| now.saturating_sub(found) < GATHERING)
        };
        let mut class = self.class_of(position);
        class.all(|it| !is_gathering(it) && it.lesson.as_ref().is_some_and(is_there))
    }

    /// The connected seats with the same lesson.
    fn class_of(&self, position: &LessonPosition) -> impl Iterator<Item = &SeatRecord> {
        let plan = Arc::clone(position.plan());
        self.seats.iter().filter(move |it| {
            let lesson = it.lesson.as_ref();
            it.is_here() && lesson.is_some_and(|it| it.plan().name == plan.name)
        })
    }

    fn make(&mut self, seat: usize, next: LessonMove, now: Duration) {
        match next {
            LessonMove::Note => self.note_step(seat, now),
            LessonMove::Act => self.act(seat, now),
            LessonMove::Go(target) => self.go(seat, target, now),
            LessonMove::Hold(reason) => {
                if let Some(position) = self.lesson_mut(seat) {
                    position.hold(reason);
                }
            }
        }
    }

    fn lesson_mut(&mut self, seat: usize) -> Option<&mut LessonPosition> {
        self.seats.get_mut(seat)?.lesson.as_mut()
    }

    fn note_step(&mut self, seat: usize, now: Duration) {
        let Some(position) = self.lesson_mut(seat) else {
            return;
        };
        let note = position.note();
        let id = self.order(seat, note, now);
        if let Some(position) = self.lesson_mut(seat) {
            position.noted(id, now);
        }
    }

    /// Gives the next order of a seat's step.
    fn act(&mut self, seat: usize, now: Duration) {
        let Some(position) = self.lesson_mut(seat) else {
            return;
        };
        if !position.is_acting() {
            position.act(Vec::new(), now);
        }
        let Some(deed) = position.next_deed().cloned() else {
            return;
        };
        let id = self.order(seat, deed.clone(), now);
        if let Some(position) = self.lesson_mut(seat) {
            position.has_given(GivenDeed::new(id, &deed), now);
        }
    }

    fn go(&mut self, seat: usize, target: StepTarget, now: Duration) {
        let Some(position) = self.lesson_mut(seat) else {
            return;
        };
        position.go(target, now);
        let end = (target == StepTarget::End).then(|| position.plan().end_note());
        if let Some(end) = end {
            self.order(seat, end, now);
        }
    }

    /// Directs the lesson of a seat for the instructor. A step of all seats starts at all that wait at it. Returns the
    /// seats that go on.
    ///
    /// # Errors
    /// It is not possible.
    pub fn direct(
        &mut self,
        seat: usize,
        direction: LessonDirection,
        now: Duration,
    ) -> Result<Vec<usize>, LessonFault> {
        let position = self.lesson_mut(seat).ok_or(LessonFault::NoLesson)?;
        match direction {
            LessonDirection::Next if !position.can_start() => return Err(LessonFault::NotWaiting),
            LessonDirection::Next => {
                let started = self.with(seat);
                for &seat in &started {
                    self.act(seat, now);
                }
                return Ok(started);
            }
            LessonDirection::Skip => {
                let step = position.step().filter(|_| !position.has_ended());
                let then = step.ok_or(LessonFault::NotWaiting)?.then;
                self.go(seat, then, now);
            }
            LessonDirection::Back if !position.back(now) => return Err(LessonFault::First),
            LessonDirection::Back => {
                let note = position.note();
                self.order(seat, note, now);
            }
            LessonDirection::Stop => {
                let end = position.plan().end_note();
                self.order(seat, end, now);
                if let Some(record) = self.seats.get_mut(seat) {
                    record.lesson = None;
                }
            }
        }
        Ok(vec![seat])
    }

    /// The seat, and if its step is one of all seats, the connected ones that wait at it too.
    fn with(&self, seat: usize) -> Vec<usize> {
        let own = self.seats.get(seat).and_then(|it| it.lesson.as_ref());
        let together = own.filter(|it| it.step().is_some_and(|step| step.together));
        let Some(own) = together else {
            return vec![seat];
        };
        let is_meant = |&other: &usize| {
            let record = &self.seats[other];
            let waits = record.lesson.as_ref().is_some_and(|it| {
                let same = it.plan().name == own.plan().name;
                same && it.step_index() == own.step_index() && it.can_start()
            });
            other == seat || record.is_here() && waits
        };
        (0..self.seats.len()).filter(is_meant).collect()
    }

    /// The names of the lessons that are in the journals of seats, and that the desk does not know.
    pub fn unknown_lessons(&mut self) -> BTreeSet<Words> {
        let mut names = BTreeSet::new();
        for record in self.seats.iter_mut().filter(|it| it.may_resume()) {
            match lesson_in(&record.journal) {
                Some(name) => drop(names.insert(name.clone())),
                None => record.is_lesson_known = true,
            }
        }
        names
    }

    /// Goes on with a lesson at the seats whose journals have it.
    pub fn resume(&mut self, plan: &Arc<LessonPlan>, now: Duration) {
        for seat in 0..self.seats.len() {
            let record = &mut self.seats[seat];
            let is_meant = record.may_resume()
                && lesson_in(&record.journal).is_some_and(|name| *name == plan.name);
            if !is_meant {
                continue;
            }
            record.is_lesson_known = true;
            let found = position_in(&record.journal, plan, now);
            let Some(FoundPosition { position, given }) = found else {
                continue;
            };
            let lesson = record.lesson.insert(position);
            if !given.is_empty() {
                lesson.act(given, now);
            }
            record.lesson_found_at = Some(now);
        }
    }

    /// A lesson in the journals of seats cannot be read: nothing goes on there.
    pub fn give_up_lesson(&mut self, name: &Words) {
        let same = |it: &&mut SeatRecord| lesson_in(&it.journal) == Some(name);
        for record in self.seats.iter_mut().filter(same) {
            record.is_lesson_known = true;
        }
    }
}
