//! Faults of files, as they are printed and noticed.

use std::env;
use std::io::IsTerminal as _;
use std::path::Path;

use super::Failure;
use crate::diagnostic::{self, Diagnostic};
use crate::notice::{sanitised, sanitised_lines};
use crate::store::{Source, StoreError};
use crate::text::Text;

/// The faults of a file.
#[derive(Debug)]
pub(super) enum FileFault {
    /// Faults at places in it.
    Inside(Source, Vec<Diagnostic>),
    /// The whole of it.
    Whole(Text),
}

impl FileFault {
    /// A line for each fault, without the folder: for notices. The first ones stand for too many.
    pub fn texts(&self) -> Vec<Text> {
        match self {
            Self::Inside(source, faults) => {
                let path = Path::new(&source.name);
                let last = path.file_name().unwrap_or(path.as_os_str());
                let name = sanitised(&last.to_string_lossy());
                let (shown, rest) = diagnostic::first_shown(faults);
                let lines = shown.iter().map(|fault| fault.text(&name, &source.text));
                lines.chain(rest).collect()
            }
            Self::Whole(text) => vec![text.clone()],
        }
    }

    /// Each fault with the lines around it. The first ones stand for too many.
    pub fn explained(&self) -> String {
        match self {
            Self::Inside(source, faults) => {
                let colour = std::io::stderr().is_terminal() && env::var_os("NO_COLOR").is_none();
                // The renderer writes out the control characters of the file's text, and not those of its name.
                let name = sanitised(&source.name);
                let (shown, rest) = diagnostic::first_shown(faults);
                let rendered = shown
                    .iter()
                    .map(|fault| fault.render(&name, &source.text, colour));
                let parts: Vec<String> =
                    rendered.chain(rest.map(|text| text.to_string())).collect();
                parts.join("\n\n")
            }
            Self::Whole(text) => sanitised_lines(&format!("sortie: {text}")),
        }
    }

    /// The failure of a command that cannot do without the file.
    pub fn failure(&self) -> Failure {
        Failure::Shown(self.explained())
    }
}

impl From<&StoreError> for FileFault {
    fn from(error: &StoreError) -> Self {
        Self::Whole(error.into())
    }
}
