//! The themes on offer: the embedded ones, and those of the administrator's and the user's folders.

use std::collections::BTreeMap;

use super::{EMBEDDED, Theme, file};
use crate::diagnostic::{Diagnostic, first_shown, nearest};
use crate::text::Text;

/// Themes by name. One of a file stands before the embedded one of the same name, and may inherit it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Themes {
    own: BTreeMap<String, ThemeFile>,
}

/// A theme file of the administrator's or the user's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThemeFile {
    /// Under which faults in it are reported.
    pub path: String,
    pub text: String,
}

/// A theme that could not be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ThemeError {
    /// Nothing is called so.
    #[error("unknown theme `{name}`: choose one of {known}{guess}")]
    Unknown {
        /// What was asked for.
        name: String,
        known: String,
        /// The name that may have been meant, with the words around it.
        guess: String,
    },
    /// Its file is wrong.
    #[error("{}", one_by_one(file, faults))]
    Faulty {
        file: ThemeFile,
        /// Every fault, with its place.
        faults: Vec<Diagnostic>,
    },
}

impl From<&ThemeError> for Text {
    fn from(error: &ThemeError) -> Self {
        match error {
            // The console offers names that there are; only a command line can ask for others.
            ThemeError::Unknown { .. } => Self::verbatim(error.to_string()),
            ThemeError::Faulty { file, faults } => {
                let (shown, rest) = first_shown(faults);
                let lines = shown.iter().map(|it| it.text(&file.path, &file.text));
                Self::joined("\n", lines.chain(rest).collect())
            }
        }
    }
}

impl Themes {
    /// Adds a theme of a file; it takes the place of one of the same name.
    pub fn add(&mut self, name: String, file: ThemeFile) {
        self.own.insert(name, file);
    }

    /// The names on offer: the embedded themes, then those of files.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let added = self.own.keys().map(String::as_str);
        let embedded = EMBEDDED.iter().map(|&(name, _)| name);
        embedded.chain(added.filter(|name| !Theme::names().any(|known| known == *name)))
    }

    /// The theme of that name.
    ///
    /// # Errors
    /// There is none, or its file is wrong.
    pub fn named(&self, name: &str) -> Result<Theme, ThemeError> {
        if let Some(file) = self.own.get(name) {
            return self
                .read(name, &file.text)
                .map_err(|faults| ThemeError::Faulty {
                    file: file.clone(),
                    faults,
                });
        }
        Theme::named(name).ok_or_else(|| ThemeError::Unknown {
            name: name.to_owned(),
            known: self.names().collect::<Vec<_>>().join(", "),
            guess: nearest(name, self.names())
                .map_or(String::new(), |guess| format!("; did you mean `{guess}`?")),
        })
    }

    /// Reads the file of the theme `name`, which inherits from those on offer.
    ///
    /// # Errors
    /// Every fault of the file, each at its place.
    pub fn read(&self, name: &str, source: &str) -> Result<Theme, Vec<Diagnostic>> {
        let lineage = file::Lineage::new(self, name);
        file::read(source, &lineage).map(|styles| Theme {
            name: name.to_owned(),
            styles,
        })
    }

    /// The file of that name.
    pub(super) fn own(&self, name: &str) -> Option<&ThemeFile> {
        self.own.get(name)
    }
}

/// The faults of a file, a line each.
fn one_by_one(file: &ThemeFile, faults: &[Diagnostic]) -> String {
    let lines = faults
        .iter()
        .map(|fault| fault.one_line(&file.path, &file.text));
    lines.collect::<Vec<_>>().join("\n")
}
