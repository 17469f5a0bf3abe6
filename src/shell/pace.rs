//! The console's ticks: the faster simulated time runs, the more frequent they are.

use std::time::Duration;

use tokio::time::{Interval, MissedTickBehavior};

/// The simulated time between two ticks, in which telemetry is collected and missions are stepped: a mission gets the
/// same detail at any speed-up.
pub(super) const TICK: Duration = Duration::from_millis(100);
/// The minimum time between two ticks, at any speed-up.
const LEAST_TICK: Duration = Duration::from_millis(5);

/// The ticks of a console.
#[derive(Debug)]
pub(super) struct Pace {
    ticks: Interval,
}

impl Pace {
    /// The ticks of a flight at a speed-up.
    pub fn of(speedup: f64) -> Self {
        let mut ticks = tokio::time::interval(tick_every(speedup));
        ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
        Self { ticks }
    }

    /// Adjusts the ticks to a new speed-up.
    pub fn keep(&mut self, speedup: f64) {
        if self.ticks.period() != tick_every(speedup) {
            *self = Self::of(speedup);
        }
    }

    /// Waits for the next tick.
    pub async fn tick(&mut self) {
        self.ticks.tick().await;
    }
}

fn tick_every(speedup: f64) -> Duration {
    TICK.div_f64(speedup.max(1.0)).max(LEAST_TICK)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At a speed-up of 20, a tick of 100 ms would show a mission its vehicles only every other second.
    #[tokio::test]
    async fn a_mission_sees_as_much_of_its_vehicles_at_any_speedup() {
        for (speedup, every_ms) in [(0.5, 100), (1.0, 100), (4.0, 25), (20.0, 5), (1000.0, 5)] {
            assert_eq!(
                Pace::of(speedup).ticks.period(),
                Duration::from_millis(every_ms),
                "{speedup}"
            );
        }
    }
}
