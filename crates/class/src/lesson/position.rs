//! Where a seat is in a lesson, and what follows there.

use std::sync::Arc;
use std::time::Duration;

use super::plan::{LessonPlan, LessonStep, StepStart, StepTarget};
use crate::order::ANSWERED_WITHIN;
use crate::{Deed, NotedStep, OrderId, Outcome, Refusal, Words};

/// The number of steps that are remembered for the way back.
pub(super) const REMEMBERED: usize = 200;
/// A seat that comes to more than so many steps within [`LAP`] runs in circles.
const MOST_STEPS: u32 = 20;
const LAP: Duration = Duration::from_secs(10);

/// Where a seat is in a lesson.
#[derive(Debug, Clone, PartialEq)]
pub struct LessonPosition {
    pub(super) plan: Arc<LessonPlan>,
    step: usize,
    /// When the seat came to the step.
    since: Duration,
    /// The steps before, oldest first.
    path: Vec<usize>,
    /// The number of steps before those in `path`.
    forgotten: u32,
    stage: StepStage,
    /// The steps since the beginning of the present [`LAP`].
    lap: (Duration, u32),
}

/// How far a step is.
#[derive(Debug, Clone, PartialEq)]
enum StepStage {
    /// It waits for its start.
    Waits(GivenNote),
    /// It waits for the instructor, whatever the plan says.
    Held(HoldReason),
    /// Its orders are given, each after the outcome of the one before. `at` is when the last one was given. With
    /// `leads_on`, none of them stops the lesson.
    Acts {
        at: Duration,
        given: Vec<GivenDeed>,
        leads_on: bool,
    },
    /// The lesson has ended.
    Ended,
}

/// The way of a seat to its step.
#[derive(Debug, Default)]
pub(super) struct FoundWay {
    /// The last steps, oldest first.
    pub path: Vec<usize>,
    /// The number of steps before those.
    pub forgotten: u32,
}

/// The note at the seat that it is at the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GivenNote {
    /// `None` before it is given.
    pub id: Option<OrderId>,
    pub at: Duration,
    pub outcome: Option<Outcome>,
}

/// An order of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GivenDeed {
    pub id: OrderId,
    /// Whether the following steps need its effect.
    pub is_needed: bool,
    pub outcome: Option<Outcome>,
}

/// Why a step waits for the instructor, although the plan does not say so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HoldReason {
    /// The instructor has gone back to it.
    Back,
    /// The mission of the step was not begun at the seat.
    NotFlown,
    /// The seat cannot watch the condition.
    Condition,
    /// The lesson runs in circles.
    Circles,
}

/// What a seat waits for in a lesson.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LessonWait<'a> {
    /// The answer of the seat.
    Seat,
    /// For a key of the instructor, and why if the lesson stopped by itself.
    Instructor(Option<HoldReason>),
    /// For a condition of its own flight.
    Condition(&'a Words),
    /// For the other seats of the lesson.
    Others,
    /// Nothing: the lesson has ended.
    Ended,
}

/// What follows at a seat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LessonMove {
    /// Note the step at the seat.
    Note,
    /// Give the next order of the step.
    Act,
    /// Go to another step, or end.
    Go(StepTarget),
    /// Wait for the instructor.
    Hold(HoldReason),
}

impl LessonPosition {
    /// At the first step of a lesson.
    pub(crate) fn new(plan: Arc<LessonPlan>, now: Duration) -> Self {
        let stage = if plan.steps.is_empty() {
            StepStage::Ended
        } else {
            StepStage::Waits(GivenNote::none(now))
        };
        Self {
            plan,
            step: 0,
            since: now,
            path: Vec::new(),
            forgotten: 0,
            stage,
            lap: (now, 0),
        }
    }

    /// At a step after those of a way, where the note is given already.
    pub(super) fn found(
        plan: Arc<LessonPlan>,
        step: usize,
        way: FoundWay,
        note: GivenNote,
        now: Duration,
    ) -> Self {
        Self {
            step,
            path: way.path,
            forgotten: way.forgotten,
            stage: StepStage::Waits(note),
            ..Self::new(plan, now)
        }
    }

    /// The plan of the lesson.
    pub fn plan(&self) -> &Arc<LessonPlan> {
        &self.plan
    }

    /// The index of the step.
    pub fn step_index(&self) -> usize {
        self.step
    }

    /// The step at which the seat is; `None` once the lesson has ended.
    pub fn step(&self) -> Option<&LessonStep> {
        self.plan.steps.get(self.step)
    }

    /// Whether the lesson has ended at this seat.
    pub fn has_ended(&self) -> bool {
        self.stage == StepStage::Ended
    }

    /// For how long the seat has been at the step.
    pub fn waited(&self, now: Duration) -> Duration {
        now.saturating_sub(self.since)
    }

    /// What the seat waits for.
    pub fn wait(&self) -> LessonWait<'_> {
        match &self.stage {
            StepStage::Ended => LessonWait::Ended,
            StepStage::Held(reason) => LessonWait::Instructor(Some(*reason)),
            StepStage::Acts { .. } => LessonWait::Seat,
            StepStage::Waits(note) if note.outcome.is_none() => LessonWait::Seat,
            StepStage::Waits(note) => match self.step().map(|step| &step.start) {
                Some(StepStart::Instructor) => LessonWait::Instructor(None),
                Some(StepStart::When(condition)) if !note.has_ended() => {
                    LessonWait::Condition(condition)
                }
                Some(StepStart::AtOnce | StepStart::When(_)) | None => LessonWait::Others,
            },
        }
    }

    /// Why the step waits for the instructor, although the plan does not say so.
    pub fn held(&self) -> Option<HoldReason> {
        match &self.stage {
            StepStage::Held(reason) => Some(*reason),
            StepStage::Waits(_) | StepStage::Acts { .. } | StepStage::Ended => None,
        }
    }

    /// Whether the step would start now if it did not wait for other seats.
    pub(crate) fn is_ready(&self) -> bool {
        match &self.stage {
            StepStage::Waits(note) => {
                let waits = self.step().map(|step| &step.start);
                note.has_ended() && waits != Some(&StepStart::Instructor)
            }
            StepStage::Held(_) | StepStage::Acts { .. } | StepStage::Ended => false,
        }
    }

    /// Whether the instructor can let the step start.
    pub(crate) fn can_start(&self) -> bool {
        matches!(self.stage, StepStage::Waits(_) | StepStage::Held(_))
    }

    /// Whether the seat is at a step, or may still come to it.
    pub(crate) fn may_come_to(&self, step: usize) -> bool {
        let steps = &self.plan.steps;
        !self.has_ended() && LessonStep::reached(steps, self.step).contains(&step)
    }

    /// How often the seat has left a step.
    pub(crate) fn times_left(&self, step: usize) -> usize {
        self.path.iter().filter(|before| **before == step).count()
    }

    /// What follows now. `together` is whether all other seats of the lesson are ready for the step, or past it.
    pub(crate) fn next(&self, together: bool, now: Duration) -> Option<LessonMove> {
        let step = self.step()?;
        match &self.stage {
            StepStage::Waits(note) => self.after_note(step, *note, together, now),
            StepStage::Acts {
                at,
                given,
                leads_on,
            } => {
                let last = given.last();
                let is_open = last.is_some_and(|one| one.outcome.is_none());
                if is_open && now.saturating_sub(*at) < ANSWERED_WITHIN {
                    return None;
                }
                Some(if !leads_on && last.is_some_and(GivenDeed::is_missing) {
                    LessonMove::Hold(HoldReason::NotFlown)
                } else if given.len() < step.deeds.len() {
                    LessonMove::Act
                } else {
                    LessonMove::Go(step.then)
                })
            }
            StepStage::Held(_) | StepStage::Ended => None,
        }
    }

    fn after_note(
        &self,
        step: &LessonStep,
        note: GivenNote,
        together: bool,
        now: Duration,
    ) -> Option<LessonMove> {
        match note.outcome {
            None if note.id.is_none() || now.saturating_sub(note.at) >= ANSWERED_WITHIN => {
                return Some(LessonMove::Note);
            }
            None => return None,
            // The seat does not watch the condition any more.
            Some(Outcome::Disarmed) => return Some(LessonMove::Note),
            // The flight is over, so that the condition cannot hold any more.
            Some(Outcome::Refused(Refusal::NotFlying)) => {
                let otherwise = step.limit.map(|limit| limit.otherwise);
                return Some(LessonMove::Go(otherwise.unwrap_or(step.then)));
            }
            Some(Outcome::Refused(_)) => return Some(LessonMove::Hold(HoldReason::Condition)),
            Some(_) => {}
        }
        if self.is_ready() && (together || !step.together) {
            return Some(LessonMove::Act);
        }
        // A seat that is ready is not late if it waits for others.
        let limit = step.limit.filter(|_| !self.is_ready());
        let limit = limit.filter(|it| self.waited(now) >= it.within)?;
        Some(LessonMove::Go(limit.otherwise))
    }

    /// The note for a seat that comes to the step, or is back at it.
    pub(crate) fn note(&self) -> Deed {
        let step = self.step();
        let is_held = self.held() == Some(HoldReason::Back);
        let when = step
            .filter(|_| !is_held)
            .and_then(|step| match &step.start {
                StepStart::When(condition) => Some(condition.clone()),
                StepStart::AtOnce | StepStart::Instructor => None,
            });
        Deed::Step(NotedStep {
            lesson: self.plan.name.clone(),
            step: step.map(|step| step.id.clone()),
            mission: step.and_then(|step| step.mission.clone()),
            when,
            is_held,
            before: self.forgotten.saturating_add(self.path.len() as u32),
        })
    }

    /// The note of the step was given to the seat.
    pub(crate) fn noted(&mut self, id: OrderId, now: Duration) {
        self.stage = StepStage::Waits(GivenNote {
            id: Some(id),
            at: now,
            outcome: None,
        });
    }

    /// The orders of the step begin, after those that were given before. Once the lesson has stopped at them, they are
    /// not waited for again: the key of the instructor always leads on.
    pub(crate) fn act(&mut self, given: Vec<GivenDeed>, now: Duration) {
        let leads_on = self.held() == Some(HoldReason::NotFlown);
        let at = now;
        self.stage = StepStage::Acts {
            at,
            given,
            leads_on,
        };
    }

    /// The next order of the step.
    pub(crate) fn next_deed(&self) -> Option<&Deed> {
        let given = match &self.stage {
            StepStage::Acts { given, .. } => given.len(),
            StepStage::Waits(_) | StepStage::Held(_) | StepStage::Ended => 0,
        };
        self.step()?.deeds.get(given)
    }

    /// The next order of the step was given to the seat.
    pub(crate) fn has_given(&mut self, deed: GivenDeed, now: Duration) {
        if let StepStage::Acts { at, given, .. } = &mut self.stage {
            *at = now;
            given.push(deed);
        }
    }

    /// Whether the orders of the step are being given.
    pub(crate) fn is_acting(&self) -> bool {
        matches!(self.stage, StepStage::Acts { .. })
    }

    /// The step waits for the instructor.
    pub(crate) fn hold(&mut self, reason: HoldReason) {
        self.stage = StepStage::Held(reason);
    }

    /// Goes to another step.
    pub(crate) fn go(&mut self, target: StepTarget, now: Duration) {
        match target {
            StepTarget::End => self.stage = StepStage::Ended,
            StepTarget::Step(step) => {
                if self.path.len() == REMEMBERED {
                    self.path.remove(0);
                    self.forgotten = self.forgotten.saturating_add(1);
                }
                self.path.push(self.step);
                self.come_to(step, now);
            }
        }
    }

    fn come_to(&mut self, step: usize, now: Duration) {
        self.step = step;
        self.since = now;
        self.stage = StepStage::Waits(GivenNote::none(now));
        let (began, count) = self.lap;
        self.lap = if now.saturating_sub(began) < LAP {
            (began, count + 1)
        } else {
            (now, 1)
        };
        if self.lap.1 > MOST_STEPS {
            self.lap = (now, 0);
            self.hold(HoldReason::Circles);
        }
    }

    /// Goes back to the step before, which waits for the instructor; whether there is one.
    pub(crate) fn back(&mut self, now: Duration) -> bool {
        // At its end, the lesson is still at its last step.
        let before = if self.has_ended() {
            Some(self.step)
        } else {
            self.path.pop()
        };
        if let Some(step) = before {
            self.step = step;
            self.since = now;
            self.hold(HoldReason::Back);
        }
        before.is_some()
    }

    /// The seat has a new run of the console, which knows nothing of the lesson.
    pub(crate) fn forget_note(&mut self, now: Duration) {
        if let StepStage::Waits(note) = &mut self.stage {
            *note = GivenNote::none(now);
        }
    }

    /// Takes in the outcome of an order.
    pub(crate) fn hear(&mut self, id: OrderId, outcome: Outcome) {
        match &mut self.stage {
            StepStage::Waits(note) if note.id == Some(id) => note.outcome = Some(outcome),
            StepStage::Acts { given, .. } => {
                let known = given.iter_mut().filter(|one| one.id == id);
                known.for_each(|one| one.outcome = Some(outcome));
            }
            StepStage::Waits(_) | StepStage::Held(_) | StepStage::Ended => {}
        }
    }
}

impl GivenNote {
    fn none(now: Duration) -> Self {
        Self {
            id: None,
            at: now,
            outcome: None,
        }
    }

    /// Whether nothing more follows at the seat: there is no condition, or it holds.
    fn has_ended(self) -> bool {
        matches!(self.outcome, Some(Outcome::Done | Outcome::NoEffect))
    }
}

impl GivenDeed {
    pub fn new(id: OrderId, deed: &Deed) -> Self {
        Self {
            id,
            // What comes after it is about that flight.
            is_needed: matches!(deed, Deed::Fly { .. } | Deed::Start),
            outcome: None,
        }
    }

    fn is_missing(&self) -> bool {
        self.is_needed && self.outcome != Some(Outcome::Done)
    }
}
