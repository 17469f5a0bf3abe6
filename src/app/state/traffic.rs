//! The traffic around the vehicles: what their receivers hear, and what the mission reports.

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
    /// Its most dangerous approach, if any vehicle is in the air.
    pub fn worst(&self) -> Option<&VehicleApproach> {
        self.approaches.first()
    }

    pub fn threat(&self) -> TrafficThreat {
        self.worst()
            .map_or(TrafficThreat::None, |worst| worst.approach.threat)
    }

    /// Its name, height, course and speed, and the age of its report.
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
        // Several receivers hear the same aircraft: the newest report counts.
        let mut newest: BTreeMap<(Option<u32>, String), Aircraft> = BTreeMap::new();
        let heard = vehicles.values().flat_map(|vehicle| vehicle.traffic.iter());
        for aircraft in heard.cloned().chain(of_mission(mission, now)) {
            let name = aircraft
                .icao
                .map_or_else(|| aircraft.name(), |_| String::new());
            let known = newest
                .entry((aircraft.icao, name))
                .or_insert_with(|| aircraft.clone());
            if aircraft.at > known.at {
                *known = aircraft;
            }
        }
        let flying: Vec<&Vehicle> = if newest.is_empty() {
            Vec::new()
        } else {
            let flies = |vehicle: &&Vehicle| vehicle.airborne() && !vehicle.link.lost;
            vehicles.values().map(AsRef::as_ref).filter(flies).collect()
        };
        let aircraft = newest.into_values();
        let mut tracked: Vec<TrackedAircraft> =
            aircraft.map(|it| track(it, &flying, now)).collect();
        tracked.sort_by(|a, b| urgency(a.worst()).total_cmp(&urgency(b.worst())));
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

/// The manned aircraft of a mission: its task force receives their reports.
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
    approaches.sort_by(|a, b| urgency(Some(a)).total_cmp(&urgency(Some(b))));
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
fn urgency(one: Option<&VehicleApproach>) -> f64 {
    let Some(VehicleApproach { approach, .. }) = one else {
        return f64::MAX;
    };
    let class = match approach.threat {
        TrafficThreat::Critical => 0.0,
        TrafficThreat::Warning => 1e9,
        TrafficThreat::None => 2e9,
    };
    class + approach.closest_m + 10.0 * approach.in_s
}
