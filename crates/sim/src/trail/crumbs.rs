//! Breadcrumbs, and how points that a return does not need are removed: bit by bit on the way, and all of them before
//! the return.

use std::cmp::Reverse;

use glam::Vec3;

/// Points are simplified after this many new ones.
const SIMPLIFIED_AFTER: usize = 50;
/// With room for no more than `MARGIN` points, they are simplified after `FEWEST` new ones, and loops are cut until
/// that many points are gone.
const MARGIN: usize = 10;
const FEWEST: usize = 10;
/// Points closer to a straight line than this share of the accuracy are left out.
const SIMPLIFY_SHARE: f32 = 0.5;
/// A loop whose ends come closer to each other than this share of the accuracy is left out.
const PRUNE_SHARE: f32 = 0.99;
/// Stretches count as parallel below this square of the sine of their angle.
const PARALLEL: f32 = 1e-6;

/// Points in a row that a single one can replace: the stretches into the first and out of the last one nearly meet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Loop {
    first: usize,
    last: usize,
    /// Where the stretches nearly meet.
    middle_m: Vec3,
    length_m: f32,
}

impl Loop {
    fn overlaps(&self, other: &Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }

    /// The number of points that the path loses with the loop.
    fn saves(&self) -> usize {
        self.last - self.first
    }
}

/// The points of a path.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Crumbs {
    points_m: Vec<Vec3>,
    /// The number of points, from the first one, that have been simplified.
    done: usize,
    /// Whether these are known to have no loops.
    is_loopless: bool,
}

impl Crumbs {
    pub(super) fn len(&self) -> usize {
        self.points_m.len()
    }

    pub(super) fn last(&self) -> Option<Vec3> {
        self.points_m.last().copied()
    }

    #[cfg(test)]
    pub(super) fn points_m(&self) -> &[Vec3] {
        &self.points_m
    }

    pub(super) fn push(&mut self, point_m: Vec3) {
        self.points_m.push(point_m);
    }

    pub(super) fn pop(&mut self) -> Option<Vec3> {
        let point_m = self.points_m.pop();
        self.done = self.done.min(self.len());
        point_m
    }

    /// Makes room: removes points if many are new, and loops if there is little room left.
    pub(super) fn tend(&mut self, accuracy_m: f32, room: usize) {
        let is_low = |crumbs: &Self| crumbs.len() + MARGIN >= room;
        let due = if is_low(self) {
            FEWEST
        } else {
            SIMPLIFIED_AFTER
        };
        if self.len() - self.done >= due {
            self.simplify(accuracy_m);
        }
        while is_low(self) && self.shorten(accuracy_m, FEWEST) {}
    }

    /// Removes all points and loops that a return does not need.
    pub(super) fn tidy(&mut self, accuracy_m: f32) {
        self.simplify(accuracy_m);
        self.shorten(accuracy_m, usize::MAX);
    }

    /// Simplifies the points that are new, from the last one that was kept before.
    fn simplify(&mut self, accuracy_m: f32) {
        let fresh = self.points_m.split_off(self.done.saturating_sub(1));
        let kept = simplified(&fresh, accuracy_m * SIMPLIFY_SHARE);
        self.points_m.extend(kept);
        self.done = self.len();
        self.is_loopless = false;
    }

    /// Cuts out the longest loops, until a number of points are gone; `false` if there are none.
    fn shorten(&mut self, accuracy_m: f32, points: usize) -> bool {
        if self.is_loopless {
            return false;
        }
        let mut gone = 0;
        let mut cut = self.loops(accuracy_m * PRUNE_SHARE);
        cut.retain(|found| {
            let is_wanted = gone < points;
            gone += if is_wanted { found.saves() } else { 0 };
            is_wanted
        });
        // From the end, so that the places of the others stay right.
        cut.sort_unstable_by_key(|found| Reverse(found.first));
        for found in &cut {
            let replaced = found.first..=found.last;
            self.points_m.splice(replaced, [found.middle_m]);
        }
        self.done -= gone;
        self.is_loopless = cut.is_empty();
        !self.is_loopless
    }

    /// The loops of the simplified points, the longest first. Of loops that overlap, the longest counts.
    fn loops(&self, within_m: f32) -> Vec<Loop> {
        let way = self.points_m.get(..self.done).unwrap_or_default();
        let mut all: Vec<_> = (0..way.len())
            .filter_map(|to| longest_loop(way.get(..=to)?, within_m))
            .collect();
        all.sort_by(|one, other| other.length_m.total_cmp(&one.length_m));
        let mut apart: Vec<Loop> = Vec::new();
        for found in all {
            if !apart.iter().any(|longer| longer.overlaps(&found)) {
                apart.push(found);
            }
        }
        apart
    }
}

/// The longest loop that ends on the last stretch of a way.
fn longest_loop(way: &[Vec3], within_m: f32) -> Option<Loop> {
    let [before @ .., _, from_m, to_m] = way else {
        return None;
    };
    let last = before.len() + 1;
    let starts = way.iter().zip(way.iter().skip(1)).take(before.len());
    let (first, middle_m) = starts.enumerate().find_map(|(at, (start_m, end_m))| {
        let [one, other] = nearest([*start_m, *end_m], [*from_m, *to_m])?;
        (one.distance(other) < within_m).then(|| (at + 1, one.midpoint(other)))
    })?;
    let points = way.get(first..=last)?.iter().copied();
    let round = std::iter::once(middle_m).chain(points);
    let ends = round.clone().skip(1).chain([middle_m]);
    Some(Loop {
        first,
        last,
        middle_m,
        length_m: round.zip(ends).map(|(a, b)| a.distance(b)).sum(),
    })
}

/// The points without those closer than `within_m` to the straight line past them (Ramer, Douglas and Peucker).
fn simplified(points_m: &[Vec3], within_m: f32) -> Vec<Vec3> {
    let mut kept = vec![false; points_m.len()];
    let mut open = Vec::new();
    if let Some(last) = points_m.len().checked_sub(1) {
        (kept[0], kept[last]) = (true, true);
        open.push((0, last));
    }
    while let Some((first, last)) = open.pop() {
        let off_m = |at: usize| off_stretch_m(points_m[at], points_m[first], points_m[last]);
        let furthest = (first + 1..last).max_by(|a, b| off_m(*a).total_cmp(&off_m(*b)));
        if let Some(furthest) = furthest.filter(|at| off_m(*at) > within_m) {
            kept[furthest] = true;
            open.extend([(first, furthest), (furthest, last)]);
        }
    }
    let pairs = points_m.iter().zip(kept);
    pairs
        .filter_map(|(point_m, kept)| kept.then_some(*point_m))
        .collect()
}

fn off_stretch_m(point_m: Vec3, from_m: Vec3, to_m: Vec3) -> f32 {
    let (along_m, way_m) = (to_m - from_m, point_m - from_m);
    let length_2 = along_m.length_squared();
    let share = if length_2 > 0.0 {
        (way_m.dot(along_m) / length_2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    way_m.distance(along_m * share)
}

/// The points of two stretches that are nearest to each other (Ericson, Real-Time Collision Detection, 5.1.9); `None`
/// for parallel ones, where no pair of points stands out.
fn nearest(one: [Vec3; 2], other: [Vec3; 2]) -> Option<[Vec3; 2]> {
    let (way, along, apart) = (one[1] - one[0], other[1] - other[0], one[0] - other[0]);
    let (way_2, along_2) = (way.length_squared(), along.length_squared());
    let both = way.dot(along);
    let (apart_way, apart_along) = (apart.dot(way), apart.dot(along));
    let slant = way_2 * along_2 - both * both;
    if slant <= PARALLEL * way_2 * along_2 {
        return None;
    }
    let crossing = ((both * apart_along - apart_way * along_2) / slant).clamp(0.0, 1.0);
    let on_other = ((both * crossing + apart_along) / along_2).clamp(0.0, 1.0);
    // Nearest to the place on the other stretch, which may have been moved to its end.
    let on_one = ((both * on_other - apart_way) / way_2).clamp(0.0, 1.0);
    Some([one[0] + way * on_one, other[0] + along * on_other])
}
