//! Vehicles that came close to each other in the air.

use std::collections::BTreeSet;
use std::time::Duration;

use super::Lookout;
use crate::app::State;
use crate::moment::{Moment, MomentKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};

/// The margin above the required separation below which an approach becomes a moment, in metres.
pub(super) const NEAR_MARGIN_M: f64 = 2.0;
/// Vehicles below this height stand on neighbouring pads, take off or land.
const FLYING_ABOVE_M: f64 = 2.0;
/// Two vehicles have passed each other once their distance has grown by this much.
const PASSED_M: f64 = 1.0;

/// Two vehicles, the vehicle with the lower number first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    one: VehicleId,
    other: VehicleId,
}

/// The closest distance of two vehicles during an approach.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approach {
    closest_m: f64,
    at: Duration,
    is_told: bool,
}

impl Lookout {
    /// Handles the end of the recording, which ends all approaches. The smallest distance of the
    /// flight becomes a moment, even if it was large enough.
    pub fn end(&mut self) {
        self.part(&BTreeSet::new());
        let nearest = self.nearest.take();
        if let Some((pair, Approach { at, closest_m, .. })) = nearest
            && closest_m >= self.near_m
        {
            let metres = text::figure(closest_m, 1);
            self.add_separation(pair, at, text!("moment-nearest", metres = metres));
        }
    }

    /// Measures the distances between the vehicles in the air.
    pub(super) fn measure(&mut self, now: Duration, state: &State) {
        let vehicles = state.session().vehicles().values();
        let flying: Vec<&Vehicle> = vehicles
            .map(AsRef::as_ref)
            .filter(|it| is_flying(it) && !it.link.lost && it.global.is_some())
            .collect();
        self.part(&flying.iter().map(|it| it.id).collect());
        for (at, one) in flying.iter().enumerate() {
            for other in &flying[at + 1..] {
                if let Some(distance_m) = one.distance_m(other) {
                    let pair = Pair {
                        one: one.id,
                        other: other.id,
                    };
                    self.approach(now, pair, distance_m);
                }
            }
        }
    }

    /// Ends the approaches in which one of the vehicles no longer flies.
    fn part(&mut self, flying: &BTreeSet<VehicleId>) {
        let ends = |pair: &Pair| !(flying.contains(&pair.one) && flying.contains(&pair.other));
        let ended: Vec<Pair> = self.pairs.keys().copied().filter(ends).collect();
        for pair in ended {
            if let Some(passed) = self.pairs.remove(&pair) {
                self.tell_approach(pair, passed);
            }
        }
    }

    fn approach(&mut self, now: Duration, pair: Pair, distance_m: f64) {
        let here = Approach {
            closest_m: distance_m,
            at: now,
            is_told: false,
        };
        if self.nearest.is_none_or(|(_, it)| distance_m < it.closest_m) {
            self.nearest = Some((pair, here));
        }
        if distance_m > self.near_m + PASSED_M {
            if let Some(passed) = self.pairs.remove(&pair) {
                self.tell_approach(pair, passed);
            }
            return;
        }
        let known = self.pairs.entry(pair).or_insert(here);
        if distance_m < known.closest_m {
            *known = here;
        } else if distance_m > known.closest_m + PASSED_M {
            let passed = *known;
            known.is_told = true;
            self.tell_approach(pair, passed);
        }
    }

    fn tell_approach(&mut self, pair: Pair, passed: Approach) {
        if passed.closest_m < self.near_m && !passed.is_told {
            let metres = text::figure(passed.closest_m, 1);
            self.add_separation(pair, passed.at, text!("moment-near", metres = metres));
        }
    }

    fn add_separation(&mut self, pair: Pair, at: Duration, text: Text) {
        self.add(Moment {
            at,
            vehicles: vec![pair.one, pair.other],
            kind: MomentKind::Separation,
            by: None,
            text,
        });
    }
}

/// Whether a vehicle flies: only then does its distance from others count.
fn is_flying(vehicle: &Vehicle) -> bool {
    let is_high = vehicle.altitude_m().is_none_or(|it| it > FLYING_ABOVE_M);
    vehicle.airborne() && is_high
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    const fn pair(one: VehicleId, other: VehicleId) -> Pair {
        Pair { one, other }
    }

    /// A lookout with a required separation of 5 m: approaches below 7 m become moments.
    fn lookout() -> Lookout {
        Lookout::new(Arc::default(), 5.0)
    }

    fn watch(lookout: &mut Lookout, distances: &[(u64, Pair, f64)]) {
        for &(at_s, pair, distance_m) in distances {
            lookout.approach(Duration::from_secs(at_s), pair, distance_m);
        }
    }

    fn told(lookout: &mut Lookout) -> Vec<(u64, Vec<VehicleId>, String)> {
        let found = lookout.found().unwrap_or_default().into_iter();
        found
            .map(|it| (it.at.as_secs(), it.vehicles, it.text.to_string()))
            .collect()
    }

    #[test]
    fn vehicles_that_stay_close_until_they_land_or_the_recording_ends_were_close() {
        let mut lookout = lookout();
        watch(
            &mut lookout,
            &[
                (1, pair(1, 2), 12.0),
                (2, pair(1, 2), 4.0),
                (3, pair(1, 2), 4.2),
                (3, pair(2, 3), 6.0),
                (4, pair(3, 4), 7.5),
            ],
        );
        assert_eq!(told(&mut lookout), []);
        lookout.part(&BTreeSet::from([2, 3, 4]));
        lookout.end();
        let near = [
            (2, vec![1, 2], "only 4.0 m apart".to_owned()),
            (3, vec![2, 3], "only 6.0 m apart".to_owned()),
        ];
        assert_eq!(told(&mut lookout), near);
    }

    #[test]
    fn distances_above_the_required_separation_leave_one_moment_the_smallest() {
        let mut lookout = lookout();
        for second in 0..40 {
            let distance_m = if second % 4 < 2 { 8.0 } else { 30.0 };
            watch(&mut lookout, &[(second, pair(1, 2), distance_m)]);
        }
        watch(
            &mut lookout,
            &[(50, pair(2, 3), 7.8), (51, pair(2, 3), 20.0)],
        );
        assert_eq!(told(&mut lookout), []);
        lookout.end();
        let smallest = "smallest separation of the flight: 7.8 m".to_owned();
        assert_eq!(told(&mut lookout), [(50, vec![2, 3], smallest)]);
    }
}
