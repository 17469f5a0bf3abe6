//! Why commands fail, in the language of the reader.

use std::io;

use super::fault::FileFault;
use crate::store::StoreError;
use crate::text::{Locale, Text};

/// Why a command failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The requested action failed; exit code 1.
    Failed(anyhow::Error),
    /// Wrong usage or an invalid file; exit code 2. The text may have several lines.
    Invalid(String),
    /// An invalid file, shown with the lines of its faults, in colour if the terminal supports it;
    /// exit code 2. Control characters of the file are escaped.
    Shown(String),
    /// Wrong usage or an invalid file, in the reader's language; exit code 2. One line for each text.
    Wrong(Vec<Text>),
    /// The faults of a file that a command needs, in the reader's language; exit code 2.
    Faulty(FileFault),
}

impl Failure {
    /// The failure with its texts in a language.
    pub fn said_in(self, locale: &Locale) -> Self {
        match self {
            Self::Wrong(texts) => {
                let lines = texts
                    .iter()
                    .map(|text| format!("sortie: {}", locale.text(text)));
                Self::Invalid(lines.collect::<Vec<_>>().join("\n"))
            }
            Self::Faulty(fault) => Self::Shown(fault.explained(locale)),
            Self::Failed(error) => match error.downcast_ref::<StoreError>() {
                Some(fault) if !is_closed_pipe(&error) => {
                    Self::Failed(anyhow::anyhow!(locale.text(&Text::from(fault))))
                }
                _ => Self::Failed(error),
            },
            Self::Invalid(_) | Self::Shown(_) => self,
        }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Whether an error means that the reader of the output needs no more of it.
pub(super) fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let error = match error.downcast_ref() {
        Some(StoreError::Unwritable { error, .. }) => Some(error),
        _ => error.downcast_ref::<io::Error>(),
    };
    error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
