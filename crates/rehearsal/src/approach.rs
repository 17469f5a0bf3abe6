//! The closest approaches of vehicles to each other.

use sortie_geo::{LatLon, maths};

/// The horizontal limit of a conflict, in metres: two vehicles are in conflict if both distances between them, the
/// horizontal and the vertical, are below their limits.
pub const TOO_NEAR_M: f64 = 5.0;
/// The vertical limit of a conflict, in metres.
pub const TOO_NEAR_VERTICALLY_M: f64 = 3.0;

/// Two vehicles that start closer together than this multiple of the usual horizontal limit have a
/// smaller limit.
const NEIGHBOURS_FACTOR: f64 = 1.3;
/// The horizontal limit of two vehicles that start close together, as a share of their distance at
/// the start.
const NEIGHBOURS_SHARE: f64 = 0.75;
const LEAST_LIMIT_M: f64 = 1.0;
/// A vehicle counts as beside its start within this horizontal distance, in metres: there it climbs
/// and lands.
const BESIDE_START_M: f64 = 15.0;

/// The closest approach of two vehicles, counted from 0: the moment at which the larger of the two distances, each
/// divided by its limit, was smallest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// The vehicle with the lower number.
    pub a: usize,
    /// The vehicle with the higher number.
    pub b: usize,
    /// The horizontal distance, in metres.
    pub horizontal_m: f64,
    /// The vertical distance, in metres.
    pub vertical_m: f64,
    /// The time in seconds since the first vehicle started.
    pub at_s: f64,
    /// The place halfway between the two vehicles.
    pub place: LatLon,
    /// The horizontal limit of these two vehicles there, in metres: [`TOO_NEAR_M`], or less if they started close to
    /// each other, and one of them is beside its start.
    pub limit_m: f64,
    /// The minimum delay of one of them that causes a conflict, in whole seconds: 0 if they
    /// conflict without a delay, `None` if more than [`LATE_S`](crate::LATE_S).
    pub late_s: Option<u32>,
}

impl Approach {
    /// Whether there is no conflict, even if one of them is up to `late_s` seconds late.
    pub fn is_apart(&self, late_s: u32) -> bool {
        self.late_s.is_none_or(|least| least > late_s)
    }

    /// Whether the vehicles came too close to each other.
    pub fn is_conflict(&self) -> bool {
        self.horizontal_m < self.limit_m && self.vertical_m < TOO_NEAR_VERTICALLY_M
    }

    /// The square of the distance relative to the limits: less than 1 is a conflict.
    pub(crate) fn nearness(&self) -> f64 {
        let horizontal = self.horizontal_m / self.limit_m;
        let vertical = self.vertical_m / TOO_NEAR_VERTICALLY_M;
        (horizontal * horizontal).max(vertical * vertical)
    }
}

/// The limits of a conflict: two vehicles are in conflict if both distances between them are below
/// these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationLimits {
    /// The horizontal distance, in metres.
    pub across_m: f64,
    /// The vertical distance, in metres.
    pub height_m: f64,
}

impl Default for SeparationLimits {
    fn default() -> Self {
        Self {
            across_m: TOO_NEAR_M,
            height_m: TOO_NEAR_VERTICALLY_M,
        }
    }
}

/// The separation rule for two vehicles: the usual limits everywhere, except that neighbours may be
/// closer while one of them is beside its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// The starts, in metres north and east, if they are known.
    starts_m: Option<[[f64; 2]; 2]>,
    usual: SeparationLimits,
    /// The horizontal limit beside the starts, in metres.
    beside_m: f64,
}

impl Separation {
    /// The rule for two vehicles with these starts, in metres north and east; without starts, the
    /// usual limits apply everywhere.
    pub fn new(starts_m: Option<[[f64; 2]; 2]>, usual: SeparationLimits) -> Self {
        let apart_m = starts_m.map_or(f64::INFINITY, |[a, b]| {
            maths::hypot(a[0] - b[0], a[1] - b[1])
        });
        Self {
            starts_m,
            usual,
            beside_m: neighbours_limit_m(apart_m, usual.across_m),
        }
    }

    /// The horizontal limit of the two vehicles at two points, in metres; the points are in metres
    /// north, east and up.
    pub fn limit_m(&self, points: [[f64; 3]; 2]) -> f64 {
        let starts = self
            .starts_m
            .filter(|_| self.beside_m < self.usual.across_m);
        let mut pairs = starts.iter().flatten().zip(points);
        let is_beside = pairs
            .any(|(start, at)| maths::hypot(start[0] - at[0], start[1] - at[1]) <= BESIDE_START_M);
        if is_beside {
            self.beside_m
        } else {
            self.usual.across_m
        }
    }

    /// The nearness of the two vehicles at two points in metres north, east and up: less than 1 is a conflict.
    pub fn nearness(&self, [a, b]: [[f64; 3]; 2]) -> f64 {
        let limit_m = self.limit_m([a, b]);
        let [north, east, up] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let horizontal = (north * north + east * east) / (limit_m * limit_m);
        horizontal.max(up * up / (self.usual.height_m * self.usual.height_m))
    }
}

/// The horizontal limit of two vehicles whose starts are this far apart, in metres; `usual_m` is that of vehicles from
/// distant starts. Starts less than a metre apart count as the same place, for which the usual limit applies.
fn neighbours_limit_m(apart_m: f64, usual_m: f64) -> f64 {
    if (LEAST_LIMIT_M..usual_m * NEIGHBOURS_FACTOR).contains(&apart_m) {
        (apart_m * NEIGHBOURS_SHARE).max(LEAST_LIMIT_M).min(usual_m)
    } else {
        usual_m
    }
}

/// The separation rule for two vehicles of a rehearsal, from their starts in metres north and east.
pub(crate) fn between(starts_m: [[f64; 2]; 2]) -> Separation {
    Separation::new(Some(starts_m), SeparationLimits::default())
}

/// The nearness of two vehicles, the sample at which it occurred, and their points.
type Meeting = (f64, u32, [[f64; 3]; 2]);

/// The closest approaches of all pairs.
#[derive(Debug)]
pub(crate) struct Closest {
    vehicles: usize,
    /// For each pair (a, b) with a < b, in the order of a and then b.
    pairs: Vec<Option<Meeting>>,
    /// For each pair, the rule.
    rules: Vec<Separation>,
}

impl Closest {
    /// No approaches yet, for vehicles that start at these points, in metres north and east.
    pub(crate) fn new(starts_m: &[[f64; 2]]) -> Self {
        let rules = starts_m.iter().enumerate().flat_map(|(a, first)| {
            let others = starts_m[a + 1..].iter();
            others.map(|other| between([*first, *other]))
        });
        let rules: Vec<Separation> = rules.collect();
        Self {
            vehicles: starts_m.len(),
            pairs: vec![None; rules.len()],
            rules,
        }
    }

    /// Updates the closest approaches with the points of the vehicles in the air.
    pub(crate) fn take(&mut self, sample: u32, points: &[Option<[f64; 3]>]) {
        let mut pairs = self.pairs.iter_mut().zip(&self.rules);
        for (a, first) in points.iter().enumerate() {
            for second in &points[a + 1..] {
                let Some((pair, rule)) = pairs.next() else {
                    return;
                };
                let (Some(first), Some(second)) = (first, second) else {
                    continue;
                };
                let near = rule.nearness([*first, *second]);
                if pair.is_none_or(|(least, ..)| near < least) {
                    *pair = Some((near, sample, [*first, *second]));
                }
            }
        }
    }

    /// The pairs that were in the air together, the closest first; points were measured from `origin`.
    pub(crate) fn found(&self, sample_s: f64, origin: LatLon) -> Vec<Approach> {
        let mut found = Vec::new();
        let mut pairs = self.pairs.iter().zip(&self.rules);
        for a in 0..self.vehicles {
            for b in a + 1..self.vehicles {
                let Some((Some((_, sample, [first, second])), rule)) = pairs.next() else {
                    continue;
                };
                let [north, east, up] = [0, 1, 2].map(|axis| first[axis] - second[axis]);
                found.push(Approach {
                    a,
                    b,
                    horizontal_m: (north * north + east * east).sqrt(),
                    vertical_m: up.abs(),
                    at_s: f64::from(*sample) * sample_s,
                    limit_m: rule.limit_m([*first, *second]),
                    late_s: None,
                    place: origin.moved(
                        f64::midpoint(first[0], second[0]),
                        f64::midpoint(first[1], second[1]),
                    ),
                });
            }
        }
        found.sort_by(|one, other| one.nearness().total_cmp(&other.nearness()));
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vehicles 0 and 1 are 4 m apart over the ground and 20 m in height, 0 and 2 are 9 m apart at the same height: the
    /// second pair is nearer to a conflict.
    #[test]
    fn the_closest_pair_is_that_nearest_to_a_conflict() {
        let starts = [[0.0, 0.0], [0.0, 100.0], [0.0, 200.0]];
        let mut closest = Closest::new(&starts);
        let points = [[50.0, 50.0, 20.0], [54.0, 50.0, 40.0], [59.0, 50.0, 20.0]];
        closest.take(0, &points.map(Some));
        let found = closest.found(1.0, LatLon::new(50.45, 30.52));
        assert_eq!((found[0].a, found[0].b), (0, 2), "{found:?}");
    }

    /// A pair is shown at the moment nearest to a conflict, not at the smallest distance over the ground.
    #[test]
    fn a_pair_is_shown_at_its_nearest_moment() {
        let mut closest = Closest::new(&[[0.0, 0.0], [0.0, 100.0]]);
        for (sample, [across_m, height_m]) in (0..).zip([[3.0, 12.0], [6.0, 2.0], [5.0, 9.0]]) {
            let points = [[50.0, 50.0, 20.0], [50.0 + across_m, 50.0, 20.0 + height_m]];
            closest.take(sample, &points.map(Some));
        }
        let found = closest.found(1.0, LatLon::new(50.45, 30.52));
        assert!((found[0].at_s - 1.0).abs() < 1e-9, "{found:?}");
    }
}
