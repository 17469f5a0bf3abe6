//! Estimates of the time and energy of a copter's flight; the energy is given as the duration of a
//! hover that uses the same amount.
//!
//! The figures are `ArduCopter`'s defaults and measurements with its simulator; a rehearsal is more
//! accurate.

use std::iter::Sum;
use std::ops::Add;

use glam::DVec2;
use sortie_geo::maths;

/// The power of a climb, relative to the hover.
const CLIMBING: f64 = 1.3;
/// The growth of power with the square of the airspeed, from a measurement of 12 % more at 10 m/s.
const DRAG_PER_SPEED2: f64 = 0.0012;
/// The number of bisection steps that find the highest speed of a short leg.
const TOP_SPEED_STEPS: u32 = 14;
/// The default of `CIRCLE_RATE`, in degrees per second.
const CIRCLE_RATE_DEG_S: f64 = 20.0;
/// The default of `RTL_ALT`, in metres above home.
const RETURN_HEIGHT_M: f64 = 15.0;
/// `RTL_CONE_SLOPE`: near home, a return stays below a cone of this slope above home.
const CONE_SLOPE: f64 = 3.0;
/// The time that acceleration and braking add to a return, in seconds.
const RETURN_CHANGES_S: f64 = 5.0;
/// The default of `RTL_LOIT_TIME`, in seconds.
const RETURN_WAIT_S: f64 = 5.0;
/// The time from the touchdown until the motors stop, in seconds.
const STOP_S: f64 = 2.0;
/// The highest airspeed of a return, in m/s: a headwind stronger than the margin between this and
/// the usual speed slows the return down.
const FASTEST_RETURN_M_S: f64 = 15.0;
/// The minimum ground speed assumed in any wind, in m/s.
const SLOWEST_RETURN_M_S: f64 = 1.0;
/// The default of `LAND_ALT_LOW`, in metres.
const LANDING_HEIGHT_M: f64 = 10.0;

/// How fast a copter flies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// The horizontal speed between waypoints in m/s (`WPNAV_SPEED`).
    pub speed_m_s: f64,
    /// The horizontal acceleration in m/s² (`WPNAV_ACCEL`).
    pub accel_m_s2: f64,
    /// The change of the horizontal acceleration in m/s³ (`WPNAV_JERK`).
    pub jerk_m_s3: f64,
    /// The speed of a climb in m/s (`WPNAV_SPEED_UP`).
    pub climb_m_s: f64,
    /// The speed of a descent in m/s (`WPNAV_SPEED_DN`).
    pub descent_m_s: f64,
    /// The speed of the last metres before the ground in m/s (`LAND_SPEED`).
    pub landing_m_s: f64,
}

impl Default for Pace {
    /// The pace of an `ArduCopter` whose parameters have their defaults.
    fn default() -> Self {
        Self {
            speed_m_s: 10.0,
            accel_m_s2: 2.5,
            jerk_m_s3: 1.0,
            climb_m_s: 2.5,
            descent_m_s: 1.5,
            landing_m_s: 0.5,
        }
    }
}

/// The time and energy of a part of a flight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effort {
    /// The duration, in seconds.
    pub time_s: f64,
    /// The duration of a hover that uses the same energy, in seconds.
    pub hover_s: f64,
}

impl Add for Effort {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            time_s: self.time_s + other.time_s,
            hover_s: self.hover_s + other.hover_s,
        }
    }
}

impl Sum for Effort {
    fn sum<I: Iterator<Item = Self>>(efforts: I) -> Self {
        efforts.fold(Self::default(), Add::add)
    }
}

impl Effort {
    /// The effort of a hover, or of a descent.
    pub const fn hover(time_s: f64) -> Self {
        Self {
            time_s,
            hover_s: time_s,
        }
    }

    /// The effort of level flight.
    pub fn level(time_s: f64, airspeed_m_s: f64) -> Self {
        let drag = 1.0 + DRAG_PER_SPEED2 * airspeed_m_s * airspeed_m_s;
        Self {
            time_s,
            hover_s: time_s * drag,
        }
    }
}

impl Pace {
    /// The effort of a climb, or of a descent if `up_m` is negative.
    pub fn rise(&self, up_m: f64) -> Effort {
        if up_m > 0.0 {
            let time_s = up_m / self.climb_m_s;
            Effort {
                time_s,
                hover_s: time_s * CLIMBING,
            }
        } else {
            Effort::hover(-up_m / self.descent_m_s)
        }
    }

    /// The effort of a landing from a height.
    pub fn landing(&self, height_m: f64) -> Effort {
        let low_m = height_m.min(LANDING_HEIGHT_M);
        Effort::hover((height_m - low_m) / self.descent_m_s + low_m / self.landing_m_s)
    }

    /// The effort of the last part of a return: from a height above home until the motors have stopped.
    pub fn touchdown(&self, height_m: f64) -> Effort {
        self.landing(height_m) + Effort::hover(STOP_S)
    }

    /// The effort of a return that has reached home: the wait above it, and the descent to the ground.
    pub fn above_home(&self, height_m: f64) -> Effort {
        Effort::hover(RETURN_WAIT_S) + self.touchdown(height_m)
    }

    /// The effort of a return from a distance and a height above home against a headwind, until the motors have
    /// stopped.
    pub fn homeward(&self, distance_m: f64, height_m: f64, headwind_m_s: f64) -> Effort {
        let cone_m = (distance_m * CONE_SLOPE).max(height_m);
        let top_m = height_m.max(RETURN_HEIGHT_M.min(cone_m));
        let fastest_m_s = FASTEST_RETURN_M_S - headwind_m_s;
        let speed_m_s =
            fastest_m_s.clamp(SLOWEST_RETURN_M_S, self.speed_m_s.max(SLOWEST_RETURN_M_S));
        self.rise(top_m - height_m)
            + Effort::level(distance_m / speed_m_s, speed_m_s + headwind_m_s)
            + Effort::hover(RETURN_CHANGES_S)
            + self.above_home(top_m)
    }

    /// The seconds lost by braking and accelerating where the path turns by an angle: a copter
    /// nearly stops at a right angle, and hardly slows down where the path is nearly straight.
    pub fn corner_s(&self, turn_deg: f64) -> f64 {
        let share = 1.0 - maths::cos(turn_deg.to_radians());
        share.min(1.0) * self.start_s()
    }

    /// The seconds lost by accelerating from rest.
    pub fn start_s(&self) -> f64 {
        self.speed_m_s / self.accel_m_s2 + self.accel_m_s2 / self.jerk_m_s3
    }

    /// The duration of turns around a place, in seconds (`LOITER_TURNS`); with a radius of 0, the
    /// vehicle turns in place.
    pub fn circle_s(&self, turns: f64, radius_m: f64) -> f64 {
        let radius_m = radius_m.abs();
        let fastest_m_s = self
            .speed_m_s
            .min((0.5 * self.accel_m_s2 * radius_m).sqrt());
        let rate = CIRCLE_RATE_DEG_S.to_radians();
        let rate = if radius_m > 0.0 {
            rate.min(fastest_m_s / radius_m)
        } else {
            rate
        };
        turns.max(0.0) * std::f64::consts::TAU / rate
    }

    /// The effort of a flight from place to place in calm air, from rest to rest; points are in
    /// metres.
    ///
    /// The speed at a corner depends on the turn: full speed straight ahead, half at 90 degrees,
    /// zero at a reversal.
    pub fn path(&self, points: &[DVec2]) -> Effort {
        let legs: Vec<DVec2> = points
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .filter(|leg| leg.length() > 1e-3)
            .collect();
        let corner = |before: DVec2, after: DVec2| {
            let cosine = before.normalize().dot(after.normalize());
            self.speed_m_s * (1.0 + cosine.clamp(-1.0, 1.0)) / 2.0
        };
        let mut entry_m_s = 0.0;
        let mut total = Effort::default();
        for (index, leg) in legs.iter().enumerate() {
            let exit_m_s = legs.get(index + 1).map_or(0.0, |next| corner(*leg, *next));
            let time_s = self.leg_s(leg.length(), entry_m_s, exit_m_s);
            total = total + Effort::level(time_s, leg.length() / time_s);
            entry_m_s = exit_m_s;
        }
        total
    }

    fn leg_s(&self, length_m: f64, entry_m_s: f64, exit_m_s: f64) -> f64 {
        let changing = |top_m_s: f64| {
            let [up, down] = [entry_m_s, exit_m_s].map(|end| {
                let time_s = self.change_s(top_m_s - end);
                (time_s, time_s * f64::midpoint(top_m_s, end))
            });
            (up.0 + down.0, up.1 + down.1)
        };
        let mut low = entry_m_s.max(exit_m_s).min(self.speed_m_s);
        if changing(low).1 > length_m {
            // Too short to change from one speed to the other.
            return length_m / f64::midpoint(entry_m_s, exit_m_s).max(0.1);
        }
        let mut top = self.speed_m_s;
        if changing(top).1 > length_m {
            for _ in 0..TOP_SPEED_STEPS {
                let middle = f64::midpoint(low, top);
                if changing(middle).1 > length_m {
                    top = middle;
                } else {
                    low = middle;
                }
            }
            top = low;
        }
        let (time_s, way_m) = changing(top);
        time_s + (length_m - way_m) / top.max(0.1)
    }

    /// The duration of a change of speed, with a limited jerk.
    fn change_s(&self, by_m_s: f64) -> f64 {
        let by_m_s = by_m_s.max(0.0);
        let ramp_s = self.accel_m_s2 / self.jerk_m_s3;
        if by_m_s < self.accel_m_s2 * ramp_s {
            2.0 * (by_m_s / self.jerk_m_s3).sqrt()
        } else {
            by_m_s / self.accel_m_s2 + ramp_s
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_leg_accelerates_and_brakes() {
        let straight = Pace::default().path(&[DVec2::ZERO, DVec2::new(200.0, 0.0)]);
        // 6.5 s and 32.5 m to either end, 135 m at 10 m/s.
        assert!((straight.time_s - 26.5).abs() < 1e-9, "{straight:?}");
        assert!(straight.hover_s > straight.time_s * 1.05, "{straight:?}");
        let points = [0.0, 70.0, 200.0].map(|north| DVec2::new(north, 0.0));
        let divided = Pace::default().path(&points);
        assert!((divided.time_s - straight.time_s).abs() < 1e-9);
    }

    #[test]
    fn corners_cost_time_and_a_reversal_most() {
        let way = |north: f64, east: f64| {
            let corner = DVec2::new(100.0, 0.0);
            let points = [DVec2::ZERO, corner, corner + DVec2::new(north, east)];
            Pace::default().path(&points).time_s
        };
        assert!(way(100.0, 0.0) < way(0.0, 100.0));
        assert!(way(0.0, 100.0) < way(-100.0, 0.0));
    }

    #[test]
    fn turns_are_as_slow_as_their_rate_or_their_radius_demands() {
        let pace = Pace::default();
        // At 20 degrees per second, 18 s for a turn in place or on a small circle.
        for radius_m in [0.0, 5.0, -5.0] {
            assert!(
                (pace.circle_s(2.0, radius_m) - 36.0).abs() < 1e-9,
                "{radius_m}"
            );
        }
        // On 25 m, the speed is limited to 5.6 m/s.
        assert!((pace.circle_s(1.0, 25.0) - 28.1).abs() < 0.1);
        // On 200 m, at 10 m/s.
        assert!((pace.circle_s(1.0, 200.0) - 125.7).abs() < 0.1);
    }

    #[test]
    fn a_return_is_flight_pauses_and_a_slow_landing() {
        let pace = Pace::default();
        // 10 s, the pauses, 13.3 s down to 10 m, 20 s to the ground.
        let homeward = pace.homeward(100.0, 30.0, 0.0).time_s;
        assert!((homeward - (10.0 + 12.0 + 33.3)).abs() < 0.1, "{homeward}");
        assert!((pace.touchdown(5.0).time_s - 12.0).abs() < 1e-9);
    }

    #[test]
    fn a_climb_takes_more_than_a_descent_of_the_same_time() {
        let pace = Pace::default();
        let climb = Effort {
            time_s: 10.0,
            hover_s: 13.0,
        };
        assert_eq!(pace.rise(25.0), climb);
        assert_eq!(pace.rise(-15.0), Effort::hover(10.0));
        assert_eq!(pace.landing(25.0), Effort::hover(30.0));
    }
}
