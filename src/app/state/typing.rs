//! What the user is typing and has typed.

use std::collections::VecDeque;
use std::time::Duration;

/// The length of the command line's history.
const HISTORY_KEPT: usize = 200;

/// The user's unfinished and earlier lines.
#[derive(Debug, Clone, Default)]
pub struct Typing {
    /// The vehicle list being typed, `3-9`; empty without one.
    pub(in crate::app) targets: String,
    /// Lines of a macro that wait for an answer.
    pub(in crate::app) macro_lines: VecDeque<String>,
    /// The command history, oldest first.
    pub(in crate::app) history: VecDeque<String>,
    /// When the previous key answered a question that changed the session, by the wall clock.
    pub(in crate::app) answered_at: Option<Duration>,
}

impl Typing {
    /// Starts with the lines of earlier sessions, oldest first.
    pub(in crate::app) fn after(lines: &[String]) -> Self {
        let mut typing = Self::default();
        for line in lines {
            typing.remember(line);
        }
        typing
    }

    /// The vehicle list being typed, `3-9`; empty without one.
    pub fn targets(&self) -> &str {
        &self.targets
    }

    /// Whether lines of a macro wait for an answer.
    pub fn is_in_macro(&self) -> bool {
        !self.macro_lines.is_empty()
    }

    /// The last line given on the command line.
    pub fn last_line(&self) -> Option<&str> {
        self.history.back().map(String::as_str)
    }

    /// Adds a line to the history, without duplicates.
    pub(in crate::app) fn remember(&mut self, line: &str) {
        self.history.retain(|known| known != line);
        self.history.push_back(line.to_owned());
        if self.history.len() > HISTORY_KEPT {
            self.history.pop_front();
        }
    }
}
