//! The program's clock, which can be stopped.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::time::Instant;

/// The longest time for which a running program can leave its clock unread. Every task of a session
/// reads it several times a second, so after a longer gap the whole program was stopped. This is
/// shorter than the silence after which a vehicle counts as lost.
const STOPPED_AFTER: Duration = Duration::from_secs(2);

/// The program's clock: every `now` in the pure modules counts from its start. All clones share one clock: while it is
/// stopped, no deadline of any vehicle approaches.
#[derive(Debug, Clone)]
pub struct FleetClock {
    start: Instant,
    pauses: Arc<Mutex<ClockPauses>>,
}

#[derive(Debug, Default)]
struct ClockPauses {
    /// The start of the current pause; `None` while the clock runs.
    since: Option<Instant>,
    /// The total duration of its earlier pauses.
    before: Duration,
    /// The time of the last look at the clock; `None` if the clock runs on while the program is
    /// stopped.
    seen: Option<Instant>,
    /// How long the program has been stopped since the last report of a stop.
    stopped: Duration,
}

impl ClockPauses {
    /// Looks at the clock. If the program was stopped since the last look, that time counts as a
    /// pause.
    fn look(&mut self, at: Instant) {
        let Some(seen) = &mut self.seen else {
            return;
        };
        let unseen = at.saturating_duration_since(*seen);
        *seen = at.max(*seen);
        if self.since.is_none() && unseen > STOPPED_AFTER {
            self.before += unseen;
            self.stopped += unseen;
        }
    }
}

impl FleetClock {
    /// A clock that starts now.
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
            pauses: Arc::default(),
        }
    }

    /// The time since the start, without pauses.
    pub fn now(&self) -> Duration {
        let mut pauses = self.pauses();
        let now = Instant::now();
        pauses.look(now);
        let until = pauses.since.unwrap_or(now);
        until
            .duration_since(self.start)
            .saturating_sub(pauses.before)
    }

    /// The wall time since the start, which never stops.
    pub fn wall(&self) -> Duration {
        self.start.elapsed()
    }

    pub fn stop(&self) {
        let mut pauses = self.pauses();
        let now = Instant::now();
        pauses.look(now);
        pauses.since.get_or_insert(now);
    }

    /// Resumes the clock; returns how long it was stopped, or `None` if it was not.
    pub fn go_on(&self) -> Option<Duration> {
        let mut pauses = self.pauses();
        let now = Instant::now();
        pauses.look(now);
        let stood = pauses.since.take().map(|since| now - since);
        pauses.before += stood.unwrap_or_default();
        stood
    }

    /// Sets a stopped clock back to an earlier time, at which it stands.
    pub fn go_back(&self, to: Duration) {
        self.stop();
        let mut pauses = self.pauses();
        if let Some(since) = pauses.since {
            pauses.before = since.duration_since(self.start).saturating_sub(to);
        }
    }

    /// Sets whether time also stands still while the whole program is stopped, as by Ctrl-Z. This
    /// is right if the program itself simulates the vehicles, which are then stopped with it.
    pub fn stand_through_stops(&self, stands: bool) {
        self.pauses().seen = stands.then(Instant::now);
    }

    /// How long the program was stopped since the last call; `None` if it was not.
    pub fn take_stopped(&self) -> Option<Duration> {
        let mut pauses = self.pauses();
        pauses.look(Instant::now());
        Some(std::mem::take(&mut pauses.stopped)).filter(|stopped| !stopped.is_zero())
    }

    fn pauses(&self) -> MutexGuard<'_, ClockPauses> {
        self.pauses.lock().unwrap_or_else(PoisonError::into_inner)
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

    #[tokio::test(start_paused = true)]
    async fn a_clock_that_is_set_back_stands_there_and_goes_on_from_there() {
        let clock = FleetClock::start();
        advance(s(5)).await;
        clock.stop();
        advance(s(1)).await;
        clock.go_on();
        advance(s(20)).await;
        clock.go_back(s(5));
        advance(s(3)).await;
        assert_eq!(clock.now(), s(5));
        clock.go_on();
        advance(s(2)).await;
        assert_eq!(clock.now(), s(7));
    }

    #[tokio::test(start_paused = true)]
    async fn a_stop_of_the_whole_program_is_a_pause_where_it_also_stops_the_vehicles() {
        let clock = FleetClock::start();
        advance(s(5)).await;
        assert_eq!((clock.now(), clock.take_stopped()), (s(5), None));
        clock.stand_through_stops(true);
        advance(s(1)).await;
        assert_eq!((clock.now(), clock.take_stopped()), (s(6), None));
        let other = clock.clone();
        advance(s(60)).await;
        assert_eq!((other.now(), clock.now()), (s(6), s(6)));
        assert_eq!(clock.take_stopped(), Some(s(60)));
        assert_eq!(clock.take_stopped(), None);
        advance(s(1)).await;
        assert_eq!(clock.now(), s(7));
        // A stop within a pause belongs to the pause.
        clock.stop();
        advance(s(30)).await;
        assert_eq!((clock.take_stopped(), clock.go_on()), (None, Some(s(30))));
        clock.stand_through_stops(false);
        advance(s(60)).await;
        assert_eq!((clock.now(), clock.take_stopped()), (s(67), None));
    }
}
