//! Rules of the air: closed areas, and distances to people and aircraft.

use std::collections::BTreeMap;

use super::mover::{Mover, MoverKind};
use super::scope::Scope;
use crate::geo::maths;
use crate::mission::craft::{Breach, Craft};
use crate::mission::zone::ZoneKind;
use crate::scoring::SafetyKind;
use crate::text;
use crate::vehicle::VehicleId;

/// Vehicles closer than this have collided.
const TOUCH_M: f64 = 0.5;
/// Vehicles closer than this to an aircraft have collided with it; it is larger than they are.
const AIRCRAFT_M: f64 = 5.0;
/// A vehicle this close to a person and this low injures the person.
const HURTS_WITHIN_M: f64 = 1.0;
const HURTS_BELOW_M: f64 = 2.5;
/// Vehicles above this height do not disturb people who walk by.
const OVERHEAD_M: f64 = 30.0;

/// Metres east, north and up.
type Place = [f64; 3];

/// Watches the rules during one flight.
#[derive(Debug, Clone, Default)]
pub(crate) struct Airspace {
    /// The positions of the vehicles in the air at the last step.
    before: BTreeMap<VehicleId, Place>,
}

impl Airspace {
    /// The rules broken now, each with the vehicle that breaks it.
    pub fn step(&mut self, scope: &Scope<'_>, min_separation_m: f64) -> Vec<(VehicleId, Breach)> {
        let places = scope
            .flying()
            .filter_map(|craft| Some((craft, craft.place_m()?)));
        let flying: Vec<(&Craft, Place)> = places.collect();
        let mut breaches = Vec::new();
        for &(craft, place) in &flying {
            let mut note = |breach| breaches.push((craft.id, breach));
            in_zones(place, scope).into_iter().for_each(&mut note);
            let near = scope.movers.iter().filter_map(|mover| near(mover, place));
            near.for_each(note);
        }
        for (index, a) in flying.iter().enumerate() {
            for b in &flying[index + 1..] {
                let distance_m = self.closest_m([a.0.id, b.0.id], [a.1, b.1]);
                if let Some(breach) = too_close(distance_m, b.0.id, min_separation_m) {
                    breaches.push((a.0.id, breach));
                }
            }
        }
        self.before = flying.iter().map(|(craft, at)| (craft.id, *at)).collect();
        breaches
    }

    /// The minimum distance between two vehicles since the last step, as if both had flown straight.
    fn closest_m(&self, [a, b]: [VehicleId; 2], now_at: [Place; 2]) -> f64 {
        let between =
            |a: Place, b: Place| -> Place { std::array::from_fn(|axis| b[axis] - a[axis]) };
        let length = |v: Place| maths::hypot(maths::hypot(v[0], v[1]), v[2]);
        let now = between(now_at[0], now_at[1]);
        let (Some(&a), Some(&b)) = (self.before.get(&a), self.before.get(&b)) else {
            return length(now);
        };
        let before = between(a, b);
        let way = between(before, now);
        let dot = |a: Place, b: Place| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let way_2 = dot(way, way);
        let along = if way_2 > 0.0 {
            (-dot(before, way) / way_2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        length(std::array::from_fn(|axis| before[axis] + along * way[axis]))
    }
}

fn too_close(distance_m: f64, other: VehicleId, min_separation_m: f64) -> Option<Breach> {
    if distance_m < TOUCH_M {
        let text = text!("threat-collision", other = i64::from(other));
        Some((SafetyKind::Collision, text))
    } else if distance_m < min_separation_m {
        let text = text!(
            "threat-separation",
            other = i64::from(other),
            distance = format!("{distance_m:.1}")
        );
        Some((SafetyKind::Separation, text))
    } else {
        None
    }
}

fn in_zones([east_m, north_m, up_m]: Place, scope: &Scope<'_>) -> Vec<Breach> {
    let zones = scope.zones.iter().zip(scope.active);
    let inside = zones
        .filter(|(zone, active)| **active && zone.shape.contains([east_m, north_m]))
        .map(|(zone, _)| zone);
    let breach = |zone: &crate::mission::zone::Zone| match zone.kind {
        ZoneKind::NoFly { floor_m, ceiling_m } => (floor_m..=ceiling_m)
            .contains(&up_m)
            .then(|| (SafetyKind::NoFly, text!("threat-no-fly", zone = &zone.id))),
        ZoneKind::People { below_m } => (up_m < below_m).then(|| {
            let text = text!(
                "threat-people",
                zone = &zone.id,
                height = format!("{below_m:.0}")
            );
            (SafetyKind::People, text)
        }),
        ZoneKind::Task
        | ZoneKind::Geofence { .. }
        | ZoneKind::GnssJam { .. }
        | ZoneKind::GnssGlitch { .. }
        | ZoneKind::RadioJam { .. }
        | ZoneKind::CommShadow(_) => None,
    };
    inside.filter_map(breach).collect()
}

/// The rule that a vehicle at a place breaks near a mover, if any.
fn near(mover: &Mover, place: Place) -> Option<Breach> {
    let distance_m = mover.distance_m(place);
    let distance = || format!("{distance_m:.0}");
    match mover.kind {
        MoverKind::Person if distance_m < HURTS_WITHIN_M && place[2] < HURTS_BELOW_M => {
            Some((SafetyKind::Injury, text!("threat-injury")))
        }
        MoverKind::Person if distance_m < mover.keep_out_m && place[2] < OVERHEAD_M => {
            let text = text!("threat-near-person", distance = distance());
            Some((SafetyKind::People, text))
        }
        MoverKind::Aircraft if distance_m < AIRCRAFT_M => {
            Some((SafetyKind::AircraftHit, text!("threat-aircraft-hit")))
        }
        MoverKind::Aircraft if distance_m < mover.keep_out_m => {
            let text = text!("threat-bubble", distance = distance());
            Some((SafetyKind::Bubble, text))
        }
        MoverKind::Intruder if distance_m < TOUCH_M => {
            Some((SafetyKind::Collision, text!("threat-intruder-hit")))
        }
        MoverKind::Intruder if distance_m < mover.keep_out_m => {
            let text = text!("threat-intruder-near", distance = distance());
            Some((SafetyKind::Separation, text))
        }
        MoverKind::Person | MoverKind::Aircraft | MoverKind::Intruder => None,
    }
}

#[cfg(test)]
mod tests;
