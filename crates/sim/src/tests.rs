//! The simulator as a ground station sees it.

mod airframes;
mod answers;
mod arming;
mod batteries;
mod booting;
mod copies;
mod driven;
mod driving;
mod failsafes;
mod faults;
mod files;
mod flight;
mod following;
mod ground;
mod links;
mod messages;
mod numbers;
mod operator;
mod output_test;
mod piloted;
mod protocol;
mod retracing;
mod serials;
mod signing;
mod storms;
mod surface_estimate;
mod surface_missions;
mod sweep;
mod switches;
mod takeoff;
mod timeline;
mod traffic;
mod transfers;

use super::*;
use sortie_geo::LatLon;

pub(super) use ground::Ground;

/// A rover that has just been switched on.
pub(super) fn rover() -> autopilot::Autopilot {
    let airframe = Airframe::shared_default();
    let kind = VehicleKind::Rover(Chassis::Ackermann);
    autopilot::Autopilot::new(kind, 1, start(), airframe, wind::Wind::new(0, 0))
}

/// The field at Canberra where the real vehicle was measured.
pub(super) fn start() -> Start {
    Start {
        at: LatLon::new(-35.363_262, 149.165_237),
        altitude_amsl_m: 584.0,
        heading_deg: 0.0,
    }
}
