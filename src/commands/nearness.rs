//! How near to a place counts as there, by the kind of vehicle.

use super::setpoint::TravelEnd;
use crate::geo::maths;
use crate::vehicle::{Vehicle, VehicleClass};

/// The horizontal distance from a place within which it counts as reached.
const ARRIVED_M: f64 = 1.5;
/// The vertical distance from a place within which it counts as reached.
const ARRIVED_HEIGHT_M: f64 = 1.0;
/// The distance from a place within which a rover or boat that stands still counts as there: they stop within
/// `WP_RADIUS` (2 m by default), and boats stay within `LOIT_RADIUS` (2 m).
pub const STOPPED_M: f64 = 4.0;
/// The distance from a place within which a plane counts as there: it circles around it, with a radius of 60 m by default
/// (`WP_LOITER_RAD`).
const CIRCLING_M: f64 = 100.0;
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
        VehicleClass::Rover => STOPPED_M,
        VehicleClass::Plane => CIRCLING_M,
        VehicleClass::Copter | VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => {
            ARRIVED_M
        }
    }
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
    goal.is_some_and(|goal| is_near(vehicle, global.at_point.distance_m(goal)))
}

fn is_near(vehicle: &Vehicle, horizontal_m: f64) -> bool {
    let is_still = || {
        let speed_m_s = vehicle.ground_speed_m_s();
        speed_m_s.is_some_and(|speed_m_s| f64::from(speed_m_s) < STILL_M_S)
    };
    let passes = horizontal_m <= ARRIVED_M;
    match vehicle.class() {
        VehicleClass::Rover => passes || horizontal_m <= STOPPED_M && is_still(),
        VehicleClass::Plane => horizontal_m <= CIRCLING_M,
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
