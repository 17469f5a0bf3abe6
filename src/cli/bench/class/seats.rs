//! The trainees' consoles of a measured class.

use std::io::{self, BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::Instant;

/// Plain consoles, each a process. They end with this value.
pub(super) struct Seats {
    all: Vec<SeatProcess>,
    lines: Receiver<SeatOutput>,
}

/// A line that a seat has printed, and when.
pub(super) struct SeatOutput {
    /// The index of the seat among those that were started.
    pub seat: usize,
    pub at: Instant,
    pub text: String,
}

struct SeatProcess {
    child: Child,
    input: ChildStdin,
}

impl Seats {
    pub fn start(commands: impl Iterator<Item = io::Result<Command>>) -> io::Result<Self> {
        let (sender, lines) = mpsc::channel();
        let start = |(seat, command): (usize, io::Result<Command>)| {
            SeatProcess::start(command?, seat, sender.clone())
        };
        let all = commands.enumerate().map(start).collect::<io::Result<_>>()?;
        Ok(Self { all, lines })
    }

    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// Gives a line at one seat, by its index.
    pub fn give(&mut self, seat: usize, line: &str) -> io::Result<()> {
        writeln!(self.all[seat].input, "{line}")
    }

    /// Gives a line at every seat.
    pub fn give_all(&mut self, line: &str) -> io::Result<()> {
        (0..self.count()).try_for_each(|seat| self.give(seat, line))
    }

    /// The lines printed since the last call.
    pub fn lines(&self) -> impl Iterator<Item = SeatOutput> {
        self.lines.try_iter()
    }
}

impl SeatProcess {
    fn start(mut command: Command, seat: usize, sender: Sender<SeatOutput>) -> io::Result<Self> {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(io::Error::other("a seat has no pipes"));
        };
        std::thread::spawn(move || {
            for text in BufReader::new(output).lines().map_while(Result::ok) {
                let at = Instant::now();
                if sender.send(SeatOutput { seat, at, text }).is_err() {
                    break;
                }
            }
        });
        Ok(Self { child, input })
    }
}

impl Drop for SeatProcess {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
