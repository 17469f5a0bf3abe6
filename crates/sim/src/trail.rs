//! The return path of `SMART_RTL`: breadcrumbs of the flight, simplified and with its loops removed
//! (`AP_SmartRTL`).

mod crumbs;

use std::time::Duration;

use glam::DVec3;

use self::crumbs::Crumbs;
use super::parameters::Parameters;

/// The time between breadcrumbs, in steps.
pub(super) const EVERY_STEPS: u64 = 33;
/// The path is abandoned after this time without a position, or without room for breadcrumbs.
const PATIENCE: Duration = Duration::from_secs(15);
/// The maximum number of breadcrumbs that are ever kept.
const POINTS_MAX: f64 = 500.0;
/// The pilot is warned, again and again after a pause, when there is room for no more than this many breadcrumbs.
const LOW: usize = 9;
const WARNS_EVERY: Duration = Duration::from_secs(10);

/// The rules from the `SRTL_*` parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrailRules {
    accuracy_m: f32,
    /// The maximum number of breadcrumbs; 0 disables `SMART_RTL`.
    points: usize,
}

impl TrailRules {
    pub(super) fn read(all: &Parameters) -> Self {
        Self {
            accuracy_m: all.value("SRTL_ACCURACY").clamp(0.0, 1e4) as f32,
            points: all.value("SRTL_POINTS").clamp(0.0, POINTS_MAX) as usize,
        }
    }
}

/// What the pilot must know about the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TrailNews {
    /// There is little room left.
    Low,
    /// The path was given up, for a reason.
    GivenUp(&'static str),
}

/// The breadcrumbs, from the place where home was set or the motors were armed to the vehicle's last position, in
/// metres from the start.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Trail {
    crumbs: Crumbs,
    /// The room that was set aside when the first path began: a change needs a reboot.
    room: Option<usize>,
    begun: bool,
    active: bool,
    /// When the position was last good, when there was last room, and when the lack of it was reported.
    good: Duration,
    kept: Duration,
    warned: Option<Duration>,
}

impl Trail {
    /// Whether the path can be retraced.
    pub(super) fn is_active(&self) -> bool {
        self.active
    }

    /// Begins the path at a place. Without one, it begins where the position is first known, or goes on empty.
    pub(super) fn begin(&mut self, here_m: Option<DVec3>, rules: &TrailRules, now: Duration) {
        let is_on = rules.points > 0 && rules.accuracy_m > 0.0;
        let room = *self
            .room
            .get_or_insert(if is_on { rules.points } else { 0 });
        if room == 0 {
            return;
        }
        self.crumbs = Crumbs::default();
        if let Some(here_m) = here_m {
            self.crumbs.push(here_m.as_vec3());
            (self.good, self.kept) = (now, now);
            (self.active, self.begun) = (true, true);
        }
    }

    /// Notes the vehicle's position, if it is known.
    pub(super) fn note(
        &mut self,
        here_m: Option<DVec3>,
        rules: &TrailRules,
        now: Duration,
    ) -> Option<TrailNews> {
        if here_m.is_some() && !self.begun {
            self.begin(here_m, rules, now);
        }
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

    /// Makes room from time to time.
    pub(super) fn tend(&mut self, rules: &TrailRules, now: Duration) -> Option<TrailNews> {
        let room = self.room.filter(|_| self.active)?;
        self.crumbs.tend(rules.accuracy_m, room);
        let is_low = self.crumbs.len() > 0 && self.crumbs.len() + LOW >= room;
        let is_silent = self.warned.is_none_or(|warned| now > warned + WARNS_EVERY);
        if !(is_low && is_silent) {
            return None;
        }
        self.warned = Some(now);
        Some(TrailNews::Low)
    }

    fn give_up(&mut self, reason: &'static str) -> TrailNews {
        self.active = false;
        TrailNews::GivenUp(reason)
    }

    /// Stores a place unless it is near the last one; `false` if there is no room.
    fn keep(&mut self, here_m: DVec3, rules: &TrailRules) -> bool {
        let here_m = here_m.as_vec3();
        let last = self.crumbs.last();
        if last.is_some_and(|last| last.distance(here_m) < rules.accuracy_m) {
            return true;
        }
        let has_room = self.room.is_some_and(|room| self.crumbs.len() < room);
        if has_room {
            self.crumbs.push(here_m);
        }
        has_room
    }

    /// Removes points that the return does not need.
    pub(super) fn tidy(&mut self, rules: &TrailRules) {
        self.crumbs.tidy(rules.accuracy_m);
    }

    /// Removes and returns the last breadcrumb, and whether it is the first one of the flight;
    /// `None` if there are none left.
    pub(super) fn pop(&mut self) -> Option<(DVec3, bool)> {
        let point = self.active.then(|| self.crumbs.pop())??;
        Some((point.as_dvec3(), self.crumbs.len() == 0))
    }

    /// The next result of [`Trail::pop`].
    pub(super) fn peek(&self) -> Option<(DVec3, bool)> {
        let point = self.crumbs.last().filter(|_| self.active)?;
        Some((point.as_dvec3(), self.crumbs.len() == 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sortie_geo::maths;

    const RULES: TrailRules = TrailRules {
        accuracy_m: 2.0,
        points: 50,
    };

    /// The news with their seconds.
    fn flown(way: impl Iterator<Item = (f64, f64)>) -> (Trail, Vec<(u64, TrailNews)>) {
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &RULES, Duration::ZERO);
        let mut news = Vec::new();
        for (step, (north, east)) in way.enumerate() {
            let now = Duration::from_millis(330 * step as u64);
            let here = DVec3::new(north, east, -10.0);
            let noted = trail.note(Some(here), &RULES, now);
            let tended = trail.tend(&RULES, now);
            news.extend(
                noted
                    .into_iter()
                    .chain(tended)
                    .map(|news| (now.as_secs(), news)),
            );
        }
        (trail, news)
    }

    #[test]
    fn a_way_needs_few_points() {
        let out = (0..400).map(|step| (f64::from(step), 0.0));
        let across = (0..400).map(|step| (399.0, f64::from(step)));
        let (mut trail, news) = flown(out.chain(across));
        assert!(news.is_empty() && trail.crumbs.len() <= RULES.points);
        trail.tidy(&RULES);
        assert!(trail.crumbs.len() <= 20, "{trail:?}");
    }

    /// A point remains of each fifty.
    #[test]
    fn a_straight_way_is_simplified_bit_by_bit() {
        let rules = TrailRules {
            points: 300,
            ..RULES
        };
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &rules, Duration::ZERO);
        for north in 1..400 {
            let here_m = DVec3::X * f64::from(north);
            trail.note(Some(here_m), &rules, Duration::ZERO);
            trail.tend(&rules, Duration::ZERO);
        }
        trail.tidy(&rules);
        let norths: Vec<_> = trail.crumbs.points_m().iter().map(|at| at.x).collect();
        assert_eq!(norths, [0.0, 98.0, 198.0, 298.0, 398.0]);
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
        let points_m = trail.crumbs.points_m();
        let furthest = points_m.iter().map(|p| p.x).fold(0.0, f32::max);
        assert!(furthest < 22.0, "{trail:?}");
        let end = points_m.last().expect("an end");
        assert!((end.y + 38.0).abs() < 2.5, "{trail:?}");
    }

    /// A spiral outwards: nothing can be left out.
    fn spiral() -> impl Iterator<Item = (f64, f64)> {
        (1..2000).map(|step| {
            let angle = f64::from(step) * 0.7;
            let out_m = angle * 6.0;
            (out_m * maths::cos(angle), out_m * maths::sin(angle))
        })
    }

    /// As a real rover did.
    #[test]
    fn a_way_that_does_not_fit_is_reported_every_ten_seconds_and_given_up_after_fifteen() {
        let (trail, news) = flown(spiral());
        let full = TrailNews::GivenUp("buffer full");
        assert_eq!(
            news,
            [(12, TrailNews::Low), (23, TrailNews::Low), (31, full)]
        );
        assert!(!trail.is_active());
        assert_eq!(trail.peek(), None);
    }

    #[test]
    fn a_place_is_kept_unless_it_is_near_the_last_one_and_all_are_without_an_accuracy() {
        let out = || (0..30).map(|step| (f64::from(step) * 0.5, 0.0));
        assert!(flown(out()).0.crumbs.len() < 10);
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &RULES, Duration::ZERO);
        let rules = TrailRules {
            accuracy_m: 0.0,
            ..RULES
        };
        for (north, east) in out() {
            trail.note(Some(DVec3::new(north, east, 0.0)), &rules, Duration::ZERO);
        }
        assert_eq!(trail.crumbs.len(), 31);
    }

    #[test]
    fn the_room_is_that_of_the_boot() {
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &RULES, Duration::ZERO);
        let off = TrailRules { points: 0, ..RULES };
        trail.begin(Some(DVec3::ZERO), &off, Duration::ZERO);
        assert!(trail.is_active(), "turned off after the boot");
        let mut trail = Trail::default();
        trail.begin(Some(DVec3::ZERO), &off, Duration::ZERO);
        trail.begin(Some(DVec3::ZERO), &RULES, Duration::ZERO);
        assert!(!trail.is_active(), "turned on after the boot");
    }

    #[test]
    fn a_path_begins_where_the_position_is_first_known() {
        let mut trail = Trail::default();
        trail.begin(None, &RULES, Duration::ZERO);
        assert!(!trail.is_active());
        trail.note(Some(DVec3::X), &RULES, Duration::ZERO);
        assert_eq!(trail.peek(), Some((DVec3::X, true)));
    }
}
