//! The vehicles' parameters: list, search, edit, files, differences.
//!
//! The room lists the parameters of the vehicle under the cursor. A new value goes to the targets
//! of any command: the selection if there is one, otherwise the vehicle under the cursor.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, ParametersAction, SelectAction, Step, ViewAction};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::fly;
use crate::app::room::{Answer, Room, RoomModel, RoomRequest};
use crate::app::state::Purpose;
use crate::ledger::EntryId;
use crate::parameters::{
    ListedParameter, ParameterDocuments, ParameterEncoding, ParameterSnapshot, shown,
};
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
pub use edit::{Edit, doubt, entered, fate, note_order, order_doubt, setting_line, tell};
pub use files::{load, read, save};
pub use rows::{Row, coming, extra, rows};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Parameters {
    /// The known parameters of each vehicle.
    pub(in crate::app) lists: BTreeMap<VehicleId, ParameterSnapshot>,
    /// The name under the cursor; if it is hidden, the cursor is on the next one.
    pub(in crate::app) cursor: String,
    /// The filter by name.
    pub(in crate::app) filter: String,
    /// Whether only parameters that were changed, or that a command tried to change, are shown.
    pub(in crate::app) changed_only: bool,
    /// Whether only parameters that differ from their defaults are shown.
    pub(in crate::app) other_than_default: bool,
    /// The other side of the comparison.
    pub(in crate::app) comparison: Option<Comparison>,
    /// The newest value commanded for each parameter of each vehicle.
    pub(in crate::app) edits: BTreeMap<VehicleId, BTreeMap<String, Edit>>,
    /// The ledger's entries of parameter commands that are under way.
    under_way: BTreeSet<EntryId>,
    /// The values being set one after another.
    pub(in crate::app) batch: Option<Batch>,
    /// Vehicles whose lists must be downloaded again.
    anew: BTreeSet<VehicleId>,
    /// Vehicles whose list was requested but has not begun to arrive, with the time of the request.
    asked: BTreeMap<VehicleId, Duration>,
}

/// The values of all vehicles at one time, and those that commands tried to set.
#[derive(Debug, Clone)]
pub(in crate::app) struct ParametersSnapshot {
    lists: BTreeMap<VehicleId, ParameterSnapshot>,
    edits: BTreeMap<VehicleId, BTreeMap<String, Edit>>,
}

impl Parameters {
    /// A snapshot of the values; cheap, because no value is copied.
    pub(in crate::app) fn snapshot(&self) -> ParametersSnapshot {
        ParametersSnapshot {
            lists: self.lists.clone(),
            edits: self.edits.clone(),
        }
    }

    /// Restores the values of a snapshot; the view stays.
    pub(in crate::app) fn restore(&mut self, snapshot: ParametersSnapshot) {
        self.lists = snapshot.lists;
        self.edits = snapshot.edits;
    }

    /// The known parameters of each vehicle.
    pub fn lists(&self) -> &BTreeMap<VehicleId, ParameterSnapshot> {
        &self.lists
    }

    /// The name under the cursor; if it is hidden, the cursor is on the next one.
    pub fn cursor(&self) -> &str {
        &self.cursor
    }

    /// The filter by name.
    pub fn filter_text(&self) -> &str {
        &self.filter
    }

    /// Whether only parameters that were changed, or that a command tried to change, are shown.
    pub fn shows_changed_only(&self) -> bool {
        self.changed_only
    }

    /// Whether only parameters that differ from their defaults are shown.
    pub fn shows_other_than_default(&self) -> bool {
        self.other_than_default
    }

    /// The default of a vehicle's parameter, if it has another value.
    pub fn other_default(&self, vehicle: VehicleId, name: &str) -> Option<f64> {
        self.lists.get(&vehicle)?.list.other_default(name)
    }

    /// The other side of the comparison.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// The values being set one after another.
    pub fn batch(&self) -> Option<&Batch> {
        self.batch.as_ref()
    }

    /// Drops a vehicle's parameters and requests.
    pub(in crate::app) fn forget(&mut self, vehicle: VehicleId) {
        self.lists.remove(&vehicle);
        self.edits.remove(&vehicle);
        self.anew.remove(&vehicle);
        self.asked.remove(&vehicle);
    }

    /// A parameter of a vehicle, if it is known.
    pub fn get(&self, vehicle: VehicleId, name: &str) -> Option<&ListedParameter> {
        self.lists.get(&vehicle)?.list.get(name)
    }

    /// What a vehicle itself documents about its parameters; `None` until that has been read.
    pub fn own_documents(&self, vehicle: VehicleId) -> Option<&ParameterDocuments> {
        let known = self.lists.get(&vehicle)?;
        (!known.documents.is_empty()).then_some(&known.documents)
    }

    /// How a vehicle encodes its parameters.
    pub fn encoding(&self, vehicle: VehicleId) -> ParameterEncoding {
        let known = self.lists.get(&vehicle);
        known.map_or_else(ParameterEncoding::default, |known| known.list.encoding())
    }

    /// The newest command that set a parameter of a vehicle, and its value; `None` if there was
    /// none.
    pub fn edit(&self, vehicle: VehicleId, name: &str) -> Option<Edit> {
        self.edits.get(&vehicle)?.get(name).copied()
    }
}

const HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "parameters-hint-set"),
    hint(
        &[Action::View(ViewAction::Filter)],
        "parameters-hint-search",
    ),
    hint(
        &[Action::Parameters(ParametersAction::ChangedParameters)],
        "parameters-hint-changed",
    ),
    hint(
        &[Action::Parameters(ParametersAction::SaveParameters)],
        "parameters-hint-save",
    ),
    hint(
        &[Action::Parameters(ParametersAction::LoadParameters)],
        "parameters-hint-load",
    ),
    hint(
        &[Action::Parameters(ParametersAction::CompareParameters)],
        "parameters-hint-compare",
    ),
    hint(
        &[
            Action::View(ViewAction::PreviousVehicle),
            Action::View(ViewAction::NextVehicle),
        ],
        "parameters-hint-vehicle",
    ),
    hint(&[Action::Help], "parameters-hint-help"),
];

const COMPARISON_HINTS: &[KeyHint] = &[
    hint(
        &[Action::Select(SelectAction::Toggle)],
        "parameters-hint-mark",
    ),
    hint(
        &[
            Action::Select(SelectAction::SelectAll),
            Action::Select(SelectAction::Invert),
        ],
        "parameters-hint-mark-all",
    ),
    hint(
        &[Action::Parameters(ParametersAction::ApplyParameters)],
        "parameters-hint-apply",
    ),
    hint(
        &[Action::Parameters(ParametersAction::ChangedParameters)],
        "parameters-hint-extra",
    ),
    hint(
        &[Action::View(ViewAction::Filter)],
        "parameters-hint-search",
    ),
    hint(&[Action::Escape], "parameters-hint-close"),
    hint(&[Action::Help], "parameters-hint-help"),
];

impl RoomModel for Parameters {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(key('/'), Action::View(ViewAction::Filter)),
        does(
            key('o'),
            Action::Parameters(ParametersAction::ChangedParameters),
        ),
        does(
            key('s'),
            Action::Parameters(ParametersAction::SaveParameters),
        ),
        does(
            key('l'),
            Action::Parameters(ParametersAction::LoadParameters),
        ),
        does(
            key('d'),
            Action::Parameters(ParametersAction::CompareParameters),
        ),
        does(key(' '), Action::Select(SelectAction::Toggle)),
        does(key('*'), Action::Select(SelectAction::SelectAll)),
        does(key('!'), Action::Select(SelectAction::Invert)),
        does(
            key('a'),
            Action::Parameters(ParametersAction::ApplyParameters),
        ),
        does(
            key('r'),
            Action::Parameters(ParametersAction::FetchParameters),
        ),
        does(
            key('i'),
            Action::Parameters(ParametersAction::ReadDocuments),
        ),
        does(
            Press::Plain(KeyCode::Left),
            Action::View(ViewAction::PreviousVehicle),
        ),
        does(key('['), Action::View(ViewAction::PreviousVehicle)),
        does(
            Press::Plain(KeyCode::Right),
            Action::View(ViewAction::NextVehicle),
        ),
        does(key(']'), Action::View(ViewAction::NextVehicle)),
        does(ESCAPE, Action::Escape),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.parameters.comparison {
            Some(_) => COMPARISON_HINTS,
            None => HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let rows = rows(state);
        let at = step.apply(cursor_row(state, &rows), rows.len());
        if let Some(name) = rows.get(at).map(|row| row.name.to_owned()) {
            state.rooms.parameters.cursor = name;
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        edit_under_cursor(state);
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        close(state).then(Vec::new)
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::Filter => {
                let filter = state.rooms.parameters.filter.clone();
                state.prompt(Purpose::Filter(Room::Parameters), filter);
            }
            ViewAction::NextVehicle => fly::move_cursor(state, Step::Down),
            ViewAction::PreviousVehicle => fly::move_cursor(state, Step::Up),
            ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextPage
            | ViewAction::Window => return None,
        }
        Some(Vec::new())
    }

    fn select(state: &mut State, action: SelectAction) -> Answer {
        let marks = match action {
            SelectAction::Toggle => compare::Marks::UnderCursor,
            SelectAction::SelectAll => compare::Marks::Unmarked,
            SelectAction::Invert => compare::Marks::All,
            SelectAction::Erase => return None,
        };
        compare::turn(state, marks);
        Some(Vec::new())
    }

    fn filter(state: &mut State, text: &str) {
        text.clone_into(&mut state.rooms.parameters.filter);
    }
}

pub(super) fn act(state: &mut State, action: ParametersAction) -> Vec<RoomRequest> {
    match action {
        ParametersAction::ChangedParameters => {
            let room = &mut state.rooms.parameters;
            match &mut room.comparison {
                Some(comparison) => comparison.lists_extra = !comparison.lists_extra,
                None => show_next_choice(state),
            }
        }
        ParametersAction::SaveParameters => {
            let name = state
                .session
                .choice
                .cursor
                .map(|id| format!("vehicle-{id}.parm"));
            state.prompt(Purpose::SaveParameters, name.unwrap_or_default());
        }
        ParametersAction::LoadParameters => state.prompt(Purpose::LoadParameters, ""),
        ParametersAction::CompareParameters => state.prompt(Purpose::CompareParameters, ""),
        ParametersAction::ApplyParameters => compare::apply(state),
        ParametersAction::FetchParameters => fetch(state),
        ParametersAction::ReadDocuments => {
            let vehicle = state.session.choice.cursor.into_iter();
            return vehicle
                .map(|vehicle| RoomRequest::Give(format!("{vehicle} param docs")))
                .collect();
        }
    }
    Vec::new()
}

/// Shows all parameters, then those that were changed, then those that differ from their defaults, if the vehicle has
/// told these.
fn show_next_choice(state: &mut State) {
    let vehicle = state.session.choice.cursor;
    let room = &mut state.rooms.parameters;
    let known = vehicle.and_then(|vehicle| room.lists.get(&vehicle));
    let has_defaults = known.is_some_and(|known| known.list.has_defaults());
    let was_changed_only = room.changed_only;
    room.changed_only = !was_changed_only && !room.other_than_default;
    room.other_than_default = was_changed_only && has_defaults;
}

/// The index of the row under the cursor.
pub fn cursor_row(state: &State, rows: &[Row<'_>]) -> usize {
    let name = state.rooms.parameters.cursor.as_str();
    let at = rows.partition_point(|row| row.name < name);
    at.min(rows.len().saturating_sub(1))
}

/// Downloads the list of the vehicle under the cursor again.
pub fn fetch(state: &mut State) {
    let vehicles: Vec<VehicleId> = state.session.choice.cursor.into_iter().collect();
    state.rooms.parameters.anew.extend(vehicles);
}

/// Stores a vehicle's known parameters. They are ignored after the end of a session, and a reboot
/// of the vehicle cancels earlier confirmations.
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

/// The ledger row of a command for one vehicle; `None` if the ledger has no such row.
pub fn outcome(
    state: &State,
    entry: EntryId,
    vehicle: VehicleId,
) -> Option<&crate::ledger::LedgerRow> {
    let entry = state.session.commands.ledger.entry(entry)?;
    entry.rows.iter().find(|row| row.vehicle == vehicle)
}

fn edit_under_cursor(state: &mut State) {
    let rows = rows(state);
    let Some(row) = rows.get(cursor_row(state, &rows)) else {
        return;
    };
    // In a comparison, the other value is the likely one to set.
    let value = row.other().or(row.now.map(|now| now.value));
    let (name, value) = (row.name.to_owned(), value.map_or_else(String::new, shown));
    let vehicles = state.addressed();
    state.prompt(Purpose::Parameter { name, vehicles }, value);
}

/// Stops setting values; otherwise removes the filter, the comparison or the limit to changed
/// parameters, one at a time. Returns false if there is nothing to close.
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
    } else if room.changed_only || room.other_than_default {
        room.changed_only = false;
        room.other_than_default = false;
    } else {
        return false;
    }
    true
}
