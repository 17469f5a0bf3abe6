//! Flying from place to place in AUTO: straight legs joined by corners at speed (`AC_WPNav` with `AP_Math/SCurve`),
//! and circles.

mod curve;
mod orbit;

use glam::DVec3;

use self::curve::{CurveBounds, SpeedCurve};
pub(crate) use self::orbit::Orbit;
use super::drive::rolling_point;
use super::{Act, Cockpit};
use crate::control::Limits;
use crate::helm::HelmRules;
use crate::kinematics::STEP_S;
use crate::kinematics::square_root;
use crate::parameters::Parameters;

/// The path is not slowed for a vehicle that lags by less than this share of the wanted speed.
const SPEED_MARGIN: f64 = 0.05;
/// A turn begins only after this share of the leg.
const CORNER_FROM_SHARE: f64 = 0.5;

/// Real speed estimates are noisy by 4 cm/s, which starts legs slightly sooner; this constant bias, fitted to
/// recordings, has the same mean effect. Boats show none.
const SPEED_BIAS_M_S: f64 = 0.003;
/// The snap of a rover's path.
const ROVER_SNAP_M_S4: f64 = 15.0;

/// The parameters of AUTO.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "parameters are switched one by one"
)]
pub(crate) struct AutoRules {
    pub(crate) radius_m: f64,
    corner_accel_m_s2: f64,
    jerk_m_s3: f64,
    snap_m_s4: f64,
    /// The gain with which the vehicle follows the path.
    position_p: f64,
    /// The bias of the vehicle's estimated speed.
    speed_bias_m_s: f64,
    /// Whether a waypoint also counts as reached beyond its line.
    passes: bool,
    /// `MIS_RESTART`: AUTO always begins at the first item.
    pub(crate) restarts: bool,
    /// `MIS_OPTIONS` bit 2: a takeoff may follow a landing.
    pub(crate) continues_after_landing: bool,
    /// `AUTO_OPTIONS` bit 0: the vehicle may be armed in AUTO.
    pub(crate) may_arm: bool,
    /// `AUTO_OPTIONS` bit 1: takeoffs do not need a raised throttle.
    pub(crate) lifts_unasked: bool,
}

impl AutoRules {
    pub(crate) fn read(all: &Parameters) -> Self {
        let bit = |name: &str, bit: i32| (all.value(name) as i32) & bit != 0;
        let accel = (all.value("WPNAV_ACCEL") * 0.01).clamp(0.05, 1000.0);
        let asked_jerk = all.value("WPNAV_JERK");
        let jerk = if asked_jerk > 0.0 { asked_jerk } else { accel }.clamp(0.05, 1000.0);
        let corner = all.value("WPNAV_ACCEL_C") * 0.01;
        let smoothing_s = all.value("ATC_INPUT_TC").clamp(0.1, 10.0);
        Self {
            radius_m: (all.value("WPNAV_RADIUS") * 0.01).clamp(0.05, 1000.0),
            corner_accel_m_s2: if corner > 0.0 { corner } else { 2.0 * accel },
            jerk_m_s3: jerk,
            // Half of the snap that the time constant of the attitude allows.
            snap_m_s4: 0.5 * jerk * std::f64::consts::PI / (2.0 * smoothing_s),
            position_p: 1.0,
            speed_bias_m_s: 0.0,
            passes: false,
            restarts: all.value("MIS_RESTART") as i32 == 1,
            continues_after_landing: bit("MIS_OPTIONS", 4),
            may_arm: bit("AUTO_OPTIONS", 1),
            lifts_unasked: bit("AUTO_OPTIONS", 2),
        }
    }
}

impl AutoRules {
    /// The rules of a rover, with the limits of its helm.
    pub(super) fn of_rover(all: &Parameters, helm: &HelmRules, jerk_m_s3: f64) -> Self {
        Self {
            radius_m: all.value("WP_RADIUS").clamp(0.05, 1000.0),
            corner_accel_m_s2: helm.lateral_m_s2,
            jerk_m_s3,
            snap_m_s4: ROVER_SNAP_M_S4,
            position_p: helm.position_p,
            speed_bias_m_s: if helm.is_boat { 0.0 } else { SPEED_BIAS_M_S },
            passes: true,
            ..Self::read(all)
        }
    }
}

/// One straight leg and how far along it the path is.
#[derive(Debug, Clone, PartialEq)]
struct LegTrack {
    to_m: DVec3,
    direction: DVec3,
    length_m: f64,
    fastest_m_s: f64,
    curve: SpeedCurve,
    time_s: f64,
}

impl LegTrack {
    fn plan(from_m: DVec3, to_m: DVec3, limits: &Limits, rules: &AutoRules) -> Self {
        let way = to_m - from_m;
        let direction = way.normalize_or_zero();
        let bounds = bounds(direction, limits, rules);
        Self {
            to_m,
            direction,
            length_m: way.length(),
            fastest_m_s: bounds.speed_m_s,
            curve: SpeedCurve::plan(way.length(), &bounds),
            time_s: 0.0,
        }
    }

    fn advance(&mut self, dt_s: f64) {
        self.time_s = (self.time_s + dt_s).min(self.curve.end_s);
    }

    fn left_s(&self) -> f64 {
        self.curve.end_s - self.time_s
    }

    fn is_over(&self) -> bool {
        self.time_s >= self.curve.end_s
    }

    /// The displacement from its start, the velocity and the acceleration at a time.
    fn at(&self, time_s: f64) -> [DVec3; 3] {
        let motion = self.curve.at(time_s);
        [motion.way_m, motion.speed_m_s, motion.accel_m_s2].map(|along| self.direction * along)
    }

    fn change_speed(&mut self, limits: &Limits, rules: &AutoRules) {
        let bounds = bounds(self.direction, limits, rules);
        self.fastest_m_s = bounds.speed_m_s;
        self.curve.change_speed(self.time_s, &bounds);
    }
}

/// The limits along a direction that stay within both the horizontal and the vertical ones.
fn bounds(direction: DVec3, limits: &Limits, rules: &AutoRules) -> CurveBounds {
    let (flat, steep) = (direction.truncate().length(), direction.z.abs());
    let along = |horizontal: f64, vertical: f64| {
        let by = |limit: f64, share: f64| {
            if share > 1e-6 {
                limit / share
            } else {
                f64::INFINITY
            }
        };
        let most = by(horizontal, flat).min(by(vertical, steep));
        if most.is_finite() { most } else { horizontal }
    };
    let vertical_m_s = if direction.z < 0.0 {
        limits.speed_up_m_s
    } else {
        limits.speed_down_m_s
    };
    CurveBounds {
        speed_m_s: along(limits.speed_m_s, vertical_m_s).max(0.01),
        accel_m_s2: along(limits.accel_m_s2, limits.accel_z_m_s2),
        jerk_m_s3: rules.jerk_m_s3,
        snap_m_s4: rules.snap_m_s4,
    }
}

/// A route of straight legs. While one leg is flown, the previous one may still be ending, and the next one may have
/// begun.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Route {
    from_m: DVec3,
    before: Option<LegTrack>,
    this: LegTrack,
    after: Option<LegTrack>,
    /// Whether the waypoint has been reached: a corner at its apex, any other within `WPNAV_RADIUS`.
    pub(crate) reached: bool,
    planned_for: Limits,
    /// The share of the speed at which a vehicle that lags behind can keep up.
    keeping_up: f64,
    /// The share of the speed that remains during a pause, and how fast it changes.
    pace: f64,
    pace_per_s: f64,
    pub(crate) paused: bool,
    /// Whether a rover turns on the spot before it drives on.
    pub(super) pivots: bool,
}

impl Route {
    /// Stops at once and holds the place where the vehicle comes to rest.
    pub(crate) fn standing(cockpit: &mut Cockpit<'_>) -> Self {
        let from_m = match cockpit.tuning.helm.as_deref() {
            Some(rules) => rolling_point(cockpit, rules),
            None => stopping_point(cockpit),
        };
        Self::waiting_at(from_m, cockpit)
    }

    /// Holds a place, and continues from there.
    pub(crate) fn waiting_at(from_m: DVec3, cockpit: &mut Cockpit<'_>) -> Self {
        cockpit.control.follow(from_m, DVec3::ZERO, DVec3::ZERO);
        Self {
            from_m,
            before: None,
            this: LegTrack::plan(from_m, from_m, &cockpit.limits, &cockpit.tuning.auto),
            after: None,
            reached: true,
            planned_for: cockpit.limits,
            keeping_up: 1.0,
            pace: 1.0,
            pace_per_s: 0.0,
            paused: false,
            pivots: false,
        }
    }

    pub(crate) fn goal_m(&self) -> DVec3 {
        self.this.to_m
    }

    /// Continues to a point; an unfinished leg is abandoned first.
    pub(crate) fn go_to(&mut self, goal_m: DVec3, cockpit: &mut Cockpit<'_>) {
        if !self.reached {
            *self = Self::standing(cockpit);
        }
        let next = match self.after.take() {
            Some(begun) if begun.to_m.distance_squared(goal_m) < 1e-6 && !begun.is_over() => begun,
            _ => LegTrack::plan(
                self.this.to_m,
                goal_m,
                &cockpit.limits,
                &cockpit.tuning.auto,
            ),
        };
        self.from_m = self.this.to_m;
        self.before = Some(std::mem::replace(&mut self.this, next));
        self.reached = false;
    }

    /// Continues to a further point without stopping at the goal.
    pub(crate) fn then_to(&mut self, further_m: DVec3, cockpit: &Cockpit<'_>) {
        let rules = &cockpit.tuning.auto;
        self.after = Some(LegTrack::plan(
            self.this.to_m,
            further_m,
            &cockpit.limits,
            rules,
        ));
    }

    /// Whether the goal is within `WPNAV_RADIUS`, at any height.
    pub(crate) fn is_over_goal(&self, cockpit: &Cockpit<'_>) -> bool {
        let way = cockpit.body.position_m - self.this.to_m;
        way.truncate().length() <= cockpit.tuning.auto.radius_m
    }

    pub(super) fn step(&mut self, cockpit: &mut Cockpit<'_>) -> Act {
        if cockpit.body.on_ground {
            return Act::Idle;
        }
        self.advance_path(cockpit);
        Act::Fly
    }

    /// Whether the current leg has not begun.
    pub(super) fn is_at_start(&self) -> bool {
        !self.reached && self.this.time_s == 0.0
    }

    /// Whether the route continues beyond the goal without a stop.
    pub(super) fn goes_on(&self) -> bool {
        self.after.is_some()
    }

    /// Moves the path along the route by one step.
    pub(super) fn advance_path(&mut self, cockpit: &mut Cockpit<'_>) {
        if self.planned_for != cockpit.limits {
            self.take_limits(cockpit);
        }
        let dt_s = self.time_step(cockpit);
        let over = self.advance(dt_s, cockpit);
        let [mut way, mut velocity, mut accel] = self.this.at(self.this.time_s);
        if let Some(before) = &self.before {
            let [offset, v, a] = before.at(before.time_s);
            way += offset - before.direction * before.length_m;
            velocity += v;
            accel += a;
        }
        if let Some(after) = self.after.as_ref().filter(|after| after.time_s > 0.0) {
            let [offset, v, a] = after.at(after.time_s);
            way += offset;
            velocity += v;
            accel += a;
        }
        let slowing = velocity * self.pace_per_s;
        cockpit.control.follow(
            self.from_m + way,
            velocity * self.pace,
            accel * (self.pace * self.pace) + slowing,
        );
        if over && !self.reached {
            let way = cockpit.body.position_m - self.this.to_m;
            let rules = &cockpit.tuning.auto;
            let is_past = rules.passes && way.dot(self.this.direction) > 0.0;
            self.reached = self.after.is_some() || is_past || way.length() <= rules.radius_m;
        }
    }

    fn take_limits(&mut self, cockpit: &Cockpit<'_>) {
        let rules = &cockpit.tuning.auto;
        self.planned_for = cockpit.limits;
        self.this.change_speed(&cockpit.limits, rules);
        if let Some(after) = &mut self.after {
            after.change_speed(&cockpit.limits, rules);
        }
    }

    /// The time by which the path advances in a step, in seconds: less than the step when the vehicle lags behind, or
    /// pauses.
    fn time_step(&mut self, cockpit: &Cockpit<'_>) -> f64 {
        let wanted = cockpit.control.velocity_m_s;
        let speed = wanted.length();
        let mut possible = 1.0;
        if speed > 1e-6 {
            let along = wanted / speed;
            let behind_m = (cockpit.control.path_m - cockpit.body.position_m).dot(along);
            let moving_m_s = cockpit.body.velocity_m_s.dot(along);
            let rules = &cockpit.tuning.auto;
            let able_m_s = moving_m_s + rules.speed_bias_m_s - rules.position_p * behind_m;
            possible = (SPEED_MARGIN + able_m_s / speed).clamp(0.0, 1.0);
        }
        let lag_s = cockpit.limits.accel_m_s2 / cockpit.tuning.auto.jerk_m_s3;
        self.keeping_up += (possible - self.keeping_up) * (STEP_S / lag_s).min(1.0);
        self.change_pace(&cockpit.limits);
        self.keeping_up * self.pace * STEP_S
    }

    /// Reduces the pace to zero for a pause and raises it again afterwards, with limited acceleration and jerk.
    fn change_pace(&mut self, limits: &Limits) {
        let asked = if self.paused { 0.0 } else { 1.0 };
        let error = asked - self.pace;
        if error == 0.0 && self.pace_per_s == 0.0 {
            return;
        }
        // In a pause the pace approaches zero without reaching it, so the path still waits for a
        // vehicle that lags.
        let most = limits.accel_m_s2 / limits.speed_m_s;
        let jerk = limits.jerk_m_s3 / limits.speed_m_s;
        let wanted = square_root(error, jerk / most, jerk).clamp(-most, most);
        self.pace_per_s += (wanted - self.pace_per_s).clamp(-jerk * STEP_S, jerk * STEP_S);
        self.pace = (self.pace + self.pace_per_s * STEP_S).clamp(0.0, 1.0);
        if error.abs() < 1e-3 && !self.paused {
            self.pace = asked;
            self.pace_per_s = 0.0;
        }
    }

    /// Advances the legs; returns whether the current one is over.
    fn advance(&mut self, dt_s: f64, cockpit: &Cockpit<'_>) -> bool {
        if let Some(before) = &mut self.before {
            before.advance(dt_s);
            if before.is_over() {
                self.before = None;
            }
        }
        self.this.advance(dt_s);
        let over = self.this.is_over();
        let Some(after) = &mut self.after else {
            return over;
        };
        if after.time_s > 0.0 {
            after.advance(dt_s);
            return over || after.time_s >= self.this.left_s();
        }
        if may_turn(&self.this, after, &cockpit.tuning.auto) {
            after.advance(dt_s);
        }
        over
    }
}

/// Whether the next leg may begin now: at the apex the vehicle then passes close enough to the corner, no faster than
/// either leg allows and without leaning too far.
fn may_turn(this: &LegTrack, next: &LegTrack, rules: &AutoRules) -> bool {
    let early = this.time_s < this.curve.brake_s - next.curve.turn_in_s;
    let [way, ..] = this.at(this.time_s);
    let near_start = way.length() < CORNER_FROM_SHARE * this.length_m;
    if early || near_start || this.left_s() >= next.curve.end_s * 0.5 {
        return false;
    }
    let half_s = this.left_s() * 0.5;
    let [out, out_v, out_a] = this.at(this.time_s + half_s);
    let [into, into_v, into_a] = next.at(half_s);
    let off_m = out + into - this.direction * this.length_m;
    let slowest = this.fastest_m_s.min(next.fastest_m_s);
    let speed = (out_v + into_v).truncate().length();
    off_m.length() < rules.radius_m
        && speed < slowest
        && (out_a + into_a).truncate().length() < rules.corner_accel_m_s2
}

/// The place where the vehicle comes to rest if it stops now.
pub(crate) fn stopping_point(cockpit: &Cockpit<'_>) -> DVec3 {
    let body = cockpit.body;
    let limits = &cockpit.limits;
    let flat = body.velocity_m_s.truncate();
    let speed = flat.length().min(limits.speed_m_s);
    let flat_m = flat.normalize_or_zero() * stopping_way(speed, limits.accel_m_s2);
    let climb = body.velocity_m_s.z;
    let fall_m = climb.signum() * stopping_way(climb.abs(), limits.accel_z_m_s2);
    body.position_m + flat_m.extend(fall_m)
}

/// The distance that the square-root controller with a gain of 1 needs from a speed to rest, in metres.
fn stopping_way(speed_m_s: f64, accel_m_s2: f64) -> f64 {
    if speed_m_s < accel_m_s2 {
        speed_m_s
    } else {
        accel_m_s2 / 2.0 + speed_m_s * speed_m_s / (2.0 * accel_m_s2)
    }
}
