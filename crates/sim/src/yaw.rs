//! Heading control: where the nose points and how fast it turns.

use glam::DVec2;

use super::kinematics::STEP_S;
use sortie_geo::maths;
use sortie_geo::wrap_180;

/// The lag with which the nose follows its setpoint when a pilot turns it, or when the vehicle
/// tumbles, in seconds.
const LAG_S: f64 = 0.3;
/// The autopilot's own turns swing: the natural frequency in radians per second and the damping,
/// from a turn at 60 degrees per second that reaches 68 after 0.75 s, trails by 12 degrees and
/// overshoots by 5.
const SWING_RAD_S: f64 = 4.6;
const SWING_DAMPING: f64 = 0.5;
/// The speed of the path above which the nose follows it, in m/s.
const COURSE_MIN_M_S: f64 = 0.5;

/// The demand on the heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum YawDemand {
    Hold,
    /// Turns to the course over ground.
    Course,
    /// Turns by the remaining angle (signed degrees) at a rate in degrees per second.
    Turn {
        left_deg: f64,
        rate_deg_s: f64,
    },
    /// Turns without end at a rate in degrees per second, clockwise positive.
    Rate(f64),
    /// Turns at the rate set by a pilot's stick, in degrees per second; the limit of the
    /// autopilot's own turns does not apply.
    Stick(f64),
    /// Looks at a point (north, east).
    Towards(DVec2),
}

/// The limits of turning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turning {
    /// The greatest rate of the autopilot's own turns (`ATC_SLEW_YAW`), in degrees per second.
    pub(super) fastest_deg_s: f64,
    /// The acceleration at the beginning and end of a pilot's turn.
    pub(super) accel_deg_s2: f64,
    /// Whether the vehicle tumbles: the heading is then not under control.
    pub(super) is_upset: bool,
}

/// The demand on the heading, and the setpoint that follows it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct YawControl {
    pub(super) demand: YawDemand,
    setpoint_deg: f64,
    stick_deg_s: f64,
    rate_deg_s: f64,
}

impl YawControl {
    pub(super) fn holding(yaw_deg: f64) -> Self {
        Self {
            demand: YawDemand::Hold,
            setpoint_deg: yaw_deg,
            stick_deg_s: 0.0,
            rate_deg_s: 0.0,
        }
    }

    /// Turns to a heading: the shorter way (`direction` 0), clockwise (positive) or counterclockwise (negative).
    /// A rate of zero means the fastest.
    pub(super) fn turn_to(&mut self, heading_deg: f64, rate_deg_s: f64, direction: f64) {
        let shortest = wrap_180(heading_deg - self.setpoint_deg);
        let left_deg = if direction > 0.0 && shortest < -0.5 {
            shortest + 360.0
        } else if direction < 0.0 && shortest > 0.5 {
            shortest - 360.0
        } else {
            shortest
        };
        self.demand = YawDemand::Turn {
            left_deg,
            rate_deg_s,
        };
    }

    /// Turns by a signed angle.
    pub(super) fn turn_by(&mut self, angle_deg: f64, rate_deg_s: f64) {
        self.demand = YawDemand::Turn {
            left_deg: angle_deg,
            rate_deg_s,
        };
    }

    /// One step; returns the rate at which the nose turns now. `moving` is the path's horizontal
    /// velocity, `here` the vehicle's place.
    pub(super) fn step(
        &mut self,
        yaw_deg: f64,
        moving: DVec2,
        here: DVec2,
        turning: Turning,
    ) -> f64 {
        let fastest_deg_s = turning.fastest_deg_s;
        self.rate_deg_s = if let YawDemand::Stick(rate) = self.demand {
            self.by_stick(rate, yaw_deg, turning.accel_deg_s2)
        } else {
            let change = self.change(moving, here, fastest_deg_s);
            self.setpoint_deg = wrap_180(self.setpoint_deg + change);
            let behind_deg = wrap_180(self.setpoint_deg - yaw_deg);
            if turning.is_upset {
                self.rate_deg_s = 0.0;
                return (behind_deg / LAG_S).clamp(-fastest_deg_s, fastest_deg_s);
            }
            let pull = SWING_RAD_S * SWING_RAD_S * behind_deg;
            let drag = 2.0 * SWING_DAMPING * SWING_RAD_S * self.rate_deg_s;
            self.rate_deg_s + (pull - drag) * STEP_S
        };
        self.rate_deg_s
    }

    /// Turns at a rate that changes as fast as the acceleration allows; at rest the heading is held
    /// again.
    fn by_stick(&mut self, rate_deg_s: f64, yaw_deg: f64, accel_deg_s2: f64) -> f64 {
        let most = accel_deg_s2 * STEP_S;
        self.stick_deg_s += (rate_deg_s - self.stick_deg_s).clamp(-most, most);
        self.setpoint_deg = wrap_180(self.setpoint_deg + self.stick_deg_s * STEP_S);
        if rate_deg_s == 0.0 && self.stick_deg_s == 0.0 {
            self.demand = YawDemand::Hold;
        }
        self.stick_deg_s + wrap_180(self.setpoint_deg - yaw_deg) / LAG_S
    }

    /// The angle by which the setpoint moves in this step, in degrees.
    fn change(&mut self, moving: DVec2, here: DVec2, fastest: f64) -> f64 {
        let most = fastest * STEP_S;
        match &mut self.demand {
            YawDemand::Hold | YawDemand::Stick(_) => 0.0,
            YawDemand::Rate(rate) => rate.clamp(-fastest, fastest) * STEP_S,
            YawDemand::Turn {
                left_deg,
                rate_deg_s,
            } => {
                let rate = if *rate_deg_s > 0.0 {
                    rate_deg_s.min(fastest)
                } else {
                    fastest
                };
                let change = left_deg.clamp(-rate * STEP_S, rate * STEP_S);
                *left_deg -= change;
                change
            }
            YawDemand::Course => {
                if moving.length_squared() > COURSE_MIN_M_S * COURSE_MIN_M_S {
                    turn_towards(self.setpoint_deg, moving).clamp(-most, most)
                } else {
                    0.0
                }
            }
            YawDemand::Towards(point) => {
                let way = *point - here;
                if way.length_squared() > 1.0 {
                    turn_towards(self.setpoint_deg, way).clamp(-most, most)
                } else {
                    0.0
                }
            }
        }
    }

    /// Whether a turn has come to its end, within 2 degrees.
    pub(super) fn has_turned(&self, yaw_deg: f64) -> bool {
        let left = match self.demand {
            YawDemand::Turn { left_deg, .. } => left_deg,
            YawDemand::Hold
            | YawDemand::Course
            | YawDemand::Rate(_)
            | YawDemand::Stick(_)
            | YawDemand::Towards(_) => 0.0,
        };
        left == 0.0 && wrap_180(self.setpoint_deg - yaw_deg).abs() <= 2.0
    }

    /// Resets the setpoint to the current heading.
    pub(super) fn settle(&mut self, yaw_deg: f64) {
        *self = Self::holding(wrap_180(yaw_deg));
    }
}

fn turn_towards(from_deg: f64, way: DVec2) -> f64 {
    wrap_180(maths::atan2(way.y, way.x).to_degrees() - from_deg)
}
