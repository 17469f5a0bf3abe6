//! The numbers of flight modes.

use crate::text;
use crate::text::Text;
use crate::vehicle::{Heartbeat, Mode, Vehicle, VehicleClass, is_same_name};

/// The mode in which PX4 takes setpoints.
pub(super) const OFFBOARD: &str = "OFFBOARD";
/// The mode in which PX4 holds its position.
pub(super) const AUTO_LOITER: &str = "AUTO.LOITER";

/// The mode in which the vehicle holds its position; `None` if it pauses in its current mode
/// instead.
pub(super) fn holding_mode(vehicle: &Vehicle) -> Option<&'static str> {
    let mode = vehicle.mode()?;
    match mode.class {
        // Before its takeoff has left the ground, a copter accepts a pause, but takes off nevertheless.
        VehicleClass::Copter if mode.is("GUIDED") && vehicle.armed() && !vehicle.airborne() => {
            Some("BRAKE")
        }
        VehicleClass::Copter if mode.is("GUIDED") || mode.is("AUTO") => None,
        VehicleClass::Copter => Some("BRAKE"),
        VehicleClass::Plane => Some("LOITER"),
        // A boat in HOLD drifts.
        VehicleClass::Rover if vehicle.is_boat() => Some("LOITER"),
        VehicleClass::Rover => Some("HOLD"),
        VehicleClass::Sub => Some("POSHOLD"),
        VehicleClass::Px4 => Some(AUTO_LOITER),
        VehicleClass::Other => None,
    }
}

/// The number of a mode; a plain number is used as it is.
///
/// # Errors
/// The vehicle has not been heard, lacks the mode or does not let the user select it, or the names
/// of its autopilot's modes are unknown.
pub(super) fn mode_number(vehicle: &Vehicle, name: &str) -> Result<u32, Text> {
    if let Ok(number) = name.parse::<u8>() {
        // A plain number is PX4's main mode.
        let place = if vehicle.runs_px4() { 16 } else { 0 };
        return Ok(u32::from(number) << place);
    }
    let Some(heartbeat) = vehicle.heartbeat else {
        return Err(text!("refused-not-heard"));
    };
    if let Some(announced) = vehicle.modes.named(name) {
        return if announced.is_selectable {
            Ok(announced.number)
        } else {
            Err(text!("refused-mode-hidden", mode = &announced.name))
        };
    }
    let mode = heartbeat.mode.class.mode(name);
    let number = mode.map(|mode| mode.number);
    // A vehicle that has announced all of its modes has no other ones.
    let is_offered = |&number: &u32| {
        let modes = &vehicle.modes;
        !modes.is_complete() || modes.numbered(number).is_some_and(|it| it.is_selectable)
    };
    number.filter(is_offered).ok_or_else(|| {
        if vehicle.runs_px4() && is_same_name(name, "GUIDED") {
            text!("refused-px4-guided")
        } else if heartbeat.mode.class != VehicleClass::Other || vehicle.modes.is_complete() {
            text!("refused-no-mode", mode = name)
        } else {
            text!("refused-mode-autopilot")
        }
    })
}

/// A mode by name, or by a plain number; `None` if this vehicle has no such mode, or reports its
/// modes with other numbers than those that set them, as autopilots other than `ArduPilot` and PX4 do.
pub(super) fn mode_named(vehicle: &Vehicle, name: &str) -> Option<Mode> {
    let has_names = |it: &Heartbeat| {
        it.mode.class != VehicleClass::Other || vehicle.modes.named(name).is_some()
    };
    let heartbeat = vehicle.heartbeat.filter(has_names)?;
    let class = heartbeat.mode.class;
    let number = mode_number(vehicle, name).ok()?;
    Some(Mode { class, number })
}
