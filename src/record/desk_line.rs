//! Orders of an instructor's desk in a journal.

use serde::{Deserialize, Serialize};

use crate::class::{Deed, Outcome};
use crate::class_text::{deed_text, outcome_text};
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
}

impl DeskRecord {
    /// The order in words.
    pub fn text(&self) -> Text {
        text!(
            "class-desk-line",
            instructor = &self.by,
            deed = deed_text(&self.deed),
            outcome = outcome_text(self.outcome)
        )
    }
}
