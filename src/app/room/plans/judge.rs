//! What the vehicle would say about a draft, and how fast it would fly it.

use crate::app::State;
use crate::draft::Pace;
use crate::plan::Document;
use crate::plan::check::{CheckOptions, Finding, VehicleKind, check};
use crate::vehicle::VehicleClass;

/// `FENCE_TYPE`: a maximum altitude, a circle around home.
const CEILING: u32 = 1;
const CIRCLE: u32 = 2;

/// A parameter of the vehicle under the cursor, if it is known.
fn parameter(state: &State, name: &str) -> Option<f32> {
    let vehicle = state.session.choice.cursor?;
    let known = state.rooms.parameters.get(vehicle, name)?;
    Some(known.value)
}

/// The speeds for the times of a draft: as the user has given them, otherwise those of the vehicle under the cursor,
/// otherwise ArduPilot's defaults.
pub fn pace(state: &State) -> Pace {
    let usual = Pace::default();
    let own = |name, usual| {
        let centimetres = parameter(state, name).filter(|value| *value > 0.0);
        centimetres.map_or(usual, |value| f64::from(value) / 100.0)
    };
    let given = state.rooms.plans.speed_m_s;
    Pace {
        speed_m_s: given.unwrap_or_else(|| own("WPNAV_SPEED", usual.speed_m_s)),
        climb_m_s: own("WPNAV_SPEED_UP", usual.climb_m_s),
        descent_m_s: own("WPNAV_SPEED_DN", usual.descent_m_s),
    }
}

/// What is wrong with a document by the rules of the vehicle under the cursor.
pub fn findings(state: &State, document: &Document) -> Vec<Finding> {
    let is_on = parameter(state, "FENCE_ENABLE").is_some_and(|value| value > 0.0);
    let kinds = parameter(state, "FENCE_TYPE").map_or(0, |value| value as u32);
    let limit = |bit, name| {
        let has_it = is_on && kinds & bit != 0;
        has_it.then(|| parameter(state, name)).flatten()
    };
    let options = CheckOptions {
        vehicle: match state.class() {
            VehicleClass::Copter => Some(VehicleKind::Copter),
            VehicleClass::Plane => Some(VehicleKind::Plane),
            VehicleClass::Rover => Some(VehicleKind::Rover),
            VehicleClass::Sub | VehicleClass::Other => None,
        },
        ceiling_m: limit(CEILING, "FENCE_ALT_MAX"),
        radius_m: limit(CIRCLE, "FENCE_RADIUS"),
        has_terrain: parameter(state, "TERRAIN_ENABLE").is_some_and(|value| value > 0.0),
    };
    check(document, &options)
}
