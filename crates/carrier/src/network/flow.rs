//! What the two sides of a connection have sent and taken, in numbers.

use super::frame::{Frame, FrameKind};

/// The maximum number of lines that are sent before the other side has taken the first of them. With lines of the
/// maximum length, each in two batches of Zenoh, these fit into the queue of a link.
pub(super) const WINDOW: u64 = 6;

/// One side's counters.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Flow {
    /// Frames sent.
    sent: u64,
    /// Frames received.
    received: u64,
    lines_sent: u64,
    /// Of the lines sent, those that the other side has taken.
    lines_accepted: u64,
    lines_received: u64,
    /// Of the lines received, those that the console has taken.
    lines_taken: u64,
    /// What the other side knows of `lines_taken`.
    told: u64,
}

impl Flow {
    /// Whether a line may be sent now.
    pub fn has_room(&self) -> bool {
        self.lines_sent - self.lines_accepted < WINDOW
    }

    /// The next frame to send.
    pub fn frame(&mut self, kind: FrameKind, body: Vec<u8>) -> Frame {
        let frame = Frame {
            kind,
            number: self.sent,
            taken: self.lines_taken,
            body,
        };
        self.sent += 1;
        self.told = self.lines_taken;
        self.lines_sent += u64::from(kind == FrameKind::Line);
        frame
    }

    /// Takes in the counters of a frame; `false` if it is not the next one, or claims what cannot be.
    pub fn admit(&mut self, frame: &Frame) -> bool {
        let is_line = u64::from(frame.kind == FrameKind::Line);
        let is_next = frame.number == self.received;
        let is_true = (self.lines_accepted..=self.lines_sent).contains(&frame.taken);
        let has_room = self.lines_received + is_line - self.lines_taken <= WINDOW;
        if !(is_next && is_true && has_room) {
            return false;
        }
        self.received += 1;
        self.lines_received += is_line;
        self.lines_accepted = frame.taken;
        true
    }

    /// The console has taken a line.
    pub fn take(&mut self) {
        self.lines_taken += 1;
    }

    /// Whether the other side should hear now how many lines were taken.
    pub fn has_to_tell(&self) -> bool {
        self.lines_taken - self.told >= WINDOW / 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(flow: &mut Flow) -> Frame {
        flow.frame(FrameKind::Line, Vec::new())
    }

    #[test]
    fn a_sender_waits_until_its_lines_are_taken() {
        let (mut from, mut to) = (Flow::default(), Flow::default());
        for _ in 0..WINDOW {
            assert!(from.has_room());
            assert!(to.admit(&line(&mut from)));
        }
        assert!(!from.has_room());
        for taken in 1..=WINDOW / 2 {
            assert!(!to.has_to_tell(), "{taken}");
            to.take();
        }
        assert!(to.has_to_tell());
        assert!(from.admit(&to.frame(FrameKind::KeepAlive, Vec::new())));
        assert!(from.has_room() && !to.has_to_tell());
    }

    #[test]
    fn what_is_repeated_missing_or_untrue_is_not_admitted() {
        let (mut from, mut to) = (Flow::default(), Flow::default());
        let first = line(&mut from);
        let second = line(&mut from);
        let third = line(&mut from);
        assert!(!to.admit(&second), "the first is missing");
        assert!(to.admit(&first));
        assert!(!to.admit(&first), "repeated");
        assert!(!to.admit(&third), "the second is missing");
        let untrue = Frame { taken: 1, ..second };
        assert!(!to.admit(&untrue), "it sent no line");
    }

    #[test]
    fn who_sends_more_than_the_window_is_not_admitted() {
        let (mut from, mut to) = (Flow::default(), Flow::default());
        for _ in 0..WINDOW {
            assert!(to.admit(&line(&mut from)));
        }
        assert!(!to.admit(&line(&mut from)));
    }
}
