//! The available themes: the embedded ones, and those of the administrator's and the user's folders.

use std::collections::BTreeMap;

use super::{EMBEDDED, Theme, file};
use crate::diagnostic::{Diagnostic, first_shown, nearest};
use crate::text::Text;

/// Themes by name. A theme file replaces the embedded theme of the same name, and may inherit it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Themes {
    own: BTreeMap<String, ThemeFile>,
}

/// A theme file of the administrator or the user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThemeFile {
    /// The path for fault reports.
    pub path: String,
    pub text: String,
}

/// Why a theme is not available.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ThemeError {
    /// No theme has that name.
    #[error("unknown theme `{name}`: choose one of {known}{guess}")]
    Unknown {
        name: String,
        known: String,
        /// A suggestion with the most similar name.
        guess: String,
    },
    /// The theme's file has faults.
    #[error("{}", one_by_one(file, faults))]
    Faulty {
        file: ThemeFile,
        /// Every fault, with its position.
        faults: Vec<Diagnostic>,
    },
}

impl From<&ThemeError> for Text {
    fn from(error: &ThemeError) -> Self {
        match error {
            // The console offers only existing names; only the command line can request others.
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
    /// Adds a theme file; it replaces a file of the same name.
    pub fn add(&mut self, name: String, file: ThemeFile) {
        self.own.insert(name, file);
    }

    /// The available names: the embedded themes, then those of files.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let added = self.own.keys().map(String::as_str);
        let embedded = EMBEDDED.iter().map(|&(name, _)| name);
        embedded.chain(added.filter(|name| !Theme::names().any(|known| known == *name)))
    }

    /// The theme files with faults, each with its faults.
    pub fn faulty(&self) -> impl Iterator<Item = (&ThemeFile, Vec<Diagnostic>)> {
        let files = self.own.iter();
        files.filter_map(|(name, file)| Some((file, self.read(name, &file.text).err()?)))
    }

    /// The theme of that name.
    ///
    /// # Errors
    /// The theme does not exist, or its file has faults.
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

    /// Reads the file of the theme `name`, which may inherit from the available ones.
    ///
    /// # Errors
    /// Every fault of the file, with its position.
    pub fn read(&self, name: &str, source: &str) -> Result<Theme, Vec<Diagnostic>> {
        let lineage = file::Lineage::new(self, name);
        file::read(source, &lineage).map(|styles| Theme {
            name: name.to_owned(),
            styles,
        })
    }

    /// The theme file with this name, if any; not the embedded theme.
    pub(super) fn own(&self, name: &str) -> Option<&ThemeFile> {
        self.own.get(name)
    }
}

/// The faults of a file, one per line.
fn one_by_one(file: &ThemeFile, faults: &[Diagnostic]) -> String {
    let lines = faults
        .iter()
        .map(|fault| fault.one_line(&file.path, &file.text));
    lines.collect::<Vec<_>>().join("\n")
}
