//! The battery needed for the way home, compared with the remaining charge. The flight itself, with wind, is estimated
//! by `effort` in the crate `plan`.

use std::time::Duration;

use super::{Vehicle, VehicleClass, Wind};
use crate::geo::LatLon;
use crate::geo::maths;
use crate::plan::effort::{Effort, Pace};

/// The mean current follows the measured one with this time constant, so that a short climb has
/// little effect.
const LOAD_TIME_S: f32 = 15.0;
/// The current, in amperes, below which the motors count as stopped.
const IDLE_A: f32 = 1.0;
/// The percentage that must be used before the capacity can be estimated: charge is reported in
/// whole percent.
const USED_AT_LEAST: f32 = 2.0;
/// The battery reserve after landing, in percent, where no mission sets another.
pub const USUAL_RESERVE_PERCENT: f64 = 20.0;

/// The mean current of a vehicle over the last seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanCurrent {
    /// The mean current, in amperes.
    pub mean_a: f32,
    at: Duration,
}

/// The way home, compared with the battery left. Percentages are of the battery's charge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WayHome {
    /// The charge needed until the vehicle has landed.
    pub needed_percent: f64,
    pub needed: Duration,
    pub left_percent: f64,
    /// How long the remaining charge lasts at the mean current.
    pub left: Duration,
}

/// Whether the remaining charge is enough for the way home.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HomeReach {
    /// More charge remains than the way home and the reserve need.
    Ample,
    /// After the landing, less than the reserve would remain.
    TurnBack,
    /// The remaining charge is not enough for the way home.
    OutOfReach,
}

impl MeanCurrent {
    /// The mean after another measurement; `None` while the motors are stopped.
    pub fn after(before: Option<Self>, current_a: f32, now: Duration) -> Option<Self> {
        let mean_a = before.map_or(current_a, |before| {
            let passed_s = now.saturating_sub(before.at).as_secs_f32();
            let weight = 1.0 - maths::exp_f32(-passed_s / LOAD_TIME_S);
            before.mean_a + weight * (current_a - before.mean_a)
        });
        (current_a >= IDLE_A).then_some(Self { mean_a, at: now })
    }
}

impl WayHome {
    /// Compares the remaining charge with that needed to land at home with this reserve, for a
    /// vehicle that is not on its way home yet.
    pub fn reach(&self, reserve_percent: f64) -> HomeReach {
        if self.left_percent < self.needed_percent {
            HomeReach::OutOfReach
        } else if self.left_percent < self.needed_percent + reserve_percent {
            HomeReach::TurnBack
        } else {
            HomeReach::Ample
        }
    }
}

impl Vehicle {
    /// The way home, compared with the remaining charge; `None` on the ground, without the
    /// necessary data, or if the vehicle is not a copter.
    pub fn way_home(&self) -> Option<WayHome> {
        let class = self.heartbeat?.class;
        let (global, home, load) = (self.global?, self.home?, self.load?);
        if class != VehicleClass::Copter || !self.armed() || !self.airborne() {
            return None;
        }
        let battery = self.battery()?;
        let (left, consumed_mah) = (battery.remaining_percent?, battery.consumed_mah?);
        let used = 100.0 - f32::from(left);
        if used < USED_AT_LEAST || consumed_mah <= 0.0 {
            return None;
        }
        let percent_mah = f64::from(consumed_mah) / f64::from(used - 0.5);
        let percent_per_s = f64::from(load.mean_a) / 3.6 / percent_mah;
        let way = return_flight(global.at_point, home.at_point, global.altitude_m, self.wind);
        Some(WayHome {
            needed_percent: way.hover_s * percent_per_s,
            needed: Duration::from_secs_f64(way.time_s),
            left_percent: f64::from(left),
            left: Duration::try_from_secs_f64(f64::from(left) / percent_per_s).ok()?,
        })
    }
}

fn return_flight(from: LatLon, home: LatLon, height_m: f64, wind: Option<Wind>) -> Effort {
    let headwind_m_s = wind.map_or(0.0, |wind| {
        let off = f64::from(wind.from_deg) - from.bearing_deg(home);
        f64::from(wind.speed_m_s) * maths::cos(off.to_radians())
    });
    Pace::default().homeward(from.distance_m(home), height_m, headwind_m_s)
}

/// The duration of a return from a place and a height until the motors have stopped, in seconds.
pub(super) fn return_s(from: LatLon, home: LatLon, height_m: f64, wind: Option<Wind>) -> f64 {
    return_flight(from, home, height_m, wind).time_s
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: LatLon = LatLon::new(50.0, 30.0);

    fn way(distance_m: f64, height_m: f64, wind: Option<(f32, f32)>) -> Effort {
        let wind = wind.map(|(speed_m_s, from_deg)| Wind {
            from_deg,
            speed_m_s,
        });
        return_flight(HOME.moved(-distance_m, 0.0), HOME, height_m, wind)
    }

    #[test]
    fn the_way_home_is_climb_flight_and_landing() {
        // 2 s up to 15 m, 100 s, 3.3 s down to 10 m, 20 s to the ground, and the pauses.
        assert!((way(1000.0, 10.0, None).time_s - 137.3).abs() < 0.5);
        assert!((way(0.0, 40.0, None).time_s - 52.0).abs() < 0.1);
        // Near home, the cone keeps the vehicle low: 6 s to the ground, and the pauses.
        assert!((way(0.5, 3.0, None).time_s - 18.1).abs() < 0.5);
    }

    #[test]
    fn a_headwind_costs_more_than_a_tailwind_saves_and_a_gale_takes_time() {
        let [calm, against, behind, gale] = [
            None,
            Some((5.0, 0.0)),
            Some((5.0, 180.0)),
            Some((12.0, 0.0)),
        ]
        .map(|wind| way(1000.0, 20.0, wind));
        assert!(against.hover_s > calm.hover_s && calm.hover_s > behind.hover_s);
        assert!((against.time_s - calm.time_s).abs() < 1e-9);
        assert!(gale.time_s > calm.time_s + 200.0);
    }

    #[test]
    fn a_short_climb_changes_the_mean_current_little() {
        let at = Duration::from_secs;
        let mut load = MeanCurrent::after(None, 28.0, at(0));
        load = MeanCurrent::after(load, 40.0, at(2));
        let mean_a = load.map_or(0.0, |load| load.mean_a);
        assert!((29.0..30.0).contains(&mean_a), "{mean_a}");
        assert_eq!(MeanCurrent::after(load, 0.0, at(3)), None);
    }

    #[test]
    fn the_reserve_is_left_after_the_landing() {
        let with = |needed_percent, left_percent| WayHome {
            needed_percent,
            needed: Duration::from_secs(60),
            left_percent,
            left: Duration::from_secs(200),
        };
        assert_eq!(with(15.0, 36.0).reach(20.0), HomeReach::Ample);
        assert_eq!(with(15.0, 36.0).reach(25.0), HomeReach::TurnBack);
        assert_eq!(with(15.0, 34.0).reach(20.0), HomeReach::TurnBack);
        assert_eq!(with(15.0, 14.0).reach(20.0), HomeReach::OutOfReach);
    }
}
