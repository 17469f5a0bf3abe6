//! Processes of a dead hangar.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use nix::sys::signal::{Signal, kill, killpg};
use nix::unistd::Pid;
use serde::{Deserialize, Serialize};
use tokio::time::{Instant, sleep};
use utoipa::ToSchema;

use super::INSTANCE;
use crate::hangar::process::{self, ProcessIdentity};

/// How long a process may take to end after a signal, and to disappear after being killed.
const GRACE: Duration = Duration::from_secs(2);
/// How often to check whether a process is gone: it is not a child of this process, so its end is
/// not signalled.
const LOOK_EVERY: Duration = Duration::from_millis(20);
/// The maximum size of a file that is read, in bytes.
const LARGEST_FILE: u64 = 64 * 1024;

/// A hangar's record of an instance's process.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Record {
    process: ProcessIdentity,
    /// The file that it runs; for a script, its interpreter.
    executable: PathBuf,
    program: PathBuf,
}

impl Record {
    /// The record of a running process; `None` if there is no such process, or the system cannot
    /// tell processes apart.
    pub fn of(pid: u32, program: &Path) -> Option<Self> {
        Some(Self {
            process: process::identity(pid)?,
            executable: process::executable(pid)?,
            program: program.to_owned(),
        })
    }

    /// Whether the recorded process runs, as opposed to another one with its number.
    fn is_running(&self) -> bool {
        let pid = self.process.pid;
        process::is_running(&self.process)
            && process::user(pid) == Some(process::own_user())
            && process::executable(pid).as_ref() == Some(&self.executable)
    }

    /// Processes that the recorded process started and left behind: all processes of its session
    /// whose working folder is `folder` or lies below it.
    fn orphans(self, folder: &Path) -> impl Iterator<Item = Self> {
        let folder = folder.canonicalize().ok();
        let is_here = move |pid: u32| {
            let place = process::folder(pid).zip(folder.as_ref());
            place.is_some_and(|(place, folder)| place.starts_with(folder))
        };
        let is_of_today = process::identity(std::process::id())
            .is_some_and(|me| me.has_numbers_of(&self.process));
        let members = is_of_today.then(|| process::session(self.process.pid));
        members
            .into_iter()
            .flatten()
            .filter(move |&pid| is_here(pid))
            .filter_map(move |pid| Self::of(pid, &self.program))
            .filter(Self::is_running)
    }

    fn signal(&self, signal: Signal) {
        if let Ok(pid) = i32::try_from(self.process.pid)
            && pid > 1
            && self.is_running()
        {
            // The signal goes to the process's whole group, if it leads one. An error means that
            // the process is gone.
            let pid = Pid::from_raw(pid);
            if killpg(pid, signal).is_err() {
                let _ = kill(pid, signal);
            }
        }
    }

    /// Waits until the process is gone, up to the time limit; returns whether it is.
    async fn is_gone(&self) -> bool {
        let begun = Instant::now();
        // A process that is ending no longer has a file, but is not gone yet.
        while process::is_running(&self.process) {
            if begun.elapsed() >= GRACE {
                return false;
            }
            sleep(LOOK_EVERY).await;
        }
        true
    }
}

/// A process left behind by a dead hangar.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct Leftover {
    pub program: String,
    /// The process id on the hangar's machine.
    pub pid: u32,
    /// The folder in which the process ran.
    pub folder: String,
    /// Whether the process was ended.
    pub ended: bool,
    #[serde(skip)]
    #[schema(ignore)]
    record: Record,
}

impl fmt::Display for Leftover {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            program,
            pid,
            folder,
            ended,
            ..
        } = self;
        let now = if *ended {
            "ended now"
        } else {
            "it could not be ended"
        };
        write!(
            f,
            "{program} (pid {pid}) of an earlier hangar, in {folder}: {now}"
        )
    }
}

impl Leftover {
    fn new(folder: &Path, record: Record) -> Self {
        Self {
            program: record.program.display().to_string(),
            pid: record.process.pid,
            folder: folder.display().to_string(),
            ended: false,
            record,
        }
    }
}

/// The remaining processes of a run whose owner is dead.
pub(super) fn find(run: &Path, skipped: &mut Vec<String>) -> Vec<Leftover> {
    let mut found = Vec::new();
    let entries = match fs::read_dir(run) {
        Ok(entries) => entries,
        Err(error) => {
            skipped.push(format!("cannot list {}: {error}", run.display()));
            return found;
        }
    };
    let mut folders: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    folders.sort();
    for folder in folders.into_iter().filter(|folder| folder.is_dir()) {
        match read(&folder.join(INSTANCE)) {
            Ok(record) if record.is_running() => found.push(Leftover::new(&folder, record)),
            Ok(record) => {
                let orphans = record.orphans(&folder);
                found.extend(orphans.map(|orphan| Leftover::new(&folder, orphan)));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => {
                skipped.push(format!(
                    "cannot read {}: {error}",
                    folder.join(INSTANCE).display()
                ));
            }
        }
    }
    found
}

fn read(path: &Path) -> io::Result<Record> {
    let data = fs::symlink_metadata(path)?;
    if !data.is_file() || data.len() > LARGEST_FILE {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "it is not a file of a hangar",
        ));
    }
    Ok(serde_json::from_slice(&fs::read(path)?)?)
}

/// Signals all leftovers to end, kills those that do not within two seconds, and notes which are gone.
pub(in crate::hangar) async fn end(leftovers: &mut [Leftover]) {
    for signal in [Signal::SIGTERM, Signal::SIGKILL] {
        for leftover in leftovers.iter().filter(|leftover| !leftover.ended) {
            leftover.record.signal(signal);
            // A stopped process receives the signal only once it is continued.
            leftover.record.signal(Signal::SIGCONT);
        }
        for leftover in leftovers.iter_mut() {
            leftover.ended = leftover.ended || leftover.record.is_gone().await;
        }
    }
}
