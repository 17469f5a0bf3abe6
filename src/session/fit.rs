//! Checks of a command against the kind and the parameters of the vehicle, before it is sent.

use super::VehicleCommand;
use super::parameter_code::is_bytewise;
use crate::commands::{Command, ParameterCommand, suits};
use crate::diagnostic::nearest;
use crate::messages::parameter_encoding;
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// The parameter that makes a plane hover.
const HOVERS: &str = "Q_ENABLE";

/// Checks an order against the kind of the vehicle, and against its parameters.
///
/// # Errors
/// Why the vehicle cannot carry it out.
pub(super) fn check(
    order: &VehicleCommand,
    list: &ParameterList,
    vehicle: &Vehicle,
) -> Result<(), Text> {
    let hovers = list.get(HOVERS).is_some_and(|it| it.value > 0.0);
    suits(order.verb, vehicle, hovers)?;
    check_value(&order.command, list, vehicle)
}

/// Checks a command against the vehicle's list or the parameter's type, as far as known. `ArduPilot` itself ignores
/// unknown names, and truncates values silently. A vehicle that takes the bytes of integers must have sent the
/// parameter before, since the type decides the bytes.
///
/// # Errors
/// Why the value cannot be set.
fn check_value(command: &Command, list: &ParameterList, vehicle: &Vehicle) -> Result<(), Text> {
    let Command::Parameter(ParameterCommand::Set { name, value }) = command else {
        return Ok(());
    };
    let Some(known) = list.get(name) else {
        return if is_known(list) {
            Err(lacking(name, list))
        } else if is_bytewise(vehicle) {
            Err(text!("refused-parameter-type", name = name))
        } else {
            Ok(())
        };
    };
    let checked = known.kind.check(*value, parameter_encoding(vehicle));
    checked.map(drop).map_err(|unfit| unfit.text(name))
}

/// Whether a parameter that is not in the list is really missing.
pub(super) fn is_known(list: &ParameterList) -> bool {
    // If the number of parameters has changed, new ones may have appeared.
    list.is_complete() && !list.is_outdated()
}

/// The notice that a vehicle lacks a parameter, with the most similar name.
fn lacking(name: &str, list: &ParameterList) -> Text {
    let known = list.iter().map(|(name, _)| name);
    match nearest(name, known) {
        Some(nearest) => text!("refused-no-parameter-but", name = name, nearest = nearest),
        None => text!("refused-no-parameter", name = name),
    }
}
