//! The precedence of commands.

use super::VehicleCommand;
use crate::commands::{Command, FlightCommand};
use crate::vehicle::Vehicle;
use crate::verb::Precedence;

/// Whether the order takes precedence over everything: the operator wants the vehicle to stop, land or return now.
pub(super) fn is_urgent(order: &VehicleCommand, vehicle: &Vehicle) -> bool {
    match order.verb.precedence {
        Precedence::InTurn | Precedence::Awaited => false,
        Precedence::Urgent => true,
        Precedence::ByMode => {
            let Command::Flight(FlightCommand::SetMode { name }) = &order.command else {
                return false;
            };
            let current = vehicle.mode();
            let mode = current.and_then(|current| current.class.mode(name));
            mode.is_some_and(|mode| mode.comes_down() || mode.stops())
        }
    }
}

/// Whether later commands wait for its effect. For example, a takeoff checked before the heartbeat shows the vehicle as
/// armed would be refused, although the vehicle is about to arm.
pub(super) fn later_ones_depend_on_it(order: &VehicleCommand) -> bool {
    match order.verb.precedence {
        Precedence::Awaited | Precedence::ByMode => true,
        Precedence::InTurn | Precedence::Urgent => false,
    }
}
