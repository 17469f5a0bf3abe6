//! A temporary folder, removed when it is dropped.

use std::fs::{self, DirBuilder};
use std::os::unix::fs::DirBuilderExt as _;
use std::path::{Path, PathBuf};
use std::{env, io, process};

/// The maximum number of names to try.
const TRIES: u32 = 1000;

/// A folder for this process alone, below the system's temporary folder; dropping this removes it.
pub(super) struct ScratchFolder(PathBuf);

impl ScratchFolder {
    pub fn new(name: &str) -> io::Result<Self> {
        let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
        for number in 0..TRIES {
            let path = env::temp_dir().join(format!("{name}-{}-{number}", process::id()));
            // Fails if the name exists, even as another user's link.
            match DirBuilder::new().mode(0o700).create(&path) {
                Ok(()) => return Ok(Self(path)),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => last = error,
                Err(error) => {
                    let what = format!("create the folder {}: {error}", path.display());
                    return Err(io::Error::new(error.kind(), what));
                }
            }
        }
        Err(last)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for ScratchFolder {
    fn drop(&mut self) {
        // Files that cannot be removed stay with other temporary files.
        let _ = fs::remove_dir_all(&self.0);
    }
}
