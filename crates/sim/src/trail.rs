//! The return path of `SMART_RTL`: breadcrumbs of the flight, simplified and with its loops removed
//! (`AP_SmartRTL`).

use std::time::Duration;

use glam::{DVec3, Vec3};

use super::parameters::Parameters;

/// The time between breadcrumbs, in steps.
pub(super) const EVERY_STEPS: u64 = 33;
/// The path is abandoned after this time without a position, or without room for breadcrumbs.
const PATIENCE: Duration = Duration::from_secs(15);
/// The maximum number of breadcrumbs that are ever kept.
const POINTS_MAX: f64 = 500.0;
/// The path is tidied when there is room for no more than this many further breadcrumbs.
const MARGIN: usize = 10;
/// Points closer to a straight line than this share of the accuracy are left out.
const SIMPLIFY_SHARE: f64 = 0.5;
/// A loop whose ends come closer to each other than this share of the accuracy is left out.
const PRUNE_SHARE: f64 = 0.99;

/// The rules from the `SRTL_*` parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrailRules {
    accuracy_m: f64,
    /// The maximum number of breadcrumbs; 0 disables `SMART_RTL`.
    points: usize,
}

impl TrailRules {
    pub(super) fn read(all: &Parameters) -> Self {
        Self {
            accuracy_m: all.value("SRTL_ACCURACY").clamp(0.1, 1e4),
            points: all.value("SRTL_POINTS").clamp(0.0, POINTS_MAX) as usize,
        }
    }
}

/// The breadcrumbs, from the place where home was set or the motors were armed to the vehicle's last position, in
/// metres from the start.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Trail {
    points_m: Vec<Vec3>,
    active: bool,
    /// When the position was last good, and when there was last room.
    good: Duration,
    kept: Duration,
}

impl Trail {
    /// Whether the path can be retraced.
    pub(super) fn is_active(&self) -> bool {
        self.active
    }

    /// Begins the path at a place; without a position it cannot be retraced.
    pub(super) fn begin(&mut self, here_m: Option<DVec3>, rules: &TrailRules, now: Duration) {
        self.points_m.clear();
        self.points_m.extend(here_m.map(DVec3::as_vec3));
        self.active = here_m.is_some() && rules.points > 0;
        (self.good, self.kept) = (now, now);
    }

    /// Notes the vehicle's position, if it is known. Returns the reason if the path is abandoned.
    pub(super) fn note(
        &mut self,
        here_m: Option<DVec3>,
        rules: &TrailRules,
        now: Duration,
    ) -> Option<&'static str> {
        if !self.active {
            return None;
        }
        let Some(here_m) = here_m else {
            return (now > self.good + PATIENCE).then(|| self.give_up("bad position"));
        };
        self.good = now;
        if self.keep(here_m, rules) {
            self.kept = now;
            return None;
        }
        (now > self.kept + PATIENCE).then(|| self.give_up("buffer full"))
    }

    fn give_up(&mut self, reason: &'static str) -> &'static str {
        *self = Self::default();
        reason
    }

    /// Stores a place unless it is near the last one; `false` if there is no room.
    fn keep(&mut self, here_m: DVec3, rules: &TrailRules) -> bool {
        let last = self.points_m.last().map(|point| point.as_dvec3());
        if last.is_some_and(|last| last.distance(here_m) < rules.accuracy_m) {
            return true;
        }
        if self.points_m.len() + MARGIN >= rules.points {
            self.tidy(rules);
        }
        let room = self.points_m.len() < rules.points;
        if room {
            self.points_m.push(here_m.as_vec3());
        }
        room
    }

    /// Removes points that the return does not need.
    pub(super) fn tidy(&mut self, rules: &TrailRules) {
        let mut points_m: Vec<DVec3> = self.points_m.iter().map(|p| p.as_dvec3()).collect();
        points_m = simplified(&points_m, rules.accuracy_m * SIMPLIFY_SHARE);
        prune(&mut points_m, rules.accuracy_m * PRUNE_SHARE);
        self.points_m = points_m.into_iter().map(DVec3::as_vec3).collect();
    }

    /// Removes and returns the last breadcrumb, and whether it is the first one of the flight;
    /// `None` if there are none left.
    pub(super) fn pop(&mut self) -> Option<(DVec3, bool)> {
        let point = self.points_m.pop()?;
        Some((point.as_dvec3(), self.points_m.is_empty()))
    }

    /// The next result of [`Trail::pop`].
    pub(super) fn peek(&self) -> Option<(DVec3, bool)> {
        let point = self.points_m.last()?;
        Some((point.as_dvec3(), self.points_m.len() == 1))
    }
}

/// The points without those closer than `epsilon_m` to the straight line past them (Ramer, Douglas and Peucker).
fn simplified(points_m: &[DVec3], epsilon_m: f64) -> Vec<DVec3> {
    let mut kept = vec![false; points_m.len()];
    let mut open = Vec::new();
    if let Some(last) = points_m.len().checked_sub(1) {
        (kept[0], kept[last]) = (true, true);
        open.push((0, last));
    }
    while let Some((first, last)) = open.pop() {
        let off = |place: usize| off_line(points_m[place], points_m[first], points_m[last]);
        let furthest = (first + 1..last).max_by(|a, b| off(*a).total_cmp(&off(*b)));
        if let Some(furthest) = furthest.filter(|place| off(*place) > epsilon_m) {
            kept[furthest] = true;
            open.extend([(first, furthest), (furthest, last)]);
        }
    }
    let pairs = points_m.iter().zip(kept);
    pairs.filter_map(|(p, kept)| kept.then_some(*p)).collect()
}

fn off_line(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = (to - from).normalize_or_zero();
    let way = point - from;
    (way - along * way.dot(along)).length()
}

/// Removes the loop between two legs that pass each other closer than `delta_m`.
fn prune(points_m: &mut Vec<DVec3>, delta_m: f64) {
    let mut from = 1;
    while from + 2 < points_m.len() {
        let one = [points_m[from - 1], points_m[from]];
        // The longest loop is removed first.
        let crossing = (from + 2..points_m.len()).rev().find_map(|to| {
            let [a, b] = nearest(one, [points_m[to - 1], points_m[to]]);
            (a.distance(b) < delta_m).then(|| (to, a.midpoint(b)))
        });
        if let Some((to, middle)) = crossing {
            points_m.splice(from..to, [middle]);
        }
        from += 1;
    }
}

/// The points of two stretches that are nearest to each other (Ericson, Real-Time Collision Detection, 5.1.9).
fn nearest(one: [DVec3; 2], other: [DVec3; 2]) -> [DVec3; 2] {
    let (way, along, apart) = (one[1] - one[0], other[1] - other[0], one[0] - other[0]);
    let (way_2, along_2) = (way.length_squared(), along.length_squared());
    let both = way.dot(along);
    let (apart_way, apart_along) = (apart.dot(way), apart.dot(along));
    let share = |part: f64, whole: f64| {
        if whole > 1e-12 {
            (part / whole).clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    // Valid for infinite lines only; points beyond an end are corrected below.
    let crossing = share(
        both * apart_along - apart_way * along_2,
        way_2 * along_2 - both * both,
    );
    let first_guess = share(both * crossing + apart_along, along_2);
    let on_one = share(both * first_guess - apart_way, way_2);
    let on_other = share(both * on_one + apart_along, along_2);
    [one[0] + way * on_one, other[0] + along * on_other]
}

#[cfg(test)]
mod tests {
    use super::*;
    use sortie_geo::maths;

    const RULES: TrailRules = TrailRules {
        accuracy_m: 2.0,
        points: 50,
    };

    fn flown(way: impl Iterator<Item = (f64, f64)>) -> (Trail, Vec<&'static str>) {
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &RULES, Duration::ZERO);
        let mut reasons = Vec::new();
        for (step, (north, east)) in way.enumerate() {
            let now = Duration::from_millis(330 * step as u64);
            let here = DVec3::new(north, east, -10.0);
            reasons.extend(trail.note(Some(here), &RULES, now));
        }
        (trail, reasons)
    }

    #[test]
    fn a_straight_way_needs_two_points_and_a_corner_one_more() {
        let out = (0..400).map(|step| (f64::from(step), 0.0));
        let across = (0..400).map(|step| (399.0, f64::from(step)));
        let (mut trail, reasons) = flown(out.chain(across));
        assert!(reasons.is_empty() && trail.points_m.len() <= RULES.points);
        trail.tidy(&RULES);
        // The point on the ground, the climb, the corner and the end.
        assert!((3..=5).contains(&trail.points_m.len()), "{trail:?}");
    }

    #[test]
    fn a_loop_is_cut_out() {
        let side = |step: i32| f64::from(step) * 2.0;
        let out = (0..20).map(|step| (side(step), 0.0));
        let up = (0..20).map(|step| (40.0, side(step)));
        let back = (0..20).map(|step| (40.0 - side(step) / 2.0, 40.0));
        let down = (0..40).map(|step| (20.0, 40.0 - side(step)));
        let (mut trail, _) = flown(out.chain(up).chain(back).chain(down));
        trail.tidy(&RULES);
        let furthest = trail.points_m.iter().map(|p| p.x).fold(0.0, f32::max);
        assert!(furthest < 22.0, "{trail:?}");
        let end = trail.points_m.last().expect("an end");
        assert!((end.y + 38.0).abs() < 2.5, "{trail:?}");
    }

    #[test]
    fn a_way_that_does_not_fit_is_given_up_after_fifteen_seconds() {
        // A spiral outwards: nothing can be left out.
        let spiral = (1..2000).map(|step| {
            let angle = f64::from(step) * 0.7;
            (
                angle * 6.0 * maths::cos(angle),
                angle * 6.0 * maths::sin(angle),
            )
        });
        let (trail, reasons) = flown(spiral);
        assert_eq!(reasons, ["buffer full"]);
        assert!(!trail.is_active() && trail.points_m.is_empty());
    }
}
