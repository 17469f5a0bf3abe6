//! The numbers of flight modes.

use crate::text;
use crate::text::Text;
use crate::vehicle::{Heartbeat, Mode, Vehicle, VehicleClass};

/// The mode in which the vehicle holds its position; `None` if it pauses in its current mode
/// instead.
pub(super) fn holding_mode(vehicle: &Vehicle) -> Option<&'static str> {
    let mode = vehicle.mode()?;
    match mode.class {
        VehicleClass::Copter if mode.is("GUIDED") || mode.is("AUTO") => None,
        VehicleClass::Copter => Some("BRAKE"),
        VehicleClass::Plane => Some("LOITER"),
        VehicleClass::Rover => Some("HOLD"),
        VehicleClass::Sub => Some("POSHOLD"),
        VehicleClass::Other => None,
    }
}

/// The number of a mode; a plain number is used as it is.
///
/// # Errors
/// The vehicle has not been heard, it has no such mode, or the names of its autopilot's modes are
/// unknown.
pub(super) fn mode_number(vehicle: &Vehicle, name: &str) -> Result<u32, Text> {
    if let Ok(number) = name.parse::<u8>() {
        return Ok(u32::from(number));
    }
    let Some(heartbeat) = vehicle.heartbeat else {
        return Err(text!("refused-not-heard"));
    };
    let mode = heartbeat.mode.class.mode(name);
    mode.map(|mode| mode.number).ok_or_else(|| {
        if heartbeat.is_ardupilot() {
            text!("refused-no-mode", mode = name)
        } else {
            text!("refused-mode-autopilot")
        }
    })
}

/// A mode by name, or by a plain number; `None` if this vehicle has no such mode, or reports its
/// modes with other numbers than those that set them, as autopilots other than `ArduPilot` do.
pub(super) fn mode_named(vehicle: &Vehicle, name: &str) -> Option<Mode> {
    let heartbeat = vehicle.heartbeat.filter(Heartbeat::is_ardupilot)?;
    let class = heartbeat.mode.class;
    let number = mode_number(vehicle, name).ok()?;
    Some(Mode { class, number })
}
