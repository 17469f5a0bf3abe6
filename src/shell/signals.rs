//! What the operating system tells the console.

use std::io;

use tokio::signal::unix::{Signal, SignalKind, signal};

/// What the operating system can tell the console.
pub enum Happened {
    /// The program is to end.
    End,
    /// The terminal has another size.
    Resized,
    /// The program is to stop until it is continued.
    Stopped,
    /// The program was continued after a stop.
    Continued,
}

/// Signals; Ctrl-C, Ctrl-\ and Ctrl-Z are keys in raw mode, so that all of these come from elsewhere.
pub struct Signals {
    ends: [Signal; 4],
    resized: Signal,
    stopped: Signal,
    continued: Signal,
}

impl Signals {
    /// Listens from now on.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn new() -> io::Result<Self> {
        use nix::sys::signal::Signal as Number;
        let numbered = |number: Number| signal(SignalKind::from_raw(number as i32));
        Ok(Self {
            ends: [
                signal(SignalKind::terminate())?,
                signal(SignalKind::hangup())?,
                signal(SignalKind::interrupt())?,
                signal(SignalKind::quit())?,
            ],
            resized: signal(SignalKind::window_change())?,
            stopped: numbered(Number::SIGTSTP)?,
            continued: numbered(Number::SIGCONT)?,
        })
    }

    pub async fn next(&mut self) -> Happened {
        let [terminated, hung_up, interrupted, quit] = &mut self.ends;
        tokio::select! {
            _ = terminated.recv() => Happened::End,
            _ = hung_up.recv() => Happened::End,
            _ = interrupted.recv() => Happened::End,
            _ = quit.recv() => Happened::End,
            _ = self.resized.recv() => Happened::Resized,
            _ = self.stopped.recv() => Happened::Stopped,
            _ = self.continued.recv() => Happened::Continued,
        }
    }
}
