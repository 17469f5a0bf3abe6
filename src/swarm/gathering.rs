//! Vehicles that one command sends to one place.
//!
//! Autopilots keep no distance from each other: at one height, they would meet there.

use super::Rules;
use crate::commands::{Command, Destination, MotionCommand};
use crate::geo::{LatLon, maths};
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleClass, VehicleId, Vehicles};
use crate::vehicle_id::ranges;

/// A warning if a command leads several vehicles to one place at nearly one height.
pub(super) fn meeting(
    command: &Command,
    targets: &[VehicleId],
    vehicles: &Vehicles,
    rules: Rules,
) -> Option<Text> {
    let Command::Motion(MotionCommand::Goto { destination, .. }) = command else {
        return None;
    };
    match destination {
        Destination::Global { .. } | Destination::Local { .. } => {}
        // Vehicles keep their distances.
        Destination::Offset { .. } => return None,
    }
    let end = |id: &VehicleId| {
        let vehicle = vehicles.get(id)?;
        let (place, asked_m) = destination.of(vehicle)?;
        let height_m = asked_m.or(vehicle.altitude_m())?;
        Some(TravelEnd {
            id: *id,
            place,
            height_m,
        })
    };
    let ends: Vec<TravelEnd> = targets.iter().filter_map(end).collect();
    let meets = |one: &&TravelEnd| {
        let mut others = ends.iter().filter(|other| other.id != one.id);
        others.any(|other| one.is_near(other, rules.separation_m))
    };
    let close: Vec<VehicleId> = ends.iter().filter(meets).map(|one| one.id).collect();
    if close.is_empty() {
        return None;
    }
    let is_plane = |id: &VehicleId| {
        let vehicle = vehicles.get(id);
        vehicle.is_some_and(|vehicle| vehicle.class() == VehicleClass::Plane)
    };
    // Planes take part in no formation.
    Some(if close.iter().any(is_plane) {
        text!("swarm-one-place-planes", vehicles = ranges(close))
    } else {
        text!("swarm-one-place", vehicles = ranges(close))
    })
}

struct TravelEnd {
    id: VehicleId,
    place: LatLon,
    /// The height above home, in metres.
    height_m: f64,
}

impl TravelEnd {
    fn is_near(&self, other: &Self, least_m: f64) -> bool {
        let (north_m, east_m) = self.place.offset_to(other.place);
        let is_beside = maths::hypot(north_m, east_m) < least_m;
        is_beside && (self.height_m - other.height_m).abs() < least_m
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::commands::Heading;
    use crate::vehicle::{GlobalPosition, Heartbeat, SystemStatus, Vehicle};

    const HERE: LatLon = LatLon::new(50.45, 30.52);

    fn flying(system: u8, class: VehicleClass) -> Vehicle {
        let at = Duration::ZERO;
        let mut vehicle = Vehicle::new(system, 1);
        vehicle.heartbeat = Some(Heartbeat {
            mav_type: 1,
            autopilot: 3,
            class,
            mode: class.mode("GUIDED").expect("a mode"),
            armed: true,
            status: SystemStatus::Active,
            at,
        });
        vehicle.global = Some(GlobalPosition {
            at_point: HERE,
            altitude_amsl_m: 200.0,
            altitude_m: 50.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at,
        });
        vehicle
    }

    #[test]
    fn planes_are_not_told_to_form_up() {
        let command = Command::Motion(MotionCommand::Goto {
            destination: Destination::Global {
                at_point: HERE.moved(300.0, 0.0),
                altitude_m: None,
            },
            heading: Heading::Auto,
        });
        let rules = Rules {
            separation_m: 5.0,
            swath: None,
        };
        for (class, advises) in [(VehicleClass::Plane, false), (VehicleClass::Copter, true)] {
            let fleet = [1, 2].map(|system| (system.into(), Arc::new(flying(system, class))));
            let said = meeting(&command, &[1, 2], &fleet.into(), rules).expect("a warning");
            let said = said.to_string();
            assert!(said.contains("1-2 fly to one place"), "{said}");
            assert_eq!(said.contains("`formation`"), advises, "{said}");
        }
    }
}
