//! Collisions and broken fences that are near, if vehicles keep their velocity up to their targets.

use std::sync::Arc;

use super::{FlightView, separation_limits};
use crate::class::{Danger, DangerKind};
use crate::config::AlertsConfig;
use crate::geo::{LatLon, maths};
use crate::mission::AreaKind;
use crate::rehearsal::{Separation, SeparationLimits};
use crate::vehicle::Vehicle;

/// How far ahead dangers are looked for, in whole seconds.
const HORIZON_S: u32 = 10;

/// A vehicle in the air, in metres north, east and up from the first one.
struct FlyerAhead<'a> {
    vehicle: &'a Vehicle,
    point: [f64; 3],
    /// The velocity in metres per second.
    velocity: [f64; 3],
    /// How far it will fly at most: to its target, if that is known.
    reach_m: f64,
    start: Option<[f64; 2]>,
}

impl FlyerAhead<'_> {
    /// Its place after a time.
    fn after(&self, time_s: f64) -> [f64; 3] {
        let speed = maths::hypot(self.velocity[0], self.velocity[1]);
        let share = if speed * time_s > self.reach_m {
            self.reach_m / speed
        } else {
            time_s
        };
        let [north, east, up] = self.velocity;
        let [x, y, z] = self.point;
        [x + north * share, y + east * share, z + up * share]
    }
}

/// The distances between the vehicles in the air, and what threatens them.
pub(in crate::app) struct Nearness {
    /// The least distance now, in metres.
    pub separation_m: Option<f64>,
    pub danger: Option<Danger>,
}

impl FlightView {
    /// What is near now.
    pub(in crate::app) fn nearness(&self, config: &AlertsConfig) -> Nearness {
        let flyers = self.flyers();
        let limits = self.limits(config);
        let collision = collision_in(&flyers, limits).map(|in_s| (DangerKind::Collision, in_s));
        let fence = self.fence_in(&flyers).map(|in_s| (DangerKind::Fence, in_s));
        let nearest = collision.into_iter().chain(fence);
        let nearest = nearest.min_by(|(_, a), (_, b)| a.total_cmp(b));
        Nearness {
            separation_m: least_distance(&flyers),
            danger: nearest.map(|(kind, in_s)| Danger { kind, in_s }),
        }
    }

    /// The distances that vehicles have to keep: by the mission, otherwise by the configuration.
    fn limits(&self, config: &AlertsConfig) -> SeparationLimits {
        let usual = separation_limits(config);
        let mission = self.task.listing.as_ref();
        mission.map_or(usual, |listing| SeparationLimits {
            across_m: listing.swarm_rules.separation_m,
            ..usual
        })
    }

    fn flyers(&self) -> Vec<FlyerAhead<'_>> {
        let flies = |vehicle: &&Vehicle| !vehicle.link.lost && vehicle.airborne();
        let vehicles = self.vehicles.values().map(Arc::as_ref).filter(flies);
        let mut origin = None;
        let flyers = vehicles.filter_map(|vehicle| flyer(vehicle, &mut origin));
        flyers.collect()
    }

    /// The time until a vehicle leaves a fence of the mission, in seconds.
    fn fence_in(&self, flyers: &[FlyerAhead<'_>]) -> Option<f64> {
        let areas = self.task.areas.iter();
        let fences: Vec<_> = areas.filter(|it| it.kind == AreaKind::Geofence).collect();
        if fences.is_empty() {
            return None;
        }
        let leaves = |flyer: &FlyerAhead<'_>, time_s: f64| {
            let Some(here) = flyer.vehicle.global else {
                return false;
            };
            let then = flyer.after(time_s);
            let (north_m, east_m) = (then[0] - flyer.point[0], then[1] - flyer.point[1]);
            let there = here.at_point.moved(north_m, east_m);
            fences.iter().any(|fence| !fence.contains(there))
        };
        seconds().find(|&time_s| flyers.iter().any(|flyer| leaves(flyer, time_s)))
    }
}

/// A vehicle, if its place and velocity are known; the first one's place is the origin.
fn flyer<'a>(vehicle: &'a Vehicle, origin: &mut Option<LatLon>) -> Option<FlyerAhead<'a>> {
    let here = vehicle.global?;
    let origin = *origin.get_or_insert(here.at_point);
    let [north_m, east_m] = <[f64; 2]>::from(origin.offset_to(here.at_point));
    let target = vehicle.target.and_then(|target| target.at_point);
    let velocity = [here.north_m_s, here.east_m_s, -here.down_m_s].map(f64::from);
    let point = [north_m, east_m, here.altitude_amsl_m];
    let is_known = point.iter().chain(&velocity).all(|it| it.is_finite());
    is_known.then(|| FlyerAhead {
        vehicle,
        point,
        velocity,
        reach_m: target.map_or(f64::INFINITY, |at| here.at_point.distance_m(at)),
        start: vehicle
            .home
            .map(|home| origin.offset_to(home.at_point).into()),
    })
}

fn seconds() -> impl Iterator<Item = f64> {
    (0..=HORIZON_S).map(f64::from)
}

/// Every two of the vehicles.
fn pairs<'a, 'b>(
    flyers: &'b [FlyerAhead<'a>],
) -> impl Iterator<Item = (&'b FlyerAhead<'a>, &'b FlyerAhead<'a>)> + 'b {
    let first = flyers.iter().enumerate();
    first.flat_map(|(at, one)| flyers[at + 1..].iter().map(move |other| (one, other)))
}

fn least_distance(flyers: &[FlyerAhead<'_>]) -> Option<f64> {
    let apart = |(one, other): (&FlyerAhead<'_>, &FlyerAhead<'_>)| {
        let [north, east, up] = [0, 1, 2].map(|axis| one.point[axis] - other.point[axis]);
        maths::hypot(maths::hypot(north, east), up)
    };
    pairs(flyers).map(apart).min_by(f64::total_cmp)
}

/// The time until two vehicles are closer to each other than the limits, in seconds.
fn collision_in(flyers: &[FlyerAhead<'_>], limits: SeparationLimits) -> Option<f64> {
    if limits.across_m <= 0.0 || limits.height_m <= 0.0 {
        return None;
    }
    let meet = |one: &FlyerAhead<'_>, other: &FlyerAhead<'_>, time_s: f64| {
        let starts = one.start.zip(other.start);
        let rule = Separation::new(starts.map(<[_; 2]>::from), limits);
        rule.nearness([one.after(time_s), other.after(time_s)]) < 1.0
    };
    seconds().find(|&time_s| pairs(flyers).any(|(one, other)| meet(one, other, time_s)))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::time::Duration;

    use super::*;
    use crate::app::state::Activity;
    use crate::geo::Outline;
    use crate::mission::Area;
    use crate::vehicle::{GlobalPosition, LandedState, Target, VehicleId};

    const HERE: LatLon = LatLon::new(50.45, 30.52);

    /// A vehicle 20 m up, at metres east, that flies east.
    fn flying(id: VehicleId, east_m: f64, east_m_s: f32) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.id = id;
        vehicle.landed = LandedState::InAir;
        vehicle.global = Some(GlobalPosition {
            at_point: HERE.moved(0.0, east_m),
            altitude_amsl_m: 190.0,
            altitude_m: 20.0,
            north_m_s: 0.0,
            east_m_s,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        vehicle
    }

    fn nearness(vehicles: impl IntoIterator<Item = Vehicle>, fence_m: Option<f64>) -> Nearness {
        let mut session = FlightView::new(Activity::Free, BTreeMap::new());
        for vehicle in vehicles {
            session.insert(Arc::new(vehicle));
        }
        session.task.areas.extend(fence_m.map(|side_m| Area {
            name: "field".to_owned(),
            kind: AreaKind::Geofence,
            outline: Outline::square(HERE, side_m),
            ceiling_m: None,
        }));
        session.nearness(&AlertsConfig::default())
    }

    fn danger(near: &Nearness) -> Option<(DangerKind, f64)> {
        near.danger.map(|danger| (danger.kind, danger.in_s))
    }

    #[test]
    fn vehicles_that_will_meet_within_ten_seconds_are_in_danger() {
        let near = nearness([flying(1, 0.0, 5.0), flying(2, 32.0, 0.0)], None);
        // Closer than 5 m after more than 27 m at 5 m/s.
        assert_eq!(danger(&near), Some((DangerKind::Collision, 6.0)));
        let least_m = near.separation_m.expect("two vehicles");
        assert!((least_m - 32.0).abs() < 0.1, "{least_m}");
        let far = nearness([flying(1, 0.0, 5.0), flying(2, 60.0, 0.0)], None);
        assert_eq!(danger(&far), None);
        assert_eq!(danger(&nearness([flying(1, 0.0, 5.0)], None)), None);
    }

    #[test]
    fn a_vehicle_that_stops_at_its_target_is_in_no_danger() {
        let mut first = flying(1, 0.0, 5.0);
        first.target = Some(Target {
            at_point: Some(HERE.moved(0.0, 20.0)),
            altitude_m: None,
            velocity_m_s: None,
            at: Duration::ZERO,
        });
        assert_eq!(
            danger(&nearness([first.clone(), flying(2, 30.0, 0.0)], None)),
            None
        );
        assert_eq!(danger(&nearness([first.clone()], Some(50.0))), None);
        let past = danger(&nearness([first], Some(34.0)));
        assert_eq!(past, Some((DangerKind::Fence, 4.0)));
    }

    #[test]
    fn a_vehicle_that_will_leave_the_fence_is_in_danger_and_one_outside_is_at_once() {
        let near = |east_m| danger(&nearness([flying(1, east_m, 5.0)], Some(100.0)));
        assert_eq!(near(23.0), Some((DangerKind::Fence, 6.0)));
        assert_eq!(near(-40.0), None);
        assert_eq!(near(60.0), Some((DangerKind::Fence, 0.0)));
    }
}
