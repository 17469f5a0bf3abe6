//! Other aircraft, as a vehicle's ADS-B receiver reports them (`ADSB_VEHICLE`), and how close they come.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::GlobalPosition;
use crate::geo::{LatLon, maths};

/// An aircraft without a report for longer than this is dropped.
const KEPT_FOR: Duration = Duration::from_secs(10);
/// The maximum number of aircraft of one receiver; further ones are ignored.
const MOST_AIRCRAFT: usize = 100;
/// The time for which approaches are predicted, and the distances that count, horizontally and vertically. Source: the
/// defaults of `AP_Avoidance` in `ArduCopter`: `AVD_W_TIME` and `AVD_F_TIME` 30 s; `AVD_W_DIST_XY` and `AVD_W_DIST_Z`
/// 300 m; `AVD_F_DIST_XY` and `AVD_F_DIST_Z` 100 m.
const HORIZON_S: f64 = 30.0;
const WARN_M: f64 = 300.0;
const FAIL_M: f64 = 100.0;

/// An aircraft that a vehicle receives, other than the vehicles of the swarm.
#[derive(Debug, Clone, PartialEq)]
pub struct Aircraft {
    /// The ICAO address, 24 bits; `None` if the reports come from a mission.
    pub icao: Option<u32>,
    /// The callsign; empty if unknown.
    pub callsign: String,
    pub at_point: LatLon,
    /// Height above mean sea level in metres.
    pub altitude_amsl_m: f64,
    /// The velocity over ground in m/s, north and east.
    pub velocity_m_s: Option<[f64; 2]>,
    /// The vertical speed in m/s, upwards.
    pub climb_m_s: Option<f64>,
    /// When the aircraft was at this place, on the program's clock.
    pub at: Duration,
}

impl Aircraft {
    /// The callsign, or the ICAO address in hexadecimal.
    pub fn name(&self) -> String {
        match self.icao {
            Some(icao) if self.callsign.is_empty() => format!("{icao:06X}"),
            _ => self.callsign.clone(),
        }
    }

    /// The age of the position.
    pub fn age(&self, now: Duration) -> Duration {
        now.saturating_sub(self.at)
    }

    /// The course over ground, 0 to 360 degrees; `None` if it is unknown, or the aircraft is
    /// stationary.
    pub fn course_deg(&self) -> Option<f64> {
        let [north, east] = self.velocity_m_s?;
        let moves = north != 0.0 || east != 0.0;
        moves.then(|| maths::atan2(east, north).to_degrees().rem_euclid(360.0))
    }

    /// The speed over ground in m/s; `None` if it is unknown.
    pub fn speed_m_s(&self) -> Option<f64> {
        self.velocity_m_s
            .map(|[north, east]| maths::hypot(north, east))
    }

    /// The place after a time, if the aircraft keeps its velocity.
    pub fn place_in(&self, time_s: f64) -> LatLon {
        let [north, east] = self.velocity_m_s.unwrap_or_default();
        self.at_point.moved(north * time_s, east * time_s)
    }
}

/// The aircraft that one receiver reports, by ICAO address.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Traffic(Arc<BTreeMap<u32, Aircraft>>);

impl Traffic {
    /// Adds a report, or replaces the earlier one.
    pub fn note(&mut self, icao: u32, aircraft: Aircraft) {
        if self.0.len() < MOST_AIRCRAFT || self.0.contains_key(&icao) {
            Arc::make_mut(&mut self.0).insert(icao, aircraft);
        }
    }

    /// Drops the aircraft that have not been reported for some time.
    pub fn expire(&mut self, now: Duration) {
        let is_old = |aircraft: &Aircraft| aircraft.age(now) > KEPT_FOR;
        if self.0.values().any(is_old) {
            Arc::make_mut(&mut self.0).retain(|_, aircraft| !is_old(aircraft));
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &Aircraft> {
        self.0.values()
    }
}

/// How dangerous an approach is, by the limits of `AP_Avoidance`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TrafficThreat {
    /// Within 100 m in the next 30 s.
    Critical,
    /// Within 300 m in the next 30 s.
    Warning,
    None,
}

/// The closest approach of an aircraft to a vehicle, if both keep their velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// The distance now, horizontally, in metres.
    pub distance_m: f64,
    /// The height of the aircraft above the vehicle now, in metres.
    pub height_m: f64,
    /// The time until they are closest, in seconds; 0 if they come no closer.
    pub in_s: f64,
    /// The distance then, horizontally, in metres.
    pub closest_m: f64,
    /// The height of the aircraft above the vehicle then, in metres.
    pub closest_height_m: f64,
    /// When they are closest within the time for which approaches are predicted, and where.
    pub predicted: PredictedPass,
    pub threat: TrafficThreat,
}

/// The closest point of an approach within the next 30 s, which determines the threat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PredictedPass {
    /// The time until then, in seconds.
    pub in_s: f64,
    /// The distance then, horizontally, in metres.
    pub across_m: f64,
    /// The height of the aircraft above the vehicle then, in metres.
    pub height_m: f64,
}

impl Approach {
    /// The approach of an aircraft to a vehicle at this position.
    pub fn of(aircraft: &Aircraft, own: &GlobalPosition, now: Duration) -> Self {
        let age_s = aircraft.age(now).as_secs_f64();
        let [north_m, east_m] = <[f64; 2]>::from(own.at_point.offset_to(aircraft.place_in(age_s)));
        let [north, east] = aircraft.velocity_m_s.unwrap_or_default();
        let closing = [
            north - f64::from(own.north_m_s),
            east - f64::from(own.east_m_s),
        ];
        let climb = aircraft.climb_m_s.unwrap_or_default();
        let rise = climb + f64::from(own.down_m_s);
        let height_m = aircraft.altitude_amsl_m + climb * age_s - own.altitude_amsl_m;
        let speed_2 = closing[0] * closing[0] + closing[1] * closing[1];
        let in_s = if speed_2 > 0.0 {
            (-(north_m * closing[0] + east_m * closing[1]) / speed_2).max(0.0)
        } else {
            0.0
        };
        let away_m =
            |time_s: f64| maths::hypot(north_m + closing[0] * time_s, east_m + closing[1] * time_s);
        let soon_s = in_s.min(HORIZON_S);
        let predicted = PredictedPass {
            in_s: soon_s,
            across_m: away_m(soon_s),
            height_m: height_m + rise * soon_s,
        };
        Self {
            distance_m: away_m(0.0),
            height_m,
            in_s,
            closest_m: away_m(in_s),
            closest_height_m: height_m + rise * in_s,
            predicted,
            threat: threat(predicted.across_m, least(height_m, rise)),
        }
    }
}

/// The least difference in height within the horizon.
fn least(height_m: f64, rise_m_s: f64) -> f64 {
    let then_m = height_m + rise_m_s * HORIZON_S;
    let crosses = height_m.signum() != then_m.signum();
    if crosses {
        0.0
    } else {
        height_m.abs().min(then_m.abs())
    }
}

/// The lower of the horizontal and the vertical threat.
fn threat(across_m: f64, height_m: f64) -> TrafficThreat {
    if across_m < FAIL_M && height_m <= FAIL_M {
        TrafficThreat::Critical
    } else if across_m < WARN_M && height_m <= WARN_M {
        TrafficThreat::Warning
    } else {
        TrafficThreat::None
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const HERE: LatLon = LatLon::new(50.45, 30.52);

    /// An aircraft this far away and this much higher, with this velocity.
    fn aircraft(north_m: f64, east_m: f64, up_m: f64, velocity_m_s: [f64; 2]) -> Aircraft {
        Aircraft {
            icao: Some(0xabc),
            callsign: String::new(),
            at_point: HERE.moved(north_m, east_m),
            altitude_amsl_m: 200.0 + up_m,
            velocity_m_s: Some(velocity_m_s),
            climb_m_s: Some(0.0),
            at: Duration::from_secs(100),
        }
    }

    fn own() -> GlobalPosition {
        GlobalPosition {
            at_point: HERE,
            altitude_amsl_m: 200.0,
            altitude_m: 30.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        }
    }

    fn approach(aircraft: &Aircraft) -> Approach {
        Approach::of(aircraft, &own(), Duration::from_secs(100))
    }

    #[test]
    fn the_limits_are_those_of_the_autopilot() {
        use TrafficThreat::{Critical, None, Warning};
        // From 1000 m in the north at 50 m/s: 20 s until it passes this far in the east.
        for (east_m, up_m, expected) in [
            (0.0, 0.0, Critical),
            (95.0, 95.0, Critical),
            (95.0, 105.0, Warning),
            (105.0, 0.0, Warning),
            (295.0, 295.0, Warning),
            (305.0, 0.0, None),
            (0.0, 305.0, None),
        ] {
            let found = approach(&aircraft(1000.0, east_m, up_m, [-50.0, 0.0]));
            assert_eq!(found.threat, expected, "{east_m} {up_m}");
            assert!((found.in_s - 20.0).abs() < 0.1, "{}", found.in_s);
            assert!((found.closest_m - east_m).abs() < 1.0);
        }
        // Too far for the horizon, moving away, and beside it at the same speed.
        for (north_m, velocity, expected) in [
            (2000.0, [-50.0, 0.0], None),
            (400.0, [50.0, 0.0], None),
            (250.0, [50.0, 0.0], Warning),
            (50.0, [0.0, 0.0], Critical),
        ] {
            let found = approach(&aircraft(north_m, 0.0, 0.0, velocity));
            assert_eq!(found.threat, expected, "{north_m} {velocity:?}");
        }
    }

    #[test]
    fn a_slow_approach_is_predicted_for_the_time_that_counts() {
        // 80 m away, and 4000 s until it would be overhead.
        let found = approach(&aircraft(80.0, 0.0, 10.0, [-0.02, 0.0]));
        assert_eq!(found.threat, TrafficThreat::Critical);
        assert!(found.in_s > 3900.0 && found.closest_m < 0.1);
        let PredictedPass {
            in_s,
            across_m,
            height_m,
        } = found.predicted;
        assert!((in_s - 30.0).abs() < 1e-9 && (height_m - 10.0).abs() < 1e-9);
        assert!((across_m - 79.4).abs() < 0.1, "{across_m}");
    }

    #[test]
    fn old_reports_are_extrapolated_and_dropped() {
        let report = aircraft(1000.0, 0.0, 0.0, [-50.0, 0.0]);
        let found = Approach::of(&report, &own(), Duration::from_secs(104));
        assert!((found.distance_m - 800.0).abs() < 1.0 && (found.in_s - 16.0).abs() < 0.1);
        let mut traffic = Traffic::default();
        traffic.note(0xabc, report);
        traffic.expire(Duration::from_secs(110));
        assert_eq!(traffic.iter().count(), 1);
        traffic.expire(Duration::from_secs(111));
        assert!(traffic.is_empty());
        for icao in 0..500 {
            traffic.note(icao, aircraft(0.0, 0.0, 0.0, [0.0; 2]));
        }
        assert_eq!(traffic.iter().count(), MOST_AIRCRAFT);
    }

    #[test]
    fn an_aircraft_has_a_name_and_a_course() {
        let mut it = aircraft(0.0, 0.0, 0.0, [0.0, -20.0]);
        assert_eq!(
            (it.name().as_str(), it.course_deg()),
            ("000ABC", Some(270.0))
        );
        it.callsign = "MEDEVAC1".to_owned();
        it.velocity_m_s = Some([0.0; 2]);
        assert_eq!((it.name().as_str(), it.course_deg()), ("MEDEVAC1", None));
    }

    proptest! {
        #[test]
        fn the_closest_approach_is_never_farther_than_now(
            north in -5000.0..5000.0f64, east in -5000.0..5000.0f64, up in -500.0..500.0f64,
            v_north in -80.0..80.0f64, v_east in -80.0..80.0f64, age in 0u64..10,
        ) {
            let it = aircraft(north, east, up, [v_north, v_east]);
            let found = Approach::of(&it, &own(), Duration::from_secs(100 + age));
            prop_assert!(found.closest_m <= found.distance_m + 1e-6);
            prop_assert!(found.in_s >= 0.0 && found.in_s.is_finite());
        }
    }
}
