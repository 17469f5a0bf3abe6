//! Text files, read with a size limit, and their errors.

use std::ffi::OsStr;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::names::unread;
use super::regular::read_regular;
use crate::diagnostic::{self, Diagnostic};
use crate::metadata::{is_packed, unpacked};
use crate::text;
use crate::text::Text;

/// The maximum size of a text file, in bytes; no mission, script or theme comes near it.
pub(super) const LARGEST_FILE: u64 = 1024 * 1024;
/// The maximum size of a generated file, such as the documentation of all parameters.
const LARGEST_GENERATED_FILE: u64 = 16 * 1024 * 1024;

/// A text with its name for fault reports.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The path, or the name of an embedded file.
    pub name: String,
    pub text: String,
}

impl Source {
    /// The name without folder and ending.
    pub fn stem(&self) -> &str {
        let stem = Path::new(&self.name).file_stem();
        stem.and_then(OsStr::to_str).unwrap_or_default()
    }
}

/// Why a file is not available.
#[derive(Debug, thiserror::Error)]
#[error("{}", Text::from(self))]
pub enum StoreError {
    /// The file cannot be read.
    Unreadable { path: PathBuf, error: io::Error },
    /// The file is too large.
    TooLarge {
        path: PathBuf,
        /// The id of the message that names the expected kind of file.
        kind: &'static str,
        /// The maximum size in bytes.
        most: u64,
    },
    /// The file cannot be written.
    Unwritable { path: PathBuf, error: io::Error },
    /// The file cannot be deleted.
    Undeletable { path: PathBuf, error: io::Error },
    /// The file exists already and must not be lost.
    Exists { path: PathBuf },
    /// The argument is neither a file nor a known name.
    Unknown {
        /// The id of the message that names the expected kind of file.
        kind: &'static str,
        name: String,
        known: String,
    },
    /// The file was read, but has faults.
    Faulty {
        file: Source,
        /// Every fault, with its position.
        faults: Vec<Diagnostic>,
    },
}

impl StoreError {
    /// The name, without folder and ending, of a file that exists and cannot be read.
    pub fn stem(&self) -> Option<&str> {
        match self {
            Self::Unreadable { path, .. } | Self::TooLarge { path, .. } => {
                path.file_stem().and_then(OsStr::to_str)
            }
            Self::Unwritable { .. }
            | Self::Undeletable { .. }
            | Self::Exists { .. }
            | Self::Unknown { .. }
            | Self::Faulty { .. } => None,
        }
    }
}

impl From<&StoreError> for Text {
    fn from(error: &StoreError) -> Self {
        let shown = |path: &Path| path.display().to_string();
        let named = |kind: &'static str| Self::new(kind, Vec::new());
        match error {
            StoreError::Unreadable { path, error } => unread(path, error),
            StoreError::TooLarge { path, kind, most } => text!(
                "file-too-large",
                path = shown(path),
                kind = named(kind),
                most = *most
            ),
            StoreError::Unwritable { path, error } => {
                let error = Self::from(error);
                text!("file-unwritable", path = shown(path), error = error)
            }
            StoreError::Undeletable { path, error } => {
                let error = Self::from(error);
                text!("file-undeletable", path = shown(path), error = error)
            }
            StoreError::Exists { path } => text!("file-exists", path = shown(path)),
            StoreError::Unknown { kind, name, known } => text!(
                "file-unknown",
                kind = named(kind),
                name = name,
                known = known
            ),
            StoreError::Faulty { file, faults } => {
                let (shown, rest) = diagnostic::first_shown(faults);
                let lines = shown.iter().map(|it| it.text(&file.name, &file.text));
                Self::joined("\n", lines.chain(rest).collect())
            }
        }
    }
}

/// Reads a text file of at most 1 MiB. `kind` is the id of the message that names the expected kind
/// of file.
///
/// # Errors
/// It does not exist, cannot be read, is not UTF-8 or is too large.
pub fn read(path: &Path, kind: &'static str) -> Result<Source, StoreError> {
    as_text(path, read_bytes(path, kind)?)
}

/// As [`read`], for a file that was found in a folder instead of named by the user: a FIFO there is refused, since
/// opening it would wait for a writer.
///
/// # Errors
/// As [`read`], or it is not a regular file.
pub fn read_found(path: &Path, kind: &'static str) -> Result<Source, StoreError> {
    let bytes = read_regular(path, LARGEST_FILE).map_err(|error| {
        let path = path.to_owned();
        match error.kind() {
            io::ErrorKind::FileTooLarge => StoreError::TooLarge {
                path,
                kind,
                most: LARGEST_FILE,
            },
            _ => StoreError::Unreadable { path, error },
        }
    })?;
    as_text(path, bytes)
}

fn as_text(path: &Path, bytes: Vec<u8>) -> Result<Source, StoreError> {
    let text = String::from_utf8(bytes).map_err(|error| StoreError::Unreadable {
        path: path.to_owned(),
        error: io::Error::new(io::ErrorKind::InvalidData, error),
    })?;
    Ok(Source {
        name: path.display().to_string(),
        text,
    })
}

/// Reads a file of at most 1 MiB, text or not. `kind` is the id of the message that names the
/// expected kind of file.
///
/// # Errors
/// It does not exist, cannot be read or is too large.
pub fn read_bytes(path: &Path, kind: &'static str) -> Result<Vec<u8>, StoreError> {
    read_at_most(path, kind, LARGEST_FILE)
}

/// As [`read`], for generated files, which are larger: at most 16 MiB, also after decompression (`.xz`).
///
/// # Errors
/// As [`read`].
pub fn read_documentation(path: &Path, kind: &'static str) -> Result<Source, StoreError> {
    let bytes = read_at_most(path, kind, LARGEST_GENERATED_FILE)?;
    if !is_packed(&bytes) {
        return as_text(path, bytes);
    }
    let unpacked = unpacked(bytes).map_err(|fault| StoreError::Unreadable {
        path: path.to_owned(),
        error: io::Error::other(fault.to_string()),
    })?;
    as_text(path, unpacked.into_bytes())
}

fn read_at_most(path: &Path, kind: &'static str, most: u64) -> Result<Vec<u8>, StoreError> {
    let bytes = read_start(path, most + 1)?;
    if bytes.len() as u64 > most {
        return Err(StoreError::TooLarge {
            path: path.to_owned(),
            kind,
            most,
        });
    }
    Ok(bytes)
}

/// Reads at most `most` bytes from the start of a file.
///
/// # Errors
/// It does not exist or cannot be read.
pub fn read_start(path: &Path, most: u64) -> Result<Vec<u8>, StoreError> {
    // The reported size means nothing for a device or a pipe, so the reading itself is limited.
    let mut bytes = Vec::new();
    fs::File::open(path)
        .and_then(|file| file.take(most).read_to_end(&mut bytes))
        .map_err(|error| StoreError::Unreadable {
            path: path.to_owned(),
            error,
        })?;
    Ok(bytes)
}
