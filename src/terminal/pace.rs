//! Decides when a frame may be drawn: no more often than configured, and no faster than the line
//! carries.
//!
//! Buffers on the way to the terminal (the kernel's, those of SSH) accept far more than a slow line
//! can carry, so a completed write proves little. Frames therefore end with a query that every
//! terminal answers (DSR, device status): the answer proves that the frame has been read. While an
//! answer is late, almost nothing is sent, so the next frame shows the newest state and not a
//! backlog.

use std::time::Duration;

/// An answer slower than this means a slow line: from then on only one frame is in transit at a
/// time.
const PATIENCE: Duration = Duration::from_millis(500);
/// If the last answer was slower than this, the screen reports a slow line.
const SLOW: Duration = Duration::from_secs(1);
/// How long a line is reported as slow after its last slow answer.
const SLOW_FOR: Duration = Duration::from_secs(10);
/// A terminal that has not answered its first query within this time never will; frames are then
/// sent without queries.
const DEAF_AFTER: Duration = Duration::from_secs(5);
/// The number of bytes that may be sent while the first answer is outstanding; after the frame that
/// reaches it, none is sent until the terminal answers or counts as deaf.
const TRIAL_BYTES: u64 = 4000;
/// The minimum interval between frames while the first answer is late.
const TRIAL_INTERVAL: Duration = Duration::from_secs(1);
/// The minimum number of bytes from which a rate follows: with fewer, a late answer shows only that the terminal, or the
/// console itself, was busy.
const MEASURED_BYTES: u64 = 256;
/// How long until a query is repeated: an answer can be lost, as when a multiplexer changes its
/// terminal.
const REPEAT_AFTER: Duration = Duration::from_secs(5);
/// A write that takes longer than this has met a full buffer.
const BLOCKED: Duration = Duration::from_millis(200);
/// The longest pause after a write to a full buffer.
const LONGEST_REST: Duration = Duration::from_secs(2);
/// The minimum interval between frames caused by keys, so that fast typing does not cause too many
/// frames.
const KEY_INTERVAL: Duration = Duration::from_micros(1_000_000 / 120);
/// A write that takes longer than this was blocked by a terminal that did not read, not by a slow
/// line.
const STALLED: Duration = Duration::from_secs(5);

/// The pace of the frames. All times are from the same clock.
#[derive(Debug, Clone)]
pub struct Pace {
    interval: Duration,
    drawn_at: Option<Duration>,
    question: Option<TerminalQuery>,
    hearing: QueryHearing,
    /// How long the last answer took.
    delay: Duration,
    /// When the line was last slow, and its bytes per second.
    slow: Option<(Duration, f64)>,
    rest_until: Duration,
    /// Whether one frame may be sent early, because the screen still shows the state of the blocked
    /// write.
    catches_up: bool,
    /// Whether the last write met a full buffer.
    blocked: bool,
    /// The number of bytes sent since the frame with the last query.
    unasked_bytes: u64,
    /// Whether a key press has not been shown by a frame yet.
    has_key: bool,
}

#[derive(Debug, Clone, Copy)]
struct TerminalQuery {
    at: Duration,
    unanswered_since: Duration,
    /// The number of bytes that the query's answer confirms as read.
    bytes: u64,
}

/// Whether the terminal answers queries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum QueryHearing {
    Unknown,
    Answers,
    Deaf,
}

impl Pace {
    /// A pace with a limit of frames per second.
    pub fn new(frames_per_s: u8) -> Self {
        Self {
            interval: Duration::from_secs(1) / u32::from(frames_per_s.max(1)),
            drawn_at: None,
            question: None,
            hearing: QueryHearing::Unknown,
            delay: Duration::ZERO,
            slow: None,
            rest_until: Duration::ZERO,
            catches_up: false,
            blocked: false,
            unasked_bytes: 0,
            has_key: false,
        }
    }

    /// Limits the frames per second.
    pub fn limit(&mut self, frames_per_s: u8) {
        self.interval = Duration::from_secs(1) / u32::from(frames_per_s.max(1));
    }

    /// The pace of a screen whose output is not read.
    pub fn unread() -> Self {
        Self {
            interval: Duration::ZERO,
            hearing: QueryHearing::Deaf,
            ..Self::new(1)
        }
    }

    /// Notes a key press: if the line keeps up, the next frame is drawn without its usual interval.
    pub fn pressed(&mut self) {
        self.has_key = true;
    }

    /// How long to wait before the next frame; zero if it may be drawn now. An answer in the
    /// meantime may shorten the wait.
    pub fn wait(&self, now: Duration) -> Duration {
        let Some(drawn_at) = self.drawn_at else {
            return Duration::ZERO;
        };
        let due = drawn_at + self.interval_at(now);
        let rest = if self.catches_up {
            Duration::ZERO
        } else {
            self.rest_until
        };
        due.max(rest).saturating_sub(now)
    }

    /// Whether the next frame should end with a query.
    pub fn asks(&self, now: Duration) -> bool {
        match (self.question, self.hearing) {
            (None, hearing) => hearing != QueryHearing::Deaf,
            (Some(question), QueryHearing::Answers) => {
                now.saturating_sub(question.at) >= REPEAT_AFTER
            }
            (Some(_), _) => false,
        }
    }

    /// Notes that bytes have been sent, with or without a query at their end.
    pub fn drawn(&mut self, now: Duration, bytes: u64, asked: bool) {
        self.drawn_at = Some(now);
        self.has_key = false;
        self.catches_up = false;
        self.unasked_bytes += bytes;
        if asked {
            let bytes = std::mem::take(&mut self.unasked_bytes);
            let unanswered_since = self.question.map_or(now, |known| known.unanswered_since);
            self.question = Some(TerminalQuery {
                at: now,
                unanswered_since,
                bytes,
            });
        }
        if self.hearing == QueryHearing::Unknown && self.overdue(now) >= DEAF_AFTER {
            self.hearing = QueryHearing::Deaf;
            self.question = None;
        }
    }

    /// Notes an answer from the terminal.
    pub fn answered(&mut self, now: Duration) {
        let is_first = self.hearing != QueryHearing::Answers;
        self.hearing = QueryHearing::Answers;
        let Some(question) = self.question.take() else {
            return;
        };
        self.delay = now.saturating_sub(question.at);
        if self.delay < SLOW {
            self.recover(now);
        } else if !is_first {
            // While the console starts, answers wait for it and not for the line.
            self.measure(now, question.bytes, self.delay);
        }
    }

    /// Notes that the operating system has accepted a frame, and how long that took. After a write
    /// to a full buffer the line rests for the same time, at most `LONGEST_REST`, which halves the
    /// load. After the first such write, or if the terminal did not read at all, the newest state
    /// is sent before the line rests.
    pub fn written(&mut self, now: Duration, took: Duration, bytes: u64) {
        let blocked_before = std::mem::replace(&mut self.blocked, took >= BLOCKED);
        if took < BLOCKED {
            if self.hearing == QueryHearing::Deaf {
                self.recover(now);
            }
            return;
        }
        self.rest_until = now + took.min(LONGEST_REST);
        self.catches_up = !blocked_before || took >= STALLED;
        if took >= SLOW {
            self.measure(now, bytes, took);
        }
    }

    fn measure(&mut self, now: Duration, bytes: u64, took: Duration) {
        if bytes >= MEASURED_BYTES {
            self.slow = Some((now, bytes as f64 / took.as_secs_f64()));
        }
    }

    /// The bytes per second of a slow line; `None` while the line keeps up.
    pub fn slow_bytes_per_s(&self) -> Option<f64> {
        self.slow.map(|(_, rate)| rate)
    }

    /// Whether an answer is outstanding that will probably arrive.
    pub fn expects_answer(&self) -> bool {
        self.question.is_some() && self.hearing == QueryHearing::Answers
    }

    /// Notes that the line has kept up; it is reported as slow for a while longer, because large frames are rare.
    fn recover(&mut self, now: Duration) {
        if self
            .slow
            .is_some_and(|(at, _)| now.saturating_sub(at) >= SLOW_FOR)
        {
            self.slow = None;
        }
    }

    fn interval_at(&self, now: Duration) -> Duration {
        let overdue = self.overdue(now);
        let slow = self.question.is_some() && self.delay >= PATIENCE;
        match self.hearing {
            QueryHearing::Answers if overdue >= PATIENCE || slow => REPEAT_AFTER,
            QueryHearing::Unknown
                if self.question.is_some() && self.unasked_bytes >= TRIAL_BYTES =>
            {
                DEAF_AFTER
            }
            QueryHearing::Unknown if overdue >= PATIENCE => TRIAL_INTERVAL.max(self.interval),
            _ if self.has_key => self.interval.min(KEY_INTERVAL),
            QueryHearing::Unknown | QueryHearing::Answers | QueryHearing::Deaf => self.interval,
        }
    }

    fn overdue(&self, now: Duration) -> Duration {
        self.question.map_or(Duration::ZERO, |question| {
            now.saturating_sub(question.unanswered_since)
        })
    }
}

#[cfg(test)]
mod tests;
