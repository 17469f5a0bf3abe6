//! Text files, read with a limit, and why one could not be had.

use std::ffi::OsStr;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::diagnostic::{self, Diagnostic};
use crate::text;
use crate::text::Text;

/// Files larger than this are refused: no mission, script or theme comes near it.
pub(super) const LARGEST_FILE: u64 = 1024 * 1024;

/// A text with the name under which faults in it are reported.
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

/// A file that could not be had.
#[derive(Debug, thiserror::Error)]
#[error("{}", Text::from(self))]
pub enum StoreError {
    /// It could not be read.
    Unreadable { path: PathBuf, error: io::Error },
    /// It is too large to be what was asked for.
    TooLarge {
        path: PathBuf,
        /// The id of the message that says what was expected.
        kind: &'static str,
    },
    /// It could not be written.
    Unwritable { path: PathBuf, error: io::Error },
    /// There is a file already, which is not to be lost.
    Exists { path: PathBuf },
    /// Neither a file nor a known name.
    Unknown {
        /// The id of the message that says what was expected.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// The names of those there are.
        known: String,
    },
    /// It was read, but makes no sense.
    Faulty {
        file: Source,
        /// Every fault, with its place.
        faults: Vec<Diagnostic>,
    },
}

impl From<&StoreError> for Text {
    fn from(error: &StoreError) -> Self {
        let shown = |path: &Path| path.display().to_string();
        let named = |kind: &'static str| Self::new(kind, Vec::new());
        match error {
            StoreError::Unreadable { path, error } => {
                let error = error.to_string();
                text!("file-unreadable", path = shown(path), error = error)
            }
            StoreError::TooLarge { path, kind } => text!(
                "file-too-large",
                path = shown(path),
                kind = named(kind),
                most = LARGEST_FILE
            ),
            StoreError::Unwritable { path, error } => {
                let error = error.to_string();
                text!("file-unwritable", path = shown(path), error = error)
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

/// Reads a text file of at most 1 MiB. `kind` is the id of the message that says what it is to be.
///
/// # Errors
/// It does not exist, cannot be read, is not UTF-8 or is too large.
pub fn read(path: &Path, kind: &'static str) -> Result<Source, StoreError> {
    let unreadable = |error| StoreError::Unreadable {
        path: path.to_owned(),
        error,
    };
    // A size that a file claims says nothing of what a device or a pipe gives, so what is read is limited.
    let mut bytes = Vec::new();
    fs::File::open(path)
        .and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes))
        .map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(StoreError::TooLarge {
            path: path.to_owned(),
            kind,
        });
    }
    let text = String::from_utf8(bytes)
        .map_err(|error| unreadable(io::Error::new(io::ErrorKind::InvalidData, error)))?;
    Ok(Source {
        name: path.display().to_string(),
        text,
    })
}

/// A path as a person writes it: `~/` is their home folder.
pub fn user_path(written: &str) -> PathBuf {
    let in_home = written.strip_prefix("~/").zip(etcetera::home_dir().ok());
    in_home.map_or_else(|| PathBuf::from(written), |(rest, home)| home.join(rest))
}
