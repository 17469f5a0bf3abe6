//! The rules by which a vehicle's plans are checked, from its reports and parameters.

use super::{FenceSwitch, VehicleClass};
use crate::plan::check::{CheckOptions, VehicleKind};

/// Bits of `FENCE_TYPE`: a maximum altitude, and a circle around home.
const CEILING: u32 = 1;
const CIRCLE: u32 = 2;

/// The rules of a vehicle: its class, whether it reports that its fence is on, and its parameters as far as they are
/// known. Terrain data count as present unless a parameter says otherwise.
pub fn check_rules(
    class: VehicleClass,
    reported_fence: Option<bool>,
    parameter: impl Fn(&str) -> Option<f32>,
) -> CheckOptions {
    let is_on = FenceSwitch::of(reported_fence, &parameter).is_on == Some(true);
    let kinds = parameter("FENCE_TYPE").map_or(0, |value| value as u32);
    let limit = |bit, name| {
        let has_it = is_on && kinds & bit != 0;
        has_it.then(|| parameter(name)).flatten()
    };
    CheckOptions {
        vehicle: match class {
            VehicleClass::Copter => Some(VehicleKind::Copter),
            VehicleClass::Plane => Some(VehicleKind::Plane),
            VehicleClass::Rover => Some(VehicleKind::Rover),
            VehicleClass::Sub | VehicleClass::Px4 | VehicleClass::Other => None,
        },
        ceiling_m: limit(CEILING, "FENCE_ALT_MAX"),
        radius_m: limit(CIRCLE, "FENCE_RADIUS"),
        // A vehicle may start on a hill: the ground around it is not known here.
        may_slope: true,
        has_terrain: parameter("TERRAIN_ENABLE").is_none_or(|value| value > 0.0),
    }
}
