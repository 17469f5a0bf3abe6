//! The folders of instances, and the processes that earlier runs of a hangar have left behind.
//!
//! Below the root, each hangar has its own folder `run-PID-N`, which contains a folder for each
//! instance. The hangar holds a lock on [`OWNER`] while it lives; the kernel releases the lock
//! however the hangar ends. If the lock of a run is free, its owner is therefore dead, and its
//! remaining processes are leftovers.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::os::unix::fs::{
    DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, PermissionsExt as _,
};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use super::InstanceId;
use super::process;

mod leftover;
#[cfg(all(test, target_os = "linux"))]
mod tests;

pub use leftover::Leftover;
pub(super) use leftover::end;

/// The file that names the owner of a run; the owner locks it.
const OWNER: &str = "owner.json";
/// The file that identifies an instance's process.
const INSTANCE: &str = "instance.json";
/// The lock to hold while searching or adding runs.
const GATE: &str = ".lock";
/// The number of attempts to lock [`GATE`], and the time between two attempts.
const GATE_ATTEMPTS: u32 = 250;
const GATE_ATTEMPT: Duration = Duration::from_millis(20);
const RUN: &str = "run-";
/// The number of dead hangars whose folders are kept.
const RUNS_KEPT: usize = 5;
/// The permissions that others must not have on a folder whose files decide which processes are ended.
const WRITABLE_BY_OTHERS: u32 = 0o022;

/// Why a folder cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("cannot {what} {}: {error}: {}", .path.display(), advice(.error))]
pub struct FolderError {
    what: &'static str,
    path: PathBuf,
    // Not named `source`, because the error chain would print it twice.
    error: io::Error,
}

fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "make room on that disk, or choose another folder for the hangar"
        }
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file is in the way: move it, or choose another folder for the hangar"
        }
        io::ErrorKind::TimedOut => "end it, or choose another folder for the hangar",
        _ => "choose a folder for the hangar that you can write to",
    }
}

fn cannot(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> FolderError {
    let path = path.to_owned();
    move |error| FolderError { what, path, error }
}

/// The folder of one run of a hangar. Dropping it marks the run as over, and removes what nothing needs any more: the
/// owner's file if no process is left, and the folder if no instance has left files in it.
#[derive(Debug)]
pub(super) struct Run {
    path: PathBuf,
    _lock: File,
}

/// A new run, and the findings about the other runs.
#[derive(Debug)]
pub(super) struct OpenedFolder {
    pub run: Run,
    /// Processes of dead hangars; [`end`] ends them.
    pub leftovers: Vec<Leftover>,
    /// Files that could not be read, with the reason.
    pub skipped: Vec<String>,
}

impl Run {
    /// Adds a run below the root, finds the leftovers of earlier runs, and removes the oldest runs that are over.
    ///
    /// # Errors
    /// The root cannot be created or written, belongs to another user, or is writable by other users.
    pub fn open(root: &Path) -> Result<OpenedFolder, FolderError> {
        make(root, true).map_err(cannot("create the folder", root))?;
        let is_safe = is_own(root).and_then(|own| if own { Ok(()) } else { Err(foreign()) });
        is_safe.map_err(cannot("trust the folder", root))?;
        let (mut leftovers, mut skipped) = (Vec::new(), Vec::new());
        let path = root.join(GATE);
        let gate = pass(&path, &mut skipped).map_err(cannot("lock the file", &path))?;
        let mut over = Vec::new();
        for run in runs(root).map_err(cannot("list the folder", root))? {
            if is_over(&run) {
                let found = leftover::find(&run, &mut skipped);
                if found.is_empty() {
                    over.push(run);
                }
                leftovers.extend(found);
            }
        }
        prune(over, &mut skipped);
        let run = Self::add(root)?;
        drop(gate);
        Ok(OpenedFolder {
            run,
            leftovers,
            skipped,
        })
    }

    fn add(root: &Path) -> Result<Self, FolderError> {
        let me = std::process::id();
        let mut number = 0_u32;
        let path = loop {
            let path = root.join(format!("{RUN}{me}-{number}"));
            match make(&path, false) {
                Ok(()) => break path,
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(cannot("create the folder", &path)(error)),
            }
        };
        let owner = path.join(OWNER);
        let lock = write(&owner, &process::identity(me))
            .and_then(|()| lockable(&owner))
            .map_err(cannot("write the file", &owner))?;
        // Another hangar that checks this run holds the lock only for a moment. On a disk without locks, every run
        // counts as alive.
        let _ = lock.lock();
        Ok(Self { path, _lock: lock })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folder of an instance, created if missing.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn vehicle(&self, id: InstanceId) -> Result<PathBuf, FolderError> {
        let path = self.path.join(format!("vehicle-{id:03}"));
        make(&path, true).map_err(cannot("create the folder", &path))?;
        Ok(path)
    }

    /// Records an instance's process. If this hangar does not end the process, the next hangar
    /// finds it. Must be called as soon as the process runs.
    ///
    /// # Errors
    /// The record cannot be written; the instance then runs, but would not be found.
    pub fn note(&self, id: InstanceId, pid: u32, program: &Path) -> Result<(), FolderError> {
        let path = self.vehicle(id)?.join(INSTANCE);
        let Some(record) = leftover::Record::of(pid, program) else {
            return Ok(());
        };
        write(&path, &record).map_err(cannot("write the file", &path))
    }

    /// Removes the record of an instance's process that is gone.
    pub fn forget(&self, id: InstanceId) {
        // A file that remains names a dead process; the next hangar detects that.
        drop(fs::remove_file(
            self.path.join(format!("vehicle-{id:03}")).join(INSTANCE),
        ));
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let folders = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let mut records = folders.map(|folder| folder.path().join(INSTANCE));
        // The next hangar looks for the processes that a record names.
        if records.any(|record| record.exists()) {
            return;
        }
        drop(fs::remove_file(self.path.join(OWNER)));
        // A folder that is not empty stays, with the logs of its instances.
        drop(fs::remove_dir(&self.path));
    }
}

/// Makes a folder that only its owner can read.
fn make(path: &Path, with_parents: bool) -> io::Result<()> {
    fs::DirBuilder::new()
        .mode(0o700)
        .recursive(with_parents)
        .create(path)
}

/// Whether a folder belongs to this user, and only this user can write into it.
fn is_own(folder: &Path) -> io::Result<bool> {
    let data = fs::metadata(folder)?;
    let is_shared = data.permissions().mode() & WRITABLE_BY_OTHERS != 0;
    Ok(data.uid() == process::own_user() && !is_shared)
}

fn foreign() -> io::Error {
    io::Error::new(
        io::ErrorKind::PermissionDenied,
        "it belongs to another user, or others may write into it (chmod go-w changes that)",
    )
}

fn lockable(path: &Path) -> io::Result<File> {
    OpenOptions::new()
        .create(true)
        .append(true)
        .mode(0o600)
        .open(path)
}

/// Waits for the lock for searching and adding runs.
fn pass(gate: &Path, skipped: &mut Vec<String>) -> io::Result<File> {
    let file = lockable(gate)?;
    for _ in 0..GATE_ATTEMPTS {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(TryLockError::WouldBlock) => std::thread::sleep(GATE_ATTEMPT),
            Err(TryLockError::Error(error)) => {
                let path = gate.display();
                skipped.push(format!(
                    "cannot lock {path}: {error}; processes left by earlier hangars are not searched for"
                ));
                return Ok(file);
            }
        }
    }
    Err(io::Error::new(
        io::ErrorKind::TimedOut,
        "another hangar has held it for a long time and may hang",
    ))
}

/// Writes a file completely or not at all.
fn write(path: &Path, contents: &impl Serialize) -> io::Result<()> {
    let beside = path.with_extension("part");
    let text = serde_json::to_string(contents)?;
    let written = OpenOptions::new()
        .create(true)
        .write(true)
        .truncate(true)
        .mode(0o600)
        .open(&beside)
        .and_then(|mut file| file.write_all(text.as_bytes()))
        .and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        drop(fs::remove_file(&beside));
    }
    written
}

/// The runs below a root that belong to this user, oldest first.
fn runs(root: &Path) -> io::Result<Vec<PathBuf>> {
    let is_number = |word: &str| word.parse::<u32>().is_ok();
    let mut found = Vec::new();
    for entry in fs::read_dir(root)?.flatten() {
        let name = entry.file_name();
        let numbers = name
            .to_str()
            .and_then(|name| name.strip_prefix(RUN)?.split_once('-'));
        let is_run = numbers.is_some_and(|(pid, number)| is_number(pid) && is_number(number));
        // This reads the link itself, not its target.
        if let Ok(data) = entry.metadata()
            && is_run
            && data.is_dir()
            && data.uid() == process::own_user()
        {
            found.push((begun(&entry.path()), entry.path()));
        }
    }
    found.sort();
    Ok(found.into_iter().map(|(_, path)| path).collect())
}

/// The start of a run, which is when its owner's file was written.
fn begun(run: &Path) -> Option<std::time::SystemTime> {
    let data = fs::metadata(run.join(OWNER)).or_else(|_| fs::metadata(run));
    data.and_then(|data| data.modified()).ok()
}

/// The remaining processes of dead hangars below a root, and the files that could not be checked. Changes nothing.
pub fn leftovers(root: &Path) -> (Vec<Leftover>, Vec<String>) {
    let mut skipped = Vec::new();
    let all = match runs(root) {
        Ok(all) => all,
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => {
            skipped.push(format!("cannot list {}: {error}", root.display()));
            Vec::new()
        }
    };
    let over = all.iter().filter(|run| is_over(run));
    let found = over
        .flat_map(|run| leftover::find(run, &mut skipped))
        .collect();
    (found, skipped)
}

/// Whether a run's owner is dead. If in doubt, it counts as alive.
fn is_over(run: &Path) -> bool {
    let path = run.join(OWNER);
    match OpenOptions::new().append(true).open(&path) {
        Ok(file) => match file.try_lock() {
            Ok(()) => true,
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => false,
        },
        // The owner ended before it could write the file, which is written under the lock.
        Err(error) => error.kind() == io::ErrorKind::NotFound,
    }
}

fn prune(over: Vec<PathBuf>, skipped: &mut Vec<String>) {
    let too_many = over.len().saturating_sub(RUNS_KEPT);
    for run in over.into_iter().take(too_many) {
        if let Err(error) = fs::remove_dir_all(&run) {
            skipped.push(format!("cannot remove {}: {error}", run.display()));
        }
    }
}
