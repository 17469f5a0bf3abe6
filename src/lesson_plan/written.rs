//! A lesson plan as it is written.

use serde::Deserialize;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenLesson {
    pub schema: Spanned<i64>,
    pub title: Spanned<String>,
    pub title_uk: Option<Spanned<String>>,
    pub about: Spanned<String>,
    pub about_uk: Option<Spanned<String>>,
    pub steps: Spanned<Vec<WrittenStep>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenStep {
    /// Its name in the plan.
    pub id: Spanned<String>,
    /// What the instructor reads: what to watch for, what to say.
    pub text: Spanned<String>,
    pub text_uk: Option<Spanned<String>>,
    /// What the step waits for; nothing without it.
    pub when: Option<Spanned<String>>,
    /// Whether the step waits for all seats.
    #[serde(default)]
    pub together: bool,
    /// For how many seconds a seat waits.
    pub within: Option<Spanned<u32>>,
    /// The step that follows after that time.
    pub otherwise: Option<Spanned<String>>,
    /// What the trainee reads when the step starts.
    pub message: Option<Spanned<String>>,
    pub message_uk: Option<Spanned<String>>,
    /// The orders of the step.
    #[serde(default, rename = "do")]
    pub orders: Vec<Spanned<String>>,
    /// The step that follows; the next one in the file without it.
    pub then: Option<Spanned<String>>,
}
