//! A lesson plan.

use std::time::Duration;

use crate::{Deed, NotedStep, Words};

/// The steps of a lesson. Whoever makes one checks that every [`StepTarget`] exists.
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
    /// Nothing.
    AtOnce,
    /// The instructor.
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

/// What follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepTarget {
    /// The step with this index.
    Step(usize),
    /// The lesson ends.
    End,
}

impl LessonPlan {
    /// The index of the step with this name.
    pub fn step(&self, id: &Words) -> Option<usize> {
        self.steps.iter().position(|step| step.id == *id)
    }

    /// The note for a seat that comes to a step; without a step, that the lesson ends.
    pub(crate) fn note(&self, step: Option<usize>) -> Deed {
        let step = step.and_then(|step| self.steps.get(step));
        Deed::Step(NotedStep {
            lesson: self.name.clone(),
            step: step.map(|step| step.id.clone()),
            mission: step.and_then(|step| step.mission.clone()),
            when: step.and_then(|step| match &step.start {
                StepStart::When(condition) => Some(condition.clone()),
                StepStart::AtOnce | StepStart::Instructor => None,
            }),
        })
    }
}
