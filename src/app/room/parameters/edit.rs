//! New values and their results.

use std::collections::BTreeMap;

use crate::app::State;
use crate::app::room::Room;
use crate::app::state::ParameterSetting;
use crate::commands::{Act, Command, Order, ParameterCommand};
use crate::ledger::{EntryId, LedgerRow, RowState};
use crate::parameters::{ParameterEncoding, ParameterType, written};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

/// The maximum number of edits kept; beyond that, all are dropped. The ledger keeps its entries.
const EDITS_KEPT: usize = 50_000;

/// A value that a command set, or tried to set, on a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edit {
    /// The command's entry in the ledger, with its outcome.
    pub entry: EntryId,
    pub value: f64,
}

/// The line that sets a new value for a parameter of some vehicles.
///
/// # Errors
/// The text is not a number, or not one that the parameter's type can hold.
pub fn entered(
    state: &State,
    name: &str,
    vehicles: &[VehicleId],
    entered: &str,
) -> Result<String, Text> {
    let typed = entered.trim();
    let value: f64 = typed
        .parse()
        .map_err(|_| text!("parameters-no-number", value = typed))?;
    let fits = |kind: ParameterType, encoding| {
        let checked = kind.check(value, encoding);
        checked.map_err(|unfit| unfit.text(name))
    };
    fits(ParameterType::Real32, ParameterEncoding::Converted)?;
    for &vehicle in vehicles {
        if let Some(known) = state.rooms.parameters.get(vehicle, name) {
            fits(known.kind, state.rooms.parameters.encoding(vehicle))?;
        }
    }
    Ok(line(name, &value.to_string(), vehicles))
}

/// Why a value contradicts the documentation of a parameter of some vehicles; `None` if it does not.
pub fn doubt(state: &State, vehicles: &[VehicleId], name: &str, value: f64) -> Option<Text> {
    let mut vehicles = vehicles.iter();
    vehicles.find_map(|&vehicle| {
        let document = state.documents_of(Some(vehicle)).get(name)?;
        Some(document.doubt(value)?.text(name, value))
    })
}

/// Why the value that an order sets contradicts the documentation of its parameter.
pub fn order_doubt(state: &State, order: &Order) -> Option<Text> {
    match &order.act {
        Act::Command(Command::Parameter(ParameterCommand::Set { name, value })) => {
            doubt(state, &order.targets, name, *value)
        }
        Act::Command(_)
        | Act::Deed(_)
        | Act::Manoeuvre(_)
        | Act::Plans(_)
        | Act::Rehearse { .. } => None,
    }
}

/// The line that sets a value on some vehicles.
pub fn setting_line(setting: &ParameterSetting) -> String {
    line(&setting.name, &written(setting.value), &setting.vehicles)
}

fn line(name: &str, value: &str, vehicles: &[VehicleId]) -> String {
    let targets = ranges(vehicles.iter().copied());
    format!("{targets} param set {name} {value}")
}

/// Records a parameter command for [`tell`], and its value for the list.
pub fn note_order(state: &mut State, order: &Order, entry: EntryId) {
    let Act::Command(Command::Parameter(command)) = &order.act else {
        return;
    };
    state.rooms.parameters.under_way.insert(entry);
    let ParameterCommand::Set { name, value } = command else {
        return;
    };
    let edits = &mut state.rooms.parameters.edits;
    let kept: usize = edits.values().map(BTreeMap::len).sum();
    if kept + order.targets.len() > EDITS_KEPT {
        edits.clear();
    }
    let edit = Edit {
        entry,
        value: *value,
    };
    for &vehicle in &order.targets {
        let known = edits.entry(vehicle).or_default();
        known.insert(name.clone(), edit);
    }
}

/// Reports the outcome of a parameter command on the last line of the room once every vehicle has answered: the first
/// failure, if any. For a batch, only the end is reported.
pub fn tell(state: &mut State, entry: EntryId) {
    let batch = state.rooms.parameters.batch.as_ref();
    let is_of_batch = batch.is_some_and(|batch| batch.has(entry));
    let known = state.session.commands.ledger.entry(entry);
    let Some(known) = known.filter(|known| known.is_final()) else {
        return;
    };
    if !state.rooms.parameters.under_way.remove(&entry) {
        return;
    }
    let failed = known.rows.iter().find(|row| row.state.is_failure());
    let Some(row) = failed.or(known.rows.first()) else {
        return;
    };
    if state.room != Room::Parameters || is_of_batch {
        return;
    }
    let severity = if row.state == RowState::Done {
        Severity::Info
    } else {
        Severity::Warning
    };
    let text = fate(row, &known.rows);
    state.say(severity, text);
}

/// The outcome of a command for one vehicle and all others with the same outcome.
pub fn fate(row: &LedgerRow, all: &[LedgerRow]) -> Text {
    let why = |row: &LedgerRow| row.explanation.as_ref().map(|text| text.regarding(""));
    let fared_so = |other: &&LedgerRow| other.state == row.state && why(other) == why(row);
    let those = all.iter().filter(fared_so);
    let alike: Vec<VehicleId> = those.map(|row| row.vehicle).collect();
    let (count, vehicles) = (alike.len(), ranges(alike));
    let why = row.explanation.as_ref().map(|it| it.regarding(&vehicles));
    let text = match (row.state, why) {
        (RowState::Done, Some(outcome)) => outcome,
        (how, why) => Text::joined(", ", std::iter::once(how.name()).chain(why).collect()),
    };
    text!(
        "state-explained",
        count = count,
        vehicles = vehicles,
        text = text
    )
}
