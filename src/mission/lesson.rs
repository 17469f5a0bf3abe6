//! A guided lesson: one step at a time, shown while what it asks for is not so yet.
//!
//! The step that is shown is the first one, in the order of the file, whose `when` holds and whose `until` does not. So a
//! step that was reached in another way is skipped, and one that is undone (a drone that disarms itself) comes back.

use super::event::engine::Engine;
use super::event::expression::Expression;
use super::event::scope::Sight;
use super::weather::Weather;
use crate::text::Text;

/// What stands for the key of a step in its text.
pub const STEP_KEY: &str = "{key}";

/// One thing to do, and how it is known to be done.
#[derive(Debug, Clone, PartialEq)]
pub struct LessonStep {
    /// What it is made for; always, without it.
    pub(crate) when: Option<Expression>,
    /// What it leads to; without it, it is shown as long as `when` holds.
    pub(crate) until: Option<Expression>,
    /// What to do; [`STEP_KEY`] stands for the key.
    pub text: Text,
    /// The name of the action, or the verb, whose key is shown.
    pub key: Option<String>,
}

/// The step that is to be shown, by its place; `None` once nothing is left to do.
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
