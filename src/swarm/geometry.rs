//! Distances, and the assignment of vehicles to places.

use glam::{DVec2, DVec3};

use crate::plan::pattern::distance_to_segment;

/// A straight segment on the ground, in metres north and east.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub from: DVec2,
    pub to: DVec2,
}

impl Segment {
    /// The distance between the nearest points of two segments.
    pub fn distance_to(self, other: Self) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        [
            distance_to_segment(self.from, other.from, other.to),
            distance_to_segment(self.to, other.from, other.to),
            distance_to_segment(other.from, self.from, self.to),
            distance_to_segment(other.to, self.from, self.to),
        ]
        .into_iter()
        .fold(f64::INFINITY, f64::min)
    }

    fn crosses(self, other: Self) -> bool {
        self.side(other.from) * self.side(other.to) < 0.0
            && other.side(self.from) * other.side(self.to) < 0.0
    }

    /// The side of the segment on which a point lies: positive on one side, negative on the other.
    fn side(self, point: DVec2) -> f64 {
        (self.to - self.from).perp_dot(point - self.from)
    }
}

/// A position with its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MovingPoint {
    pub at: DVec3,
    /// North, east and up, in metres per second.
    pub velocity_m_s: DVec3,
}

impl MovingPoint {
    pub fn still(at: DVec3) -> Self {
        Self {
            at,
            velocity_m_s: DVec3::ZERO,
        }
    }
}

/// The length of a path, in metres.
pub(super) fn length_m(points: &[DVec3]) -> f64 {
    points
        .windows(2)
        .map(|pair| pair[0].distance(pair[1]))
        .sum()
}

/// Assigns a vehicle to each place so that the sum of all paths is the shortest. Paths then never
/// cross, because exchanging the vehicles of two crossing paths would shorten the sum. Returns the
/// vehicle of each place, and the sum; there must be at least as many vehicles as places.
///
/// The Hungarian method with potentials, O(places² × vehicles) (H. W. Kuhn, 1955; in the form of J.
/// Munkres).
pub(super) fn assign(places: &[DVec2], vehicles: &[DVec2]) -> (Vec<usize>, f64) {
    let mut matching = Matching::new(places, vehicles);
    for row in 1..=places.len() {
        matching.add(row);
    }
    let mut chosen = vec![0; places.len()];
    for (column, &row) in matching.row_at.iter().enumerate().skip(1) {
        if row > 0 {
            chosen[row - 1] = column - 1;
        }
    }
    let ways = chosen.iter().zip(places);
    let sum = ways
        .map(|(&vehicle, place)| place.distance(vehicles[vehicle]))
        .sum();
    (chosen, sum)
}

/// A minimum-cost matching of places (rows) with vehicles (columns). Row and column 0 stand for no match.
struct Matching<'a> {
    places: &'a [DVec2],
    vehicles: &'a [DVec2],
    of_row: Vec<f64>,
    of_column: Vec<f64>,
    /// The row of each column.
    row_at: Vec<usize>,
}

impl<'a> Matching<'a> {
    fn new(places: &'a [DVec2], vehicles: &'a [DVec2]) -> Self {
        Self {
            places,
            vehicles,
            of_row: vec![0.0; places.len() + 1],
            of_column: vec![0.0; vehicles.len() + 1],
            row_at: vec![0; vehicles.len() + 1],
        }
    }

    fn reduced_cost(&self, row: usize, column: usize) -> f64 {
        let way = self.places[row - 1].distance(self.vehicles[column - 1]);
        way - self.of_row[row] - self.of_column[column]
    }

    /// Adds one row, by the cheapest path of exchanges that ends at a free column.
    fn add(&mut self, row: usize) {
        let columns = self.vehicles.len();
        let mut before = vec![0; columns + 1];
        let mut least = vec![f64::INFINITY; columns + 1];
        let mut used = vec![false; columns + 1];
        self.row_at[0] = row;
        let mut column = 0;
        while self.row_at[column] != 0 {
            used[column] = true;
            let (at, mut next, mut step) = (self.row_at[column], 0, f64::INFINITY);
            for other in (1..=columns).filter(|&other| !used[other]) {
                let reduced = self.reduced_cost(at, other);
                if reduced < least[other] {
                    (least[other], before[other]) = (reduced, column);
                }
                if least[other] < step {
                    (step, next) = (least[other], other);
                }
            }
            for other in 0..=columns {
                if used[other] {
                    self.of_row[self.row_at[other]] += step;
                    self.of_column[other] -= step;
                } else {
                    least[other] -= step;
                }
            }
            column = next;
        }
        while column != 0 {
            self.row_at[column] = self.row_at[before[column]];
            column = before[column];
        }
    }
}

/// Moves points apart until no two are closer than `spacing_m`, each by as little as its neighbours
/// allow.
pub(super) fn spread(points: &[DVec2], spacing_m: f64) -> Vec<DVec2> {
    /// A factor slightly above 1, so that repeated shifts end instead of approaching the spacing
    /// forever.
    const BEYOND: f64 = 1.001;
    const ROUNDS: usize = 2000;
    let mut points = points.to_vec();
    for _ in 0..ROUNDS {
        let mut moved = false;
        for a in 0..points.len() {
            for b in a + 1..points.len() {
                let way = points[b] - points[a];
                let distance = way.length();
                if distance >= spacing_m {
                    continue;
                }
                // Two points in one place move apart in a direction that depends on their numbers.
                let turn = (a * points.len() + b) as f64;
                let direction = way
                    .try_normalize()
                    .unwrap_or_else(|| DVec2::from_angle(turn));
                let push = direction * (spacing_m * BEYOND - distance) / 2.0;
                points[a] -= push;
                points[b] += push;
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<DVec2>> {
        let point = (-100.0..100.0f64, -100.0..100.0f64);
        proptest::collection::vec(point.prop_map(DVec2::from), count)
    }

    #[test]
    fn segments_that_cross_have_no_distance() {
        let segment = |from: [f64; 2], to: [f64; 2]| Segment {
            from: from.into(),
            to: to.into(),
        };
        let along = segment([-5.0, 0.0], [5.0, 0.0]);
        let across = segment([0.0, -5.0], [0.0, 5.0]);
        assert!(along.distance_to(across) < 1e-9);
        let beside = segment([0.0, 3.0], [0.0, 5.0]);
        assert!((along.distance_to(beside) - 3.0).abs() < 1e-9);
    }

    /// The smallest sum of all paths, found by brute force, for comparison. The places before `at` have their vehicles
    /// already.
    fn best(places: &[DVec2], vehicles: &mut Vec<DVec2>, at: usize) -> f64 {
        if at == places.len() {
            return 0.0;
        }
        (at..vehicles.len())
            .map(|other| {
                vehicles.swap(at, other);
                let rest = best(places, vehicles, at + 1);
                let sum = rest + places[at].distance(vehicles[at]);
                vehicles.swap(at, other);
                sum
            })
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn nobody_finds_a_cheaper_assignment(places in points(1..5), mut vehicles in points(5..7)) {
            let (chosen, sum) = assign(&places, &vehicles);
            let mut seen = chosen.clone();
            seen.sort_unstable();
            seen.dedup();
            prop_assert_eq!(seen.len(), places.len());
            let least = best(&places, &mut vehicles, 0);
            prop_assert!((sum - least).abs() < 1e-6, "{sum} {least}");
        }

        #[test]
        fn assigned_ways_do_not_cross(places in points(6..7), vehicles in points(6..7)) {
            let (chosen, _) = assign(&places, &vehicles);
            let way = |place: usize| Segment {
                from: vehicles[chosen[place]],
                to: places[place],
            };
            for a in 0..places.len() {
                for b in 0..a {
                    prop_assert!(!way(a).crosses(way(b)), "{a} {b}");
                }
            }
        }

        #[test]
        fn who_has_been_spread_has_room(start in points(1..12), spacing in 5.0..40.0f64) {
            let points = spread(&start, spacing);
            for a in 0..points.len() {
                for b in 0..a {
                    prop_assert!(points[a].distance(points[b]) >= spacing - 1e-9);
                }
            }
        }
    }

    #[test]
    fn who_has_room_stays_and_who_stands_in_one_place_parts() {
        let wide = [DVec2::ZERO, DVec2::new(20.0, 0.0)];
        assert_eq!(spread(&wide, 20.0), wide);
        let parted = spread(&[DVec2::ONE; 5], 10.0);
        let near = |a: &DVec2| parted.iter().filter(|b| a.distance(**b) < 9.99).count();
        assert!(parted.iter().all(|point| near(point) == 1));
    }
}
