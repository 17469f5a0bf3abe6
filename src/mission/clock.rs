//! Mission time from the vehicles' own clocks.

use std::collections::BTreeMap;
use std::time::Duration;

use super::TICK;
use crate::vehicle::VehicleId;

/// A clock that jumps back by more than this has rebooted; a smaller jump means that datagrams arrived out of order.
const STEP_BACK_MS: i64 = 1_000;
/// A vehicle that lags takes over as the reference once its own clock has advanced by more than
/// this since any vehicle's clock last advanced mission time.
const CARRIED_AFTER_MS: i64 = 3_000;
/// When all vehicles have been silent for this long, time runs without them.
const SILENT_AFTER: Duration = Duration::from_millis(2500);
const RATE_EVERY: Duration = Duration::from_secs(1);

/// Mission time, driven by the vehicles' own clocks: a simulator slower than requested slows the
/// mission down with it.
///
/// Mission time follows the clock that is furthest ahead. A clock that reboots, lags or falls
/// silent does not delay it, because the others drive it. When all are silent, mission time
/// continues at the last rate. It never goes back, and never runs more than a [`TICK`] ahead of the
/// requested rate.
#[derive(Debug, Clone)]
pub struct Clock {
    speedup: f64,
    /// The time of the first and of the last step.
    begun: Option<Duration>,
    stepped: Duration,
    elapsed: Duration,
    vehicles: BTreeMap<VehicleId, ClockReading>,
    /// When a vehicle's clock last advanced the time.
    carried: Duration,
    /// The start of the current measurement of the rate: the time, and mission time then.
    mark: (Duration, Duration),
    rate: f64,
}

/// A vehicle's clock, as last received.
#[derive(Debug, Clone, Copy)]
#[expect(
    clippy::struct_field_names,
    reason = "the unit of each, which is wire time"
)]
struct ClockReading {
    boot_ms: u32,
    /// Mission time by this clock.
    claim_ms: i64,
    /// How far the vehicle's clock has advanced since any vehicle's clock last advanced mission
    /// time.
    behind_ms: i64,
}

impl Clock {
    /// A clock at zero, for vehicles with the requested speed-up.
    pub fn new(speedup: f64) -> Self {
        Self {
            speedup,
            begun: None,
            stepped: Duration::ZERO,
            elapsed: Duration::ZERO,
            vehicles: BTreeMap::new(),
            carried: Duration::ZERO,
            mark: (Duration::ZERO, Duration::ZERO),
            rate: speedup,
        }
    }

    /// The mission time that has passed.
    pub fn elapsed(&self) -> Duration {
        self.elapsed
    }

    /// Mission seconds per second, as last measured.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Reads the vehicles' clocks ([`Vehicle::clock_ms`](crate::vehicle::Vehicle::clock_ms), `None` while unheard) at
    /// the program's time `now`, and returns mission time. Mission time begins with the first step.
    pub fn step(
        &mut self,
        now: Duration,
        clocks: impl IntoIterator<Item = (VehicleId, Option<u32>)>,
    ) -> Duration {
        let begun = *self.begun.get_or_insert_with(|| {
            (self.stepped, self.carried, self.mark.0) = (now, now, now);
            now
        });
        let passed = now.saturating_sub(self.stepped);
        self.stepped = self.stepped.max(now);
        for (id, boot_ms) in clocks {
            if let Some(boot_ms) = boot_ms {
                self.note(id, boot_ms);
            }
        }
        let limit = self.stepped.saturating_sub(begun).mul_f64(self.speedup) + TICK;
        let claims_ms = self.vehicles.values().map(|reading| reading.claim_ms);
        let ahead = Duration::from_millis(claims_ms.max().unwrap_or(0).unsigned_abs());
        if ahead > self.elapsed {
            self.carry(ahead.min(limit));
        } else if self.stepped.saturating_sub(self.carried) >= SILENT_AFTER {
            let blind = self.elapsed + passed.mul_f64(self.rate);
            self.elapsed = blind.min(limit).max(self.elapsed);
            // A vehicle that is heard again counts from now, not from its last time.
            self.mark = (self.stepped, self.elapsed);
        }
        self.elapsed
    }

    /// Advances a vehicle's claim by as much as its clock has advanced.
    fn note(&mut self, id: VehicleId, boot_ms: u32) {
        let elapsed_ms = self.elapsed.as_millis() as i64;
        let fresh = ClockReading {
            boot_ms,
            claim_ms: elapsed_ms,
            behind_ms: 0,
        };
        let reading = self.vehicles.entry(id).or_insert(fresh);
        // The counter wraps after 49.7 days.
        let moved_ms = i64::from(boot_ms.wrapping_sub(reading.boot_ms).cast_signed());
        if moved_ms < -STEP_BACK_MS {
            *reading = fresh;
        } else if moved_ms > 0 {
            reading.boot_ms = boot_ms;
            reading.claim_ms += moved_ms;
            reading.behind_ms += moved_ms;
            if reading.claim_ms <= elapsed_ms && reading.behind_ms > CARRIED_AFTER_MS {
                reading.claim_ms = elapsed_ms;
            }
        }
    }

    fn carry(&mut self, to: Duration) {
        self.elapsed = self.elapsed.max(to);
        self.carried = self.stepped;
        for reading in self.vehicles.values_mut() {
            reading.behind_ms = 0;
        }
        let (at, elapsed) = self.mark;
        let over = self.stepped.saturating_sub(at);
        if over >= RATE_EVERY {
            self.rate = self.elapsed.saturating_sub(elapsed).as_secs_f64() / over.as_secs_f64();
            self.mark = (self.stepped, self.elapsed);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Runs steps of 50 ms; `clocks` gives each vehicle's clock at a step.
    fn run(speedup: f64, steps: u32, clocks: impl Fn(u32) -> Vec<Option<u32>>) -> Duration {
        let mut clock = Clock::new(speedup);
        for step in 0..=steps {
            clock.step(Duration::from_millis(50) * step, (1..).zip(clocks(step)));
        }
        clock.elapsed()
    }

    fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[test]
    fn mission_time_is_how_far_the_vehicles_have_come_since_the_beginning() {
        // The requested speed-up is 10, but the vehicles reach only 4.
        let elapsed = run(10.0, 100, |step| {
            vec![Some(7_000 + step * 200), Some(9_000 + step * 190)]
        });
        assert_eq!(elapsed, ms(20_000));
    }

    #[test]
    fn a_clock_that_leaps_takes_the_time_no_faster_than_was_asked_for() {
        let leap = |step| vec![Some(if step < 10 { step * 50 } else { 900_000 })];
        assert_eq!(run(1.0, 100, leap), ms(5_100));
    }

    #[test]
    fn a_vehicle_that_boots_goes_on_from_where_the_mission_is() {
        let boots = |step: u32| {
            vec![Some(if step < 60 {
                60_000 + step * 50
            } else {
                (step - 60) * 50
            })]
        };
        // The step at which it reboots adds nothing.
        assert_eq!(run(1.0, 100, boots), ms(4_950));
    }

    #[test]
    fn a_reading_out_of_order_is_no_boot() {
        let shaken = |step: u32| vec![Some(10_000 + step * 50 - step % 2 * 80)];
        assert_eq!(run(1.0, 100, shaken), ms(5_000));
    }

    #[test]
    fn the_others_carry_the_time_when_the_one_ahead_falls_silent() {
        let lost = |step: u32| vec![Some(step.min(40) * 500), Some(step * 400)];
        let elapsed = run(10.0, 100, lost);
        // The first clock gives 20 s until step 40, then a pause reveals its silence, and the second gives the rest.
        assert!(
            (ms(20_000 + 19_000)..=ms(20_000 + 24_000)).contains(&elapsed),
            "{elapsed:?}"
        );
    }

    #[test]
    fn when_all_are_silent_time_goes_on_as_it_went() {
        let mut clock = Clock::new(10.0);
        for step in 0..=1000_u32 {
            let reading = Some(step.min(200) * 250);
            clock.step(ms(50) * step, [(1, reading)]);
        }
        // 50 s in 10 s, then 2.5 s of waiting, then five times real time again.
        let expected = 50.0 + (40.0 - 2.5) * 5.0;
        let off = (clock.elapsed().as_secs_f64() - expected).abs();
        assert!(off < 2.0, "{:?} instead of {expected}", clock.elapsed());
    }

    #[test]
    fn nobody_needs_to_be_heard_for_time_to_pass() {
        assert_eq!(run(2.0, 100, |_| vec![None]), ms(5_100));
    }

    #[test]
    fn the_counter_may_wrap() {
        let wraps = |step: u32| vec![Some((u32::MAX - 1_000).wrapping_add(step * 50))];
        assert_eq!(run(1.0, 100, wraps), ms(5_000));
    }

    proptest! {
        #[test]
        fn it_never_goes_back_nor_faster_than_was_asked_for(
            speedup in 0.1_f64..50.0,
            steps in prop::collection::vec(
                (0_u64..400, prop::collection::vec(prop::option::of(any::<u32>()), 0..4)),
                1..200,
            ),
            honest in prop::collection::vec(0_u32..2000, 200),
        ) {
            let mut clock = Clock::new(speedup);
            let (mut now, mut before, mut boot) = (Duration::from_secs(5), Duration::ZERO, 0);
            for ((step, readings), moved) in steps.into_iter().zip(honest) {
                now += ms(step);
                boot += moved;
                let readings = (1..).zip(readings).chain([(9, Some(boot))]);
                let elapsed = clock.step(now, readings);
                prop_assert!(elapsed >= before);
                let limit = now.saturating_sub(Duration::from_secs(5)).mul_f64(speedup) + TICK;
                prop_assert!(elapsed <= limit, "{elapsed:?} of {limit:?}");
                before = elapsed;
            }
        }
    }
}
