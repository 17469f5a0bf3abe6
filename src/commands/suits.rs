//! Whether a verb suits a kind of vehicle.

use crate::text::Text;
use crate::vehicle::{Heartbeat, Vehicle, VehicleClass};
use crate::verb::{Unsuited, UnsuitedKind, Verb};

/// Checks that a vehicle of this kind can carry out the orders of a verb. A plane may be `known_to_hover` by its
/// parameters alone.
///
/// # Errors
/// The reason why it cannot, and what to do instead.
pub fn suits(verb: &Verb, vehicle: &Vehicle, known_to_hover: bool) -> Result<(), Text> {
    let hovers = known_to_hover || vehicle.is_vtol();
    let is_unsuited = |unsuited: &&Unsuited| is_of_kind(vehicle, unsuited.kind, hovers);
    let Some(unsuited) = verb.unsuited.iter().find(is_unsuited) else {
        return Ok(());
    };
    let arguments = vec![
        ("kind", vehicle.kind_name().into()),
        ("vehicle", vehicle.id.into()),
        ("verb", verb.name.into()),
    ];
    Err(Text::new(unsuited.reason, arguments))
}

fn is_of_kind(vehicle: &Vehicle, kind: UnsuitedKind, hovers: bool) -> bool {
    let is_plane = || {
        let is_ardupilot = vehicle
            .heartbeat
            .as_ref()
            .is_some_and(Heartbeat::is_ardupilot);
        is_ardupilot && vehicle.class() == VehicleClass::Plane
    };
    match kind {
        UnsuitedKind::Surface => vehicle.is_on_surface(),
        UnsuitedKind::Plane => is_plane(),
        UnsuitedKind::FixedWing => is_plane() && !hovers,
    }
}
