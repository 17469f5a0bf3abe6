//! Why profiles cannot be had.

use std::io;
use std::path::{Path, PathBuf};

use crate::campaign::PurchaseRefusal;
use crate::text;
use crate::text::Text;

/// Why profiles cannot be had.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.text())]
pub enum ProfileError {
    /// The folder or the file cannot be read or written.
    Unusable { path: PathBuf, error: io::Error },
    /// A newer version of the program made it.
    Newer {
        path: PathBuf,
        /// The version of its tables.
        found: i32,
        /// The newest version that this program knows.
        known: i32,
    },
    /// An older version of the program made it, and it may only be read.
    Older { path: PathBuf },
    /// The database says no.
    Database {
        path: PathBuf,
        error: rusqlite::Error,
    },
    /// It holds something that this program did not write.
    Damaged {
        path: PathBuf,
        /// What is wrong with it.
        fault: String,
    },
    /// There is no such profile.
    Unknown {
        /// Who was asked for.
        name: String,
        known: Vec<String>,
    },
    /// There is one of this name.
    Exists { name: String },
    /// The name is none.
    Name,
    /// A file that should be a profile is none.
    NoProfile {
        /// What is wrong with it.
        fault: String,
    },
    /// A part cannot be bought.
    Refused(PurchaseRefusal),
}

impl ProfileError {
    pub fn text(&self) -> Text {
        let shown = |path: &Path| path.display().to_string();
        match self {
            Self::Unusable { path, error } => {
                text!(
                    "profiles-unusable",
                    path = shown(path),
                    error = error.to_string()
                )
            }
            Self::Newer { path, found, known } => {
                text!(
                    "profiles-newer",
                    path = shown(path),
                    found = *found,
                    known = *known
                )
            }
            Self::Older { path } => text!("profiles-older", path = shown(path)),
            Self::Database { path, error } => {
                text!(
                    "profiles-database",
                    path = shown(path),
                    error = error.to_string()
                )
            }
            Self::Damaged { path, fault } => {
                text!(
                    "profiles-damaged",
                    path = shown(path),
                    fault = fault.as_str()
                )
            }
            Self::Unknown { name, known } if known.is_empty() => {
                text!("profiles-unknown-first", name = name.as_str())
            }
            Self::Unknown { name, known } => {
                text!(
                    "profiles-unknown",
                    name = name.as_str(),
                    known = known.join(", ")
                )
            }
            Self::Exists { name } => text!("profiles-exists", name = name.as_str()),
            Self::Name => text!("profiles-name", most = super::LONGEST_NAME),
            Self::NoProfile { fault } => text!("profiles-no-profile", fault = fault.as_str()),
            Self::Refused(refusal) => refusal.text(),
        }
    }
}
