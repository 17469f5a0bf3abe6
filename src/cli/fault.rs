//! Faults of files, as commands print them and the console shows them.

use std::env;
use std::io::IsTerminal as _;
use std::path::PathBuf;

use super::Failure;
use crate::diagnostic::{self, Diagnostic};
use crate::notice::{sanitised, sanitised_lines};
use crate::store::{Source, StoreError};
use crate::text::{Locale, Text};

/// The faults of a file.
#[derive(Debug)]
pub(super) enum FileFault {
    /// Faults at positions in the file.
    Inside(Source, Vec<Diagnostic>),
    /// A fault of the file as a whole.
    Whole(Text),
    /// A folder that this user has no permission to read.
    Closed { folder: PathBuf, text: Text },
}

impl FileFault {
    /// The fault of a folder that cannot be read.
    pub fn closed(error: StoreError) -> Self {
        let text = Text::from(&error);
        match error {
            StoreError::Unreadable { path: folder, .. } => Self::Closed { folder, text },
            _ => Self::Whole(text),
        }
    }

    /// A line for each fault, for notices; only the first few if there are many.
    pub fn texts(&self) -> Vec<Text> {
        match self {
            Self::Inside(source, faults) => {
                let name = sanitised(&source.name);
                let (shown, rest) = diagnostic::first_shown(faults);
                let lines = shown.iter().map(|fault| fault.text(&name, &source.text));
                lines.chain(rest).collect()
            }
            Self::Whole(text) | Self::Closed { text, .. } => vec![text.clone()],
        }
    }

    /// Each fault with the lines around it; only the first few if there are many.
    pub fn explained(&self, locale: &Locale) -> String {
        match self {
            Self::Inside(source, faults) => {
                let colour = std::io::stderr().is_terminal() && env::var_os("NO_COLOR").is_none();
                // The renderer escapes control characters in the file's text, but not in its name.
                let name = sanitised(&source.name);
                let (shown, rest) = diagnostic::first_shown(faults);
                let rendered = shown
                    .iter()
                    .map(|fault| fault.render(&name, &source.text, colour, locale));
                let parts: Vec<String> = rendered
                    .chain(rest.map(|text| locale.text(&text)))
                    .collect();
                parts.join("\n\n")
            }
            Self::Whole(text) | Self::Closed { text, .. } => {
                sanitised_lines(&format!("sortie: {}", locale.text(text)))
            }
        }
    }

    /// The failure of a command that needs the file.
    pub fn failure(self) -> Failure {
        Failure::Faulty(self)
    }
}

impl From<&StoreError> for FileFault {
    fn from(error: &StoreError) -> Self {
        Self::Whole(error.into())
    }
}
