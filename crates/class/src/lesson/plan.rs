//! Lesson plans: their steps, and what each step waits for, orders and leads to.

use std::collections::BTreeSet;
use std::time::Duration;

use crate::{Deed, NotedStep, Words};

/// The steps of a lesson. The maker of a plan checks that every [`StepTarget`] exists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LessonPlan {
    /// The name by which the lesson is started, and found again in journals.
    pub name: Words,
    /// The steps; a seat begins with the first one.
    pub steps: Vec<LessonStep>,
}

/// A step of a lesson.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LessonStep {
    /// Its name in the plan.
    pub id: Words,
    /// The mission that the step is about: the last one that a step before it lets fly.
    pub mission: Option<Words>,
    /// What the step waits for.
    pub start: StepStart,
    /// Whether it waits until all seats of the lesson are ready for it.
    pub together: bool,
    /// What follows if the step does not start in time.
    pub limit: Option<StepLimit>,
    /// The orders of the step, in their order.
    pub deeds: Vec<Deed>,
    /// What follows after its orders.
    pub then: StepTarget,
}

/// What a step waits for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StepStart {
    /// It waits for nothing.
    AtOnce,
    /// It waits for a key of the instructor.
    Instructor,
    /// A condition in the language of mission files, or a [`FlightMoment`], which the seat watches.
    When(Words),
}

/// A moment of a flight that a step can wait for, besides the conditions of missions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlightMoment {
    /// The time of the mission has begun to pass.
    Started,
    /// The mission is over.
    Over,
    /// The mission is over, and was passed.
    Passed,
}

impl FlightMoment {
    /// All moments with their names.
    pub const ALL: [(&'static str, Self); 3] = [
        ("started", Self::Started),
        ("over", Self::Over),
        ("passed", Self::Passed),
    ];

    /// The moment with this name.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = Self::ALL.into_iter();
        all.find(|(known, _)| *known == name)
            .map(|(_, moment)| moment)
    }
}

/// A time limit for a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepLimit {
    /// The time that a seat may wait for the start of the step.
    pub within: Duration,
    /// What follows after that, instead of the step's orders.
    pub otherwise: StepTarget,
}

/// What follows a step, or its time limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepTarget {
    /// The step with this index.
    Step(usize),
    /// The lesson ends for the seat.
    End,
}

impl LessonPlan {
    /// The index of the step with this name.
    pub fn step(&self, id: &Words) -> Option<usize> {
        self.steps.iter().position(|step| step.id == *id)
    }

    /// The note for a seat whose lesson ends.
    pub(crate) fn end_note(&self) -> Deed {
        Deed::Step(NotedStep {
            lesson: self.name.clone(),
            step: None,
            mission: None,
            when: None,
            is_held: false,
            before: 0,
        })
    }
}

impl LessonStep {
    /// What may follow: after its orders, and after its time limit.
    pub fn targets(&self) -> impl Iterator<Item = StepTarget> {
        let otherwise = self.limit.map(|limit| limit.otherwise);
        [self.then].into_iter().chain(otherwise)
    }

    /// The steps to which a step leads, with itself.
    pub fn reached(steps: &[Self], from: usize) -> BTreeSet<usize> {
        let mut reached = BTreeSet::new();
        let mut left = vec![from];
        while let Some(at) = left.pop() {
            let Some(step) = steps.get(at) else {
                continue;
            };
            if reached.insert(at) {
                left.extend(step.targets().filter_map(StepTarget::index));
            }
        }
        reached
    }
}

impl StepTarget {
    /// The index of the step that follows; `None` if the lesson ends.
    pub fn index(self) -> Option<usize> {
        match self {
            Self::Step(index) => Some(index),
            Self::End => None,
        }
    }
}
