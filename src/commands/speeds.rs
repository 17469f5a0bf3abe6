//! Speed limits, and when they must be sent again.
//!
//! ArduCopter resets them to its parameters whenever GUIDED begins a different kind of control: a speed that was set
//! before or during a takeoff is lost with the first `goto` (`ModeGuided::pva_control_start`). Each place to fly to is
//! therefore followed by the commanded speeds.

use mavlink::dialects::ardupilotmega::{MavCmd, SpeedType};

use super::encode::{self, LongFields};
use crate::text;
use crate::text::Text;
use crate::vehicle::{SpeedAxis, Vehicle, VehicleClass};
use crate::wire::Outgoing;

/// The command that changes a speed limit.
pub const CHANGE_SPEED: u16 = MavCmd::MAV_CMD_DO_CHANGE_SPEED as u16;

/// Refuses the vertical speeds of vehicles that have none: a rover would drive at that speed.
pub(super) fn check(axis: SpeedAxis, vehicle: &Vehicle) -> Result<(), Text> {
    match axis {
        SpeedAxis::Climb | SpeedAxis::Descend if vehicle.is_on_surface() => {
            let kind = vehicle.kind_name();
            Err(text!("refused-surface-vertical", kind = kind))
        }
        SpeedAxis::Climb | SpeedAxis::Descend if is_arduplane(vehicle) => {
            Err(text!("refused-plane-vertical-speed"))
        }
        SpeedAxis::Ground | SpeedAxis::Climb | SpeedAxis::Descend => Ok(()),
    }
}

fn is_arduplane(vehicle: &Vehicle) -> bool {
    let mode = vehicle.mode();
    mode.is_some_and(|mode| mode.class == VehicleClass::Plane)
}

/// Whether the vehicle is a plane that reports no airspeed sensor. An `ArduPlane` accepts a speed all the same, and flies by
/// its throttle (`TRIM_THROTTLE`).
pub(super) fn is_unmeasured(vehicle: &Vehicle) -> bool {
    let health = vehicle.health;
    is_arduplane(vehicle) && health.is_some_and(|health| !health.measures_airspeed())
}

pub(super) fn fields(vehicle: &Vehicle, axis: SpeedAxis, speed_m_s: f64) -> LongFields {
    // -1 leaves the throttle unchanged.
    let changed = [speed_type(vehicle, axis), speed_m_s as f32, -1.0];
    LongFields::new(MavCmd::MAV_CMD_DO_CHANGE_SPEED, &changed)
}

/// The messages that repeat the commanded speeds, one for each.
///
/// # Errors
/// The vehicle cannot be addressed.
pub fn asked_again(vehicle: &Vehicle) -> Result<Vec<Outgoing>, Text> {
    let asked = vehicle.asked_speeds.all();
    asked
        .map(|(axis, speed_m_s)| encode::long(vehicle, &fields(vehicle, axis, speed_m_s), 0))
        .collect()
}

/// The `SPEED_TYPE` of MAVLink. `ArduPlane` takes a speed over ground only as the least one, for flights against the wind.
fn speed_type(vehicle: &Vehicle, axis: SpeedAxis) -> f32 {
    let kind = match axis {
        SpeedAxis::Ground if is_arduplane(vehicle) => SpeedType::SPEED_TYPE_AIRSPEED,
        SpeedAxis::Ground => SpeedType::SPEED_TYPE_GROUNDSPEED,
        SpeedAxis::Climb => SpeedType::SPEED_TYPE_CLIMB_SPEED,
        SpeedAxis::Descend => SpeedType::SPEED_TYPE_DESCENT_SPEED,
    };
    f32::from(kind as u8)
}
