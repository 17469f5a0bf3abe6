//! Which commands give way to which.

use crate::commands::Command;
use crate::vehicle::Vehicle;

/// Modes in which a vehicle stops, lands or comes home, under the names of every class.
const URGENT_MODES: [&str; 8] = [
    "LAND",
    "RTL",
    "SMART_RTL",
    "AUTO_RTL",
    "BRAKE",
    "QLAND",
    "QRTL",
    "HOLD",
];

/// Whether everything that waits or flies must give way: the operator wants it to stop, land or come home now.
pub(super) fn is_urgent(command: &Command, vehicle: &Vehicle) -> bool {
    match command {
        Command::Kill
        | Command::Disarm
        | Command::Land
        | Command::ReturnToLaunch
        | Command::Hold => true,
        Command::SetMode { name } => {
            let class = vehicle.heartbeat.map(|heartbeat| heartbeat.class);
            let mode = class.and_then(|class| class.mode(name));
            mode.is_some_and(|mode| URGENT_MODES.iter().any(|urgent| mode.is(urgent)))
        }
        _ => false,
    }
}

/// Whether the command decides where the vehicle flies, so that a newer one of the kind replaces it.
pub fn moves_the_vehicle(command: &Command) -> bool {
    matches!(
        command,
        Command::SetMode { .. }
            | Command::Takeoff { .. }
            | Command::Land
            | Command::ReturnToLaunch
            | Command::Hold
            | Command::Resume
            | Command::Goto { .. }
            | Command::Altitude { .. }
            | Command::Velocity { .. }
            | Command::Orbit { .. }
            | Command::Disarm
            | Command::Kill
    )
}

/// Whether a newer movement takes the place of what was awaited of the command. A turn is no movement and ends
/// none, but every movement turns the nose its own way.
pub(super) fn gives_way_to_movement(command: &Command) -> bool {
    moves_the_vehicle(command) || matches!(command, Command::Yaw { .. })
}

/// Whether later commands are judged by its effect, so that they wait for it to show: a takeoff that is
/// looked at before the heartbeat says "armed" would be refused for nothing.
pub(super) fn later_ones_depend_on_it(command: &Command) -> bool {
    matches!(command, Command::Arm | Command::SetMode { .. })
}
