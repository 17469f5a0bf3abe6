//! Breadcrumbs, and how points that a return does not need are found and removed: bit by bit on the way, and all of them
//! before the return.

use std::ops::Range;

use glam::Vec3;

/// Points are simplified after this many new ones.
const SIMPLIFIED_AFTER: usize = 50;
/// With room for no more than `MARGIN` points, they are simplified after `FEWEST` new ones, and loops of that many
/// points are cut.
const MARGIN: usize = 10;
const FEWEST: usize = 10;
/// Points closer to a straight line than this share of the accuracy are left out.
const SIMPLIFY_SHARE: f32 = 0.5;
/// A loop whose ends come closer to each other than this share of the accuracy is left out.
const PRUNE_SHARE: f32 = 0.99;
/// There can be one loop for this many points of room.
const ROOM_PER_LOOP: usize = 4;
/// The fewest points that can have a loop.
const LOOP_POINTS: usize = 4;

/// A way from a point to a further one that begins and ends near the same place.
#[derive(Debug, Clone, PartialEq)]
struct Loop {
    from: usize,
    to: usize,
    middle_m: Vec3,
    squares_m2: f32,
}

impl Loop {
    fn overlaps(&self, other: &Self) -> bool {
        self.from <= other.to && other.from <= self.to
    }
}

/// The points of a path, and how many of them have been dealt with.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Crumbs {
    points_m: Vec<Vec3>,
    /// The points that have been simplified, and how many there were then.
    simplified: usize,
    simplified_of: usize,
    /// The points that have been searched for loops, and how many there were then.
    searched: usize,
    searched_of: usize,
    loops: Vec<Loop>,
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
        let left = self.len();
        self.simplified = self.simplified.min(left);
        self.searched = self.searched.min(left);
        self.loops.retain(|found| found.to < left);
        point_m
    }

    /// Makes room: removes points if many are new, and loops if there is little room left.
    pub(super) fn tend(&mut self, accuracy_m: f32, room: usize) {
        self.search(accuracy_m, room);
        let is_low = |crumbs: &Self| crumbs.len() + MARGIN >= room;
        let fresh = self.len().saturating_sub(self.simplified);
        if fresh >= SIMPLIFIED_AFTER || is_low(self) && fresh >= FEWEST {
            self.simplify(accuracy_m);
            self.search(accuracy_m, room);
        }
        while is_low(self) && !self.loops.is_empty() {
            self.cut(FEWEST);
        }
    }

    /// Removes all points and loops that a return does not need.
    pub(super) fn tidy(&mut self, accuracy_m: f32, room: usize) {
        if self.simplified_of != self.len() {
            self.simplify(accuracy_m);
        }
        self.search(accuracy_m, room);
        self.cut(usize::MAX);
    }

    /// Leaves out points close to the straight lines past them (Ramer, Douglas and Peucker), from the last point that
    /// was simplified before.
    fn simplify(&mut self, accuracy_m: f32) {
        let all = self.len();
        self.simplified_of = all;
        if all < 3 {
            return;
        }
        let mut kept = vec![true; all];
        let mut open = vec![(self.simplified.saturating_sub(1), all - 1)];
        while let Some((first, last)) = open.pop() {
            match self.furthest(first, last) {
                Some((at, off_m)) if off_m > accuracy_m * SIMPLIFY_SHARE => {
                    open.extend([(first, at), (at, last)]);
                }
                _ => kept
                    .iter_mut()
                    .take(last)
                    .skip(first + 1)
                    .for_each(|kept| *kept = false),
            }
        }
        let mut kept = kept.into_iter();
        self.points_m.retain(|_| kept.next().unwrap_or(true));
        self.simplified = self.len();
        self.simplified_of = self.len();
    }

    /// The point between two others that is furthest from the line from one to the other.
    fn furthest(&self, first: usize, last: usize) -> Option<(usize, f32)> {
        let ends = [*self.points_m.get(first)?, *self.points_m.get(last)?];
        let between = self.points_m.iter().enumerate().take(last).skip(first + 1);
        between
            .map(|(at, point_m)| (at, off_stretch_m(*point_m, ends)))
            .filter(|(_, off_m)| *off_m > 0.0)
            .reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// Searches the simplified points for loops, unless that was done.
    fn search(&mut self, accuracy_m: f32, room: usize) {
        let all = self.simplified.min(self.len());
        if self.searched_of == all {
            return;
        }
        self.searched_of = all;
        if all < LOOP_POINTS {
            return;
        }
        let oldest = self.searched.max(LOOP_POINTS);
        // The last stretch is looked at in any case.
        for at in (oldest.min(all - 1)..all).rev() {
            let Some(found) = self.loop_back_from(at, accuracy_m) else {
                continue;
            };
            if self.loops.len() >= room / ROOM_PER_LOOP {
                break;
            }
            self.take_loop(found);
        }
        self.searched = all;
    }

    /// The longest loop that ends on the stretch to a point.
    fn loop_back_from(&self, at: usize, accuracy_m: f32) -> Option<Loop> {
        let end = self.stretch(at)?;
        (1..at - 1).find_map(|from| {
            let middle_m = meeting_point(end, self.stretch(from)?, accuracy_m * PRUNE_SHARE)?;
            Some(Loop {
                from,
                to: at - 1,
                middle_m,
                squares_m2: self.squares_m2(from..at - 1, middle_m),
            })
        })
    }

    fn stretch(&self, to: usize) -> Option<[Vec3; 2]> {
        Some([*self.points_m.get(to - 1)?, *self.points_m.get(to)?])
    }

    /// The measure by which loops are compared.
    fn squares_m2(&self, range: Range<usize>, middle_m: Vec3) -> f32 {
        let way = self
            .points_m
            .get(range.start..=range.end)
            .unwrap_or_default();
        let ends = [way.first(), way.last()].into_iter().flatten();
        let inside = way.windows(2).map(|pair| pair[0].distance_squared(pair[1]));
        ends.map(|end| end.distance_squared(middle_m))
            .chain(inside)
            .sum()
    }

    /// Notes a loop; of loops that overlap, the longer ones count.
    fn take_loop(&mut self, found: Loop) {
        let rivals = self.loops.iter().filter(|other| other.overlaps(&found));
        if rivals.map(|rival| rival.squares_m2).sum::<f32>() > found.squares_m2 {
            return;
        }
        self.loops.retain(|other| !other.overlaps(&found));
        self.loops.push(found);
    }

    /// Cuts out loops, from the last one found, until this many points are gone.
    fn cut(&mut self, points: usize) {
        let mut gone = 0;
        while gone < points
            && let Some(found) = self.loops.pop()
        {
            let fewer = found.to - found.from;
            self.points_m.drain(found.from + 1..=found.to);
            if let Some(start) = self.points_m.get_mut(found.from) {
                *start = found.middle_m;
            }
            gone += fewer;
            for later in self.loops.iter_mut().filter(|other| other.from >= found.to) {
                later.from -= fewer;
                later.to -= fewer;
            }
        }
    }
}

fn off_stretch_m(point_m: Vec3, [from_m, to_m]: [Vec3; 2]) -> f32 {
    let along = to_m - from_m;
    let squares = along.length_squared();
    if squares <= f32::EPSILON {
        return point_m.distance(from_m);
    }
    let share = ((point_m - from_m).dot(along) / squares).clamp(0.0, 1.0);
    point_m.distance(from_m + along * share)
}

/// The middle between the nearest points of two stretches that pass each other within a distance; parallel ones never
/// meet.
fn meeting_point(one: [Vec3; 2], other: [Vec3; 2], within_m: f32) -> Option<Vec3> {
    let (way, along, apart) = (one[1] - one[0], other[1] - other[0], one[0] - other[0]);
    let (way_2, along_2, both) = (way.dot(way), along.dot(along), way.dot(along));
    let slant = way_2 * along_2 - both * both;
    if slant.abs() < f32::EPSILON {
        return None;
    }
    let (apart_way, apart_along) = (apart.dot(way), apart.dot(along));
    // The nearest points of the endless lines, each moved back onto its stretch.
    let on_one = ((both * apart_along - along_2 * apart_way) / slant).clamp(0.0, 1.0);
    let on_other = ((way_2 * apart_along - both * apart_way) / slant).clamp(0.0, 1.0);
    let ends = [one[0] + way * on_one, other[0] + along * on_other];
    (ends[0].distance(ends[1]) < within_m).then(|| ends[0].midpoint(ends[1]))
}
