//! `checked`: look at each place closely before it is reported.
//!
//! A vehicle looks closely while it is near the place, slow enough and at the right height. The
//! looks of all vehicles together must last for `dwell`, and include `crossings` straight passes
//! across the place, in different directions. Only looks before the report count, and each second
//! of `dwell` for one report: a stop between two places is no look at both. Whether the report is
//! correct plays no role, so the state is no secret in flight.

use std::collections::BTreeMap;

use super::{
    DemandedTime, Demands, Equipment, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker, Trying,
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
    /// Whether it has counted for a report.
    is_used: bool,
}

#[derive(Debug, Clone)]
struct CheckedTracker {
    plan: Checked,
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

    /// Whether each of these places has had looks of its own that last for `dwell`; uses them up.
    /// The places with the fewest looks choose first, those that are near no other place.
    fn allot(&mut self, places: &[Point]) -> Vec<bool> {
        let needed = (self.plan.dwell_s / TICK.as_secs_f64() - 1e-9).ceil() as usize;
        let radius_m = self.plan.radius_m;
        let is_near = |at: Point, place: Point| distance_m(at, place) <= radius_m;
        let near_count = |place: Point| {
            let moments = self.slow.values().flatten();
            moments
                .filter(|it| !it.is_used && is_near(it.at, place))
                .count()
        };
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.sort_by_key(|index| near_count(places[*index]));
        let mut served = vec![false; places.len()];
        for index in order {
            let rivals = |moment: &SlowMoment| {
                places
                    .iter()
                    .filter(|place| is_near(moment.at, **place))
                    .count()
            };
            let moments = self.slow.values_mut().flatten();
            let near = moments.filter(|it| !it.is_used && is_near(it.at, places[index]));
            let mut near: Vec<&mut SlowMoment> = near.collect();
            if near.len() >= needed {
                near.sort_by_key(|moment| rivals(moment));
                for moment in near.into_iter().take(needed) {
                    moment.is_used = true;
                }
                served[index] = true;
            }
        }
        served
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
                self.slow.entry(craft.id).or_default().push(SlowMoment {
                    step,
                    at,
                    is_used: false,
                });
            }
        }
        let judged = &self.judged;
        let is_new = |mark: &&Mark| judged.iter().all(|(judged, _)| judged != *mark);
        let new: Vec<&Mark> = scene.marks.iter().filter(is_new).collect();
        let places: Vec<Point> = new.iter().map(|mark| mark.at).collect();
        let served = self.allot(&places);
        for (mark, is_served) in new.into_iter().zip(served) {
            let is_checked = is_served && self.is_checked(mark.at);
            self.judged.push((mark.clone(), is_checked));
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
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let (count, all) = (self.count(scene.marks), scene.marks.len());
        ObjectiveDetails {
            product: None,
            result: text!("checked-result", count = count, all = all),
            outlook: None,
            target: text!("checked-target"),
            advice: self.plan.advice(),
        }
    }
}

#[cfg(test)]
mod tests;
