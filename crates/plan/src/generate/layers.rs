//! The heights at which vehicles cross, so that they do not meet on the way.

use glam::DVec2;

use super::compose::Trip;
use super::{Scene, Work};
use crate::pattern::distance_to_segment;

/// Paths closer than this are flown at different heights, in metres: the conflict limit plus a
/// margin.
pub(super) const ASIDE_M: f64 = 6.0;

/// A path counts as too close to a place if it comes closer than its vehicle's own climb or descent
/// by more than this, in metres.
const BESIDE_M: f64 = 0.5;

/// Where a vehicle crosses, and where it climbs and descends.
struct Crossing {
    legs: Vec<[DVec2; 2]>,
    columns: Vec<DVec2>,
    length_m: f64,
}

impl Crossing {
    fn of(scene: &Scene, work: &Work) -> Self {
        let home = scene.homes[work.vehicle];
        let trip = Trip::of(scene, work).unwrap_or_default();
        let legs = [&trip.out, &trip.back].into_iter();
        let legs: Vec<[DVec2; 2]> = legs
            .flat_map(|way| way.windows(2).map(|pair| [pair[0], pair[1]]))
            .collect();
        let ends = [work.points.first(), work.points.last()];
        Self {
            length_m: legs.iter().map(|[from, to]| from.distance(*to)).sum(),
            legs,
            columns: ends.into_iter().flatten().copied().chain([home]).collect(),
        }
    }

    /// Whether the vehicle comes too close to a place. If one of its own columns is closer than the
    /// limit, as on neighbouring pads, the distance of that column is the limit.
    fn comes_near(&self, point: DVec2) -> bool {
        let own = self.columns.iter().map(|mine| mine.distance(point));
        let limit = match own.fold(f64::INFINITY, f64::min) {
            own if own < ASIDE_M => own - BESIDE_M,
            _ => ASIDE_M,
        };
        let mut legs = self.legs.iter();
        legs.any(|[from, to]| distance_to_segment(point, *from, *to) < limit)
    }

    /// Whether the vehicle passes where the other one climbs or descends, and therefore has to be
    /// above it.
    fn passes_over(&self, other: &Self) -> bool {
        let mut columns = other.columns.iter();
        columns.any(|column| self.comes_near(*column))
    }

    fn meets(&self, other: &Self) -> bool {
        self.legs.iter().any(|mine| {
            other
                .legs
                .iter()
                .any(|theirs| gap_m(*mine, *theirs) < ASIDE_M)
        })
    }
}

/// The distance between the nearest points of two legs.
pub(super) fn gap_m([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    if crosses {
        return 0.0;
    }
    let ends = [
        distance_to_segment(a, c, d),
        distance_to_segment(b, c, d),
        distance_to_segment(c, a, b),
        distance_to_segment(d, a, b),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// Sets the height at which each vehicle crosses: above all work, and different for vehicles whose
/// paths are close. A vehicle that passes where another climbs or descends is above it, unless each
/// passes the other. A single vehicle crosses at the height of its work.
pub(super) fn set(scene: &Scene, works: &mut [Work], layer_m: f64) {
    let top_m = top_m(works);
    if let [only] = works {
        only.layer_m = only.height_m;
        return;
    }
    let crossings: Vec<Crossing> = works.iter().map(|work| Crossing::of(scene, work)).collect();
    let mut placed: Vec<(usize, usize)> = Vec::new();
    let mut left: Vec<usize> = (0..works.len()).collect();
    while let Some(next) = lowest(&crossings, &left) {
        let here = left.remove(next);
        let below = placed
            .iter()
            .filter(|(other, _)| crossings[here].passes_over(&crossings[*other]));
        let highest = below.map(|(_, layer)| layer + 1).max();
        let meets = |layer: usize| {
            let mut same = placed.iter().filter(|(_, other)| *other == layer);
            same.any(|(other, _)| crossings[here].meets(&crossings[*other]))
        };
        let lowest = highest.unwrap_or_default();
        let mut layers = lowest..=lowest + works.len();
        let layer = layers.find(|layer| !meets(*layer));
        placed.push((here, layer.unwrap_or(lowest)));
    }
    for (index, layer) in placed {
        works[index].layer_m = top_m + layer_m * (layer + 1) as f64;
    }
}

/// Sets heights for work in which all vehicles pass the same places: each has one height, at which it also crosses, so
/// that it climbs and descends only at home. A vehicle that passes over the home of another is above it, unless each
/// passes the other's.
pub(super) fn stack(scene: &Scene, works: &mut [Work], layer_m: f64) {
    let crossing = |work: &Work| Crossing {
        columns: vec![scene.homes[work.vehicle]],
        ..Crossing::of(scene, work)
    };
    let crossings: Vec<Crossing> = works.iter().map(crossing).collect();
    let mut left: Vec<usize> = (0..works.len()).collect();
    let mut rank = 0.0;
    while let Some(next) = lowest(&crossings, &left) {
        let work = &mut works[left.remove(next)];
        work.height_m += layer_m * rank;
        work.layer_m = work.height_m;
        rank += 1.0;
    }
}

fn top_m(works: &[Work]) -> f64 {
    let heights = works.iter().map(|work| work.height_m);
    heights.fold(f64::NEG_INFINITY, f64::max)
}

/// Whether the heights at which vehicles cross keep them apart.
pub(super) fn are_apart(scene: &Scene, works: &[Work], layer_m: f64) -> bool {
    let [_, _, ..] = works else {
        return works.iter().all(|work| work.layer_m >= work.height_m);
    };
    let least_m = top_m(works) + layer_m - 1e-6;
    let crossings: Vec<Crossing> = works.iter().map(|work| Crossing::of(scene, work)).collect();
    let fits = |a: usize, b: usize| {
        let above_m = works[a].layer_m - works[b].layer_m;
        let (over, under) = (
            crossings[a].passes_over(&crossings[b]),
            crossings[b].passes_over(&crossings[a]),
        );
        let is_apart = above_m.abs() >= layer_m - 1e-6 || !crossings[a].meets(&crossings[b]);
        is_apart && (over == under || (above_m > 0.0) == over)
    };
    let mut pairs = (0..works.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    works.iter().all(|work| work.layer_m >= least_m) && pairs.all(|(a, b)| fits(a, b))
}

/// The remaining vehicle that is to be the lowest: the one that passes over the fewest others; of
/// several, the one with the shortest path.
fn lowest(crossings: &[Crossing], left: &[usize]) -> Option<usize> {
    let passed = |here: usize| {
        let others = left.iter().filter(|other| **other != here);
        others
            .filter(|other| crossings[here].passes_over(&crossings[**other]))
            .count()
    };
    let keys = left
        .iter()
        .map(|here| (passed(*here), crossings[*here].length_m));
    let lowest = keys
        .enumerate()
        .min_by(|(_, a), (_, b)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    lowest.map(|(index, _)| index)
}
