//! What a rover does: driving to places, along legs and by a pilot's sticks, and standing still.

mod circle;
mod follow;
mod heading;
mod sticks;

use std::time::Duration;

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::MavSeverity;

pub(crate) use self::circle::{CirclePlace, DriveCircle};
pub(crate) use self::heading::DriveHeading;
pub(crate) use self::sticks::of as stick_outputs;
use super::{Cockpit, Route, Task};
use crate::control::FlatMotion;
use crate::helm::{Course, HelmRules, PIVOT_WITHIN_DEG, bearing_deg};
use sortie_geo::wrap_180;

/// A path has arrived when it is this close to its goal, in metres.
const PATH_ARRIVED_M: f64 = 0.01;
/// The share of its speed that a boat loses when the place to hold is at right angles to its heading.
const LOITER_SLOWING: f64 = 0.5;

/// The level of the surface on which a rover moves, in metres down from the start.
const SURFACE_M: f64 = 0.0;

/// A point on the surface.
pub(crate) fn on_surface(point_m: DVec3) -> DVec3 {
    point_m.truncate().extend(SURFACE_M)
}

/// A task that only rovers have.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Drive {
    /// Lets the vehicle roll, with the motors off.
    Hold,
    /// Brakes and stands; a boat holds its place.
    Stop,
    /// A pilot's sticks set steering and throttle.
    Manual,
    /// A pilot's sticks set a turn rate and a speed.
    Acro,
    /// A pilot's sticks set an acceleration to the side and a speed.
    Steering,
    /// A pilot's sticks point where the vehicle drives, seen from its heading on entering the mode.
    Simple { ahead_deg: f64 },
    /// Drives to a place of GUIDED, and stays there.
    Goto(Goto),
    /// Drives along a heading or turns, as long as setpoints arrive.
    Setpoint(DriveSetpoint),
    /// Holds a place by driving back to it.
    Loiter(Loiter),
    /// Drives home, or back along the path.
    Return(DriveHome),
    /// Drives around a place.
    Circle(DriveCircle),
    /// Drives at a speed while turning to a heading.
    Heading(DriveHeading),
    /// Follows another vehicle, no faster than a speed in m/s.
    Follow(f64),
}

/// A drive to a place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Goto {
    pub(crate) goal_m: DVec3,
    /// The place on the path where the drive begins.
    from_m: DVec2,
    is_fresh: bool,
    pivots: bool,
    arrived: bool,
}

/// A setpoint of GUIDED, and when it ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DriveSetpoint {
    pub(crate) wanted: SetpointCourse,
    pub(crate) speed_m_s: f64,
    pub(crate) until: Duration,
    pub(crate) is_over: bool,
}

/// The direction of a setpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SetpointCourse {
    Heading(f64),
    TurnRate(f64),
}

/// A place to hold, and the heading while the vehicle is near it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Loiter {
    pub(crate) place_m: DVec2,
    heading_deg: f64,
}

/// A drive home along legs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DriveHome {
    pub(crate) route: Box<Route>,
    retraces: bool,
    arrived: bool,
}

/// What happened in a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DriveNews {
    /// A place of GUIDED was reached.
    Reached,
    /// A text for the ground stations.
    Say(MavSeverity, &'static str),
}

const ARRIVED: DriveNews = DriveNews::Say(MavSeverity::MAV_SEVERITY_INFO, "Reached destination");
const SILENT: DriveNews = DriveNews::Say(
    MavSeverity::MAV_SEVERITY_WARNING,
    "target not received last 3secs, stopping",
);

impl Task {
    /// The course of a rover for this step, and what happened.
    pub(crate) fn course(
        &mut self,
        cockpit: &mut Cockpit<'_>,
        rules: &HelmRules,
    ) -> (Course, Option<DriveNews>) {
        match self {
            Self::Drive(drive) => drive.course(cockpit, rules),
            Self::Route(route) if route.reached && rules.is_boat && !route.goes_on() => {
                *self = Self::Drive(Drive::rest(cockpit, rules));
                self.course(cockpit, rules)
            }
            Self::Route(route) => (route.course(cockpit, rules), None),
            _ => (Course::Stop, None),
        }
    }

    /// A drive to a place, which continues from the path of the last one.
    pub(crate) fn drive_to(&self, goal_m: DVec3, cockpit: &mut Cockpit<'_>) -> Self {
        if !matches!(self, Self::Drive(Drive::Goto(_))) {
            cockpit.control.take_over(cockpit.body);
        }
        Self::Drive(Drive::Goto(Goto {
            goal_m,
            from_m: cockpit.control.path_m.truncate(),
            is_fresh: true,
            pivots: false,
            arrived: false,
        }))
    }
}

impl Drive {
    /// Stands, or holds the place where a boat comes to rest.
    pub(crate) fn rest(cockpit: &Cockpit<'_>, rules: &HelmRules) -> Self {
        if rules.is_boat {
            Self::Loiter(Loiter::here(cockpit, rules))
        } else {
            Self::Stop
        }
    }

    /// Around the place of the vehicle.
    pub(crate) fn circle(cockpit: &Cockpit<'_>, rules: &HelmRules) -> Self {
        Self::Circle(DriveCircle::here(cockpit, &rules.circle))
    }

    /// The way home, or to the best rally point.
    pub(crate) fn home(cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> Self {
        let here = cockpit.body.position_m;
        let goal = cockpit
            .rally
            .destination(&cockpit.tuning.rally, here, cockpit.home_m, |_| true);
        let mut route = route_from_here(cockpit, rules);
        route.go_to(on_surface(goal), cockpit);
        Self::Return(DriveHome {
            route: Box::new(route),
            retraces: false,
            arrived: false,
        })
    }

    /// The way back along the path that was driven.
    pub(crate) fn retracing(cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> Self {
        cockpit.trail.tidy(&cockpit.tuning.trail);
        Self::Return(DriveHome {
            route: Box::new(route_from_here(cockpit, rules)),
            retraces: true,
            arrived: false,
        })
    }

    /// The place to which the vehicle drives, if there is one.
    pub(crate) fn goal_m(&self) -> Option<DVec3> {
        match self {
            Self::Goto(goto) => Some(goto.goal_m),
            Self::Loiter(loiter) => Some(loiter.place_m.extend(SURFACE_M)),
            Self::Return(home) if home.retraces && home.arrived => None,
            Self::Return(home) => Some(home.route.goal_m()),
            Self::Circle(circle) => Some(circle.centre_m.extend(SURFACE_M)),
            Self::Hold
            | Self::Stop
            | Self::Manual
            | Self::Acro
            | Self::Steering
            | Self::Simple { .. }
            | Self::Setpoint(_)
            | Self::Heading(_)
            | Self::Follow(_) => None,
        }
    }

    /// How far the vehicle is to the left of its leg, in metres; 0 without a leg.
    pub(crate) fn cross_track_m(&self, here_m: DVec2) -> f64 {
        match self {
            Self::Goto(goto) => left_of_leg_m([goto.from_m, goto.goal_m.truncate()], here_m),
            Self::Return(home) => home.route.cross_track_m(here_m),
            _ => 0.0,
        }
    }

    /// The course of this step. A boat that has got where it was going loiters there from the next step on.
    fn course(
        &mut self,
        cockpit: &mut Cockpit<'_>,
        rules: &HelmRules,
    ) -> (Course, Option<DriveNews>) {
        let decided = self.course_of_task(cockpit, rules);
        if rules.is_boat && self.is_over() {
            *self = Self::rest(cockpit, rules);
        }
        decided
    }

    /// Whether nothing is left to drive to.
    fn is_over(&self) -> bool {
        match self {
            Self::Heading(heading) => heading.is_reached(),
            Self::Goto(goto) => goto.arrived,
            Self::Setpoint(setpoint) => setpoint.is_over,
            Self::Return(home) => home.arrived,
            Self::Hold
            | Self::Stop
            | Self::Manual
            | Self::Acro
            | Self::Steering
            | Self::Simple { .. }
            | Self::Loiter(_)
            | Self::Circle(_)
            | Self::Follow(_) => false,
        }
    }

    fn course_of_task(
        &mut self,
        cockpit: &mut Cockpit<'_>,
        rules: &HelmRules,
    ) -> (Course, Option<DriveNews>) {
        match self {
            Self::Hold => (Course::Off, None),
            Self::Stop => (Course::Stop, None),
            Self::Manual => (Course::Sticks(sticks::of(cockpit)), None),
            Self::Acro => (sticks::acro(sticks::of(cockpit), rules), None),
            Self::Steering => (sticks::steering(sticks::of(cockpit), cockpit, rules), None),
            Self::Simple { ahead_deg } => {
                (sticks::simple(sticks::of(cockpit), *ahead_deg, rules), None)
            }
            Self::Loiter(loiter) => (loiter.course(cockpit, rules), None),
            Self::Circle(circle) => (circle.course(cockpit, &rules.circle), None),
            Self::Follow(fastest_m_s) => (follow::course(cockpit, *fastest_m_s), None),
            Self::Heading(heading) => (heading.course(cockpit.body.yaw_deg), None),
            Self::Goto(goto) => {
                let (course, arrives) = goto.course(cockpit, rules);
                (course, arrives.then_some(DriveNews::Reached))
            }
            Self::Setpoint(setpoint) => setpoint.course(cockpit.now),
            Self::Return(home) => {
                let (course, arrives) = home.course(cockpit, rules);
                (course, arrives.then_some(ARRIVED))
            }
        }
    }
}

/// A route that begins where the vehicle comes to rest.
fn route_from_here(cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> Route {
    Route::waiting_at(rolling_point(cockpit, rules), cockpit)
}

/// The place where the vehicle comes to rest if it brakes now.
pub(super) fn rolling_point(cockpit: &Cockpit<'_>, rules: &HelmRules) -> DVec3 {
    let moving = cockpit.body.velocity_m_s.truncate();
    let way_m = if rules.accel_max_m_s2 > 0.0 {
        0.5 * moving.length_squared() / rules.accel_max_m_s2
    } else {
        0.0
    };
    let here_m = cockpit.body.position_m.truncate();
    (here_m + moving.normalize_or_zero() * way_m).extend(SURFACE_M)
}

impl Goto {
    /// The course, and whether the vehicle has arrived in this step.
    fn course(&mut self, cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> (Course, bool) {
        if self.arrived {
            return (Course::Stop, false);
        }
        let bearing = heading_towards(self.goal_m, cockpit);
        if must_pivot(&mut self.pivots, self.is_fresh, bearing, cockpit, rules) {
            return (Course::Pivot(bearing), false);
        }
        self.is_fresh = false;
        let limits = cockpit.limits;
        cockpit.control.towards(self.goal_m, &limits);
        let path = cockpit.control.flat_motion();
        let is_there = path.place_m.distance(self.goal_m.truncate()) < PATH_ARRIVED_M;
        let off_m = path.place_m.distance(cockpit.body.position_m.truncate());
        self.arrived = is_there && off_m < cockpit.tuning.auto.radius_m;
        (following(path, cockpit), self.arrived)
    }
}

impl Route {
    fn course(&mut self, cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> Course {
        let bearing = heading_towards(self.goal_m(), cockpit);
        let at_start = self.is_at_start();
        if must_pivot(&mut self.pivots, at_start, bearing, cockpit, rules) {
            return Course::Pivot(bearing);
        }
        self.advance_path(cockpit);
        following(cockpit.control.flat_motion(), cockpit)
    }
}

/// How far a place is to the left of a leg, in metres.
pub(super) fn left_of_leg_m([from_m, to_m]: [DVec2; 2], here_m: DVec2) -> f64 {
    (here_m - from_m).perp_dot((to_m - from_m).normalize_or_zero())
}

/// The heading of a vehicle that drives to a goal, forwards or backwards.
fn heading_towards(goal_m: DVec3, cockpit: &Cockpit<'_>) -> f64 {
    let bearing = bearing_deg(cockpit.body.position_m.truncate(), goal_m.truncate());
    if cockpit.backs_up {
        wrap_180(bearing + 180.0)
    } else {
        bearing
    }
}

fn following(point: FlatMotion, cockpit: &Cockpit<'_>) -> Course {
    Course::Follow {
        point,
        fastest_m_s: cockpit.limits.speed_m_s,
        backwards: cockpit.backs_up,
    }
}

/// Whether the vehicle turns on the spot now, at the start of a leg.
fn must_pivot(
    pivots: &mut bool,
    at_start: bool,
    bearing_deg: f64,
    cockpit: &Cockpit<'_>,
    rules: &HelmRules,
) -> bool {
    let Some(from_deg) = rules.pivot_from_deg.filter(|_| at_start) else {
        return false;
    };
    let error = wrap_180(bearing_deg - cockpit.body.yaw_deg).abs();
    *pivots = error > if *pivots { PIVOT_WITHIN_DEG } else { from_deg };
    *pivots
}

impl DriveSetpoint {
    fn course(&mut self, now: Duration) -> (Course, Option<DriveNews>) {
        if self.is_over {
            return (Course::Stop, None);
        }
        if now > self.until {
            self.is_over = true;
            return (Course::Stop, Some(SILENT));
        }
        let speed_m_s = self.speed_m_s;
        let course = match self.wanted {
            SetpointCourse::Heading(heading_deg) => Course::Heading {
                heading_deg,
                speed_m_s,
            },
            SetpointCourse::TurnRate(rate_deg_s) => Course::Turn {
                rate_deg_s,
                speed_m_s,
            },
        };
        (course, None)
    }
}

impl Loiter {
    /// Holds the place where the vehicle comes to rest.
    pub(crate) fn here(cockpit: &Cockpit<'_>, rules: &HelmRules) -> Self {
        Self {
            place_m: rolling_point(cockpit, rules).truncate(),
            heading_deg: cockpit.body.yaw_deg,
        }
    }

    fn course(&mut self, cockpit: &Cockpit<'_>, rules: &HelmRules) -> Course {
        let course = hold(self.place_m, self.heading_deg, cockpit, rules);
        if let Course::Heading { heading_deg, .. } = course {
            self.heading_deg = heading_deg;
        }
        course
    }
}

/// Drives back to a place, forwards or backwards; near it, the vehicle stops.
fn hold(place_m: DVec2, heading_deg: f64, cockpit: &Cockpit<'_>, rules: &HelmRules) -> Course {
    let here = cockpit.body.position_m.truncate();
    let beyond_m = here.distance(place_m) - rules.loiter_radius_m;
    if beyond_m <= 0.0 {
        return Course::Heading {
            heading_deg,
            speed_m_s: 0.0,
        };
    }
    let mut speed = (beyond_m * rules.loiter_speed_per_m).min(rules.speed_max_m_s);
    let mut heading_deg = bearing_deg(here, place_m);
    let mut error = wrap_180(heading_deg - cockpit.body.yaw_deg);
    if error.abs() > 90.0 {
        heading_deg = wrap_180(heading_deg + 180.0);
        error = wrap_180(heading_deg - cockpit.body.yaw_deg);
        speed = -speed;
    }
    Course::Heading {
        heading_deg,
        speed_m_s: speed * (1.0 - (error.abs() / 90.0).min(1.0) * LOITER_SLOWING),
    }
}

impl DriveHome {
    /// The course, and whether the vehicle has arrived in this step.
    fn course(&mut self, cockpit: &mut Cockpit<'_>, rules: &HelmRules) -> (Course, bool) {
        if self.arrived {
            return (Course::Stop, false);
        }
        let tuning = cockpit.tuning;
        if (cockpit.limits.speed_m_s - tuning.speed_m_s).abs() < f64::EPSILON {
            // No other speed was commanded.
            cockpit.limits.speed_m_s = tuning.return_speed_m_s;
        }
        if self.route.reached {
            let crumb = self.retraces.then(|| cockpit.trail.pop()).flatten();
            let Some((point_m, _)) = crumb else {
                self.arrived = true;
                return (Course::Stop, true);
            };
            let next = cockpit.trail.peek();
            self.route.go_to(on_surface(point_m), cockpit);
            if let Some((next_m, _)) = next {
                self.route.then_to(on_surface(next_m), cockpit);
            }
        }
        (self.route.course(cockpit, rules), false)
    }
}
