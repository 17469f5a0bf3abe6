//! Paths on which no vehicles meet.
//!
//! All vehicles first climb (or descend) in place to a height of their own, then all cross, then all go to the height
//! of their work; each part begins when all vehicles have finished the one before. Paths that stay clear of all others
//! share the height at which they end. Because crossing and changing height never coincide, only paths that come close
//! on the ground need different heights, and only vehicles that begin or end above one another need an order.

use glam::DVec3;

use super::Rules;
use super::geometry::Segment;

/// The margin added to the separation, horizontally and vertically, for position errors.
pub(super) const MARGIN_M: f64 = 1.0;
const MARGIN_ABOVE_M: f64 = 1.5;

/// The maximum number of heights tried for one path.
const MOST_LAYERS: usize = 40;
/// The accuracy of positions, in metres.
const ROUNDING_M: f64 = 0.05;

/// A straight path of one vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    pub from: DVec3,
    pub to: DVec3,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clearance {
    pub aside_m: f64,
    pub above_m: f64,
}

impl Rules {
    pub(super) fn clearance(self) -> Clearance {
        Clearance {
            aside_m: self.separation_m + MARGIN_M,
            above_m: self.separation_m + MARGIN_ABOVE_M,
        }
    }
}

impl Clearance {
    /// The horizontal distance below which two paths always need different heights.
    fn least_m(self) -> f64 {
        self.aside_m * 0.75
    }
}

fn distance(a: DVec3, b: DVec3) -> f64 {
    a.truncate().distance(b.truncate())
}

impl Leg {
    fn flat(&self) -> Segment {
        Segment {
            from: self.from.truncate(),
            to: self.to.truncate(),
        }
    }

    fn is_short(&self) -> bool {
        self.from.truncate().distance(self.to.truncate()) < 1.0
    }

    /// Whether the paths come closer than the clearance. If both start or end slightly closer than that, as on their
    /// pads, their current distance is the limit.
    fn comes_near(&self, other: &Self, clearance: Clearance) -> bool {
        let least = clearance.least_m();
        let wanted = clearance.aside_m;
        let apart = |a: DVec3, b: DVec3| match distance(a, b) {
            apart if apart < wanted => (apart - ROUNDING_M).max(least),
            _ => wanted,
        };
        let wanted = wanted
            .min(apart(self.from, other.from))
            .min(apart(self.to, other.to));
        self.flat().distance_to(other.flat()) < wanted
    }

    /// Whether this vehicle may cross at a height while the other one crosses at another.
    fn is_clear_at(&self, height_m: f64, other: &Self, other_m: f64, clearance: Clearance) -> bool {
        if !self.comes_near(other, clearance) {
            return true;
        }
        let above_m = height_m - other_m;
        let near = |a: DVec3, b: DVec3| distance(a, b) < clearance.least_m();
        // A vehicle above another at the beginning or the end is above it all the way.
        let agrees = |a: DVec3, b: DVec3| !near(a, b) || (a.z - b.z) * above_m >= 0.0;
        above_m.abs() >= clearance.above_m - 1e-6
            && agrees(self.from, other.from)
            && agrees(self.to, other.to)
    }
}

/// The heights at which the legs cross; `others` stay in place. `None` if there are not enough heights.
pub(super) fn heights(legs: &[Leg], others: &[DVec3], clearance: Clearance) -> Option<Vec<f64>> {
    let mut order: Vec<usize> = (0..legs.len()).collect();
    // Vehicles that stay in place keep their heights; then the lower ones choose before the higher ones.
    order.sort_by(|&a, &b| {
        let key = |index: usize| (!legs[index].is_short(), legs[index].from.z);
        let ((a_moves, a_m), (b_moves, b_m)) = (key(a), key(b));
        a_moves
            .cmp(&b_moves)
            .then(a_m.total_cmp(&b_m))
            .then(a.cmp(&b))
    });
    let mut placed: Vec<(Leg, f64)> = others
        .iter()
        .map(|&at| (Leg { from: at, to: at }, at.z))
        .collect();
    let mut heights = vec![0.0; legs.len()];
    for index in order {
        let leg = legs[index];
        let height_m = (0..MOST_LAYERS)
            .map(|layer| leg.to.z + clearance.above_m * layer as f64)
            .find(|&height_m| {
                let clear = |(other, other_m): &(Leg, f64)| {
                    leg.is_clear_at(height_m, other, *other_m, clearance)
                };
                placed.iter().all(clear)
            })?;
        heights[index] = height_m;
        placed.push((leg, height_m));
    }
    Some(heights)
}

/// Whether all members may fly straight to the ends of their paths at the same time.
pub(super) fn are_apart(legs: &[Leg], others: &[DVec3], clearance: Clearance) -> bool {
    legs.iter().enumerate().all(|(index, leg)| {
        let apart = |other: &Leg| !leg.comes_near(other, clearance);
        let still = |&at: &DVec3| Leg { from: at, to: at };
        legs[..index].iter().all(apart) && others.iter().map(still).all(|other| apart(&other))
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::geometry::spread;
    use super::*;
    use glam::DVec2;

    const CLEARANCE: Clearance = Clearance {
        aside_m: 6.0,
        above_m: 6.5,
    };

    /// Flies the three parts with vehicles of very different speeds, and returns the minimum distance between two of
    /// them.
    fn least_distance(legs: &[Leg], heights: &[f64]) -> f64 {
        let parts: [Vec<(DVec3, DVec3)>; 3] = [
            legs.iter()
                .zip(heights)
                .map(|(leg, &z)| (leg.from, leg.from.truncate().extend(z)))
                .collect(),
            legs.iter()
                .zip(heights)
                .map(|(leg, &z)| (leg.from.truncate().extend(z), leg.to.truncate().extend(z)))
                .collect(),
            legs.iter()
                .zip(heights)
                .map(|(leg, &z)| (leg.to.truncate().extend(z), leg.to))
                .collect(),
        ];
        let mut least = f64::INFINITY;
        for part in &parts {
            for step in 0..=200 {
                let place = |index: usize| {
                    let speed = 1.0 + (index % 3) as f64;
                    let share = (f64::from(step) / 200.0 * speed).min(1.0);
                    part[index].0.lerp(part[index].1, share)
                };
                for a in 0..legs.len() {
                    for b in 0..a {
                        least = least.min(place(a).distance(place(b)));
                    }
                }
            }
        }
        least
    }

    fn places(points: &[(f64, f64)]) -> Vec<DVec2> {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
        spread(&points, CLEARANCE.aside_m)
    }

    proptest! {
        #[test]
        fn nobody_comes_nearer_than_the_clearance(
            from in proptest::collection::vec((-60.0..60.0f64, -60.0..60.0f64), 8),
            to in proptest::collection::vec((-60.0..60.0f64, -60.0..60.0f64), 8),
            heights_m in proptest::collection::vec(10.0..40.0f64, 8),
        ) {
            let legs: Vec<Leg> = places(&from)
                .into_iter()
                .zip(places(&to))
                .zip(heights_m)
                .map(|((from, to), z)| Leg { from: from.extend(z), to: to.extend(25.0) })
                .collect();
            let heights = heights(&legs, &[], CLEARANCE).expect("eight heights at most");
            let least = least_distance(&legs, &heights);
            prop_assert!(least >= CLEARANCE.aside_m - 1e-6, "{least} {heights:?}");
        }
    }

    #[test]
    fn ways_that_stay_clear_share_a_height_and_those_that_cross_do_not() {
        let leg = |from: (f64, f64), to: (f64, f64)| Leg {
            from: DVec2::from(from).extend(10.0),
            to: DVec2::from(to).extend(25.0),
        };
        let side_by_side = [leg((0.0, 0.0), (50.0, 0.0)), leg((0.0, 20.0), (50.0, 20.0))];
        assert_eq!(
            heights(&side_by_side, &[], CLEARANCE),
            Some(vec![25.0, 25.0])
        );
        assert!(are_apart(&side_by_side, &[], CLEARANCE));
        let crossing = [leg((0.0, 0.0), (50.0, 20.0)), leg((0.0, 20.0), (50.0, 0.0))];
        assert_eq!(heights(&crossing, &[], CLEARANCE), Some(vec![25.0, 31.5]));
        assert!(!are_apart(&crossing, &[], CLEARANCE));
    }

    #[test]
    fn a_bystander_is_passed_above() {
        let leg = Leg {
            from: DVec3::new(0.0, 0.0, 20.0),
            to: DVec3::new(50.0, 0.0, 20.0),
        };
        let bystander = DVec3::new(25.0, 2.0, 22.0);
        assert_eq!(heights(&[leg], &[bystander], CLEARANCE), Some(vec![33.0]));
    }

    /// Two vehicles above each other cannot exchange heights in place.
    #[test]
    fn those_above_one_another_keep_their_order() {
        let leg = |z: f64, to: DVec3| Leg {
            from: DVec3::new(0.0, 0.0, z),
            to,
        };
        let apart = [
            leg(10.0, DVec3::new(0.0, 40.0, 20.0)),
            leg(17.0, DVec3::new(0.0, -40.0, 20.0)),
        ];
        let found = heights(&apart, &[], CLEARANCE).expect("heights");
        assert!(found[1] >= found[0] + CLEARANCE.above_m, "{found:?}");
        let swapped = [
            leg(10.0, DVec3::new(0.0, 40.0, 30.0)),
            leg(17.0, DVec3::new(0.0, 40.0, 20.0)),
        ];
        assert_eq!(heights(&swapped, &[], CLEARANCE), None);
    }
}
