//! Errors of profiles.

use std::io;
use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;

use crate::campaign::PurchaseRefusal;
use crate::text;
use crate::text::Text;

/// Why profiles are not available.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.text())]
pub enum ProfileError {
    /// The folder or the file cannot be written.
    Unusable { path: PathBuf, error: io::Error },
    /// The folder or the file cannot be read.
    Unreadable { path: PathBuf, error: io::Error },
    /// Only its owner may read the file.
    Forbidden {
        path: PathBuf,
        owner: String,
        /// Whether the mode of its folder keeps new results from the group, although the group may enter it.
        is_folder_unshared: bool,
    },
    /// The file can be read, but must not be written.
    ReadOnly { path: PathBuf },
    /// A newer version of the program wrote the file.
    Newer {
        path: PathBuf,
        /// The version of the file's tables.
        found: i32,
        /// The newest version that this program supports.
        known: i32,
    },
    /// An older version of the program wrote the file, and the file is read-only.
    Older { path: PathBuf },
    /// The file is read-only, and beside it is a log without the index that is needed to read it.
    LogAlone { path: PathBuf, log: PathBuf },
    /// The database reports an error.
    Database {
        path: PathBuf,
        error: rusqlite::Error,
    },
    /// The file contains data that this program did not write.
    Damaged { path: PathBuf, fault: String },
    /// No profile has this name.
    Unknown { name: String, known: Vec<String> },
    /// The name is taken.
    Exists { name: String },
    /// The name is not valid.
    Name,
    /// A file does not contain a profile.
    NoProfile { fault: String },
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
                    error = Text::from(error)
                )
            }
            Self::Unreadable { path, error } => {
                text!(
                    "profiles-unreadable",
                    path = shown(path),
                    error = Text::from(error)
                )
            }
            Self::Forbidden {
                path,
                owner,
                is_folder_unshared: false,
            } => text!("profiles-forbidden", path = shown(path), owner = owner),
            Self::Forbidden {
                path,
                owner,
                is_folder_unshared: true,
            } => {
                let folder = shown(path.parent().unwrap_or(path));
                text!(
                    "profiles-unshared",
                    path = shown(path),
                    owner = owner,
                    folder = folder
                )
            }
            Self::ReadOnly { path } => text!("profiles-read-only", path = shown(path)),
            Self::Newer { path, found, known } => {
                text!(
                    "profiles-newer",
                    path = shown(path),
                    found = *found,
                    known = *known
                )
            }
            Self::Older { path } => text!("profiles-older", path = shown(path)),
            Self::LogAlone { path, log } => {
                text!("profiles-log-alone", path = shown(path), log = shown(log))
            }
            Self::Database { path, error } => {
                text!(
                    "profiles-database",
                    path = shown(path),
                    error = database_fault(path, error)
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

/// With less space than this, `SQLite` cannot create the files beside a database.
const LEAST_FREE: u64 = 64 * 1024;

/// An error of the database. On a full disk, `SQLite` often reports only an input or output error.
fn database_fault(path: &Path, error: &rusqlite::Error) -> Text {
    match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => text!("system-full"),
        Some(ErrorCode::SystemIoFailure) if is_full(path) => text!("system-full"),
        _ => Text::verbatim(error.to_string()),
    }
}

/// Whether the disk of a file has hardly any space left.
fn is_full(path: &Path) -> bool {
    let folder = path.parent().unwrap_or(path);
    let facts = nix::sys::statvfs::statvfs(folder);
    facts.is_ok_and(|it| it.blocks_available() * it.fragment_size() < LEAST_FREE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let said = |code: i32| {
            let code = rusqlite::ffi::Error::new(code);
            let error = rusqlite::Error::SqliteFailure(code, None);
            database_fault(&folder.path().join("profiles.sqlite"), &error).to_string()
        };
        assert_eq!(
            said(rusqlite::ffi::SQLITE_FULL),
            "no space left on the disk"
        );
        // This disk has space.
        assert!(said(rusqlite::ffi::SQLITE_IOERR).contains("I/O"));
    }
}
