//! When a frame may be drawn: not more often than wanted, and not faster than the line takes them.
//!
//! Buffers between here and the eyes (the kernel's, those of SSH) swallow far more than a slow line can carry, so a
//! write that goes through says little. Frames therefore carry a question that every terminal answers
//! (DSR, "are you well?"): the answer proves that the frame has been read. While it is outstanding for long, next to
//! nothing is sent, so that what comes next is the newest state and not a backlog.

use std::time::Duration;

/// An answer that takes longer means a slow line: from then on one frame is under way at a time.
const PATIENCE: Duration = Duration::from_millis(500);
/// A line whose last answer took longer is called slow on the screen.
const SLOW: Duration = Duration::from_secs(1);
/// A line is called slow for so long after it was.
const SLOW_FOR: Duration = Duration::from_secs(10);
/// A terminal that has not answered its first question by now never will; frames go out without.
const DEAF_AFTER: Duration = Duration::from_secs(5);
/// Bytes that may be unread while the first answer is outstanding; the frame that exceeds it is the last one.
const TRIAL_BYTES: u64 = 4000;
/// Frames while the first answer is outstanding.
const TRIAL_INTERVAL: Duration = Duration::from_secs(1);
/// An answer can be lost, as when a multiplexer changes its terminal: the question is repeated after this time.
const REPEAT_AFTER: Duration = Duration::from_secs(5);
/// A write that takes longer has met a full buffer.
const BLOCKED: Duration = Duration::from_millis(200);
/// The longest rest after a write that met one.
const LONGEST_REST: Duration = Duration::from_secs(2);
/// A write that takes longer than this has met a terminal that did not read, not a slow line.
const STALLED: Duration = Duration::from_secs(5);

/// The pace of the frames. Times are on any one clock.
#[derive(Debug, Clone)]
pub struct Pace {
    interval: Duration,
    drawn_at: Option<Duration>,
    question: Option<Question>,
    hearing: Hearing,
    /// How long the last answer took.
    delay: Duration,
    /// When the line was slow last, and what it carried, in bytes per second.
    slow: Option<(Duration, f64)>,
    rest_until: Duration,
    /// Whether one frame may go before the rest, because what the screen shows is as old as the write that blocked.
    catches_up: bool,
    /// Whether the last write met a full buffer.
    blocked: bool,
    /// Bytes sent since the last question, without its frame.
    unasked_bytes: u64,
}

#[derive(Debug, Clone, Copy)]
struct Question {
    at: Duration,
    /// When the first of those was asked that have had no answer.
    unanswered_since: Duration,
    /// What its answer proves to have been read.
    bytes: u64,
}

/// Whether the terminal answers questions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hearing {
    Unknown,
    Answers,
    Deaf,
}

impl Pace {
    /// A pace of at most so many frames a second.
    pub fn new(frames_per_s: u8) -> Self {
        Self {
            interval: Duration::from_secs(1) / u32::from(frames_per_s.max(1)),
            drawn_at: None,
            question: None,
            hearing: Hearing::Unknown,
            delay: Duration::ZERO,
            slow: None,
            rest_until: Duration::ZERO,
            catches_up: false,
            blocked: false,
            unasked_bytes: 0,
        }
    }

    /// From now on at most so many frames a second.
    pub fn limit(&mut self, frames_per_s: u8) {
        self.interval = Duration::from_secs(1) / u32::from(frames_per_s.max(1));
    }

    /// The pace of a screen that nobody reads.
    pub fn unread() -> Self {
        Self {
            interval: Duration::ZERO,
            hearing: Hearing::Deaf,
            ..Self::new(1)
        }
    }

    /// How long a frame has to wait still; zero means now. A question that is answered meanwhile may shorten it.
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

    /// Whether the next frame shall carry a question.
    pub fn asks(&self, now: Duration) -> bool {
        match (self.question, self.hearing) {
            (None, hearing) => hearing != Hearing::Deaf,
            (Some(question), Hearing::Answers) => now.saturating_sub(question.at) >= REPEAT_AFTER,
            (Some(_), _) => false,
        }
    }

    /// So many bytes have been sent, with a question at their end or without.
    pub fn drawn(&mut self, now: Duration, bytes: u64, asked: bool) {
        self.drawn_at = Some(now);
        self.catches_up = false;
        self.unasked_bytes += bytes;
        if asked {
            let bytes = std::mem::take(&mut self.unasked_bytes);
            let unanswered_since = self.question.map_or(now, |known| known.unanswered_since);
            self.question = Some(Question {
                at: now,
                unanswered_since,
                bytes,
            });
        }
        if self.hearing == Hearing::Unknown && self.overdue(now) >= DEAF_AFTER {
            self.hearing = Hearing::Deaf;
            self.question = None;
        }
    }

    /// The terminal has answered.
    pub fn answered(&mut self, now: Duration) {
        self.hearing = Hearing::Answers;
        let Some(question) = self.question.take() else {
            return;
        };
        self.delay = now.saturating_sub(question.at);
        if self.delay >= SLOW {
            let rate = question.bytes as f64 / self.delay.as_secs_f64();
            self.slow = Some((now, rate));
        } else {
            self.recover(now);
        }
    }

    /// The operating system has taken a frame, after so long. A full buffer earns the line as long a rest, which
    /// halves the load. Where it was the first, or the terminal did not read at all, the newest state goes first.
    pub fn written(&mut self, now: Duration, took: Duration, bytes: u64) {
        let blocked_before = std::mem::replace(&mut self.blocked, took >= BLOCKED);
        if took < BLOCKED {
            if self.hearing == Hearing::Deaf {
                self.recover(now);
            }
            return;
        }
        self.rest_until = now + took.min(LONGEST_REST);
        self.catches_up = !blocked_before || took >= STALLED;
        if took >= SLOW {
            self.slow = Some((now, bytes as f64 / took.as_secs_f64()));
        }
    }

    /// What a slow line carries, in bytes per second; `None` while the line keeps up.
    pub fn slow_bytes_per_s(&self) -> Option<f64> {
        self.slow.map(|(_, rate)| rate)
    }

    /// Whether an answer is outstanding that will probably come.
    pub fn expects_answer(&self) -> bool {
        self.question.is_some() && self.hearing == Hearing::Answers
    }

    /// The line has kept up; it is called slow for a while longer, because large frames are rare.
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
            Hearing::Answers if overdue >= PATIENCE || slow => REPEAT_AFTER,
            Hearing::Unknown if self.question.is_some() && self.unasked_bytes >= TRIAL_BYTES => {
                DEAF_AFTER
            }
            Hearing::Unknown if overdue >= PATIENCE => TRIAL_INTERVAL.max(self.interval),
            _ => self.interval,
        }
    }

    fn overdue(&self, now: Duration) -> Duration {
        self.question.map_or(Duration::ZERO, |question| {
            now.saturating_sub(question.unanswered_since)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Draws whenever allowed for `seconds`, against a line that carries so many bytes per second and whose terminal
    /// answers; returns frames drawn and the largest number of bytes under way.
    fn fly(pace: &mut Pace, seconds: u64, line_bytes_per_s: u64, frame_bytes: u64) -> (u32, u64) {
        let (mut frames, mut most, mut under_way) = (0, 0, 0_u64);
        let mut question_behind: Option<u64> = None;
        for millis in 0..seconds * 1000 {
            let now = Duration::from_millis(millis);
            let carried = line_bytes_per_s * (millis + 1) / 1000 - line_bytes_per_s * millis / 1000;
            under_way = under_way.saturating_sub(carried);
            question_behind = question_behind.map(|behind| behind.saturating_sub(carried));
            if question_behind == Some(0) {
                question_behind = None;
                pace.answered(now);
            }
            if pace.wait(now).is_zero() {
                let asks = pace.asks(now);
                under_way += frame_bytes;
                frames += 1;
                pace.drawn(now, frame_bytes, asks);
                if asks {
                    question_behind = Some(under_way);
                }
            }
            most = most.max(under_way);
        }
        (frames, most)
    }

    #[test]
    fn a_fast_line_gets_every_frame_that_is_wanted() {
        for wanted in [1, 10, 30] {
            let (frames, _) = fly(&mut Pace::new(wanted), 10, 1_000_000, 400);
            let expected = u32::from(wanted) * 10;
            assert!(
                (expected * 9 / 10..=expected).contains(&frames),
                "{frames} of {expected}"
            );
        }
    }

    #[test]
    fn a_slow_line_never_has_a_backlog_to_work_off() {
        let mut pace = Pace::new(10);
        let (_, most) = fly(&mut pace, 60, 1000, 400);
        assert!(most <= 3000, "{most} bytes were under way");
        let mut pace = Pace::new(10);
        let (_, most) = fly(&mut pace, 60, 1000, 2000);
        assert!(most <= 14_000, "{most} bytes were under way");
        let rate = pace.slow_bytes_per_s().expect("frames of two seconds");
        assert!((900.0..1100.0).contains(&rate), "{rate}");
    }

    #[test]
    fn a_stalled_terminal_gets_next_to_nothing_and_then_everything() {
        let mut pace = Pace::new(10);
        fly(&mut pace, 5, 1_000_000, 400);
        let mut frames = 0;
        let stalled_at = Duration::from_secs(5);
        for millis in 0..30_000 {
            let now = stalled_at + Duration::from_millis(millis);
            if pace.wait(now).is_zero() {
                pace.drawn(now, 400, pace.asks(now));
                frames += 1;
            }
        }
        assert!(frames <= 12, "{frames} frames wait to be read");
        let now = stalled_at + Duration::from_secs(30);
        pace.answered(now);
        assert!(pace.wait(now + Duration::from_millis(100)).is_zero());
    }

    #[test]
    fn a_terminal_that_answers_nothing_is_drawn_on_at_full_pace_after_a_while() {
        let mut pace = Pace::new(10);
        let (frames, _) = fly(&mut pace, 5, 0, 400);
        assert!(frames <= 11, "{frames}: trial first");
        let now = Duration::from_secs(6);
        pace.drawn(now, 400, pace.asks(now));
        assert_eq!(pace.wait(now), Duration::from_millis(100));
        assert!(!pace.asks(now), "it has been asked often enough");
    }

    #[test]
    fn a_terminal_that_has_not_answered_yet_has_little_to_read() {
        for (frame_bytes, most_bytes) in [(400, 4400), (1500, 5500), (6000, 6500)] {
            let mut pace = Pace::new(10);
            pace.drawn(Duration::ZERO, 50, true);
            let (_, most) = fly(&mut pace, 5, 0, frame_bytes);
            assert!(most <= most_bytes, "{most} bytes of {frame_bytes} each");
        }
    }

    #[test]
    fn an_answer_that_comes_late_is_believed() {
        let mut pace = Pace::new(10);
        pace.drawn(Duration::ZERO, 400, true);
        let now = Duration::from_secs(7);
        pace.drawn(now, 400, pace.asks(now));
        assert!(!pace.asks(now), "taken for deaf");
        pace.answered(now);
        assert!(pace.asks(now));
    }

    #[test]
    fn after_a_stall_the_newest_state_follows_at_once_and_only_then_a_rest() {
        let mut pace = Pace::new(10);
        pace.drawn(Duration::from_secs(70), 3000, false);
        let now = Duration::from_secs(100);
        pace.written(now, Duration::from_secs(30), 3000);
        assert_eq!(pace.wait(now), Duration::ZERO);
        pace.drawn(now, 3000, false);
        pace.written(now, Duration::from_millis(1), 3000);
        assert_eq!(pace.wait(now), LONGEST_REST);
    }

    #[test]
    fn a_line_on_which_write_after_write_meets_a_full_buffer_rests_after_each() {
        let mut pace = Pace::new(10);
        pace.drawn(Duration::from_secs(8), 3000, false);
        pace.written(Duration::from_secs(10), Duration::from_secs(2), 3000);
        assert_eq!(pace.slow_bytes_per_s(), Some(1500.0));
        pace.drawn(Duration::from_secs(10), 3000, false);
        let now = Duration::from_secs(11);
        pace.written(now, Duration::from_secs(1), 3000);
        assert_eq!(pace.wait(now), Duration::from_secs(1));
    }
}
