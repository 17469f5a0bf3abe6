//! The vehicles' parameters: list, search, edit, files, differences.
//!
//! The list is that of the vehicle under the cursor; a value that is set goes where every command goes, to the
//! selection if there is one.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::fly;
use crate::app::room::{Room, RoomModel, RoomRequest};
use crate::app::state::Purpose;
use crate::ledger::EntryId;
use crate::parameters::{ListedParameter, ParameterSnapshot, shown};
use crate::text;
use crate::vehicle::{Severity, VehicleId};

mod batch;
mod compare;
mod demand;
mod edit;
mod files;
mod rows;

pub use batch::Batch;
pub use compare::{Comparison, Other};
pub use demand::wanted;
pub use edit::{Edit, entered, note_order, setting_line, tell};
pub use files::{load, read, save};
pub use rows::{Row, coming, extra, rows};

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Parameters {
    /// What is known of each vehicle's parameters.
    pub(in crate::app) lists: BTreeMap<VehicleId, ParameterSnapshot>,
    /// The name under the cursor; where it is not shown, the next one is.
    pub(in crate::app) cursor: String,
    /// Only names with these letters are shown.
    pub(in crate::app) filter: String,
    /// Only what has changed, or was to be changed, is shown.
    pub(in crate::app) changed_only: bool,
    /// What the list is compared with.
    pub(in crate::app) comparison: Option<Comparison>,
    /// The newest value that was asked of each vehicle for each parameter.
    pub(in crate::app) edits: BTreeMap<VehicleId, BTreeMap<String, Edit>>,
    /// The ledger's entries of commands about parameters that have not ended.
    under_way: BTreeSet<EntryId>,
    /// Values that are being set one after the other.
    pub(in crate::app) batch: Option<Batch>,
    /// Vehicles whose lists are to come anew.
    anew: BTreeSet<VehicleId>,
    /// Vehicles that were asked and have not begun yet, with the time.
    asked: BTreeMap<VehicleId, Duration>,
}

impl Parameters {
    /// What is known of each vehicle's parameters.
    pub fn lists(&self) -> &BTreeMap<VehicleId, ParameterSnapshot> {
        &self.lists
    }

    /// The name under the cursor; where it is not shown, the next one is.
    pub fn cursor(&self) -> &str {
        &self.cursor
    }

    /// Only names with these letters are shown.
    pub fn filter_text(&self) -> &str {
        &self.filter
    }

    /// Only what has changed, or was to be changed, is shown.
    pub fn shows_changed_only(&self) -> bool {
        self.changed_only
    }

    /// What the list is compared with.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// Values that are being set one after the other.
    pub fn batch(&self) -> Option<&Batch> {
        self.batch.as_ref()
    }

    /// A parameter of a vehicle, if it is known.
    pub fn get(&self, vehicle: VehicleId, name: &str) -> Option<&ListedParameter> {
        self.lists.get(&vehicle)?.list.get(name)
    }

    /// The entry of the ledger that last set a parameter of a vehicle, and what it asked for.
    pub fn edit(&self, vehicle: VehicleId, name: &str) -> Option<Edit> {
        self.edits.get(&vehicle)?.get(name).copied()
    }
}

const HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "parameters-hint-set"),
    hint(&[Action::Filter], "parameters-hint-search"),
    hint(&[Action::ChangedParameters], "parameters-hint-changed"),
    hint(&[Action::SaveParameters], "parameters-hint-save"),
    hint(&[Action::LoadParameters], "parameters-hint-load"),
    hint(&[Action::CompareParameters], "parameters-hint-compare"),
    hint(
        &[Action::PreviousVehicle, Action::NextVehicle],
        "parameters-hint-vehicle",
    ),
    hint(&[Action::Help], "parameters-hint-help"),
];

const COMPARISON_HINTS: &[KeyHint] = &[
    hint(&[Action::Toggle], "parameters-hint-mark"),
    hint(
        &[Action::SelectAll, Action::Invert],
        "parameters-hint-mark-all",
    ),
    hint(&[Action::ApplyParameters], "parameters-hint-apply"),
    hint(&[Action::ChangedParameters], "parameters-hint-extra"),
    hint(&[Action::Filter], "parameters-hint-search"),
    hint(&[Action::Escape], "parameters-hint-close"),
    hint(&[Action::Help], "parameters-hint-help"),
];

impl RoomModel for Parameters {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(key('/'), Action::Filter),
        does(key('o'), Action::ChangedParameters),
        does(key('s'), Action::SaveParameters),
        does(key('l'), Action::LoadParameters),
        does(key('d'), Action::CompareParameters),
        does(key(' '), Action::Toggle),
        does(key('*'), Action::SelectAll),
        does(key('!'), Action::Invert),
        does(key('a'), Action::ApplyParameters),
        does(key('r'), Action::FetchParameters),
        does(Press::Plain(KeyCode::Left), Action::PreviousVehicle),
        does(key('['), Action::PreviousVehicle),
        does(Press::Plain(KeyCode::Right), Action::NextVehicle),
        does(key(']'), Action::NextVehicle),
        does(ESCAPE, Action::Escape),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.parameters.comparison {
            Some(_) => COMPARISON_HINTS,
            None => HINTS,
        }
    }

    fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
        match action {
            Action::Move(step) => {
                let rows = rows(state);
                let at = step.apply(cursor_row(state, &rows), rows.len());
                if let Some(name) = rows.get(at).map(|row| row.name.to_owned()) {
                    state.rooms.parameters.cursor = name;
                }
            }
            Action::Submit => edit_under_cursor(state),
            Action::Filter => {
                let filter = state.rooms.parameters.filter.clone();
                state.prompt(Purpose::Filter(Room::Parameters), filter);
            }
            Action::ChangedParameters => {
                let room = &mut state.rooms.parameters;
                match &mut room.comparison {
                    Some(comparison) => comparison.lists_extra = !comparison.lists_extra,
                    None => room.changed_only = !room.changed_only,
                }
            }
            Action::SaveParameters => {
                let name = state.session.cursor.map(|id| format!("vehicle-{id}.parm"));
                state.prompt(Purpose::SaveParameters, name.unwrap_or_default());
            }
            Action::LoadParameters => state.prompt(Purpose::LoadParameters, ""),
            Action::CompareParameters => state.prompt(Purpose::CompareParameters, ""),
            Action::Toggle | Action::SelectAll | Action::Invert => compare::mark(state, action),
            Action::ApplyParameters => compare::apply(state),
            Action::FetchParameters => fetch(state),
            Action::NextVehicle | Action::PreviousVehicle => change_vehicle(state, action),
            Action::Escape => return close(state).then(Vec::new),
            _ => return None,
        }
        Some(Vec::new())
    }

    fn filter(state: &mut State, text: &str) {
        text.clone_into(&mut state.rooms.parameters.filter);
    }
}

/// The row under the cursor.
pub fn cursor_row(state: &State, rows: &[Row<'_>]) -> usize {
    let name = state.rooms.parameters.cursor.as_str();
    let at = rows.partition_point(|row| row.name < name);
    at.min(rows.len().saturating_sub(1))
}

/// Has the lists of the vehicles come anew.
pub fn fetch(state: &mut State) {
    let vehicles: Vec<VehicleId> = state.session.cursor.into_iter().collect();
    state.rooms.parameters.anew.extend(vehicles);
}

/// Takes over what is known of a vehicle's parameters. What comes after the session has ended belongs to nobody, and
/// what was confirmed before the vehicle rebooted is not confirmed any more.
pub fn arrived(state: &mut State, vehicle: VehicleId, snapshot: ParameterSnapshot) {
    if state.session.activity.is_none() {
        return;
    }
    let room = &mut state.rooms.parameters;
    room.asked.remove(&vehicle);
    let reboots = snapshot.reboots;
    let before = room.lists.insert(vehicle, snapshot);
    if reboots > before.map_or(0, |known| known.reboots) {
        room.edits.remove(&vehicle);
    }
}

/// How a command of the ledger stands with a vehicle.
pub fn outcome(
    state: &State,
    entry: EntryId,
    vehicle: VehicleId,
) -> Option<&crate::ledger::LedgerRow> {
    let entry = state.session.ledger.entry(entry)?;
    entry.rows.iter().find(|row| row.vehicle == vehicle)
}

fn edit_under_cursor(state: &mut State) {
    let rows = rows(state);
    let Some(row) = rows.get(cursor_row(state, &rows)) else {
        return;
    };
    // Of what is compared, the other value is what one would want to set.
    let value = row.other().or(row.now.map(|now| now.value));
    let (name, value) = (row.name.to_owned(), value.map_or_else(String::new, shown));
    let vehicles = state.addressed();
    state.prompt(Purpose::Parameter { name, vehicles }, value);
}

fn change_vehicle(state: &mut State, action: Action) {
    let step = match action {
        Action::NextVehicle => Step::Down,
        _ => Step::Up,
    };
    fly::move_cursor(state, step);
}

/// Stops setting values; else takes back the last thing that narrows the list. False if there is neither.
fn close(state: &mut State) -> bool {
    state.hush();
    let room = &mut state.rooms.parameters;
    let stopped = room.batch.as_mut().map_or(0, Batch::stop);
    if stopped > 0 {
        state.say(
            Severity::Notice,
            text!("parameters-stopped", count = stopped),
        );
    } else if !room.filter.is_empty() {
        room.filter.clear();
    } else if room.comparison.take().is_some() {
    } else if room.changed_only {
        room.changed_only = false;
    } else {
        return false;
    }
    true
}
