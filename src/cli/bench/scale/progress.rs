//! Says on standard error how far a series of measurements is.

use std::io::{IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// How often the line is written again on a terminal.
const EVERY: Duration = Duration::from_millis(500);

/// One line that is written again and again on a terminal, and a line per phase elsewhere.
pub(super) struct Progress {
    is_terminal: bool,
    said: String,
    said_at: Option<Instant>,
    /// What is measured now.
    subject: String,
    /// When this repeat began.
    begun: Instant,
    /// How long one repeat takes beside the booting of its vehicles.
    repeat: Duration,
    /// What booting took last time, per vehicle and the least.
    boot: Duration,
    /// Repeats after this one.
    left: usize,
}

impl Progress {
    /// A series of so many repeats, each of which takes so long and longer.
    pub fn new(repeats: usize, repeat: Duration) -> Self {
        Self {
            is_terminal: std::io::stderr().is_terminal(),
            said: String::new(),
            said_at: None,
            subject: String::new(),
            begun: Instant::now(),
            repeat,
            boot: Duration::from_secs(3),
            left: repeats,
        }
    }

    /// More repeats than were thought of at first.
    pub fn add(&mut self, repeats: usize) {
        self.left += repeats;
    }

    /// The next repeat begins.
    pub fn begin(&mut self, vehicles: u16, repeat: usize, repeats: usize) {
        self.left = self.left.saturating_sub(1);
        self.begun = Instant::now();
        self.subject = format!(
            "{vehicles} vehicle{}, repeat {repeat} of {repeats}",
            if vehicles == 1 { "" } else { "s" }
        );
    }

    /// The vehicles of this repeat can be armed.
    pub fn booted(&mut self) {
        self.boot = self.begun.elapsed();
    }

    /// What is done now.
    pub fn say(&mut self, phase: &str) {
        // A phase that counts is still the same phase.
        let words: String = phase.chars().filter(|c| !c.is_ascii_digit()).collect();
        let is_news = self.said != words;
        if self.is_terminal {
            if is_news || self.said_at.is_none_or(|at| at.elapsed() >= EVERY) {
                eprint!("\r\x1b[K{}: {phase}{}", self.subject, self.remaining());
                // A terminal that is gone needs no progress.
                let _ = std::io::stderr().flush();
                self.said_at = Some(Instant::now());
            }
        } else if is_news {
            eprintln!("{}: {phase}{}", self.subject, self.remaining());
        }
        self.said = words;
    }

    /// Takes the line away.
    pub fn clear(&mut self) {
        if self.is_terminal && self.said_at.take().is_some() {
            eprint!("\r\x1b[K");
        }
        self.said.clear();
    }

    fn remaining(&self) -> String {
        let one = self.repeat + self.boot;
        let now = one.saturating_sub(self.begun.elapsed());
        let left_s = (now + one * self.left as u32).as_secs();
        if left_s >= 90 {
            format!(", about {} min left", left_s.div_ceil(60))
        } else {
            format!(", about {left_s} s left")
        }
    }
}
