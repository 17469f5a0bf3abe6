//! Vehicles that one command sends to one place.
//!
//! Autopilots keep no distance from each other: at one height, they would meet there.

use super::Rules;
use crate::commands::{Command, Destination, MotionCommand};
use crate::geo::{LatLon, maths};
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles};
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
    let close = ranges(ends.iter().filter(meets).map(|one| one.id));
    (!close.is_empty()).then(|| text!("swarm-one-place", vehicles = close))
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
