//! How near to a place counts as there, by the kind of vehicle.

use super::setpoint::TravelEnd;
use crate::geo::maths;
use crate::vehicle::{Vehicle, VehicleClass};

/// The horizontal distance from a place within which it counts as reached.
const ARRIVED_M: f64 = 1.5;
/// The vertical distance from a place within which it counts as reached.
const ARRIVED_HEIGHT_M: f64 = 1.0;
/// The distance from a place within which a rover or boat that stands still counts as there, if its parameters have not
/// been read: they stop within `WP_RADIUS` (2 m by default), and boats stay within `LOIT_RADIUS` (2 m).
const STOPPED_M: f64 = 4.0;
/// The same as a multiple of `WP_RADIUS`.
const STOPPED_RADII: f64 = 2.0;
/// The least distance, for a small `WP_RADIUS`: positions are not more precise.
const STOPPED_LEAST_M: f64 = 1.5;
/// The distance from a place within which a plane counts as there, if its parameters have not been read: it circles
/// around it, with a radius of 60 m by default (`WP_LOITER_RAD`).
const CIRCLING_M: f64 = 100.0;
/// How far outside of its circle a plane may be, in the wind.
const CIRCLE_MARGIN_M: f64 = 40.0;
const CIRCLING_HEIGHT_M: f64 = 10.0;
/// A speed below this counts as standing still.
pub(super) const STILL_M_S: f64 = 0.5;

/// Whether the vehicle is at a place.
pub(super) fn arrived(vehicle: &Vehicle, place: TravelEnd) -> bool {
    separation(vehicle, place).is_some_and(|(horizontal_m, vertical_m)| {
        let is_level = match vehicle.class() {
            VehicleClass::Rover => true,
            VehicleClass::Plane => vertical_m <= CIRCLING_HEIGHT_M,
            VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => {
                vertical_m <= ARRIVED_HEIGHT_M
            }
        };
        is_level && is_near(vehicle, horizontal_m)
    })
}

/// The distance from a place, in metres, within which the vehicle counts as there.
pub(super) fn arrival_m(vehicle: &Vehicle) -> f64 {
    match vehicle.class() {
        VehicleClass::Rover => stopped_m(vehicle),
        VehicleClass::Plane => circling_m(vehicle),
        VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => {
            ARRIVED_M
        }
    }
}

/// The distance from a place, in metres, within which a rover or boat that stands still counts as there.
pub fn stopped_m(vehicle: &Vehicle) -> f64 {
    let radius_m = vehicle.arrival.waypoint_radius_m;
    radius_m.map_or(STOPPED_M, |radius_m| {
        (STOPPED_RADII * f64::from(radius_m)).max(STOPPED_LEAST_M)
    })
}

/// The distance from a place, in metres, within which a plane circles around it.
fn circling_m(vehicle: &Vehicle) -> f64 {
    let radius_m = vehicle.arrival.loiter_radius_m;
    radius_m.map_or(CIRCLING_M, |radius_m| f64::from(radius_m) + CIRCLE_MARGIN_M)
}

/// Whether a vehicle in a mode that returns is back: it stands where the way back ends, or, as a plane, circles there.
pub fn is_back(vehicle: &Vehicle) -> bool {
    let (Some(global), Some(mode)) = (vehicle.global, vehicle.mode()) else {
        return false;
    };
    // RTL may end at a rally point. In SMART_RTL, the target is only the next place on the way back.
    let target = vehicle.target.filter(|_| mode.is("RTL"));
    let goal = target
        .and_then(|target| target.at_point)
        .or_else(|| vehicle.home.map(|home| home.at_point));
    let height_m = target.and_then(|target| target.altitude_m);
    goal.is_some_and(|goal| is_near(vehicle, global.at_point.distance_m(goal)))
        && (vehicle.class() != VehicleClass::Plane || circles_at(vehicle, height_m))
}

/// Whether a plane is in the air and, if the height at which it is to circle is known, near it.
fn circles_at(vehicle: &Vehicle, height_m: Option<f64>) -> bool {
    let off_m = vehicle.altitude_m().zip(height_m);
    vehicle.airborne()
        && off_m.is_none_or(|(is_m, goal_m)| (is_m - goal_m).abs() <= CIRCLING_HEIGHT_M)
}

fn is_near(vehicle: &Vehicle, horizontal_m: f64) -> bool {
    let is_still = || {
        let speed_m_s = vehicle.ground_speed_m_s();
        speed_m_s.is_some_and(|speed_m_s| f64::from(speed_m_s) < STILL_M_S)
    };
    let passes = horizontal_m <= ARRIVED_M;
    match vehicle.class() {
        VehicleClass::Rover => passes || horizontal_m <= stopped_m(vehicle) && is_still(),
        VehicleClass::Plane => horizontal_m <= circling_m(vehicle),
        VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => {
            passes
        }
    }
}

/// The distance to a place in metres, horizontally and vertically; `None` while the vehicle's
/// position is unknown.
pub(super) fn separation(vehicle: &Vehicle, place: TravelEnd) -> Option<(f64, f64)> {
    match place {
        TravelEnd::Global { point, altitude_m } => {
            let global = vehicle.global?;
            Some((
                global.at_point.distance_m(point),
                (global.altitude_m - altitude_m).abs(),
            ))
        }
        TravelEnd::Local { ned_m } => {
            let here = vehicle.local?.ned_m.map(f64::from);
            let [north, east, down] = [0, 1, 2].map(|axis| here[axis] - ned_m[axis]);
            Some((maths::hypot(north, east), down.abs()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::tests::flying;

    #[test]
    fn the_distance_follows_the_parameters_that_were_read() {
        let mut vehicle = flying("GUIDED");
        let mut of = |class: VehicleClass, name: &str, value: f32| {
            if let Some(heartbeat) = &mut vehicle.heartbeat {
                heartbeat.class = class;
            }
            let before = arrival_m(&vehicle);
            vehicle.arrival.note(name, value);
            (before, arrival_m(&vehicle))
        };
        assert_eq!(of(VehicleClass::Rover, "WP_RADIUS", 5.0), (4.0, 10.0));
        assert_eq!(of(VehicleClass::Rover, "WP_RADIUS", 0.1), (10.0, 1.5));
        assert_eq!(
            of(VehicleClass::Plane, "WP_LOITER_RAD", -150.0),
            (100.0, 190.0)
        );
        assert_eq!(
            of(VehicleClass::Plane, "WP_LOITER_RAD", f32::NAN),
            (190.0, 190.0)
        );
        assert_eq!(of(VehicleClass::Copter, "WP_RADIUS", 9.0), (1.5, 1.5));
    }
}
