//! Stopping and going on, as shells do with their jobs.

use std::io;

use rustix::process::{Signal, getpid, getppid, getsid, kill_current_process_group, kill_process};
use rustix::termios::{QueueSelector, tcflush};

/// Whether a shell is there that could bring the console back. Started by `ssh HOST sortie` or as a login shell it
/// would stand still for ever.
pub fn can_be_suspended() -> bool {
    let ours = getsid(None).ok();
    let parents = getppid().and_then(|parent| getsid(Some(parent)).ok());
    ours.is_some() && ours == parents
}

/// Asks every process of the job to stop, this one too: what Ctrl-Z does where it is not a key.
pub fn suspend_group() {
    let _ = kill_current_process_group(Signal::TSTP);
}

/// Stops this process until it is continued.
pub fn stop() {
    let _ = kill_process(getpid(), Signal::STOP);
}

/// Throws away what has been written to the terminal and not been read.
pub(super) fn discard_output() {
    let _ = tcflush(io::stdout(), QueueSelector::OFlush);
}
