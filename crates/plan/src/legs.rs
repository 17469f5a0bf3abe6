//! The time that the legs and stays of a plan take.

use sortie_geo::{LatLon, wrap_180};

use crate::effort::Pace;
use crate::{Item, command};

/// The length below which a leg has no direction, in metres.
const SAME_PLACE_M: f64 = 1.0;
/// The values of the first parameter of `DO_CHANGE_SPEED` for a horizontal speed: 0 is airspeed, 1
/// is ground speed.
const GROUND_SPEEDS: std::ops::RangeInclusive<f32> = 0.0..=1.0;

/// How a vehicle arrives at the start of a leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LegMotion {
    /// The vehicle is already on the leg; its direction is not considered, and it loses no time in
    /// a turn.
    Unknown,
    /// The vehicle stands still, or hovers.
    Rest,
    /// In this direction, in degrees.
    Along(f64),
}

/// The start of a leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegStart {
    /// The place over the ground.
    pub place: LatLon,
    /// The height above home, in metres.
    pub height_m: f64,
    /// How the vehicle arrives there.
    pub motion: LegMotion,
}

/// How fast a vehicle flies legs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LegPace {
    /// A copter, with rates that most copters share.
    Copter(Pace),
    /// Another vehicle: only its speed over ground is known, in m/s; `None` before it has been
    /// measured.
    Other(Option<f64>),
}

impl LegPace {
    fn speed_m_s(self) -> Option<f64> {
        let speed_m_s = match self {
            Self::Copter(pace) => Some(pace.speed_m_s),
            Self::Other(speed_m_s) => speed_m_s,
        };
        speed_m_s.filter(|speed_m_s| *speed_m_s > 0.0)
    }

    /// The duration of a climb, or of a descent if `up_m` is negative, in seconds; 0 for vehicles
    /// whose rates are unknown.
    pub fn rise_s(self, up_m: f64) -> f64 {
        match self {
            Self::Copter(pace) => pace.rise(up_m).time_s,
            Self::Other(_) => 0.0,
        }
    }

    /// The seconds lost by braking and accelerating at the start of a leg in this direction, in
    /// degrees.
    fn corner_s(self, motion: LegMotion, bearing_deg: f64) -> f64 {
        match (self, motion) {
            (Self::Other(_), _) | (Self::Copter(_), LegMotion::Unknown) => 0.0,
            (Self::Copter(pace), LegMotion::Rest) => pace.start_s(),
            (Self::Copter(pace), LegMotion::Along(before_deg)) => {
                pace.corner_s(wrap_180(bearing_deg - before_deg))
            }
        }
    }

    /// The seconds that a vehicle stays at an item's place; `None` for a stay without a known end.
    pub fn stay_s(self, item: &Item) -> Option<f64> {
        let first = f64::from(item.params[0]).max(0.0);
        match (item.command, self) {
            (command::WAYPOINT | command::SPLINE_WAYPOINT | command::LOITER_TIME, _) => Some(first),
            (command::LOITER_TURNS, Self::Copter(pace)) => {
                Some(pace.circle_s(first, circle_m(item)))
            }
            (command::LOITER_TURNS, Self::Other(speed_m_s)) => {
                let turns_m = Some(turns_m(item)).filter(|_| circle_m(item) > 0.0)?;
                Some(turns_m / speed_m_s?)
            }
            (command::LOITER_UNLIMITED | command::PAYLOAD_PLACE, _) => None,
            _ => Some(0.0),
        }
    }
}

impl LegStart {
    /// Moves the start along a straight leg to a place and a height; returns the duration of the
    /// leg in seconds. The vehicle flies horizontally at the speed over ground, vertically no
    /// faster than its climb and descent rates. `None` if its speed is unknown.
    pub fn fly(&mut self, place: LatLon, height_m: f64, pace: LegPace) -> Option<f64> {
        let across_m = self.place.distance_m(place);
        let steep_s = pace.rise_s(height_m - self.height_m);
        let mut across_s = 0.0;
        if across_m >= SAME_PLACE_M {
            let bearing_deg = self.place.bearing_deg(place);
            across_s = across_m / pace.speed_m_s()? + pace.corner_s(self.motion, bearing_deg);
            self.motion = LegMotion::Along(bearing_deg);
        }
        (self.place, self.height_m) = (place, height_m);
        Some(across_s.max(steep_s))
    }
}

/// The new speed over ground in m/s, if the item changes it.
pub fn changed_speed_m_s(item: &Item) -> Option<f64> {
    let [kind, speed_m_s, ..] = item.params;
    let is_ground = item.command == command::DO_CHANGE_SPEED && GROUND_SPEEDS.contains(&kind);
    (is_ground && speed_m_s > 0.0).then(|| f64::from(speed_m_s))
}

/// The radius of an item's circle, in metres; 0 for other items.
pub fn circle_m(item: &Item) -> f64 {
    match item.command {
        command::LOITER_TURNS => f64::from(item.params[2]).abs(),
        _ => 0.0,
    }
}

/// The length of an item's turns around its place, in metres; 0 for other items.
pub fn turns_m(item: &Item) -> f64 {
    circles_m(f64::from(item.params[0]), circle_m(item))
}

/// The length of a number of turns on a circle, in metres.
pub fn circles_m(turns: f64, radius_m: f64) -> f64 {
    turns.max(0.0) * std::f64::consts::TAU * radius_m
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start(motion: LegMotion) -> LegStart {
        LegStart {
            place: LatLon::new(50.45, 30.52),
            height_m: 20.0,
            motion,
        }
    }

    fn leg_s(motion: LegMotion, pace: LegPace) -> Option<f64> {
        let mut at = start(motion);
        let north = at.place.moved(100.0, 0.0);
        at.fly(north, 20.0, pace)
    }

    #[test]
    fn a_leg_takes_longer_from_rest_and_after_a_turn() {
        let pace = Pace::default();
        let copter = LegPace::Copter(pace);
        let level_s = 100.0 / pace.speed_m_s;
        for (motion, lost_s) in [
            (LegMotion::Unknown, 0.0),
            (LegMotion::Along(0.0), 0.0),
            (LegMotion::Along(180.0), pace.start_s()),
            (LegMotion::Rest, pace.start_s()),
        ] {
            let took_s = leg_s(motion, copter).expect("a known speed");
            assert!((took_s - level_s - lost_s).abs() < 0.1, "{motion:?}");
        }
        let of_plane = |speed_m_s| leg_s(LegMotion::Rest, LegPace::Other(speed_m_s));
        assert_eq!(of_plane(None), None);
        assert!(of_plane(Some(20.0)).is_some_and(|took_s| (took_s - 5.0).abs() < 0.1));
    }

    #[test]
    fn a_leg_is_no_faster_than_its_climb_and_one_in_place_has_no_direction() {
        let mut at = start(LegMotion::Rest);
        let copter = LegPace::Copter(Pace::default());
        let place = at.place;
        let took_s = at.fly(place, 60.0, copter).expect("a known speed");
        assert!((took_s - copter.rise_s(40.0)).abs() < 1e-9);
        assert_eq!(at.motion, LegMotion::Rest);
        assert!((at.height_m - 60.0).abs() < 1e-9);
    }

    #[test]
    fn only_speeds_over_ground_change_the_pace() {
        let change = |kind: f32, speed_m_s: f32| Item {
            command: command::DO_CHANGE_SPEED,
            params: [kind, speed_m_s, 0.0, 0.0],
            ..Item::default()
        };
        assert_eq!(changed_speed_m_s(&change(1.0, 6.0)), Some(6.0));
        for other in [change(2.0, 6.0), change(0.0, -1.0), Item::default()] {
            assert_eq!(changed_speed_m_s(&other), None);
        }
    }
}
