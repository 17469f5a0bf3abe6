//! The swarm in flight: the rows of the table and their order.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::action::{Action, SelectAction, Step, ViewAction};
use crate::app::keymap::{HintKeys, KeyHint, KeyRow, Place, does, hint, key, latin_line, writes};
use crate::app::room::{Answer, Room, RoomModel, footer_keys};
use crate::app::state::{FlightView, Purpose, SortKey, VehicleFilter};
use crate::config::{Column, TableSort};
use crate::text;
use crate::text::Locale;
use crate::vehicle::{Severity, VehicleId};

/// The minimum time between changes of the order, so that the eye can follow a row.
const RESORT_EVERY: Duration = Duration::from_secs(1);
/// The columns that the sort key cycles through if none are chosen.
const SORTS: &[Column] = &[
    Column::Id,
    Column::Alert,
    Column::Mode,
    Column::Armed,
    Column::Altitude,
    Column::Speed,
    Column::Battery,
    Column::Link,
    Column::Home,
    Column::Group,
];

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Fly {
    /// The filter as typed.
    pub(in crate::app) filter: String,
    rows: Vec<VehicleId>,
    keys: BTreeMap<VehicleId, SortKey>,
    ordered: Option<(TableSort, Duration)>,
}

impl Fly {
    /// The filter as typed.
    pub fn filter_text(&self) -> &str {
        &self.filter
    }

    /// The vehicles in the table, in the order of their rows.
    pub fn rows(&self) -> &[VehicleId] {
        &self.rows
    }

    /// A vehicle's index in the table; 0 if it is not there.
    pub fn row_of(&self, vehicle: Option<VehicleId>) -> usize {
        let place = self.rows.iter().position(|&id| Some(id) == vehicle);
        place.unwrap_or(0)
    }
}

/// Puts the cursor on another vehicle, in the order of the table.
pub fn move_cursor(state: &mut State, step: Step) {
    let fly = &state.rooms.fly;
    let row = step.apply(fly.row_of(state.session.choice.cursor), fly.rows().len());
    if let Some(&id) = fly.rows().get(row) {
        state.session.choice.place_cursor(id);
    }
}

const LIST: KeyHint = KeyHint {
    keys: HintKeys::VehicleList,
    about: "hint-list",
};

/// The keys of the commands to vehicles, the most useful first.
const COMMANDS: KeyHint = KeyHint {
    keys: HintKeys::Lines(&[
        "arm", "takeoff", "goto", "land", "rtl", "hold", "mode", "disarm",
    ]),
    about: "hint-commands",
};

const LOOK_BACK: KeyHint = hint(
    &[Action::Show(Room::Ledger), Action::Notices],
    "hint-look-back",
);

const MAP: KeyHint = hint(&[Action::Show(Room::Map)], "room-map");

const ROOMS: KeyHint = hint(
    &[
        Action::Show(Room::Vehicle),
        Action::Show(Room::Parameters),
        Action::Show(Room::Messages),
        Action::Show(Room::Links),
    ],
    "hint-rooms",
);

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    COMMANDS,
    hint(&[Action::Select(SelectAction::Toggle)], "hint-select"),
    LIST,
    hint(&[Action::Select(SelectAction::SelectAll)], "hint-all"),
    hint(&[Action::View(ViewAction::Filter)], "hint-filter"),
    hint(&[Action::View(ViewAction::Sort)], "hint-sort"),
    hint(&[Action::Acknowledge], "hint-acknowledge"),
    hint(&[Action::Escape], "hint-none"),
    footer_keys::MOVE,
    LOOK_BACK,
    MAP,
    ROOMS,
];

const MISSION_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::PAUSE,
    footer_keys::MISSION_HINT,
    COMMANDS,
    hint(&[Action::Show(Room::Mission)], "room-mission"),
    MAP,
    hint(&[Action::Select(SelectAction::Toggle)], "hint-select"),
    LIST,
    hint(&[Action::Select(SelectAction::SelectAll)], "hint-all"),
    hint(&[Action::Acknowledge], "hint-acknowledge"),
    footer_keys::MOVE,
    LOOK_BACK,
    ROOMS,
];

impl RoomModel for Fly {
    const KEYS: &'static [KeyRow] = &[
        writes('h', "hold"),
        does(key('/'), Action::View(ViewAction::Filter)),
        does(key('s'), Action::View(ViewAction::Sort)),
        does(key('S'), Action::View(ViewAction::SortReverse)),
        does(key('x'), Action::Acknowledge),
        does(key('J'), Action::TakeSticks),
        writes('@', "select @"),
        writes('w', "hint"),
        writes('o', "workload "),
        writes('e', "inject "),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.flown_mission() {
            Some(_) => MISSION_HINTS,
            None => HINTS,
        }
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::Filter => {
                let filter = state.rooms.fly.filter.clone();
                state.prompt(Purpose::Filter(Room::Fly), filter);
            }
            ViewAction::Sort => next_sort(state),
            ViewAction::SortReverse => {
                let sort = sorted_by(state);
                set_sort(
                    state,
                    TableSort {
                        reversed: !sort.reversed,
                        ..sort
                    },
                );
            }
            ViewAction::NextVehicle
            | ViewAction::PreviousVehicle
            | ViewAction::NextPage
            | ViewAction::Window => return None,
        }
        Some(Vec::new())
    }

    /// Clears the filter, unless a typed list or a selection must be cleared first.
    fn escape(state: &mut State) -> Answer {
        let is_all_else_taken_back =
            state.typing.targets.is_empty() && state.session.choice.selection.is_empty();
        if !is_all_else_taken_back || state.rooms.fly.filter.is_empty() {
            return None;
        }
        state.hush();
        filter(state, "");
        Some(Vec::new())
    }

    fn filter(state: &mut State, text: &str) {
        filter(state, text);
    }
}

/// The order of the table.
pub fn sorted_by(state: &State) -> TableSort {
    state.config.table.sort
}

pub fn set_sort(state: &mut State, sort: TableSort) {
    state.config.table.sort = sort;
    arrange(state);
    let column = sort.column.title();
    let text = if sort.reversed {
        text!("fly-sorted-reversed", column = column)
    } else {
        text!(
            "fly-sorted",
            column = column,
            key = state
                .keymap
                .key(Action::View(ViewAction::SortReverse), Place::In(Room::Fly))
        )
    };
    state.say(Severity::Info, text);
}

/// Applies a filter, and puts the cursor on a shown vehicle.
pub fn filter(state: &mut State, text: &str) {
    text.trim().clone_into(&mut state.rooms.fly.filter);
    state.rooms.fly.rows.clear();
    arrange(state);
    let fly = &state.rooms.fly;
    let is_shown = state
        .session
        .choice
        .cursor
        .is_some_and(|id| fly.rows.contains(&id));
    if let Some(&first) = fly.rows.first()
        && !is_shown
    {
        state.session.choice.place_cursor(first);
    }
}

/// The filter in force: as typed, or read by its keys if only that finds a vehicle.
fn in_force(text: &str, session: &FlightView, locale: &Locale) -> VehicleFilter {
    let finds = |filter: &VehicleFilter| {
        let mut vehicles = session.vehicles.values();
        vehicles.any(|vehicle| filter.fits(vehicle, session, locale))
    };
    let typed = VehicleFilter::new(text);
    let Some(read) = latin_line(text).map(|read| VehicleFilter::new(&read)) else {
        return typed;
    };
    if !finds(&typed) && finds(&read) {
        read
    } else {
        typed
    }
}

/// Adds a row for a new vehicle that matches the filter; the row is sorted in at the next update.
pub fn heard(state: &mut State, id: VehicleId) {
    let filter = in_force(&state.rooms.fly.filter, &state.session, &state.locale);
    let fits = |state: &State| {
        let vehicle = state.session.vehicles.get(&id);
        vehicle.is_some_and(|vehicle| filter.fits(vehicle, &state.session, &state.locale))
    };
    if filter.is_empty() || fits(state) {
        let by_id = sorted_by(state) == TableSort::BY_ID;
        let rows = &mut state.rooms.fly.rows;
        let place = rows.partition_point(|&known| known < id);
        rows.insert(if by_id { place } else { rows.len() }, id);
    }
}

/// Removes the rows of forgotten vehicles.
pub fn forget(state: &mut State, ids: &[VehicleId]) {
    state.rooms.fly.rows.retain(|id| !ids.contains(id));
}

/// Updates the rows at intervals; returns whether they have changed.
pub fn tick(state: &mut State) -> bool {
    let sort = sorted_by(state);
    let fly = &state.rooms.fly;
    let is_static = sort == TableSort::BY_ID && fly.filter.is_empty();
    let is_due = match fly.ordered {
        Some((known, at)) if known == sort => {
            !is_static && state.now.saturating_sub(at) >= RESORT_EVERY
        }
        _ => true,
    };
    if !is_due {
        return false;
    }
    let before = state.rooms.fly.rows.clone();
    arrange(state);
    before != state.rooms.fly.rows
}

/// Acknowledges the alerts on the alert line.
pub fn acknowledge_pressing(state: &mut State) {
    let pressing = state.session.alerts.pressing();
    let kind = pressing.map(|pressing| pressing.first.alert.kind);
    acknowledge(state, |_, known| Some(known) == kind);
}

/// Acknowledges the alerts that `which` selects, and shows their number.
pub fn acknowledge(state: &mut State, which: impl Fn(VehicleId, AlertKind) -> bool) {
    let count = state.session.alerts.acknowledge(which);
    state.say(Severity::Info, text!("alert-acknowledged", count = count));
}

fn next_sort(state: &mut State) {
    let chosen = state.config.table.columns.as_slice();
    let all = if chosen.is_empty() { SORTS } else { chosen };
    let now = sorted_by(state).column;
    let at = all.iter().position(|column| *column == now);
    let column = all[at.map_or(0, |at| (at + 1) % all.len())];
    set_sort(
        state,
        TableSort {
            column,
            reversed: false,
        },
    );
}

/// Filters and sorts the rows. The vehicle under the cursor keeps its row even if the filter excludes it: the target
/// of the next command must not change. A small change of a value does not move a row either.
pub(in crate::app) fn arrange(state: &mut State) {
    let sort = sorted_by(state);
    let session = &state.session;
    let fly = &mut state.rooms.fly;
    if fly
        .ordered
        .is_none_or(|(known, _)| known.column != sort.column)
    {
        fly.keys.clear();
    }
    fly.ordered = Some((sort, state.now));
    let filter = in_force(&fly.filter, session, &state.locale);
    let held = session.choice.cursor.filter(|id| fly.rows.contains(id));
    let shown = session.vehicles.values().filter(|vehicle| {
        held == Some(vehicle.id)
            || filter.is_empty()
            || filter.fits(vehicle, session, &state.locale)
    });
    fly.rows = shown.map(|vehicle| vehicle.id).collect();
    if sort.column == Column::Id {
        if sort.reversed {
            fly.rows.reverse();
        }
        return;
    }
    let step = sort.column.step();
    for id in &fly.rows {
        let Some(vehicle) = session.vehicles.get(id) else {
            continue;
        };
        let new = sort.column.key(vehicle, session);
        let stays = fly.keys.get(id).is_some_and(|old| new.is_near(old, step));
        if !stays {
            fly.keys.insert(*id, new);
        }
    }
    let keys = &fly.keys;
    let key = |id: &VehicleId| keys.get(id).unwrap_or(&SortKey::Missing);
    fly.rows
        .sort_by(|a, b| key(a).compare(key(b), sort.reversed));
}
