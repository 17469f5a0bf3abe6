//! The traffic around the vehicles, from their receivers and from the mission's reports.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::time::Duration;

use crate::mission::{MoverKind, Progress};
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{Aircraft, Approach, TrafficThreat, Vehicle, VehicleId, Vehicles};

/// The maximum number of vehicles whose approach to one aircraft is listed.
const LISTED: usize = 8;

/// An aircraft, and how it approaches vehicles in the air.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackedAircraft {
    pub aircraft: Aircraft,
    /// The approaches to the vehicles in the air, the most urgent first.
    pub approaches: Vec<VehicleApproach>,
}

/// The approach of an aircraft to one vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VehicleApproach {
    pub vehicle: VehicleId,
    pub approach: Approach,
}

impl TrackedAircraft {
    /// The aircraft's most dangerous approach; `None` if no vehicle is in the air.
    pub fn worst(&self) -> Option<&VehicleApproach> {
        self.approaches.first()
    }

    pub fn threat(&self) -> TrafficThreat {
        self.worst()
            .map_or(TrafficThreat::None, |worst| worst.approach.threat)
    }

    /// The aircraft's name, height, course and speed, and the age of its report.
    pub fn text(&self, now: Duration) -> Text {
        let aircraft = &self.aircraft;
        let unknown = || "-".to_owned();
        text!(
            "traffic-aircraft",
            name = aircraft.name(),
            height = figure(aircraft.altitude_amsl_m, 0),
            course = aircraft
                .course_deg()
                .map_or_else(unknown, |it| format!("{it:03.0}")),
            speed = aircraft
                .speed_m_s()
                .map_or_else(unknown, |it| format!("{it:.0}")),
            climb = aircraft
                .climb_m_s
                .map_or_else(unknown, |it| format!("{it:+.0}")),
            age = aircraft.age(now).as_secs()
        )
    }
}

impl VehicleApproach {
    /// The distance now, and at the closest approach.
    pub fn text(&self) -> Text {
        let approach = &self.approach;
        let (distance, height) = (
            figure(approach.distance_m, 0),
            format!("{:+.0}", approach.height_m),
        );
        if approach.in_s > 0.0 {
            text!(
                "traffic-approach",
                vehicle = self.vehicle,
                distance = distance,
                height = height,
                across = figure(approach.closest_m, 0),
                above = format!("{:+.0}", approach.closest_height_m),
                seconds = figure(approach.in_s, 0)
            )
        } else {
            text!(
                "traffic-leaves",
                vehicle = self.vehicle,
                distance = distance,
                height = height
            )
        }
    }
}

/// The aircraft that threatens a vehicle most.
#[derive(Debug, Clone, PartialEq)]
pub struct TrafficConflict {
    pub name: String,
    pub approach: Approach,
}

/// All aircraft that are known, the most urgent first.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrafficPicture {
    tracked: Vec<TrackedAircraft>,
}

impl TrafficPicture {
    /// The picture now, from the vehicles' receivers and from the mission.
    pub fn new(vehicles: &Vehicles, mission: Option<&Progress>, now: Duration) -> Self {
        let known: Vec<Aircraft> = heard(vehicles).chain(of_mission(mission, now)).collect();
        let flying: Vec<&Vehicle> = if known.is_empty() {
            Vec::new()
        } else {
            let flies = |vehicle: &&Vehicle| vehicle.airborne() && !vehicle.link.lost;
            vehicles.values().map(AsRef::as_ref).filter(flies).collect()
        };
        let aircraft = known.into_iter();
        let mut tracked: Vec<TrackedAircraft> =
            aircraft.map(|it| track(it, &flying, now)).collect();
        tracked.sort_by(|a, b| match (a.worst(), b.worst()) {
            (Some(one), Some(other)) => by_urgency(one, other),
            // One without a vehicle in the air is the least urgent.
            (one, other) => other.is_some().cmp(&one.is_some()),
        });
        Self { tracked }
    }

    pub fn is_empty(&self) -> bool {
        self.tracked.is_empty()
    }

    /// The aircraft, the most urgent first.
    pub fn tracked(&self) -> &[TrackedAircraft] {
        &self.tracked
    }

    /// The greatest threat to each vehicle that is in danger.
    pub fn conflicts(&self) -> BTreeMap<VehicleId, TrafficConflict> {
        let mut found: BTreeMap<VehicleId, TrafficConflict> = BTreeMap::new();
        for tracked in &self.tracked {
            for one in &tracked.approaches {
                if one.approach.threat == TrafficThreat::None {
                    continue;
                }
                let is_worse = found
                    .get(&one.vehicle)
                    .is_none_or(|known| one.approach.threat < known.approach.threat);
                if is_worse {
                    let conflict = TrafficConflict {
                        name: tracked.aircraft.name(),
                        approach: one.approach,
                    };
                    found.insert(one.vehicle, conflict);
                }
            }
        }
        found
    }
}

/// The aircraft that receivers hear. If several receivers hear the same one, by its ICAO address,
/// the newest report counts.
fn heard(vehicles: &Vehicles) -> impl Iterator<Item = Aircraft> {
    let mut newest: BTreeMap<u32, Aircraft> = BTreeMap::new();
    let mut nameless = Vec::new();
    for aircraft in vehicles.values().flat_map(|vehicle| vehicle.traffic.iter()) {
        let Some(icao) = aircraft.icao else {
            nameless.push(aircraft.clone());
            continue;
        };
        let is_newer = newest.get(&icao).is_none_or(|known| aircraft.at > known.at);
        if is_newer {
            newest.insert(icao, aircraft.clone());
        }
    }
    newest.into_values().chain(nameless)
}

/// The manned aircraft of a mission, whose reports the task force receives. Several aircraft may
/// share a callsign.
fn of_mission(mission: Option<&Progress>, now: Duration) -> impl Iterator<Item = Aircraft> + '_ {
    let movers = mission.into_iter().flat_map(|progress| &progress.movers);
    let manned = movers.filter(|mover| mover.kind == MoverKind::Aircraft);
    manned.map(move |mover| Aircraft {
        icao: None,
        callsign: mover.callsign.clone(),
        at_point: mover.at,
        altitude_amsl_m: mover.altitude_amsl_m,
        velocity_m_s: Some(mover.velocity_m_s),
        climb_m_s: Some(0.0),
        at: now,
    })
}

fn track(aircraft: Aircraft, flying: &[&Vehicle], now: Duration) -> TrackedAircraft {
    let own = flying.iter().filter_map(|vehicle| {
        let here = vehicle.global?;
        Some(VehicleApproach {
            vehicle: vehicle.id,
            approach: Approach::of(&aircraft, &here, now),
        })
    });
    let mut approaches: Vec<VehicleApproach> = own.collect();
    approaches.sort_by(by_urgency);
    // All that are in danger are kept, for their alerts.
    let in_danger = |one: &VehicleApproach| one.approach.threat != TrafficThreat::None;
    let kept = approaches.iter().filter(|one| in_danger(one)).count();
    approaches.truncate(kept.max(LISTED));
    TrackedAircraft {
        aircraft,
        approaches,
    }
}

/// The order of approaches: the threat, then how close and how soon.
fn by_urgency(one: &VehicleApproach, other: &VehicleApproach) -> Ordering {
    let far = |it: &VehicleApproach| {
        let predicted = &it.approach.predicted;
        predicted.across_m + 10.0 * predicted.in_s
    };
    let by_threat = one.approach.threat.cmp(&other.approach.threat);
    by_threat.then_with(|| far(one).total_cmp(&far(other)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geo::LatLon;
    use crate::vehicle::GlobalPosition;

    const HERE: LatLon = LatLon::new(50.45, 30.52);

    fn vehicle(id: u8, north_m: f64, north_m_s: f32) -> Vehicle {
        let mut vehicle = Vehicle::new(id, 1);
        vehicle.global = Some(GlobalPosition {
            at_point: HERE.moved(north_m, 0.0),
            altitude_amsl_m: 200.0,
            altitude_m: 30.0,
            north_m_s,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        vehicle
    }

    fn aircraft(callsign: &str, north_m_s: f64) -> Aircraft {
        Aircraft {
            icao: None,
            callsign: callsign.to_owned(),
            at_point: HERE,
            altitude_amsl_m: 200.0,
            velocity_m_s: Some([north_m_s, 0.0]),
            climb_m_s: Some(0.0),
            at: Duration::ZERO,
        }
    }

    #[test]
    fn danger_at_nearly_equal_velocities_comes_first_and_is_never_left_out() {
        // The last one is 50 m ahead and 5e-8 m/s slower: they would meet in 1e9 s. The others are 5 km and more behind.
        let mut all: Vec<Vehicle> = (1..=12)
            .map(|id| vehicle(id, -5000.0 - 10.0 * f64::from(id), 20.0))
            .collect();
        all.push(vehicle(13, 50.0, 20.0));
        let flying: Vec<&Vehicle> = all.iter().collect();
        let tracked = track(aircraft("A", 20.0 + 5e-8), &flying, Duration::ZERO);
        assert_eq!(tracked.approaches.len(), LISTED);
        assert_eq!(tracked.threat(), TrafficThreat::Critical);
        let worst = tracked.worst().expect("vehicles fly");
        assert_eq!(worst.vehicle, 13);
        assert!(worst.approach.in_s > 1e8, "{}", worst.approach.in_s);
    }

    #[test]
    fn an_aircraft_that_flies_beside_a_vehicle_comes_no_closer() {
        let beside = vehicle(1, 50.0, 20.0);
        let tracked = track(aircraft("A", 20.0), &[&beside], Duration::ZERO);
        assert_eq!(tracked.threat(), TrafficThreat::Critical);
        let text = tracked.worst().expect("it flies").text().to_string();
        assert_eq!(text, "vehicle 1: now 50 m, +0 m vertical; comes no closer");
    }

    #[test]
    fn only_reports_with_an_icao_address_are_merged() {
        let mut vehicles = Vehicles::new();
        for (id, at_s) in [(1, 5), (2, 7)] {
            let mut receiver = vehicle(id, 0.0, 0.0);
            for icao in [0xabc, 0xdef] {
                let mut report = aircraft("SAME", 0.0);
                report.icao = Some(icao);
                report.at = Duration::from_secs(at_s);
                receiver.traffic.note(icao, report);
            }
            // Two without an address.
            let mut report = aircraft("SAME", 0.0);
            report.at = Duration::from_secs(at_s);
            receiver.traffic.note(u32::from(id), report);
            vehicles.insert(receiver.id, receiver.into());
        }
        let picture = TrafficPicture::new(&vehicles, None, Duration::from_secs(8));
        let aircraft = picture.tracked().iter().map(|it| &it.aircraft);
        let found: Vec<_> = aircraft.map(|it| (it.icao, it.at.as_secs())).collect();
        assert_eq!(
            found,
            [(Some(0xabc), 7), (Some(0xdef), 7), (None, 5), (None, 7)]
        );
    }
}
