//! Tasks inside a mode: one small controller each.

mod attitude;
mod auto;
mod drive;
mod landing;
mod piloted;
mod returning;
mod takeoff;
mod tuning;

use std::time::Duration;

use glam::{DVec2, DVec3};

pub(super) use attitude::{Attitude, Lift};
pub(super) use auto::{AutoRules, Orbit, Route, stopping_point};
pub(super) use drive::{
    CirclePlace, Drive, DriveCircle, DriveHeading, DriveNews, DriveSetpoint, Loiter,
    SetpointCourse, on_surface, stick_outputs,
};
pub(super) use landing::Landing;
pub(super) use piloted::{LineEnd, Pilot, PilotRules};
pub(super) use returning::Returning;
pub(super) use takeoff::Takeoff;
pub(super) use tuning::FlightTuning;

use super::body::Body;
use super::control::{FlatMotion, Limits, PositionControl};
use super::fence::Geofence;
use super::kinematics::STEP_S;
use super::leader::Leader;
use super::radio::Sticks;
use super::rally::Rally;
use super::trail::Trail;
use sortie_geo::maths;

/// The widest circle in metres, and the fastest in degrees per second.
const CIRCLE_MAX_M: f64 = 2000.0;
const CIRCLE_MAX_DEG_S: f64 = 90.0;
/// The deceleration of BRAKE mode (`BRAKE_MODE_DECEL_RATE`), in m/s².
const BRAKE_ACCEL_M_S2: f64 = 7.5;

/// The parts of the vehicle that a task works with.
pub(super) struct Cockpit<'a> {
    pub(super) control: &'a mut PositionControl,
    /// The state of the piloted modes.
    pub(super) pilot: &'a mut Pilot,
    /// The autopilot's estimate of the body.
    pub(super) body: &'a Body,
    pub(super) tuning: &'a FlightTuning,
    pub(super) limits: Limits,
    pub(super) sticks: Sticks,
    /// The heading that "forward" means for the sticks, in degrees; `None` for the nose.
    pub(super) stick_heading_deg: Option<f64>,
    /// Whether a ground station overrides the transmitter, so a pilot sets the throttle.
    pub(super) piloted: bool,
    /// Home, in metres north, east and down from the start.
    pub(super) home_m: DVec3,
    /// Whether the horizontal position and velocity of `body` can be trusted.
    pub(super) has_position: bool,
    pub(super) now: Duration,
    /// The end of the delay after arming in which the motors do not spin up.
    pub(super) lifts_from: Duration,
    pub(super) fence: &'a mut Geofence,
    pub(super) trail: &'a mut Trail,
    pub(super) rally: Rally<'a>,
    /// Whether a rover drives backwards along its path.
    pub(super) backs_up: bool,
    /// The vehicle to follow, if one was heard.
    pub(super) leader: Option<&'a Leader>,
}

/// The drive of the motors in this step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Act {
    /// Follow the path of the position control.
    Fly,
    /// Follow the height of the path, and keep level.
    Level,
    /// Idle on the ground.
    Idle,
    /// An acceleration (north, east, down) by lean and thrust; gravity is not part of it.
    Accelerate(DVec3),
    /// A throttle from 0 to 1 with a lean, given as the horizontal acceleration, north and east,
    /// that it causes while the thrust carries the weight.
    Throttle { share: f64, lean_m_s2: DVec2 },
}

/// The current task of the autopilot.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Task {
    /// Waits on the ground.
    Wait,
    /// Climbs from the ground.
    Takeoff(Takeoff),
    /// Flies to a point and holds it; the point itself moves until `drift_until`.
    Goto {
        goal_m: DVec3,
        drift_m_s: DVec3,
        drift_until: Duration,
    },
    /// Flies at a velocity, then stops and holds.
    Velocity { wanted_m_s: DVec3, until: Duration },
    /// Accelerates, then stops and holds.
    Accelerate { wanted_m_s2: DVec3, until: Duration },
    /// Leans as commanded by a ground station.
    Attitude(Attitude),
    /// Brakes hard and holds.
    Brake,
    /// Flies home and lands.
    Return(Returning),
    /// Descends at the vehicle's position.
    Land(Landing),
    /// Circles around a point.
    Circle(Circle),
    /// Flies along the legs of a mission.
    Route(Box<Route>),
    /// Turns around a place of a mission.
    Orbit(Orbit),
    /// A pilot's sticks set climb and movement; the autopilot holds the height.
    Piloted,
    /// A pilot's throttle drives the motors directly.
    Manual,
    /// What only rovers do.
    Drive(Drive),
}

/// A circle that is being flown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Circle {
    pub(super) centre_m: DVec2,
    pub(super) angle_rad: f64,
    pub(super) rate_rad_s: f64,
    pub(super) down_m: f64,
    /// The radius, which the pilot's pitch stick changes; the roll stick changes the rate.
    pub(super) radius_m: f64,
    pub(super) asked_deg_s: f64,
}

impl Task {
    /// Stops, then holds the place.
    pub(super) const STOP: Self = Self::Velocity {
        wanted_m_s: DVec3::ZERO,
        until: Duration::MAX,
    };

    /// Flies to a fixed point.
    pub(super) fn goto(goal_m: DVec3) -> Self {
        Self::Goto {
            goal_m,
            drift_m_s: DVec3::ZERO,
            drift_until: Duration::ZERO,
        }
    }

    /// The kind of target in GUIDED: a place, a moving place, a velocity, an acceleration, or none.
    pub(super) fn kind(&self) -> u8 {
        match self {
            Self::Goto { drift_m_s, .. } if *drift_m_s == DVec3::ZERO => 1,
            Self::Goto { .. } => 2,
            Self::Velocity { .. } => 3,
            Self::Accelerate { .. } => 4,
            Self::Wait
            | Self::Takeoff(_)
            | Self::Attitude(_)
            | Self::Brake
            | Self::Return(_)
            | Self::Land(_)
            | Self::Circle(_)
            | Self::Route(_)
            | Self::Orbit(_)
            | Self::Piloted
            | Self::Manual
            | Self::Drive(_) => 0,
        }
    }

    /// When a landing touched the ground.
    pub(super) fn touched_in_landing(&self) -> Option<Duration> {
        match self {
            Self::Land(landing) => landing.touched,
            Self::Return(returning) => returning.landing().and_then(|landing| landing.touched),
            Self::Wait
            | Self::Takeoff(_)
            | Self::Goto { .. }
            | Self::Velocity { .. }
            | Self::Accelerate { .. }
            | Self::Attitude(_)
            | Self::Brake
            | Self::Circle(_)
            | Self::Route(_)
            | Self::Orbit(_)
            | Self::Piloted
            | Self::Manual
            | Self::Drive(_) => None,
        }
    }

    /// Whether a vehicle on the ground with this task has nothing more to do.
    pub(super) fn is_resting(&self, throttle_is_low: bool) -> bool {
        match self {
            Self::Wait | Self::Route(_) => true,
            Self::Manual | Self::Piloted => throttle_is_low,
            Self::Takeoff(_)
            | Self::Goto { .. }
            | Self::Velocity { .. }
            | Self::Accelerate { .. }
            | Self::Attitude(_)
            | Self::Brake
            | Self::Return(_)
            | Self::Land(_)
            | Self::Circle(_)
            | Self::Orbit(_)
            | Self::Drive(_) => false,
        }
    }

    /// A circle whose centre is ahead of the nose.
    pub(super) fn circle(body: &Body, tuning: &FlightTuning) -> Self {
        let (sin, cos) = maths::sin_cos(body.yaw_deg.to_radians());
        let here = body.position_m.truncate();
        Self::Circle(Circle {
            centre_m: here + DVec2::new(cos, sin) * tuning.circle_radius_m,
            angle_rad: body.yaw_deg.to_radians() + std::f64::consts::PI,
            rate_rad_s: 0.0,
            down_m: body.position_m.z,
            radius_m: tuning.circle_radius_m,
            asked_deg_s: tuning.circle_rate_deg_s,
        })
    }

    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        match self {
            Self::Wait | Self::Drive(_) => return Act::Idle,
            Self::Takeoff(takeoff) => return takeoff.step(cockpit),
            Self::Land(landing) => return landing.step(cockpit),
            Self::Return(returning) => return returning.step(cockpit),
            Self::Route(route) => return route.step(cockpit),
            Self::Orbit(orbit) => return orbit.step(cockpit),
            Self::Piloted => return piloted::step(cockpit),
            Self::Manual => return piloted::manual(cockpit),
            Self::Attitude(attitude) => return attitude.step(cockpit),
            Self::Goto {
                goal_m,
                drift_m_s,
                drift_until,
            } => {
                let fresh = cockpit.now < *drift_until;
                if *drift_m_s == DVec3::ZERO {
                    cockpit.control.towards(*goal_m, &cockpit.limits);
                } else {
                    let moving = if fresh { *drift_m_s } else { DVec3::ZERO };
                    cockpit.control.chase(*goal_m, moving, &cockpit.limits);
                    *goal_m += moving * STEP_S;
                }
            }
            Self::Velocity { wanted_m_s, until } => {
                let fresh = cockpit.now < *until && *until != Duration::MAX;
                let wanted = keep_inside(cockpit, if fresh { *wanted_m_s } else { DVec3::ZERO });
                if fresh {
                    // A speed reduced by the fence stays reduced until the next setpoint.
                    *wanted_m_s = wanted;
                }
                let limits = cockpit.limits.overspeed(cockpit.control.velocity_m_s.z);
                cockpit.control.at_velocity(wanted, &limits);
            }
            Self::Accelerate { wanted_m_s2, until } => {
                if cockpit.now < *until {
                    cockpit
                        .control
                        .at_acceleration(*wanted_m_s2, &cockpit.limits);
                } else {
                    cockpit.control.at_velocity(DVec3::ZERO, &cockpit.limits);
                }
            }
            Self::Brake => brake(cockpit),
            Self::Circle(circle) => circle.step(cockpit),
        }
        Act::Fly
    }
}

/// A wanted velocity, slowed so that the vehicle stays inside its fence.
fn keep_inside(cockpit: &mut Cockpit<'_>, wanted_m_s: DVec3) -> DVec3 {
    let points_m = [cockpit.body.position_m, cockpit.home_m];
    let rules = &cockpit.tuning.fence;
    let limits = &cockpit.limits;
    cockpit
        .fence
        .keep_inside(wanted_m_s, rules, points_m, limits, cockpit.now)
}

fn brake(cockpit: &mut Cockpit<'_>) {
    let limits = Limits {
        accel_m_s2: BRAKE_ACCEL_M_S2,
        ..cockpit.limits
    };
    cockpit.control.at_velocity(DVec3::ZERO, &limits);
}

impl Circle {
    /// Pitch forward shrinks the circle at up to the cruise speed, roll changes the turn rate by up
    /// to 1 degree per second each second, and the throttle stick sets the climb rate.
    fn obey_sticks(&mut self, cockpit: &Cockpit<'_>) {
        let [roll, pitch, ..] = &cockpit.tuning.radio.sticks;
        let channels = &cockpit.sticks.channels_us;
        let (right, back) = (roll.off_centre(channels[0]), pitch.off_centre(channels[1]));
        if back != 0.0 {
            let grown_m = self.radius_m + back * cockpit.tuning.speed_m_s * STEP_S;
            self.radius_m = grown_m.clamp(0.0, CIRCLE_MAX_M);
        }
        if right != 0.0 {
            let faster = self.rate_rad_s.to_degrees() + right * STEP_S;
            self.asked_deg_s = if self.asked_deg_s < 0.0 {
                faster.clamp(-CIRCLE_MAX_DEG_S, 0.0)
            } else {
                faster.clamp(0.0, CIRCLE_MAX_DEG_S)
            };
        }
        if cockpit.piloted {
            self.down_m -= piloted::climb_m_s(cockpit) * STEP_S;
        }
    }

    fn step(&mut self, cockpit: &mut Cockpit<'_>) {
        self.obey_sticks(cockpit);
        let radius_m = self.radius_m;
        let most = (cockpit.limits.speed_m_s / radius_m.max(0.1))
            .min((0.5 * cockpit.limits.accel_m_s2 / radius_m.max(0.1)).sqrt());
        let wanted = self.asked_deg_s.to_radians().clamp(-most, most);
        let spin_up = 0.5 * cockpit.limits.accel_m_s2 / radius_m.max(1.0) * STEP_S;
        self.rate_rad_s += (wanted - self.rate_rad_s).clamp(-spin_up, spin_up);
        self.angle_rad += self.rate_rad_s * STEP_S;
        let (sin, cos) = maths::sin_cos(self.angle_rad);
        let outwards = DVec2::new(cos, sin) * radius_m;
        let planned = FlatMotion {
            place_m: self.centre_m + outwards,
            velocity_m_s: DVec2::new(-outwards.y, outwards.x) * self.rate_rad_s,
            accel_m_s2: -outwards * self.rate_rad_s * self.rate_rad_s,
        };
        let limits = cockpit.limits;
        cockpit.control.along(&planned, self.down_m, &limits);
    }
}
