//! Slowing down in front of a fence: `ArduPilot`'s simple avoidance (`AC_Avoid`).
//!
//! The speed towards an edge is limited so that the vehicle can stop a margin before it; inside the margin it backs
//! away slowly. The limited velocity itself changes with a limited acceleration.

use std::time::Duration;

use glam::{DVec2, DVec3};

use super::area::{AreaShape, FenceArea, is_inside};
use crate::kinematics::STEP_S;
use crate::kinematics::square_root;
use crate::parameters::Parameters;

/// The greatest deceleration that is planned for a stop before a fence, in m/s².
const ACCEL_MAX_M_S2: f64 = 1.0;
/// The share of the allowed acceleration that is used for backing away.
const BACKING_SHARE: f64 = 0.4;
/// The gain of the position control (`PSC_POSXY_P`, `PSC_POSZ_P`).
const POSITION_P: f64 = 1.0;
/// When the vehicle must stop instead of sliding, it looks ahead by its stopping distance, the
/// margin and this much more.
const LOOK_AHEAD_M: f64 = 0.02;
/// After a pause of this length the limited velocity starts again from the wanted one.
const MEMORY: Duration = Duration::from_millis(200);
/// Avoidance counts as active this long after it last changed a velocity.
const ACTIVE: Duration = Duration::from_millis(500);

/// The rules from the `AVOID_*` parameters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AvoidanceRules {
    at_fence: bool,
    /// Whether to stop in front of a fence instead of sliding along it.
    stops: bool,
    back_speed_m_s: f64,
    back_climb_m_s: f64,
    /// The strongest braking in metres per second squared; zero for no limit.
    accel_max_m_s2: f64,
}

impl AvoidanceRules {
    pub(super) fn read(all: &Parameters) -> Self {
        Self {
            at_fence: all.value("AVOID_ENABLE") as u8 & 1 != 0,
            stops: all.value("AVOID_BEHAVE") as i32 == 1,
            back_speed_m_s: all.value("AVOID_BACKUP_SPD").max(0.0),
            back_climb_m_s: all.value("AVOID_BACKZ_SPD").max(0.0),
            accel_max_m_s2: all.value("AVOID_ACCEL_MAX").max(0.0),
        }
    }
}

/// The fences that limit the flight now.
pub(super) struct Edges<'a> {
    pub(super) rules: &'a AvoidanceRules,
    pub(super) margin_m: f64,
    /// The circle around home, if it is on and not broken: its radius in metres, and the vehicle's position relative to
    /// home.
    pub(super) around_home: Option<(f64, DVec2)>,
    pub(super) areas: &'a [FenceArea<DVec2>],
    /// The room below the ceiling, in metres; `None` without a ceiling.
    pub(super) headroom_m: Option<f64>,
    /// The vehicle's position in metres north and east of the start.
    pub(super) here_m: DVec2,
    /// The limits of the position control, horizontal and vertical.
    pub(super) accel_m_s2: (f64, f64),
}

#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Limiter {
    last: Option<(Duration, DVec3)>,
}

impl Limiter {
    /// Whether a velocity has been changed recently.
    pub(super) fn is_active(&self, now: Duration) -> bool {
        self.last.is_some_and(|(at, _)| now < at + ACTIVE)
    }

    /// Reduces a wanted velocity to the allowed one.
    pub(super) fn limit(&mut self, wanted_m_s: DVec3, edges: &Edges<'_>, now: Duration) -> DVec3 {
        if !edges.rules.at_fence {
            return wanted_m_s;
        }
        let (flat, backing) = edges.limit_level(wanted_m_s.truncate());
        let (climb, sink) = edges.limit_climb(-wanted_m_s.z);
        let mut limited = flat.extend(-climb);
        back_away(&mut limited, backing, edges.rules.back_speed_m_s);
        if sink > 0.0 && edges.rules.back_climb_m_s > 0.0 {
            limited.z = limited.z.max(sink.min(edges.rules.back_climb_m_s));
        }
        if limited.distance_squared(wanted_m_s) < 1e-18 {
            return wanted_m_s;
        }
        let before = match self.last {
            Some((at, velocity)) if now <= at + MEMORY => velocity,
            _ => wanted_m_s,
        };
        if edges.rules.accel_max_m_s2 > 0.0 {
            let most = edges.rules.accel_max_m_s2 * STEP_S;
            limited = before + (limited - before).clamp_length_max(most);
        }
        self.last = Some((now, limited));
        limited
    }
}

/// Raises a velocity to the backing velocity, along each axis that has one.
fn back_away(limited: &mut DVec3, backing: DVec2, most_m_s: f64) {
    if most_m_s <= 0.0 {
        return;
    }
    let backing = backing.clamp_length_max(most_m_s);
    let at_least = |own: f64, back: f64| match back {
        back if back > 0.0 => own.max(back),
        back if back < 0.0 => own.min(back),
        _ => own,
    };
    limited.x = at_least(limited.x, backing.x);
    limited.y = at_least(limited.y, backing.y);
}

/// The strongest backing velocities by quadrant: edges on different sides do not add up, opposite ones cancel.
#[derive(Default)]
struct Backing {
    quadrants: [DVec2; 4],
}

impl Backing {
    fn push(&mut self, velocity: DVec2) {
        if velocity == DVec2::ZERO {
            return;
        }
        let place = usize::from(velocity.x < 0.0) + 2 * usize::from(velocity.y < 0.0);
        let own = &mut self.quadrants[place];
        let stronger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        *own = DVec2::new(stronger(own.x, velocity.x), stronger(own.y, velocity.y));
    }

    /// Adds a velocity away from an edge that is `too_near_m` closer than the margin.
    fn away_from(&mut self, towards: DVec2, too_near_m: f64, accel_m_s2: f64) {
        let speed = square_root(too_near_m, POSITION_P, BACKING_SHARE * accel_m_s2);
        self.push(-towards.normalize_or_zero() * speed);
    }

    fn sum(&self) -> DVec2 {
        self.quadrants.iter().sum()
    }
}

impl Edges<'_> {
    fn accel(&self) -> f64 {
        self.accel_m_s2.0.min(ACCEL_MAX_M_S2)
    }

    /// The climb rate allowed under the ceiling, and the sink rate demanded above it.
    fn limit_climb(&self, climb: f64) -> (f64, f64) {
        let Some(headroom_m) = self.headroom_m else {
            return (climb, 0.0);
        };
        // A vehicle that does not climb is not limited, even above the ceiling.
        if climb <= 0.0 {
            return (climb, 0.0);
        }
        let accel = self.accel_m_s2.1.min(ACCEL_MAX_M_S2);
        let speed = square_root(headroom_m, POSITION_P, accel);
        if headroom_m <= 0.0 {
            (0.0, -speed)
        } else {
            (climb.min(speed), 0.0)
        }
    }

    /// The allowed horizontal velocity, and the velocity away from edges that are too close.
    fn limit_level(&self, mut wanted: DVec2) -> (DVec2, DVec2) {
        let mut total = Backing::default();
        if let Some((radius_m, from_home)) = self.around_home
            && wanted != DVec2::ZERO
        {
            let mut backing = Backing::default();
            self.inside_circle(&mut wanted, from_home, radius_m, &mut backing);
            total.push(backing.sum());
        }
        // Polygons, then inclusion circles, then exclusion circles: each kind gathers its own backing.
        for kind in self.areas.chunk_by(|a, b| group(a) == group(b)) {
            let mut backing = Backing::default();
            for area in kind {
                match &area.shape {
                    AreaShape::Polygon(corners) => {
                        if is_inside(self.here_m, corners) == area.keeps_in {
                            self.polygon(&mut wanted, corners, &mut backing);
                        }
                    }
                    AreaShape::Circle { centre, radius_m } => {
                        let from_centre = self.here_m - *centre;
                        if area.keeps_in {
                            self.inside_circle(&mut wanted, from_centre, *radius_m, &mut backing);
                        } else {
                            self.outside_circle(&mut wanted, from_centre, *radius_m, &mut backing);
                        }
                    }
                }
            }
            total.push(backing.sum());
        }
        (wanted, total.sum())
    }

    fn polygon(&self, wanted: &mut DVec2, corners: &[DVec2], backing: &mut Backing) {
        let mut safe = *wanted;
        let ahead = safe.normalize_or_zero() * self.look_ahead_m(safe.length());
        let mut own = Backing::default();
        let next = corners.iter().skip(1).chain(corners.first());
        for (&end, &start) in corners.iter().zip(next) {
            let towards = closest_point(self.here_m, start, end) - self.here_m;
            let distance_m = towards.length();
            if distance_m < self.margin_m {
                own.away_from(towards, self.margin_m - distance_m, self.accel());
            }
            if *wanted == DVec2::ZERO {
                continue;
            }
            let limited_by = if self.rules.stops {
                crossing(self.here_m, self.here_m + ahead, start, end)
                    .map(|point| point - self.here_m)
            } else {
                Some(towards)
            };
            let Some(towards) = limited_by else {
                continue;
            };
            let distance_m = towards.length();
            if distance_m <= 1e-9 {
                // On the edge itself, there is no direction to limit.
                return;
            }
            if self.rules.stops && distance_m <= self.margin_m {
                safe = DVec2::ZERO;
            } else {
                self.limit_towards(&mut safe, towards / distance_m, distance_m - self.margin_m);
            }
        }
        *wanted = safe;
        backing.push(own.sum());
    }

    /// Limits the part of a velocity along `direction` so that the vehicle can stop within a distance.
    fn limit_towards(&self, wanted: &mut DVec2, direction: DVec2, distance_m: f64) {
        let most = self.speed_to_stop_in(distance_m.max(0.0));
        let speed = wanted.dot(direction);
        if speed > most {
            *wanted += direction * (most - speed);
        }
    }

    fn inside_circle(
        &self,
        wanted: &mut DVec2,
        from_centre: DVec2,
        radius_m: f64,
        backing: &mut Backing,
    ) {
        let distance_m = from_centre.length();
        let inner_m = radius_m - self.margin_m;
        if distance_m > radius_m || inner_m < 0.0 {
            return;
        }
        if distance_m > inner_m {
            backing.away_from(from_centre, distance_m - inner_m, self.accel());
        }
        let speed = wanted.length();
        if speed <= 0.0 {
            return;
        }
        if self.rules.stops {
            self.stop_at_circle(wanted, from_centre, inner_m, distance_m >= inner_m);
            return;
        }
        // Slide: aim at the point of the inner circle next to where the vehicle would come to rest.
        let rest = from_centre + *wanted / speed * self.stopping_distance_m(speed);
        let rest_m = rest.length();
        if rest_m <= inner_m {
            return;
        }
        let way = rest * (inner_m / rest_m) - from_centre;
        let way_m = way.length();
        if way_m > 0.0 {
            *wanted = way / way_m * speed.min(self.speed_to_stop_in(way_m));
        }
    }

    fn outside_circle(
        &self,
        wanted: &mut DVec2,
        from_centre: DVec2,
        radius_m: f64,
        backing: &mut Backing,
    ) {
        let distance_m = from_centre.length();
        if distance_m < radius_m || radius_m < self.margin_m {
            return;
        }
        let gap_m = distance_m - radius_m;
        if gap_m < self.margin_m {
            backing.away_from(-from_centre, self.margin_m - gap_m, self.accel());
        }
        if *wanted == DVec2::ZERO {
            return;
        }
        if self.rules.stops {
            let outer_m = radius_m + self.margin_m;
            self.stop_at_circle(wanted, from_centre, outer_m, distance_m < outer_m);
        } else if gap_m > 0.0 {
            self.limit_towards(wanted, -from_centre / distance_m, gap_m - self.margin_m);
        }
    }

    /// Reduces a velocity that leads across a circle; within the margin only one that leads away from the edge
    /// remains.
    fn stop_at_circle(&self, wanted: &mut DVec2, from_centre: DVec2, radius_m: f64, near: bool) {
        let speed = wanted.length();
        let ahead = from_centre + *wanted / speed * self.look_ahead_m(speed);
        if near {
            let outwards = ahead.length() >= from_centre.length();
            if outwards == (from_centre.length() >= radius_m) {
                *wanted = DVec2::ZERO;
            }
        } else if let Some(way_m) = way_to_circle(from_centre, ahead, radius_m) {
            *wanted *= (self.speed_to_stop_in(way_m) / speed).min(1.0);
        }
    }

    fn speed_to_stop_in(&self, distance_m: f64) -> f64 {
        square_root(distance_m, POSITION_P, self.accel())
    }

    fn look_ahead_m(&self, speed: f64) -> f64 {
        LOOK_AHEAD_M + self.margin_m + self.stopping_distance_m(speed)
    }

    /// The inverse of [`Self::speed_to_stop_in`].
    fn stopping_distance_m(&self, speed: f64) -> f64 {
        let accel = self.accel();
        if speed < accel / POSITION_P {
            speed / POSITION_P
        } else {
            accel / (2.0 * POSITION_P * POSITION_P) + speed * speed / (2.0 * accel)
        }
    }
}

fn group(area: &FenceArea<DVec2>) -> (bool, bool) {
    let circle = matches!(area.shape, AreaShape::Circle { .. });
    (circle, circle && area.keeps_in)
}

fn closest_point(to: DVec2, start: DVec2, end: DVec2) -> DVec2 {
    let way = end - start;
    let length = way.length_squared();
    if length <= 0.0 {
        return start;
    }
    start + way * ((to - start).dot(way) / length).clamp(0.0, 1.0)
}

fn crossing(from: DVec2, to: DVec2, start: DVec2, end: DVec2) -> Option<DVec2> {
    let (way, edge) = (to - from, end - start);
    let across = way.perp_dot(edge);
    if across.abs() < 1e-12 {
        return None;
    }
    let along = (start - from).perp_dot(edge) / across;
    let beside = (start - from).perp_dot(way) / across;
    let within = (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&beside);
    within.then(|| from + way * along)
}

/// The distance along a segment to a circle around the origin, in metres.
fn way_to_circle(from: DVec2, to: DVec2, radius_m: f64) -> Option<f64> {
    let way = to - from;
    let a = way.length_squared();
    let b = 2.0 * from.dot(way);
    let c = from.length_squared() - radius_m * radius_m;
    let under = b * b - 4.0 * a * c;
    if a <= 0.0 || under < 0.0 {
        return None;
    }
    let root = under.sqrt();
    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
        .into_iter()
        .find(|share| (0.0..=1.0).contains(share))
        .map(|share| share * a.sqrt())
}
