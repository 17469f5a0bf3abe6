//! The simulator as a ground station sees it.

mod airframes;
mod flight;
mod ground;
mod links;
mod messages;
mod piloted;
mod protocol;
mod serials;
mod signing;
mod sweep;

use super::*;

pub(super) use ground::Ground;

/// The field at Canberra where the real vehicle was measured.
pub(super) fn start() -> Start {
    Start {
        at: LatLon::new(-35.363_262, 149.165_237),
        altitude_amsl_m: 584.0,
        heading_deg: 0.0,
    }
}
