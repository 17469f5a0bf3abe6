//! A guided lesson: one step at a time, shown until it is done.
//!
//! The current step is the first one, in file order, whose `when` holds and whose `until` does not. A step that is done
//! in another way is therefore skipped, and one that is undone (a drone that disarms itself) returns.

use super::event::engine::Engine;
use super::event::expression::Expression;
use super::event::scope::Sight;
use super::weather::Weather;
use crate::text::Text;

/// The placeholder for a step's key in its text.
pub const STEP_KEY: &str = "{key}";

/// One step of a lesson, with the condition that completes it.
#[derive(Debug, Clone, PartialEq)]
pub struct LessonStep {
    /// The condition under which it applies; `None` for always.
    pub(crate) when: Option<Expression>,
    /// Its goal; `None` shows it as long as `when` holds.
    pub(crate) until: Option<Expression>,
    /// The instruction; [`STEP_KEY`] is replaced by the key.
    pub text: Text,
    /// The action or verb whose key is shown.
    pub key: Option<String>,
}

/// The index of the current step; `None` once all are done.
pub(super) fn step_now(
    lesson: &[LessonStep],
    engine: &Engine,
    weather: &Weather,
    sight: &Sight<'_>,
) -> Option<usize> {
    if lesson.is_empty() {
        return None;
    }
    let scope = engine.scope(weather, sight);
    let holds = |asked: &Option<Expression>| asked.as_ref().map(|it| it.holds(&scope));
    lesson
        .iter()
        .position(|step| holds(&step.when).unwrap_or(true) && !holds(&step.until).unwrap_or(false))
}
