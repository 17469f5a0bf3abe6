//! Orders that lead a vehicle out of its own fence. ArduCopter drops the target of such an order without an answer.

use std::sync::Arc;

use crate::app::State;
use crate::commands::{Act, Command, FlightCommand, MotionCommand, Order};
use crate::geo::{LatLon, Outline};
use crate::mission::{Area, AreaKind};
use crate::plan::check::CheckOptions;
use crate::text;
use crate::text::Text;
use crate::vehicle::{FenceArea, FenceShape, Vehicle, VehicleClass, check_rules};

/// Why an order needs a confirmation although its verb does not:
/// [`FlightView::hazard`](crate::app::state::FlightView::hazard), or a target outside a vehicle's own fence. `None` if it
/// needs none.
pub fn hazard(state: &State, order: &Order) -> Option<Text> {
    let session = &state.session;
    session.hazard(order).or_else(|| {
        let targets = order.targets.iter();
        let mut vehicles = targets.filter_map(|id| session.vehicles.get(id));
        let leaves =
            |vehicle: &&Arc<Vehicle>| leaves_own_fence(vehicle, &limits(state, vehicle), order);
        let vehicle = vehicles.find(leaves)?;
        Some(text!("hazard-outside-own-fence", vehicle = vehicle.id))
    })
}

/// The limits of a vehicle's fence by its parameters, as far as they have been read.
fn limits(state: &State, vehicle: &Vehicle) -> CheckOptions {
    let class = vehicle.heartbeat.map(|beat| beat.class);
    let class = class.unwrap_or(VehicleClass::Other);
    let known = state.rooms.parameters.lists.get(&vehicle.id);
    check_rules(class, vehicle.reports_fence_on(), |name| {
        Some(known?.list.get(name)?.value as f32)
    })
}

/// Whether an order leads a vehicle out of the areas on board, farther from home or higher than its limits allow.
fn leaves_own_fence(vehicle: &Vehicle, limits: &CheckOptions, order: &Order) -> bool {
    let (place, height_m) = match &order.act {
        Act::Command(Command::Motion(MotionCommand::Goto { destination, .. })) => {
            let Some((place, height_m)) = destination.of(vehicle) else {
                return false;
            };
            (Some(place), height_m)
        }
        Act::Command(
            Command::Motion(MotionCommand::Altitude { altitude_m })
            | Command::Flight(FlightCommand::Takeoff { altitude_m }),
        ) => (None, Some(*altitude_m)),
        Act::Command(_)
        | Act::Deed(_)
        | Act::Manoeuvre(_)
        | Act::Plans(_)
        | Act::Rehearse { .. } => return false,
    };
    let is_above = |limit_m: f32| height_m.is_some_and(|height_m| height_m > f64::from(limit_m));
    limits.ceiling_m.is_some_and(is_above)
        || place.is_some_and(|place| is_beyond(vehicle, limits, place))
}

fn is_beyond(vehicle: &Vehicle, limits: &CheckOptions, place: LatLon) -> bool {
    let from_home_m = vehicle.home.map(|home| home.at_point.distance_m(place));
    let is_far = |radius_m: f32| from_home_m.is_some_and(|far_m| far_m > f64::from(radius_m));
    let areas = vehicle.fence_in_force().map(|fence| fence.areas.as_slice());
    let is_broken = |area: &FenceArea| contains(area, place) != area.inclusion;
    limits.radius_m.is_some_and(is_far) || areas.unwrap_or_default().iter().any(is_broken)
}

fn contains(area: &FenceArea, place: LatLon) -> bool {
    let outline = match &area.shape {
        FenceShape::Polygon(corners) => Outline::Polygon(corners.clone()),
        FenceShape::Circle { center, radius_m } => Outline::Circle {
            centre: *center,
            radius_m: f64::from(*radius_m),
        },
    };
    let area = Area {
        name: String::new(),
        kind: AreaKind::Geofence,
        outline,
        ceiling_m: None,
    };
    area.contains(place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::testing::{HOME, at_home, carry_fence, read, switch_fence_on};
    use crate::vehicle::Place;

    /// A vehicle that knows where its home is, 20 m above it.
    fn above_home() -> Vehicle {
        let mut vehicle = at_home(20.0);
        vehicle.home = Some(Place {
            at_point: HOME,
            altitude_amsl_m: 160.0,
        });
        vehicle
    }

    fn leaves(vehicle: &Vehicle, limits: &CheckOptions, line: &str) -> bool {
        leaves_own_fence(vehicle, limits, &read(line))
    }

    #[test]
    fn the_radius_and_the_ceiling_of_a_vehicle_count() {
        let limits = CheckOptions {
            radius_m: Some(80.0),
            ceiling_m: Some(50.0),
            ..CheckOptions::default()
        };
        for (line, out) in [
            ("1 goto by n 70 e 0", false),
            ("1 goto by n 200 e 0", true),
            ("1 goto by n 70 e 0 up 40", true),
            ("1 altitude 60", true),
            ("1 altitude 40", false),
            ("1 takeoff 60", true),
            ("1 land", false),
        ] {
            assert_eq!(leaves(&above_home(), &limits, line), out, "{line}");
        }
        let none = CheckOptions::default();
        assert!(!leaves(&above_home(), &none, "1 goto by n 200 e 0"));
    }

    #[test]
    fn an_area_on_board_counts_while_the_fence_is_on() {
        let mut vehicle = above_home();
        carry_fence(&mut vehicle, Some(200.0));
        let limits = CheckOptions::default();
        assert!(!leaves(&vehicle, &limits, "1 goto by n 110 e 0"));
        switch_fence_on(&mut vehicle);
        assert!(leaves(&vehicle, &limits, "1 goto by n 110 e 0"));
        assert!(!leaves(&vehicle, &limits, "1 goto by n 90 e 0"));
    }
}
