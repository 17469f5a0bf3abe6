//! The numbers of flight modes.

use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle, VehicleClass};

/// The mode that holds the position; `None` if pausing does that.
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
pub(super) fn mode_number(vehicle: &Vehicle, name: &str) -> Result<u32, Text> {
    if let Ok(number) = name.parse::<u8>() {
        return Ok(u32::from(number));
    }
    let Some(heartbeat) = vehicle.heartbeat else {
        return Err(text!("refused-not-heard"));
    };
    heartbeat
        .class
        .mode(name)
        .map(|mode| mode.number)
        .ok_or_else(|| text!("refused-no-mode", mode = name))
}

/// A mode by name, or by a plain number; `None` if this vehicle has no such mode.
pub(super) fn mode_named(vehicle: &Vehicle, name: &str) -> Option<Mode> {
    let class = vehicle.heartbeat?.class;
    let number = mode_number(vehicle, name).ok()?;
    Some(Mode { class, number })
}
