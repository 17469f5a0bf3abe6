//! The seats of a measured class.

use std::io::{self, BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::Instant;

/// Seats as this program sees them: what is typed there, and what is shown. They end with this value.
pub(super) struct Seats {
    all: Vec<Box<dyn SeatInput>>,
    lines: Receiver<SeatOutput>,
}

/// The keyboard of a seat.
pub(super) trait SeatInput {
    /// Types a line, which the seat carries out.
    fn give(&mut self, line: &str) -> io::Result<()>;
}

/// A line that a seat has shown, and when.
pub(super) struct SeatOutput {
    /// The index of the seat among those that were started.
    pub seat: usize,
    pub at: Instant,
    pub text: String,
}

/// A plain console in a process of its own.
struct ConsoleProcess {
    child: Child,
    input: ChildStdin,
}

impl Seats {
    /// Starts seats; `start` gets the index of each, and where it shows its lines.
    pub fn start(
        count: usize,
        mut start: impl FnMut(usize, Sender<SeatOutput>) -> anyhow::Result<Box<dyn SeatInput>>,
    ) -> anyhow::Result<Self> {
        let (sender, lines) = mpsc::channel();
        let all = (0..count)
            .map(|seat| start(seat, sender.clone()))
            .collect::<anyhow::Result<_>>()?;
        Ok(Self { all, lines })
    }

    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// Gives a line at one seat, by its index.
    pub fn give(&mut self, seat: usize, line: &str) -> io::Result<()> {
        self.all[seat].give(line)
    }

    /// Gives a line at every seat.
    pub fn give_all(&mut self, line: &str) -> io::Result<()> {
        (0..self.count()).try_for_each(|seat| self.give(seat, line))
    }

    /// The lines shown since the last call.
    pub fn lines(&self) -> impl Iterator<Item = SeatOutput> {
        self.lines.try_iter()
    }
}

/// Starts a plain console.
pub(super) fn console(
    mut command: Command,
    seat: usize,
    output: Sender<SeatOutput>,
) -> io::Result<Box<dyn SeatInput>> {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let (Some(input), Some(shown)) = (child.stdin.take(), child.stdout.take()) else {
        return Err(io::Error::other("a seat has no pipes"));
    };
    std::thread::spawn(move || {
        for text in BufReader::new(shown).lines().map_while(Result::ok) {
            let at = Instant::now();
            if output.send(SeatOutput { seat, at, text }).is_err() {
                break;
            }
        }
    });
    Ok(Box::new(ConsoleProcess { child, input }))
}

impl SeatInput for ConsoleProcess {
    fn give(&mut self, line: &str) -> io::Result<()> {
        writeln!(self.input, "{line}")
    }
}

impl Drop for ConsoleProcess {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
