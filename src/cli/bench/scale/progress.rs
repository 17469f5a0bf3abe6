//! Shows the progress of a series of measurements on standard error.

use std::io::{IsTerminal as _, Write as _, stderr};
use std::time::{Duration, Instant};

/// The interval of updates of the line on a terminal.
const EVERY: Duration = Duration::from_millis(500);

/// One line that is rewritten on a terminal, or a line per phase elsewhere.
pub(super) struct ScaleProgress {
    is_terminal: bool,
    said: String,
    said_at: Instant,
    /// The measurement in progress, as the line names it.
    subject: String,
    begun: Instant,
    /// The duration of a repeat without the boot of its vehicles.
    repeat: Duration,
    /// The duration of the last boot of the vehicles.
    boot: Duration,
    /// The number of repeats that remain, this one included.
    pub left: usize,
}

impl ScaleProgress {
    /// A series of repeats, each of which takes at least `repeat`.
    pub fn new(repeats: usize, repeat: Duration) -> Self {
        let now = Instant::now();
        Self {
            is_terminal: stderr().is_terminal(),
            said: String::new(),
            said_at: now,
            subject: String::new(),
            begun: now,
            repeat,
            boot: Duration::from_secs(3),
            left: repeats,
        }
    }

    /// Begins the next repeat.
    pub fn begin(&mut self, subject: String) {
        self.begun = Instant::now();
        self.subject = subject;
        self.say("starting");
    }

    /// Records that the vehicles of this repeat can be armed.
    pub fn booted(&mut self) {
        self.boot = self.begun.elapsed();
    }

    /// Shows the current phase.
    pub fn say(&mut self, phase: &str) {
        // A changed count within a phase is not a new phase.
        let words: String = phase.chars().filter(|c| !c.is_ascii_digit()).collect();
        let is_news = self.said != words;
        if !(is_news || self.is_terminal && self.said_at.elapsed() >= EVERY) {
            return;
        }
        let (from, to) = if self.is_terminal {
            ("\r\x1b[K", "")
        } else {
            ("", "\n")
        };
        let (subject, remaining) = (&self.subject, self.remaining());
        // Without a reader, no progress is needed.
        let _ = write!(stderr(), "{from}{subject}: {phase}{remaining}{to}");
        let _ = stderr().flush();
        (self.said, self.said_at) = (words, Instant::now());
    }

    /// Clears the line on the terminal.
    pub fn clear(&mut self) {
        if self.is_terminal && !self.said.is_empty() {
            let _ = write!(stderr(), "\r\x1b[K");
        }
        self.said.clear();
    }

    fn remaining(&self) -> String {
        let one = self.repeat + self.boot;
        let others = one * self.left.saturating_sub(1) as u32;
        let left_s = (one.saturating_sub(self.begun.elapsed()) + others).as_secs();
        if left_s >= 90 {
            format!(", about {} min left", left_s.div_ceil(60))
        } else {
            format!(", about {left_s} s left")
        }
    }
}
