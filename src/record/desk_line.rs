//! Orders of an instructor's desk in a journal.

use serde::{Deserialize, Serialize};

use crate::class::{Deed, Outcome, Words};
use crate::class_text::{deed_text, done_text, ended_text};
use crate::text;
use crate::text::Text;

/// An order of a desk that has ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct DeskRecord {
    /// The user name of the instructor.
    pub by: String,
    /// What was asked for.
    pub deed: Deed,
    /// How the order ended at the seat.
    pub outcome: Outcome,
    /// More about the outcome.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<Words>,
}

impl DeskRecord {
    /// Whether it changed who flies, or what was flown before.
    pub fn changes_flight(&self) -> bool {
        let changes = matches!(
            self.deed,
            Deed::TakeOver { .. } | Deed::HandBack { .. } | Deed::Recall { .. }
        );
        changes && self.outcome == Outcome::Done
    }

    /// The order in words.
    pub fn text(&self) -> Text {
        let done = (self.outcome == Outcome::Done).then(|| done_text(&self.by, &self.deed));
        if let Some(told) = done.flatten() {
            return told;
        }
        text!(
            "class-desk-line",
            instructor = &self.by,
            deed = deed_text(&self.deed),
            outcome = ended_text(self.outcome, self.why.as_ref())
        )
    }
}
