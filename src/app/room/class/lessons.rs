//! The lessons that the desk knows.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::class::LessonPlan;
use crate::lesson_plan::{Lesson, LessonList};

/// The lessons that the desk knows.
#[derive(Debug, Clone, Default)]
pub struct Lessons {
    /// Those that can be read; `None` until they are.
    pub(in crate::app) listed: Option<LessonList>,
    /// Those that have begun.
    pub(in crate::app) begun: Vec<Arc<Lesson>>,
    /// The names of those that journals have, and that were asked for.
    pub(in crate::app) asked: BTreeSet<String>,
}

impl Lessons {
    /// Those that can be read; `None` until they are.
    pub fn listed(&self) -> Option<&LessonList> {
        self.listed.as_ref()
    }

    /// The texts of a plan that a seat is in.
    pub fn of(&self, plan: &Arc<LessonPlan>) -> Option<&Lesson> {
        let mut begun = self.begun.iter();
        begun
            .find(|it| Arc::ptr_eq(&it.plan, plan))
            .map(Arc::as_ref)
    }
}
