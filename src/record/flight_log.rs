//! The log of a flight in progress: data not yet written to its files.

use std::time::Duration;

use super::{Happening, JournalLine};
use crate::wire::{Anatomy, is_secret};

/// Frames and lines of a flight that have not been written yet.
#[derive(Debug)]
pub struct FlightLog {
    began_unix_us: u64,
    /// The time of the last frame or line, from the beginning of the flight.
    last_at: Duration,
    frames: Vec<u8>,
    lines: String,
}

impl FlightLog {
    /// The log of a flight that begins at a time of day, in microseconds since 1970 (UTC).
    pub fn new(began_unix_us: u64) -> Self {
        Self {
            began_unix_us,
            last_at: Duration::ZERO,
            frames: Vec::new(),
            lines: String::new(),
        }
    }

    /// Adds a frame, unless it contains a secret. A time earlier than that of the last entry is
    /// raised to it.
    pub fn note_frame(&mut self, at: Duration, frame: &[u8]) {
        self.last_at = self.last_at.max(at);
        let since = u64::try_from(self.last_at.as_micros()).unwrap_or(u64::MAX);
        push_frame(
            &mut self.frames,
            self.began_unix_us.saturating_add(since),
            frame,
        );
    }

    /// Adds a line to the journal. A time earlier than that of the last entry is raised to it.
    pub fn note(&mut self, at: Duration, what: Happening) {
        self.last_at = self.last_at.max(at);
        let line = JournalLine::new(self.last_at, what);
        self.lines.push_str(&line.to_line());
    }

    /// Notes that the flight was flown to its end.
    pub fn end(&mut self) {
        self.note(self.last_at, Happening::End);
    }

    pub fn waiting(&self) -> usize {
        self.frames.len() + self.lines.len()
    }

    /// The entries of a tlog since the last call.
    pub fn take_frames(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.frames)
    }

    /// The lines of the journal since the last call.
    pub fn take_lines(&mut self) -> String {
        std::mem::take(&mut self.lines)
    }
}

/// Appends a frame to the entries of a tlog, unless it contains a secret. The time is in microseconds since 1970 (UTC).
pub fn push_frame(entries: &mut Vec<u8>, unix_us: u64, frame: &[u8]) {
    if Anatomy::of(frame).is_some_and(|it| is_secret(it.id)) {
        return;
    }
    entries.extend_from_slice(&unix_us.to_be_bytes());
    entries.extend_from_slice(frame);
}
