//! A comparison of a vehicle's parameters with a file or another vehicle.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::files::incomplete;
use super::{coming, rows};
use crate::app::State;
use crate::app::state::{Consequence, ParameterSetting};
use crate::parameters::{ParameterFinding, is_the_vehicles_own};
use crate::text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

/// The other side of the comparison with the vehicle under the cursor.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    pub with: Other,
    /// Names whose mark the user has toggled.
    turned: BTreeSet<String>,
    /// Names that were set: they stay in the list even without a difference.
    pub set: BTreeSet<String>,
    /// Whether parameters that only the vehicle has are also listed; compared with a short file,
    /// these are nearly all parameters.
    pub lists_extra: bool,
}

/// The other side of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Other {
    File {
        /// The file's path as typed.
        path: String,
        values: BTreeMap<String, f64>,
    },
    Vehicle(VehicleId),
}

impl Comparison {
    /// A comparison without any choices by the user yet.
    pub fn new(with: Other) -> Self {
        Self {
            lists_extra: matches!(with, Other::Vehicle(_)),
            with,
            turned: BTreeSet::new(),
            set: BTreeSet::new(),
        }
    }

    /// Whether a value would be set. By default, values that differ and are not specific to the
    /// vehicle are marked, but not parameters that the vehicle lacks. Parameters that only the
    /// vehicle has cannot be marked.
    pub fn is_marked(&self, name: &str, finding: ParameterFinding) -> bool {
        let by_itself = match finding {
            ParameterFinding::Changed(..) => !is_the_vehicles_own(name),
            ParameterFinding::Missing(_) => false,
            ParameterFinding::Extra(_) => return false,
        };
        by_itself != self.turned.contains(name)
    }
}

/// Which marks to toggle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marks {
    /// The parameter in the row under the cursor.
    UnderCursor,
    /// The unmarked parameters, so all are marked afterwards.
    Unmarked,
    /// Every parameter that the list shows.
    All,
}

/// Toggles marks. Parameters specific to a vehicle can only be marked one by one.
pub fn turn(state: &mut State, marks: Marks) {
    let shown = rows(state);
    let Some(comparison) = &state.rooms.parameters.comparison else {
        return;
    };
    let at = super::cursor_row(state, &shown);
    let turned: Vec<String> = shown
        .iter()
        .enumerate()
        .filter(|(row, it)| {
            let Some(finding) = it.finding else {
                return false;
            };
            match marks {
                Marks::UnderCursor => *row == at,
                Marks::Unmarked => {
                    !is_the_vehicles_own(it.name) && !comparison.is_marked(it.name, finding)
                }
                Marks::All => !is_the_vehicles_own(it.name),
            }
        })
        .map(|(_, row)| row.name.to_owned())
        .collect();
    if let Some(comparison) = &mut state.rooms.parameters.comparison {
        for name in turned {
            if !comparison.turned.remove(&name) {
                comparison.turned.insert(name);
            }
        }
    }
}

/// Asks whether to set the marked values on the target vehicles.
pub fn apply(state: &mut State) {
    let Some(comparison) = &state.rooms.parameters.comparison else {
        return state.say(Severity::Notice, text!("parameters-nothing-compared"));
    };
    let vehicle = state.session.choice.cursor;
    if let Some(id) = vehicle.and_then(|id| coming(state, id, &comparison.with)) {
        let known = state.rooms.parameters.lists.get(&id);
        let list = known.map(|known| Arc::clone(&known.list));
        let text = incomplete(id, &list.unwrap_or_default());
        return state.say(Severity::Notice, text);
    }
    let mut targets = state.addressed();
    if let Other::Vehicle(other) = comparison.with {
        targets.retain(|id| *id != other);
    }
    // Only values that are marked and shown are set.
    let settings: Vec<ParameterSetting> = rows(state)
        .iter()
        .filter_map(|row| {
            let finding = row.finding?;
            let value = row.other()?;
            let is_marked = comparison.is_marked(row.name, finding);
            is_marked.then(|| ParameterSetting::new(row.name, value, targets.clone()))
        })
        .collect();
    if settings.is_empty() || targets.is_empty() {
        return state.say(Severity::Notice, text!("parameters-nothing-marked"));
    }
    let count = settings.len();
    let question = text!(
        "parameters-ask-apply",
        count = count,
        vehicles = ranges(targets)
    );
    let reason = text!("parameters-ask-apply-reason");
    state.ask(question, reason, Consequence::Parameters(settings));
}
