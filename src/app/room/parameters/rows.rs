//! The parameters shown, ordered by name.

use std::collections::BTreeMap;

use super::{Comparison, Other};
use crate::app::State;
use crate::app::keymap::latin_line;
use crate::parameters::{
    Fetching, ListedParameter, ParameterDifference, ParameterFinding, differences,
};
use crate::vehicle::VehicleId;

/// One line of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<'a> {
    pub name: &'a str,
    /// The shown vehicle's parameter; `None` if the vehicle lacks it.
    pub now: Option<ListedParameter>,
    /// The difference in the comparison.
    pub finding: Option<ParameterFinding>,
}

impl Row<'_> {
    /// The value on the other side of a comparison; `None` without a comparison, or if the other
    /// side lacks it.
    pub fn other(&self) -> Option<f64> {
        match self.finding {
            Some(ParameterFinding::Changed(_, other) | ParameterFinding::Missing(other)) => {
                Some(other)
            }
            Some(ParameterFinding::Extra(_)) | None => None,
        }
    }
}

/// The lines of the list with its filters; a filter by name that finds nothing is read as typed in another keyboard
/// layout. With a comparison, only differences and parameters that were set from it.
pub fn rows(state: &State) -> Vec<Row<'_>> {
    let Some(vehicle) = state.session.choice.cursor else {
        return Vec::new();
    };
    let room = &state.rooms.parameters;
    let all: Vec<Row<'_>> = match &room.comparison {
        None => plain(state, vehicle)
            .filter(|row| !room.changed_only || is_changed(state, vehicle, row))
            .filter(|row| {
                !room.other_than_default || room.other_default(vehicle, row.name).is_some()
            })
            .collect(),
        Some(comparison) => compared(state, vehicle, comparison),
    };
    let found = named(&all, &room.filter);
    match latin_line(&room.filter) {
        Some(read) if found.is_empty() => named(&all, &read),
        _ => found,
    }
}

/// The rows whose names contain every word of the filter.
fn named<'a>(all: &[Row<'a>], filter: &str) -> Vec<Row<'a>> {
    let words: Vec<String> = filter.split_whitespace().map(str::to_uppercase).collect();
    let fits = |row: &&Row<'a>| {
        let name = || row.name.to_uppercase();
        words.iter().all(|word| name().contains(word.as_str()))
    };
    all.iter().filter(fits).cloned().collect()
}

fn plain(state: &State, vehicle: VehicleId) -> impl Iterator<Item = Row<'_>> {
    let snapshot = state.rooms.parameters.lists.get(&vehicle);
    let all = snapshot.into_iter().flat_map(|known| known.list.iter());
    all.map(|(name, parameter)| Row {
        name,
        now: Some(*parameter),
        finding: None,
    })
}

fn compared<'a>(state: &'a State, vehicle: VehicleId, comparison: &'a Comparison) -> Vec<Row<'a>> {
    let mut found = difference(state, vehicle, &comparison.with);
    found.retain(|(_, finding)| {
        comparison.lists_extra || !matches!(finding, ParameterFinding::Extra(_))
    });
    let set = comparison.set.iter().map(|name| (name.as_str(), None));
    let mut all: BTreeMap<&str, Option<ParameterFinding>> = set.collect();
    all.extend(
        found
            .into_iter()
            .map(|(name, finding)| (name, Some(finding))),
    );
    let rows = all.into_iter().map(|(name, finding)| Row {
        name,
        now: state.rooms.parameters.get(vehicle, name).copied(),
        finding,
    });
    rows.collect()
}

/// The number of parameters that the shown vehicle has and the other side lacks.
pub fn extra(state: &State, comparison: &Comparison) -> usize {
    let vehicle = state.session.choice.cursor;
    let compared = vehicle.map(|vehicle| difference(state, vehicle, &comparison.with));
    let found = compared.unwrap_or_default();
    let is_extra =
        |(_, finding): &&(&str, ParameterFinding)| matches!(finding, ParameterFinding::Extra(_));
    found.iter().filter(is_extra).count()
}

/// The differences between a vehicle and the other side; while a list may still arrive, without the
/// parameters that one side lacks.
fn difference<'a>(
    state: &'a State,
    vehicle: VehicleId,
    with: &'a Other,
) -> Vec<(&'a str, ParameterFinding)> {
    let lists = &state.rooms.parameters.lists;
    let of = |id: VehicleId| {
        let known = lists.get(&id).into_iter();
        known
            .flat_map(|known| known.list.iter())
            .map(|(name, parameter)| (name, parameter.value))
    };
    let found: Vec<ParameterDifference<'a>> = match with {
        Other::Vehicle(other) => differences(of(vehicle), of(*other)),
        Other::File { values, .. } => {
            let values = values.iter().map(|(name, value)| (name.as_str(), *value));
            differences(of(vehicle), values)
        }
    };
    let is_coming = coming(state, vehicle, with).is_some();
    // A parameter that one side lacks may still arrive.
    let is_sure = |finding| !is_coming || matches!(finding, ParameterFinding::Changed(..));
    let pair = |difference: ParameterDifference<'a>| (difference.name, difference.finding);
    let pairs = found.into_iter().map(pair);
    pairs.filter(|(_, finding)| is_sure(*finding)).collect()
}

/// The first vehicle of a comparison whose list is incomplete and may still arrive, if any.
pub fn coming(state: &State, vehicle: VehicleId, with: &Other) -> Option<VehicleId> {
    let other = match with {
        Other::Vehicle(other) => Some(*other),
        Other::File { .. } => None,
    };
    let is_expected = |id: &VehicleId| {
        let known = state.rooms.parameters.lists.get(id);
        known.is_none_or(|known| known.fetching != Fetching::Stalled && !known.list.is_complete())
    };
    std::iter::once(vehicle).chain(other).find(is_expected)
}

fn is_changed(state: &State, vehicle: VehicleId, row: &Row<'_>) -> bool {
    let was_set = state.rooms.parameters.edit(vehicle, row.name).is_some();
    was_set || row.now.is_some_and(|now| now.is_changed())
}
