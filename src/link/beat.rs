//! Periodic work of a link.

use std::time::Duration;

use tokio::time::{Instant, Interval, MissedTickBehavior, interval};

/// The timing of a periodic action.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeatPace {
    /// The time after which the action is done along with other work.
    pub handy: Duration,
    /// The time after which the action wakes the task.
    pub latest: Duration,
}

/// A periodic action. Waking a task costs far more than most of the work, and tokio's timers often wake it twice. A
/// link with telemetry is awake often enough without a timer.
#[derive(Debug)]
pub(super) struct LinkBeat {
    pace: BeatPace,
    last: Instant,
    timer: Interval,
}

impl LinkBeat {
    /// A new action: [`due`](Self::due) returns at once the first time;
    /// [`is_handy`](Self::is_handy) is true only after [`BeatPace::handy`].
    pub fn new(pace: BeatPace) -> Self {
        let mut timer = interval(pace.latest);
        timer.set_missed_tick_behavior(MissedTickBehavior::Skip);
        let last = Instant::now();
        Self { pace, last, timer }
    }

    /// Makes the action due at once.
    pub fn hasten(&mut self) {
        self.timer.reset_immediately();
    }

    /// Whether the action should be done now that the task is awake; if so, restarts the interval.
    pub fn is_handy(&mut self, now: Instant) -> bool {
        let is_handy = now.duration_since(self.last) >= self.pace.handy;
        if is_handy {
            self.last = now;
            self.timer.reset();
        }
        is_handy
    }

    /// Waits until the action is overdue. Cancel-safe.
    pub async fn due(&mut self) {
        self.timer.tick().await;
        self.last = Instant::now();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tokio::time::{advance, timeout};

    const PACE: BeatPace = BeatPace {
        handy: ms(200),
        latest: ms(300),
    };

    const fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[tokio::test(start_paused = true)]
    async fn a_task_that_is_awake_often_is_never_woken_by_its_beat() {
        let mut beat = LinkBeat::new(PACE);
        beat.due().await;
        let mut done = 0;
        for _ in 0..100 {
            let woken = timeout(ms(100), beat.due()).await;
            assert!(woken.is_err(), "after {done}");
            done += usize::from(beat.is_handy(Instant::now()));
        }
        assert_eq!(done, 50);
    }

    #[tokio::test(start_paused = true)]
    async fn a_task_that_nothing_else_wakes_is_woken_at_the_latest_time() {
        let mut beat = LinkBeat::new(PACE);
        beat.due().await;
        let start = Instant::now();
        beat.due().await;
        assert!(!beat.is_handy(Instant::now()), "it has just been done");
        beat.due().await;
        assert_eq!(start.elapsed(), ms(600));
        advance(ms(250)).await;
        assert!(beat.is_handy(Instant::now()));
        beat.due().await;
        assert_eq!(start.elapsed(), ms(1150), "counted from when it was handy");
    }

    #[tokio::test(start_paused = true)]
    async fn what_is_hastened_is_due_at_once() {
        let mut beat = LinkBeat::new(PACE);
        beat.due().await;
        let start = Instant::now();
        beat.hasten();
        beat.due().await;
        assert_eq!(start.elapsed(), Duration::ZERO);
    }
}
