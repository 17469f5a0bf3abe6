//! Statistics of one kind of message since the last reset.

use std::time::Duration;

use super::Rate;

/// Counts and intervals of one kind of message since the last reset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MessageStatistics {
    pub count: u64,
    /// Their total size on the wire, in bytes.
    pub bytes: u64,
    /// The time of the reset, or of the first message if it came later.
    since: Duration,
    last_at: Option<Duration>,
    /// The mean interval, in seconds.
    mean_s: f64,
    /// The sum of the squared differences from the mean, in s² (Welford's method).
    squares_s2: f64,
    longest_interval: Duration,
    /// The time from the reset to the first message.
    initial_silence: Duration,
}

impl MessageStatistics {
    pub(super) fn new(since: Duration) -> Self {
        Self {
            since,
            ..Self::default()
        }
    }

    pub(super) fn note(&mut self, len: usize, now: Duration) {
        self.bytes += len as u64;
        self.count += 1;
        let Some(last) = self.last_at.replace(now) else {
            self.initial_silence = now.saturating_sub(self.since);
            return;
        };
        let interval = now.saturating_sub(last);
        self.longest_interval = self.longest_interval.max(interval);
        let interval_s = interval.as_secs_f64();
        let difference = interval_s - self.mean_s;
        self.mean_s += difference / (self.count - 1) as f64;
        self.squares_s2 += difference * (interval_s - self.mean_s);
    }

    /// The time that the statistics cover.
    pub fn window(&self, now: Duration) -> Duration {
        now.saturating_sub(self.since)
    }

    /// The mean rate over the window, which counts as at least one second long.
    pub fn rate(&self, now: Duration) -> Rate {
        let seconds = self.window(now).as_secs_f64().max(1.0);
        Rate {
            hz: self.count as f64 / seconds,
            bytes_s: self.bytes as f64 / seconds,
        }
    }

    /// The mean of the intervals; `None` before the second message.
    pub fn mean_interval(&self) -> Option<Duration> {
        (self.count > 1).then(|| Duration::from_secs_f64(self.mean_s.max(0.0)))
    }

    /// The standard deviation of the intervals; `None` before the third message.
    pub fn jitter(&self) -> Option<Duration> {
        let intervals = self.count.checked_sub(1).filter(|count| *count > 1)?;
        let variance = self.squares_s2 / (intervals - 1) as f64;
        Some(Duration::from_secs_f64(variance.max(0.0).sqrt()))
    }

    /// The longest interval between two messages; `None` before the second one.
    pub fn longest_interval(&self) -> Option<Duration> {
        (self.count > 1).then_some(self.longest_interval)
    }

    /// The longest time without a message, including the present one.
    pub fn longest_silence(&self, now: Duration) -> Duration {
        let present = now.saturating_sub(self.last_at.unwrap_or(self.since));
        present.max(self.longest_interval).max(self.initial_silence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(milliseconds: u64) -> Duration {
        Duration::from_millis(milliseconds)
    }

    fn of(times_ms: &[u64]) -> MessageStatistics {
        let mut statistics = MessageStatistics::new(Duration::ZERO);
        for &at in times_ms {
            statistics.note(20, ms(at));
        }
        statistics
    }

    #[test]
    fn an_even_message_has_its_rate_and_no_jitter() {
        let times: Vec<u64> = (0..100).map(|count| count * 100).collect();
        let even = of(&times);
        let Rate { hz, bytes_s } = even.rate(ms(10_000));
        assert!((hz - 10.0).abs() < 1e-9 && (bytes_s - 200.0).abs() < 1e-9);
        assert_eq!(even.mean_interval(), Some(ms(100)));
        assert!(even.jitter().expect("enough") < Duration::from_nanos(10));
        assert_eq!(even.longest_interval(), Some(ms(100)));
        assert_eq!(even.longest_silence(ms(9_950)), ms(100));
        assert_eq!(
            even.longest_silence(ms(12_000)),
            ms(2_100),
            "it has stopped"
        );
    }

    #[test]
    fn jitter_is_the_standard_deviation_of_the_intervals() {
        // Intervals of 100, 300, 200 and 200 ms: the mean is 200, the sum of squares 20000.
        let uneven = of(&[1000, 1100, 1400, 1600, 1800]);
        let jitter = uneven.jitter().expect("enough").as_secs_f64();
        assert!((jitter - (0.02_f64 / 3.0).sqrt()).abs() < 1e-9, "{jitter}");
        assert_eq!(uneven.longest_interval(), Some(ms(300)));
        assert_eq!(
            uneven.longest_silence(ms(1800)),
            ms(1000),
            "before the first"
        );
    }

    #[test]
    fn too_few_messages_have_no_intervals() {
        for (times, mean, jitter) in [
            (&[][..], false, false),
            (&[5], false, false),
            (&[5, 9], true, false),
        ] {
            let few = of(times);
            assert_eq!(few.mean_interval().is_some(), mean);
            assert_eq!(few.longest_interval().is_some(), mean);
            assert_eq!(few.jitter().is_some(), jitter);
        }
    }
}
