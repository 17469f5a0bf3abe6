//! `EXTENDED_SYS_STATE`: on the ground or in the air.

use mavlink::dialects::ardupilotmega::{EXTENDED_SYS_STATE_DATA, MavLandedState};

use crate::vehicle::{LandedState, Vehicle};

/// Applies the landed state to the vehicle model.
pub(super) fn apply(vehicle: &mut Vehicle, data: &EXTENDED_SYS_STATE_DATA) {
    vehicle.landed = match data.landed_state {
        MavLandedState::MAV_LANDED_STATE_UNDEFINED => LandedState::Undefined,
        MavLandedState::MAV_LANDED_STATE_ON_GROUND => LandedState::OnGround,
        MavLandedState::MAV_LANDED_STATE_IN_AIR => LandedState::InAir,
        MavLandedState::MAV_LANDED_STATE_TAKEOFF => LandedState::Takeoff,
        MavLandedState::MAV_LANDED_STATE_LANDING => LandedState::Landing,
    };
}
