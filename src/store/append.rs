//! Files that only grow, and are whole whenever they are looked at.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::{StoreError, sharing};

/// A file that is written for its owner, and for whom the folder is shared with. While it is open it is locked, which tells other consoles that it
/// is still written.
#[derive(Debug)]
pub(super) struct AppendFile {
    file: File,
    path: PathBuf,
    /// Bytes that were written whole.
    len: u64,
}

impl AppendFile {
    /// Creates a file; `None` if there is one of that name.
    pub fn create(path: PathBuf) -> Result<Option<Self>, StoreError> {
        let mut options = OpenOptions::new();
        match sharing::open(options.create_new(true).append(true), &path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
            Err(error) => Err(StoreError::Unwritable { path, error }),
            Ok(file) => {
                // Where files cannot be locked, one that was left cannot be told from one that is written.
                drop(file.try_lock());
                Ok(Some(Self { file, path, len: 0 }))
            }
        }
    }

    /// Adds bytes as a whole. Where that fails, what was written before is left, and no file where that is nothing.
    ///
    /// # Errors
    /// The disk is full or gone.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), StoreError> {
        let Err(error) = self.file.write_all(bytes) else {
            self.len += bytes.len() as u64;
            return Ok(());
        };
        // A disk that is gone takes no tidying up either.
        drop(if self.len == 0 {
            fs::remove_file(&self.path)
        } else {
            self.file.set_len(self.len)
        });
        let path = self.path.clone();
        Err(StoreError::Unwritable { path, error })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// From now on it takes nothing, as on a disk that is full.
    #[cfg(test)]
    pub fn make_read_only(&mut self) {
        self.file = File::open(&self.path).expect("it is there");
    }

    /// Bytes that were written.
    pub fn len(&self) -> u64 {
        self.len
    }
}

/// Whether a file may still be written: the console that writes it holds a lock on it.
pub(super) fn is_written(path: &Path) -> bool {
    let lock = File::open(path).map(|file| file.try_lock_shared());
    // Where files cannot be locked, whoever writes one cannot be seen: only what is known counts.
    matches!(lock, Ok(Err(TryLockError::WouldBlock)))
}
