//! `checked`: look at each place closely before it is reported.
//!
//! A vehicle looks closely while it is near the place, slow enough and at the right height. The
//! looks of all vehicles together must last for `dwell`, and include `crossings` straight passes
//! across the place, in different directions. Only looks before the report count. Whether the
//! report is correct plays no role, so the state is no secret in flight.

use std::collections::BTreeMap;

use super::{
    DemandedTime, Demands, Equipment, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker,
    Trying,
};
use crate::geo::maths;
use crate::mission::craft::Craft;
use crate::mission::format::{FileTable, KindOf, heights, number, seconds, whole};
use crate::mission::report::{Mark, distance_m};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::zone::distance_to_side_m;
use crate::mission::{Point, TICK};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The minimum length of a straight pass across a place, as a multiple of the radius: the line
/// between its ends misses the place by at most four fifths of the radius.
const ACROSS: f64 = 1.25;
/// How far the points of a straight pass may lie from the line between its ends, as a share of the
/// radius. An arc with this bend that stays within the radius is too short to count as a crossing.
const BEND: f64 = 0.125;
/// The minimum spacing of the points by which a path is judged, as a share of the radius; it keeps
/// long stops cheap to compute.
const GRAIN: f64 = 0.03;
/// The sine of the least angle between two crossings, 60 degrees.
const APART: f64 = 0.866;

/// The conditions that a look must meet to count.
#[derive(Debug, Clone)]
struct Checked {
    radius_m: f64,
    max_speed_m_s: f64,
    /// The heights that count; `None` for any.
    heights_m: Option<[f64; 2]>,
    dwell_s: f64,
    crossings: u32,
}

/// A step in which a vehicle was slow enough and at the right height.
#[derive(Debug, Clone, Copy)]
struct SlowMoment {
    step: u32,
    at: Point,
}

#[derive(Debug)]
struct CheckedTracker {
    plan: Checked,
    /// The number of steps so far.
    steps: u32,
    slow: BTreeMap<VehicleId, Vec<SlowMoment>>,
    /// Each report, and whether its place had been looked at closely.
    judged: Vec<(Mark, bool)>,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "checked",
    about: "met when every reported place had been looked at closely before the report, whether the report is right or wrong",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let radius_m = table.need_radius();
    let max_speed_m_s = table.need(
        "max_speed",
        number(0.1, 100.0, "m/s"),
        "maximum speed of a look",
    );
    let heights_m = table.may("heights", heights(), "heights of a look (default any)");
    let dwell = table.may(
        "dwell",
        seconds(0.1, 600.0),
        "time of the looks at a place, all vehicles together (required without `crossings`)",
    );
    let crossings = table.or(
        "crossings",
        whole(0, 2, ""),
        0,
        "number of straight ways across the place, at least 60 degrees apart",
    );
    let asks_for_looks = table.is_written("dwell") || crossings > 0;
    if !asks_for_looks && !table.has_wrong() {
        table.fault(text!("fault-checked"));
    }
    Some(Box::new(Checked {
        radius_m: radius_m?,
        max_speed_m_s: max_speed_m_s?,
        heights_m,
        dwell_s: dwell.map_or(0.0, |dwell| dwell.as_secs_f64()),
        crossings,
    }))
}

impl ObjectiveKind for Checked {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K7)
    }

    fn trying(&self) -> Trying {
        Trying::Report
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            heights_m: self.heights_m,
            times: vec![DemandedTime::seconds("dwell", self.dwell_s)],
            ..Demands::equipment(Equipment::AnySensor)
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(CheckedTracker {
            plan: self.clone(),
            steps: 0,
            slow: BTreeMap::new(),
            judged: Vec::new(),
        })
    }
}

impl Checked {
    /// The position of a vehicle that is slow enough and at the right height.
    fn slow_at(&self, craft: &Craft) -> Option<Point> {
        let is_at_height = self
            .heights_m
            .is_none_or(|[low, high]| (low..=high).contains(&craft.height_m));
        let is_slow = craft.can_see() && craft.speed_m_s <= self.max_speed_m_s;
        craft.at.filter(|_| is_slow && is_at_height)
    }

    /// Whether these looks together are long enough and cross the place as required. Each look is
    /// an uninterrupted path within the radius, with one position per step.
    fn is_shown_by(&self, looks: &[Vec<Point>]) -> bool {
        let steps: usize = looks.iter().map(Vec::len).sum();
        let ways = looks
            .iter()
            .flat_map(|look| straight_ways(look, self.radius_m));
        let across_m = ACROSS * self.radius_m;
        let ways: Vec<Point> = ways.filter(|way| length_m(*way) >= across_m).collect();
        let has_crossed = match self.crossings {
            0 => true,
            1 => !ways.is_empty(),
            _ => ways
                .iter()
                .any(|one| ways.iter().any(|other| are_apart(*one, *other))),
        };
        steps > 0 && steps as f64 * TICK.as_secs_f64() >= self.dwell_s - 1e-9 && has_crossed
    }

    fn advice(&self) -> Text {
        let (radius, speed) = (self.radius_m.to_string(), self.max_speed_m_s.to_string());
        let stay = text!(
            "checked-advice",
            dwell = self.dwell_s.to_string(),
            radius = radius.clone(),
            speed = speed.clone()
        );
        let cross = text!(
            "checked-advice-cross",
            count = self.crossings,
            radius = radius,
            speed = speed
        );
        let heights = self.heights_m.map(|heights_m| {
            let [low, high] = heights_m.map(|height_m| height_m.to_string());
            text!("checked-advice-heights", low = low, high = high)
        });
        let stay = (self.dwell_s > 0.0).then_some(stay);
        let cross = (self.crossings > 0).then_some(cross);
        Text::joined(" ", stay.into_iter().chain(cross).chain(heights).collect())
    }
}

/// The straight parts of a path, each as the vector from its beginning to its end.
fn straight_ways(path: &[Point], radius_m: f64) -> Vec<Point> {
    let points = thinned(path, GRAIN * radius_m);
    let mut ways = Vec::new();
    let (mut from, mut to) = (0, 1);
    while to < points.len() {
        let (begin, end) = (points[from], points[to]);
        let aside_m = |at: &usize| distance_to_side_m(points[*at], begin, end);
        let corner = (from + 1..to).max_by(|a, b| aside_m(a).total_cmp(&aside_m(b)));
        let corner = corner.filter(|corner| aside_m(corner) > BEND * radius_m);
        if let Some(corner) = corner {
            ways.push(way(begin, points[corner]));
            from = corner;
            to = corner;
        }
        to += 1;
    }
    ways.extend(points.last().map(|&last| way(points[from], last)));
    ways
}

/// The points of a path, without those closer than `apart_m` to the last point kept.
fn thinned(path: &[Point], apart_m: f64) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for &at in path {
        if points
            .last()
            .is_none_or(|&last| distance_m(last, at) >= apart_m)
        {
            points.push(at);
        }
    }
    points
}

fn way(from: Point, to: Point) -> Point {
    [to[0] - from[0], to[1] - from[1]]
}

fn length_m([east_m, north_m]: Point) -> f64 {
    maths::hypot(east_m, north_m)
}

/// Whether two passes differ enough in direction; opposite directions count as the same.
fn are_apart(one: Point, other: Point) -> bool {
    let aside_m2 = (one[0] * other[1] - one[1] * other[0]).abs();
    aside_m2 >= APART * length_m(one) * length_m(other)
}

impl CheckedTracker {
    fn is_checked(&self, place: Point) -> bool {
        let is_near = |moment: &&SlowMoment| distance_m(moment.at, place) <= self.plan.radius_m;
        let looks = self.slow.values().flat_map(|slow| {
            let near: Vec<SlowMoment> = slow.iter().filter(is_near).copied().collect();
            let looks = near.chunk_by(|one, next| one.step + 1 == next.step);
            let path = |look: &[SlowMoment]| look.iter().map(|moment| moment.at).collect();
            looks.map(path).collect::<Vec<Vec<Point>>>()
        });
        self.plan.is_shown_by(&looks.collect::<Vec<_>>())
    }

    /// The number of reports whose places had been looked at.
    fn count(&self, marks: &[Mark]) -> usize {
        let is_checked = |mark: &&Mark| self.judged.iter().any(|(it, good)| it == *mark && *good);
        marks.iter().filter(is_checked).count()
    }
}

impl Tracker for CheckedTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        self.steps += 1;
        for craft in scene.vehicles {
            if let Some(at) = self.plan.slow_at(craft) {
                let step = self.steps;
                self.slow
                    .entry(craft.id)
                    .or_default()
                    .push(SlowMoment { step, at });
            }
        }
        for mark in scene.marks {
            if self.judged.iter().all(|(judged, _)| judged != mark) {
                let is_checked = self.is_checked(mark.at);
                self.judged.push((mark.clone(), is_checked));
            }
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (count, all) = (self.count(scene.marks), scene.marks.len());
        let share = count as f64 / all.max(1) as f64;
        ObjectiveStanding {
            fraction: share,
            measure: share,
            met: all > 0 && count == all,
            settled: all > 0,
            landing: false,
            product: None,
            result: text!("checked-result", count = count, all = all),
            outlook: None,
            target: text!("checked-target"),
            advice: self.plan.advice(),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng as _;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution as _, Normal};

    use super::*;
    use crate::text::{Language, Locale};

    fn plan(dwell_s: f64, crossings: u32) -> Checked {
        Checked {
            radius_m: 6.0,
            max_speed_m_s: 3.0,
            heights_m: None,
            dwell_s,
            crossings,
        }
    }

    /// A straight look of 6 s from one point to another.
    fn look(from: Point, to: Point) -> Vec<Point> {
        let part = |step: u32| f64::from(step) / 59.0;
        let at = |step| [0, 1].map(|axis: usize| from[axis] + (to[axis] - from[axis]) * part(step));
        (0..60).map(at).collect()
    }

    #[test]
    fn a_place_is_checked_by_a_long_look_however_often_interrupted() {
        let (one, two) = (look([1.0, 0.0], [2.0, 0.0]), look([0.0, 3.0], [0.0, 4.0]));
        assert!(plan(6.0, 0).is_shown_by(std::slice::from_ref(&one)));
        assert!(!plan(7.0, 0).is_shown_by(std::slice::from_ref(&one)));
        assert!(plan(12.0, 0).is_shown_by(&[one, two]));
        assert!(!plan(0.0, 0).is_shown_by(&[]));
    }

    #[test]
    fn lanes_of_a_survey_cross_a_place_in_one_direction_only() {
        let north = look([1.0, -5.9], [1.0, 5.9]);
        let south = look([-3.0, 5.2], [-3.0, -5.2]);
        let east = look([-5.5, 2.0], [5.5, 2.0]);
        let edge = look([-3.5, 5.0], [3.5, 5.0]);
        assert!(!plan(0.0, 2).is_shown_by(&[north.clone(), south.clone()]));
        assert!(!plan(0.0, 2).is_shown_by(&[north.clone(), edge]));
        assert!(plan(0.0, 2).is_shown_by(&[south, north, east.clone()]));
        assert!(plan(0.0, 1).is_shown_by(&[east]));
    }

    #[test]
    fn a_look_that_turns_on_the_way_crosses_by_its_straight_parts() {
        let legs = [
            look([0.0, 0.0], [0.0, 5.0]),
            look([0.0, 5.0], [0.0, -5.0]),
            look([0.0, -5.0], [0.0, 0.0]),
            look([0.0, 0.0], [5.5, 0.0]),
            look([5.5, 0.0], [-5.5, 0.0]),
        ];
        assert!(plan(0.0, 2).is_shown_by(&[legs.concat()]));
        assert!(!plan(0.0, 2).is_shown_by(&[legs[..4].concat()]));
    }

    /// An orbit never leads across its centre, however wide it is.
    #[test]
    fn rings_around_a_place_do_not_cross_it() {
        for radius_m in [2.0, 6.0, 8.0, 30.0] {
            let plan = Checked {
                radius_m,
                ..plan(0.0, 1)
            };
            for share in [0.5, 0.7, 0.83, 0.9, 0.98] {
                let ring = |step: u32| {
                    let angle = f64::from(step) / 30.0;
                    [maths::sin(angle), maths::cos(angle)].map(|part| share * radius_m * part)
                };
                let laps = (0..400).map(ring).collect();
                assert!(!plan.is_shown_by(&[laps]), "{share} of {radius_m} m");
            }
        }
    }

    /// A slow flight with noise in its positions is long, but straight.
    #[test]
    fn slow_crossings_with_noisy_positions_count() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let noise = Normal::new(0.0, 0.1).expect("a finite deviation");
        // 11 m at 1 m/s, one position a step.
        let mut crossing = |way: fn(f64) -> Point| -> Vec<Point> {
            let along = (0..110).map(|step| way(f64::from(step) * 0.1 - 5.5));
            let noisy = |at: Point| at.map(|axis| axis + noise.sample(&mut random));
            along.map(noisy).collect()
        };
        let (north, east) = (
            crossing(|along| [1.0, along]),
            crossing(|along| [along, -1.0]),
        );
        assert!(plan(0.0, 1).is_shown_by(std::slice::from_ref(&north)));
        assert!(!plan(0.0, 2).is_shown_by(std::slice::from_ref(&north)));
        assert!(plan(0.0, 2).is_shown_by(&[north, east]));
    }

    /// The advice names every condition, and rounds none away.
    #[test]
    fn the_advice_names_every_condition_of_a_look() {
        let small = Checked {
            radius_m: 0.5,
            heights_m: Some([5.0, 17.5]),
            ..plan(4.0, 2)
        };
        let advice = small.advice();
        assert_eq!(
            advice.to_string(),
            "Before you report a place, stay within 0.5 m of it for 4 s, at 3 m/s at most. \
             Before you report a place, fly straight across it from 2 sides, within 0.5 m of it, at 3 m/s at most. \
             Only heights of 5 to 17.5 m count."
        );
        let ukrainian = Locale::new(Language::Ukrainian);
        let ukrainian = ukrainian.text(&advice);
        for condition in ["4 s", "0.5 m", "з 2 боків", "3 m/s", "від 5 до 17.5 m"] {
            assert!(ukrainian.contains(condition), "{ukrainian}");
        }
        let stop = plan(4.0, 0).advice().to_string();
        assert!(
            !stop.contains("across") && !stop.contains("heights"),
            "{stop}"
        );
        let cross = plan(0.0, 1).advice().to_string();
        assert!(
            !cross.contains("stay") && !cross.contains("heights"),
            "{cross}"
        );
    }
}
