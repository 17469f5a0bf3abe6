//! Signals of the operating system.

use std::future::poll_fn;
use std::io;
use std::task::Poll;

use nix::sys::signal::Signal as Number;
use tokio::signal::unix::{Signal, SignalKind, signal};

/// A signal to the console.
pub enum Happened {
    /// The program must end.
    End,
    /// The terminal has another size.
    Resized,
    /// The program must stop until it is continued.
    Stopped,
    /// The program was continued after a stop.
    Continued,
}

/// The signals that end the program. By default, each would end it and leave the terminal in raw mode.
const ENDS: &[Number] = &[
    Number::SIGTERM,
    Number::SIGHUP,
    Number::SIGINT,
    Number::SIGQUIT,
    Number::SIGUSR1,
    Number::SIGUSR2,
    Number::SIGALRM,
    Number::SIGVTALRM,
    Number::SIGPROF,
    Number::SIGXCPU,
    Number::SIGXFSZ,
];

/// The signals. In raw mode Ctrl-C, Ctrl-\ and Ctrl-Z are keys, so all signals come from other programs.
pub struct Signals {
    ends: Vec<Signal>,
    resized: Signal,
    stopped: Signal,
    continued: Signal,
}

impl Signals {
    /// Subscribes to the signals.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn new() -> io::Result<Self> {
        let numbered = |number: Number| signal(SignalKind::from_raw(number as i32));
        Ok(Self {
            ends: ENDS
                .iter()
                .copied()
                .map(numbered)
                .collect::<io::Result<_>>()?,
            resized: signal(SignalKind::window_change())?,
            stopped: numbered(Number::SIGTSTP)?,
            continued: numbered(Number::SIGCONT)?,
        })
    }

    /// Waits for the next signal.
    pub async fn next(&mut self) -> Happened {
        let ends = &mut self.ends;
        let end = poll_fn(|context| {
            let has_come = |it: &mut Signal| it.poll_recv(context).is_ready();
            if ends.iter_mut().any(has_come) {
                Poll::Ready(())
            } else {
                Poll::Pending
            }
        });
        tokio::select! {
            () = end => Happened::End,
            _ = self.resized.recv() => Happened::Resized,
            _ = self.stopped.recv() => Happened::Stopped,
            _ = self.continued.recv() => Happened::Continued,
        }
    }
}
