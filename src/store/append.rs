//! Append-only files that are valid at any time.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::{StoreError, sharing};

/// A file that its owner and the readers of its folder can read. It is locked while it is open; the
/// lock shows other consoles that it is still being written.
#[derive(Debug)]
pub(super) struct AppendFile {
    file: File,
    path: PathBuf,
    len: u64,
}

impl AppendFile {
    /// Creates a file; `None` if one of that name exists.
    pub fn create(path: PathBuf) -> Result<Option<Self>, StoreError> {
        let mut options = OpenOptions::new();
        match sharing::open(options.create_new(true).append(true), &path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
            Err(error) => Err(StoreError::Unwritable { path, error }),
            Ok(file) => {
                // Without file locks, an abandoned file cannot be distinguished from one being written.
                drop(file.try_lock());
                Ok(Some(Self { file, path, len: 0 }))
            }
        }
    }

    /// Appends all the bytes or none. On failure the earlier content stays; a file that is still
    /// empty is removed.
    ///
    /// # Errors
    /// The disk is full or unavailable.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), StoreError> {
        let Err(error) = self.file.write_all(bytes) else {
            self.len += bytes.len() as u64;
            return Ok(());
        };
        // On an unavailable disk, this may fail too.
        drop(if self.len == 0 {
            fs::remove_file(&self.path)
        } else {
            self.file.set_len(self.len)
        });
        let path = self.path.clone();
        Err(StoreError::Unwritable { path, error })
    }

    /// Waits until its bytes are on the disk.
    ///
    /// # Errors
    /// The disk is unavailable.
    pub fn sync(&self) -> Result<(), StoreError> {
        self.file
            .sync_all()
            .map_err(|error| StoreError::Unwritable {
                path: self.path.clone(),
                error,
            })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the file refuse further bytes, as on a full disk.
    #[cfg(test)]
    pub fn make_read_only(&mut self) {
        self.file = File::open(&self.path).expect("it is there");
    }

    /// The number of bytes written.
    pub fn len(&self) -> u64 {
        self.len
    }
}

/// Whether a file is still being written: its console holds a lock on it.
pub(super) fn is_written(path: &Path) -> bool {
    let lock = File::open(path).map(|file| file.try_lock_shared());
    // Without file locks, a writer cannot be detected: only a known lock counts.
    matches!(lock, Ok(Err(TryLockError::WouldBlock)))
}
