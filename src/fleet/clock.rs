//! The program's clock, which can be stopped.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::Instant;

/// The program's clock: every `now` in the pure modules counts from its start. All clones share one clock: while it is
/// stopped, no deadline of any vehicle approaches.
#[derive(Debug, Clone)]
pub struct FleetClock {
    start: Instant,
    stand: Arc<watch::Sender<ClockPauses>>,
}

/// The current pause of a clock, and the sum of the earlier ones.
#[derive(Debug, Clone, Copy, Default)]
struct ClockPauses {
    /// The start of the current pause; `None` while the clock runs.
    since: Option<Instant>,
    /// The duration of its earlier pauses, altogether.
    before: Duration,
}

impl FleetClock {
    /// A clock that starts now.
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
            stand: Arc::new(watch::Sender::new(ClockPauses::default())),
        }
    }

    /// The time since the start, without pauses.
    pub fn now(&self) -> Duration {
        let stand = *self.stand.borrow();
        let until = stand.since.unwrap_or_else(Instant::now);
        until
            .duration_since(self.start)
            .saturating_sub(stand.before)
    }

    /// The wall time since the start, which never stops.
    pub fn wall(&self) -> Duration {
        self.start.elapsed()
    }

    pub fn stop(&self) {
        self.stand.send_modify(|stand| {
            stand.since.get_or_insert_with(Instant::now);
        });
    }

    /// Resumes the clock; returns how long it was stopped, or `None` if it was not.
    pub fn go_on(&self) -> Option<Duration> {
        let mut stood = None;
        self.stand.send_modify(|stand| {
            stood = stand.since.take().map(|since| since.elapsed());
            stand.before += stood.unwrap_or_default();
        });
        stood
    }
}

#[cfg(test)]
mod tests {
    use tokio::time::advance;

    use super::*;

    const fn s(s: u64) -> Duration {
        Duration::from_secs(s)
    }

    #[tokio::test(start_paused = true)]
    async fn a_clock_that_is_stopped_stands_still_for_everybody_and_says_for_how_long() {
        let clock = FleetClock::start();
        let other = clock.clone();
        advance(s(5)).await;
        clock.stop();
        advance(s(10)).await;
        clock.stop();
        advance(s(2)).await;
        assert_eq!((clock.now(), other.now()), (s(5), s(5)));
        assert_eq!(other.go_on(), Some(s(12)));
        advance(s(3)).await;
        assert_eq!((clock.now(), other.now()), (s(8), s(8)));
        assert_eq!(clock.go_on(), None);
        clock.stop();
        advance(s(1)).await;
        assert_eq!(clock.now(), s(8));
    }
}
