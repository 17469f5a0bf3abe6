//! Parameter files: saving, and reading for a comparison.

use super::{Comparison, Other};
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect, FileKind};
use crate::app::room::Room;
use crate::parameters::{self, ParameterList};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// Saves the list of the vehicle under the cursor.
///
/// # Errors
/// The name is empty, or the list is unknown or incomplete.
pub fn save(state: &State, path: &str) -> Result<Effects, Text> {
    let path = named(path)?;
    let vehicle = state.session.choice.cursor;
    let known = vehicle.and_then(|id| state.rooms.parameters.lists.get(&id));
    let (Some(vehicle), Some(known)) = (vehicle, known) else {
        return Err(text!("parameters-nothing-to-save"));
    };
    let list = &known.list;
    if list.is_empty() {
        return Err(text!("parameters-nothing-to-save"));
    }
    if !list.is_complete() {
        return Err(incomplete(vehicle, list));
    }
    let comment = format!("vehicle {vehicle}, {} parameters", list.len());
    let values = list.iter().map(|(name, parameter)| (name, parameter.value));
    Ok(Effects::from(Effect::File(FileEffect::Write {
        kind: FileKind::Parameters,
        path,
        text: parameters::write(&comment, values),
        replace: false,
    })))
}

/// Compares a file, or another vehicle by its number, with the vehicle under the cursor.
///
/// # Errors
/// The name is empty, or the vehicle is unknown or is the one under the cursor.
pub fn load(state: &mut State, entered: &str) -> Result<Effects, Text> {
    let path = named(entered)?;
    let Ok(other) = path.parse::<VehicleId>() else {
        return Ok(Effects::from(Effect::File(FileEffect::Read {
            kind: FileKind::Parameters,
            path,
        })));
    };
    if !state.session.vehicles.contains_key(&other) {
        return Err(text!("parameters-no-such-vehicle", vehicle = other));
    }
    if state.session.choice.cursor == Some(other) {
        return Err(text!("parameters-same-vehicle", vehicle = other));
    }
    compare(state, Other::Vehicle(other));
    Ok(Effects::none())
}

/// Compares the vehicle's parameters with a file that has been read, or shows the file's first fault.
pub fn read(state: &mut State, path: String, content: &str) {
    match parameters::parse(content) {
        Ok(values) => compare(state, Other::File { path, values }),
        Err(faults) => {
            let Some(first) = faults.first() else {
                return;
            };
            let (line, column) = first.line_column(content);
            let text = text!(
                "parameters-file-faulty",
                path = path,
                line = line,
                column = column,
                fault = &first.message,
                count = faults.len()
            );
            state.say(Severity::Error, text);
        }
    }
}

/// The notice that a list is incomplete.
pub(super) fn incomplete(vehicle: VehicleId, list: &ParameterList) -> Text {
    text!(
        "parameters-not-complete",
        vehicle = vehicle,
        received = list.received(),
        count = list.count().unwrap_or(0)
    )
}

fn compare(state: &mut State, with: Other) {
    let room = &mut state.rooms.parameters;
    room.comparison = Some(Comparison::new(with));
    // An earlier filter would hide the differences, and leave them out of their number.
    room.filter.clear();
    state.room = Room::Parameters;
}

fn named(entered: &str) -> Result<String, Text> {
    let path = entered.trim();
    if path.is_empty() {
        return Err(text!("parameters-no-path"));
    }
    Ok(path.to_owned())
}
