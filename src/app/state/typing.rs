//! The user's unfinished input, and earlier lines.

use std::collections::VecDeque;
use std::time::Duration;

use crate::language::Named;
use crate::plan::FileFormat;
use crate::text::Text;

const HISTORY_KEPT: usize = 200;

/// The user's unfinished and earlier lines.
#[derive(Debug, Clone, Default)]
pub struct Typing {
    /// The vehicle list being typed, `3-9`; empty without one.
    pub(in crate::app) targets: String,
    /// Lines of a macro that wait until a question is answered.
    pub(in crate::app) macro_lines: VecDeque<String>,
    /// The command history, oldest first.
    pub(in crate::app) history: VecDeque<String>,
    /// The folder whose files the command line offers as completions; `None` while none are needed.
    pub(in crate::app) folder: Option<Folder>,
    /// When the previous key answered a question that changed the session, by the wall clock.
    pub(in crate::app) answered_at: Option<Duration>,
}

/// A folder as the user typed it, up to the last `/`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::app) struct Folder {
    pub path: String,
    /// The folder's files and subfolders; `None` until they are known.
    pub names: Option<Vec<String>>,
    /// Whether the names have been requested from the shell.
    pub is_asked: bool,
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

    /// The last line given on the command line, if there is one.
    pub fn last_line(&self) -> Option<&str> {
        self.history.back().map(String::as_str)
    }

    /// The plan files and the subfolders of the folder that is being typed.
    pub(in crate::app) fn plan_files(&self) -> Vec<Named> {
        let Some(folder) = &self.folder else {
            return Vec::new();
        };
        let names = folder.names.iter().flatten();
        let offered = names.filter(|name| name.ends_with('/') || is_plan_file(name));
        offered
            .map(|name| Named {
                name: format!("{}{name}", folder.path),
                meaning: Text::default(),
            })
            .collect()
    }

    /// Adds a line to the history, and removes earlier copies of it.
    pub(in crate::app) fn remember(&mut self, line: &str) {
        self.history.retain(|known| known != line);
        self.history.push_back(line.to_owned());
        if self.history.len() > HISTORY_KEPT {
            self.history.pop_front();
        }
    }
}

/// Whether a file may hold a plan, judged by its extension.
fn is_plan_file(name: &str) -> bool {
    let Some((_, ending)) = name.rsplit_once('.') else {
        return false;
    };
    // Compressed KML can only be read, so it is not a format to write.
    FileFormat::of_ending(ending).is_some() || ending.eq_ignore_ascii_case("kmz")
}
