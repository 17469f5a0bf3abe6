//! The use of a vehicle's time in the air: whether it has a task, and how long it needs no attention from its operator.

use std::time::Duration;

use super::TICK;
use crate::geo::maths;
use crate::scoring::{IDLE_AFTER, SwarmTimes, VehicleLoad, VehicleUse};
use crate::vehicle::VehicleId;

/// Movement within this distance counts as standing still: a vehicle drifts with the wind and its receiver's errors.
const STILL_WITHIN_M: f64 = 2.0;
/// A stop of up to this length is part of a task: a turn, a look, a sample.
const PAUSE: Duration = Duration::from_secs(10);
/// How long a hovering vehicle may take to start moving after a command.
const START: Duration = Duration::from_secs(3);

/// The observation of a vehicle in one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UsageLook {
    /// Metres east, north and up, while it is in the air and not lost.
    pub airborne_at: Option<[f64; 3]>,
    /// Whether it has a task even while standing still: sampling, or keeping its place in a formation.
    pub busy: bool,
    /// Whether it got a command in this tick.
    pub commanded: bool,
}

/// The time account of one vehicle.
#[derive(Debug, Clone)]
pub(crate) struct VehicleUsage {
    totals: VehicleUse,
    /// The place where it stands still, and how long it has stood there.
    anchor: [f64; 3],
    still_for: Duration,
    /// How long it has been productive since its last command; `None` if it is not.
    neglected_for: Option<Duration>,
    /// How long it has been waiting for its next command; `None` if it is not.
    waiting_for: Option<Duration>,
    /// The total time in the air in which it was productive after a command, and the total in which
    /// it waited for one.
    neglected: Duration,
    waited: Duration,
}

impl VehicleUsage {
    pub fn new(vehicle: VehicleId) -> Self {
        Self {
            totals: VehicleUse {
                vehicle,
                ..VehicleUse::default()
            },
            anchor: [f64::INFINITY; 3],
            still_for: Duration::ZERO,
            neglected_for: None,
            waiting_for: None,
            neglected: Duration::ZERO,
            waited: Duration::ZERO,
        }
    }

    /// The totals so far.
    pub fn totals(&self) -> VehicleUse {
        self.totals
    }

    /// Its totals so far, for the workload of its operator.
    pub fn load(&self) -> VehicleLoad {
        VehicleLoad {
            waiting: u16::from(self.waiting_for.is_some()),
            neglected: self.neglected,
            waited: self.waited,
        }
    }

    /// Advances by a tick.
    pub fn step(&mut self, look: UsageLook, times: &mut SwarmTimes) {
        let Some(at) = look.airborne_at else {
            times.neglected.extend(self.neglected_for.take());
            self.waiting_for = None;
            self.anchor = [f64::INFINITY; 3];
            return;
        };
        let moved = self.anchor.iter().zip(at);
        let moved_m = moved
            .map(|(a, b)| maths::powi(a - b, 2))
            .sum::<f64>()
            .sqrt();
        if look.busy || moved_m.is_nan() || moved_m > STILL_WITHIN_M {
            self.anchor = at;
            self.still_for = Duration::ZERO;
        } else {
            self.still_for += TICK;
        }
        let productive = self.still_for <= PAUSE;
        self.totals.airborne += TICK;
        if productive {
            self.totals.productive += TICK;
        }
        if self.still_for > IDLE_AFTER {
            self.totals.idle += TICK;
        }
        self.keep_times(productive, look.commanded, times);
    }

    /// Whether it has just got a command and may not have started to move yet.
    fn is_starting(&self) -> bool {
        self.neglected_for.is_some_and(|since| since < START)
    }

    fn keep_times(&mut self, productive: bool, commanded: bool, times: &mut SwarmTimes) {
        if commanded {
            times.neglected.extend(self.neglected_for.take());
            times.waited.extend(self.waiting_for.take());
            self.neglected_for = Some(Duration::ZERO);
        } else if productive || self.is_starting() {
            self.waiting_for = None;
            if let Some(neglected_for) = &mut self.neglected_for {
                *neglected_for += TICK;
                self.neglected += TICK;
            }
        } else {
            times.neglected.extend(self.neglected_for.take());
            *self.waiting_for.get_or_insert_default() += TICK;
            self.waited += TICK;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(
        usage: &mut VehicleUsage,
        times: &mut SwarmTimes,
        seconds: u32,
        at: impl Fn(f64) -> f64,
    ) {
        for tick in 0..seconds * 10 {
            let look = UsageLook {
                airborne_at: Some([at(f64::from(tick) / 10.0), 0.0, 20.0]),
                busy: false,
                commanded: tick == 0,
            };
            usage.step(look, times);
        }
    }

    #[test]
    fn a_vehicle_that_hovers_is_productive_for_a_pause_and_idle_after_half_a_minute() {
        let (mut usage, mut times) = (VehicleUsage::new(1), SwarmTimes::default());
        step(&mut usage, &mut times, 20, |t| 3.0 * t);
        step(&mut usage, &mut times, 60, |t| 60.0 + 0.5 * maths::sin(t));
        let totals = usage.totals();
        assert_eq!(totals.airborne, Duration::from_secs(80));
        let near = |time: Duration, seconds: f64| (time.as_secs_f64() - seconds).abs() < 1.5;
        assert!(near(totals.productive, 30.0), "{totals:?}");
        assert!(near(totals.idle, 30.0), "{totals:?}");
        // The next command ends the wait.
        step(&mut usage, &mut times, 1, |_| 60.0);
        assert!(near(times.neglected[0], 20.0) && near(times.neglected[1], 10.0));
        assert!(near(times.waited[0], 50.0), "{times:?}");
    }

    #[test]
    fn a_vehicle_that_hovered_works_on_its_own_after_its_next_command() {
        let (mut usage, mut times) = (VehicleUsage::new(1), SwarmTimes::default());
        step(&mut usage, &mut times, 40, |_| 0.0);
        let before = usage.load().neglected;
        // The vehicle needs a second to start moving.
        step(&mut usage, &mut times, 31, |t| (t - 1.0).max(0.0) * 4.0);
        let worked = usage.load().neglected.saturating_sub(before);
        assert!(worked > Duration::from_secs(30), "{worked:?}");
    }

    #[test]
    fn a_slow_sweep_is_no_hovering() {
        let (mut usage, mut times) = (VehicleUsage::new(1), SwarmTimes::default());
        step(&mut usage, &mut times, 120, |t| 0.4 * t);
        assert_eq!(usage.totals().productive, usage.totals().airborne);
    }
}
