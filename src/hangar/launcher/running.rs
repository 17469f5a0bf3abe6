//! A running process, and its end.

use std::io;
use std::process::ExitStatus;
use std::time::Duration;

use nix::sys::signal::{Signal, kill, killpg};
use nix::unistd::Pid;
use tokio::process::{Child, ChildStderr, ChildStdout};
use tokio::time::timeout;

/// How long a process may take to end after a signal.
const GRACE: Duration = Duration::from_secs(2);

/// A started process with the processes that it creates, as one group. Dropping it kills them.
#[derive(Debug)]
pub(in crate::hangar) struct RunningProcess {
    child: Child,
    pid: Pid,
    #[cfg(target_os = "linux")]
    changes: Option<tokio::signal::unix::Signal>,
}

impl Drop for RunningProcess {
    fn drop(&mut self) {
        // The id belongs to the process only until its exit status is fetched.
        if self.child.id().is_some() {
            self.signal(Signal::SIGKILL);
        }
    }
}

impl RunningProcess {
    /// Takes over a child; `None` if it has ended and its status is known.
    pub(super) fn new(child: Child) -> Option<Self> {
        Some(Self {
            pid: Pid::from_raw(child.id()? as i32),
            child,
            #[cfg(target_os = "linux")]
            changes: None,
        })
    }

    pub fn pid(&self) -> u32 {
        self.pid.as_raw() as u32
    }

    /// Takes the process's output pipes; possible only once.
    pub fn take_output(&mut self) -> (Option<ChildStdout>, Option<ChildStderr>) {
        (self.child.stdout.take(), self.child.stderr.take())
    }

    /// Waits until the process has ended, and kills the rest of its group. Dropping the future
    /// loses nothing.
    ///
    /// # Errors
    /// The process cannot be waited for.
    pub async fn wait(&mut self) -> io::Result<ExitStatus> {
        if self.child.id().is_some() {
            self.ended().await;
            // Its exit status has not been fetched, so no other process can have its number.
            #[cfg(target_os = "linux")]
            self.signal(Signal::SIGKILL);
        }
        self.child.wait().await
    }

    /// Signals the process and its group to end, kills them if they do not within two seconds, and
    /// waits until the process is gone.
    ///
    /// # Errors
    /// The process cannot be waited for.
    pub async fn end(&mut self) -> io::Result<ExitStatus> {
        if self.child.id().is_some() {
            self.signal(Signal::SIGTERM);
            // A stopped process receives the signal only once it is continued.
            self.signal(Signal::SIGCONT);
            if let Ok(status) = timeout(GRACE, self.wait()).await {
                return status;
            }
            self.signal(Signal::SIGKILL);
        }
        self.wait().await
    }

    /// Signals the process's group, or the process alone if it does not lead a group yet.
    fn signal(&self, signal: Signal) {
        // An error means that the process is gone.
        if killpg(self.pid, signal).is_err() {
            let _ = kill(self.pid, signal);
        }
    }

    /// Waits until the process has ended, without fetching its status.
    #[cfg(target_os = "linux")]
    async fn ended(&mut self) {
        use nix::errno::Errno;
        use nix::sys::wait::{Id, WaitPidFlag, WaitStatus, waitid};
        use tokio::signal::unix::{SignalKind, signal};

        let flags = WaitPidFlag::WEXITED | WaitPidFlag::WNOHANG | WaitPidFlag::WNOWAIT;
        if self.changes.is_none() {
            self.changes = signal(SignalKind::child()).ok();
        }
        // The subscription comes before the check, so that no end is missed.
        let Some(changes) = &mut self.changes else {
            return;
        };
        while let Ok(WaitStatus::StillAlive) | Err(Errno::EINTR) = waitid(Id::Pid(self.pid), flags)
        {
            if changes.recv().await.is_none() {
                return;
            }
        }
    }

    #[cfg(not(target_os = "linux"))]
    #[expect(clippy::unused_async, reason = "it waits on Linux")]
    async fn ended(&mut self) {}
}
