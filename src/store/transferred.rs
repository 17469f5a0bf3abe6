//! Files that are copied to and from vehicles (MAVFTP).

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::names::unread;
use super::regular::read_regular;
use super::{StoreError, user_path};
use crate::metadata::LARGEST_PACKED;
use crate::session::FileDesk;
use crate::text::Text;

/// The maximum size of a file to send, in bytes: a vehicle takes hours for a larger one.
const LARGEST: u64 = 16 * 1024 * 1024;

/// The most files of vehicles' documentation that are kept: a vehicle has three.
const MOST_KEPT: usize = 60;

/// The files of this machine; names are relative to the working directory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TransferredFiles {
    /// The folder where documentation of vehicles is kept; `None` to keep none.
    documentation: Option<PathBuf>,
}

impl TransferredFiles {
    /// The files of this machine; documentation of vehicles is kept in the data folder.
    pub fn within(data: Option<&Path>) -> Self {
        Self {
            documentation: data.map(|data| data.join("vehicle-docs")),
        }
    }

    fn kept_file(&self, checksum: u32) -> Option<PathBuf> {
        let folder = self.documentation.as_ref()?;
        Some(folder.join(format!("{checksum:08x}")))
    }
}

impl FileDesk for TransferredFiles {
    fn read(&self, file: &str) -> Result<Vec<u8>, Text> {
        let path = user_path(file);
        read_regular(&path, LARGEST).map_err(|error| unread(&path, &error))
    }

    fn write(&self, file: &str, bytes: &[u8]) -> Result<String, Text> {
        let path = user_path(file);
        create(&path, bytes).map_err(|error| {
            let path = path.clone();
            Text::from(&match error.kind() {
                io::ErrorKind::AlreadyExists => StoreError::Exists { path },
                _ => StoreError::Unwritable { path, error },
            })
        })?;
        Ok(path.display().to_string())
    }

    fn kept(&self, checksum: u32) -> Option<Vec<u8>> {
        let file = self.kept_file(checksum)?;
        read_regular(&file, LARGEST_PACKED.into()).ok()
    }

    fn keep(&self, checksum: u32, bytes: &[u8]) {
        let (Some(folder), Some(file)) = (&self.documentation, self.kept_file(checksum)) else {
            return;
        };
        if let Err(error) = keep(folder, &file, bytes) {
            tracing::warn!("{}: {error}", file.display());
        }
    }
}

/// Keeps a file whole or not at all, in place of the oldest one if there are too many.
fn keep(folder: &Path, file: &Path, bytes: &[u8]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut kept: Vec<_> = fs::read_dir(folder)?.filter_map(Result::ok).collect();
    kept.sort_by_key(|entry| entry.metadata().and_then(|about| about.modified()).ok());
    for entry in kept.iter().take((kept.len() + 1).saturating_sub(MOST_KEPT)) {
        fs::remove_file(entry.path())?;
    }
    let new = file.with_extension(format!("{}.new", std::process::id()));
    fs::write(&new, bytes)?;
    fs::rename(new, file)
}

/// Writes a new file; what could not be written completely is removed.
fn create(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
    let written = file.write_all(bytes);
    if written.is_err() {
        // The first error is the one to report.
        drop(fs::remove_file(path));
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_written_once_and_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.lua");
        let named = path.to_str().expect("UTF-8");
        assert_eq!(
            TransferredFiles::default().write(named, b"one"),
            Ok(named.to_owned())
        );
        let again = TransferredFiles::default()
            .write(named, b"two")
            .expect_err("it exists");
        assert!(again.to_string().contains("already exists"), "{again}");
        assert_eq!(TransferredFiles::default().read(named), Ok(b"one".to_vec()));
        let missing = TransferredFiles::default()
            .read("/nonexistent/a")
            .expect_err("no file");
        assert!(missing.to_string().contains("no folder"), "{missing}");
    }

    #[test]
    fn documentation_is_kept_by_its_checksum_and_not_without_end() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = TransferredFiles::within(Some(folder.path()));
        assert_eq!(files.kept(7), None);
        files.keep(7, b"one");
        files.keep(7, b"two");
        assert_eq!(files.kept(7), Some(b"two".to_vec()));
        for checksum in 100..200 {
            files.keep(checksum, b"more");
        }
        let kept = fs::read_dir(folder.path().join("vehicle-docs")).expect("a folder");
        assert_eq!(kept.count(), MOST_KEPT);
        TransferredFiles::default().keep(7, b"nowhere");
    }
}
