//! Files that are copied to and from vehicles (MAVFTP).

use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::Path;

use super::names::unread;
use super::regular::read_regular;
use super::{StoreError, user_path};
use crate::session::FileDesk;
use crate::text::Text;

/// The maximum size of a file to send, in bytes: a vehicle takes hours for a larger one.
const LARGEST: u64 = 16 * 1024 * 1024;

/// The files of this machine; names are relative to the working directory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TransferredFiles;

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
        assert_eq!(TransferredFiles.write(named, b"one"), Ok(named.to_owned()));
        let again = TransferredFiles
            .write(named, b"two")
            .expect_err("it exists");
        assert!(again.to_string().contains("already exists"), "{again}");
        assert_eq!(TransferredFiles.read(named), Ok(b"one".to_vec()));
        let missing = TransferredFiles
            .read("/nonexistent/a")
            .expect_err("no file");
        assert!(missing.to_string().contains("no folder"), "{missing}");
    }
}
