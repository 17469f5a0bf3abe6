//! The selected vehicles, and the list of vehicles being typed.

use crate::app::State;
use crate::app::action::SelectAction;
use crate::text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::{parse_ranges, ranges};

/// The greatest length of a typed vehicle list, in characters.
const LONGEST_LIST: usize = 60;

/// Selects those of the given vehicles that exist, and no others; keeps the selection if none
/// exists.
pub fn select(state: &mut State, ids: &[VehicleId]) {
    let known = |id: &VehicleId| state.session.vehicles.contains_key(id);
    let (there, missing): (Vec<VehicleId>, Vec<VehicleId>) = ids.iter().partition(|id| known(id));
    if !missing.is_empty() {
        let vehicles = ranges(missing);
        let text = if there.is_empty() {
            text!("select-missing-all", vehicles = vehicles)
        } else {
            text!("select-missing", vehicles = vehicles)
        };
        state.say(Severity::Warning, text);
        if there.is_empty() {
            return;
        }
    }
    if let Some(&first) = there.first() {
        state.session.choice.place_cursor(first);
    }
    state.session.choice.selection = there.into_iter().collect();
}

/// Carries out an action about the selection.
pub fn act(state: &mut State, action: SelectAction) {
    match action {
        SelectAction::Toggle => toggle(state),
        SelectAction::SelectAll => select_all(state),
        SelectAction::Invert => invert(state),
        SelectAction::Erase => {
            state.typing.targets.pop();
        }
    }
}

/// Selects or deselects the vehicle under the cursor.
fn toggle(state: &mut State) {
    let session = &mut state.session;
    if let Some(id) = session.choice.cursor
        && !session.choice.selection.remove(&id)
    {
        session.choice.selection.insert(id);
    }
}

/// Selects the vehicles in the table; vehicles hidden by a filter are not selected.
fn select_all(state: &mut State) {
    state.session.choice.selection = state.rooms.fly.rows().iter().copied().collect();
}

/// Inverts the selection within the table.
fn invert(state: &mut State) {
    let shown = state.rooms.fly.rows().iter().copied();
    let selected = &state.session.choice.selection;
    let others = shown.filter(|id| !selected.contains(id)).collect();
    state.session.choice.selection = others;
}

/// Adds a character to the vehicle list, unless the list would not begin with a digit or would be
/// too long.
pub fn type_ids(state: &mut State, c: char) {
    if (c.is_ascii_digit() || !state.typing.targets.is_empty())
        && state.typing.targets.len() < LONGEST_LIST
    {
        state.typing.targets.push(c);
    }
}

/// Cancels the typed list; without one, clears the selection.
pub fn cancel(state: &mut State) {
    state.hush();
    if state.typing.targets.is_empty() {
        state.session.choice.selection.clear();
    }
    state.typing.targets.clear();
}

/// Selects the typed list.
pub fn submit(state: &mut State) {
    if state.typing.targets.is_empty() {
        return;
    }
    let typed = std::mem::take(&mut state.typing.targets);
    match parse_ranges(&typed) {
        Ok(ids) => select(state, &ids),
        Err(text) => state.say(Severity::Warning, text),
    }
}
