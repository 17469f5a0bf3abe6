//! Suspends and resumes the console, as shells do with their jobs.

use std::io;

use nix::sys::signal::{Signal, kill};
use nix::sys::termios::{FlushArg, tcflush};
use nix::unistd::{Pid, getpid, getppid, getsid};

/// Whether a shell can resume the console. Started by `ssh HOST sortie` or as a login shell, it would stay stopped
/// forever.
pub fn can_be_suspended() -> bool {
    let ours = session(getpid());
    ours.is_some() && ours == session(getppid())
}

/// The session of a process. `None` if the process is not visible: a process outside a container
/// appears with the id 0, which would mean this process.
fn session(process: Pid) -> Option<Pid> {
    let visible = |id: &Pid| id.as_raw() > 0;
    let process = Some(process).filter(visible)?;
    getsid(Some(process)).ok().filter(visible)
}

/// Stops every process of the job, including this one, as Ctrl-Z does outside raw mode.
pub fn suspend_group() {
    // A process id of 0 stands for the program's own process group.
    let _ = kill(Pid::from_raw(0), Signal::SIGTSTP);
}

/// Stops this process until it is continued.
pub fn stop() {
    let _ = kill(getpid(), Signal::SIGSTOP);
}

/// Discards written bytes that the terminal has not read.
pub(super) fn discard_output() {
    let _ = tcflush(io::stdout(), FlushArg::TCOFLUSH);
}
