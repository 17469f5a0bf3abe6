//! Changes to the current draft.

use std::sync::Arc;

use super::view;
use crate::app::State;
use crate::draft::{Draft, Edit, PlanEdit, Refusal, Surroundings, needs_ground};
use crate::geo::{LatLon, Terrain};
use crate::plan::check::FAR_M;
use crate::plan::{Document, Home, ListKind};
use crate::text;
use crate::vehicle::{Place, Severity};

/// The name of a draft that is begun by adding its first item.
const FIRST_NAME: &str = "plan";

/// The home of the vehicle under the cursor, otherwise that of any vehicle.
pub(super) fn home(state: &State) -> Option<Home> {
    let vehicle = state.session.under_cursor();
    let any = state.session.vehicles.values().find_map(|it| it.home);
    let home: Place = vehicle.and_then(|vehicle| vehicle.home).or(any)?;
    let (x, y) = home.at_point.to_e7();
    Some(Home {
        x,
        y,
        z: home.altitude_amsl_m as f32,
    })
}

/// The place under the cursor of the map; `None` without a view, and in the plain console, which
/// shows no cursor.
pub(super) fn cursor(state: &State) -> Option<LatLon> {
    if !state.display.has_rooms {
        return None;
    }
    let map = &state.rooms.plans.map;
    let view = map.view(view::layout(state.display.grid()).canvas);
    view.map(|view| map.pointed(&view))
}

fn surroundings(state: &State) -> Surroundings {
    Surroundings {
        cursor: cursor(state),
        home: home(state),
        ground: state.rooms.plans.ground().clone(),
    }
}

/// Begins an empty draft, and shows it.
pub(super) fn begin(state: &mut State, name: &str) {
    let document = Arc::new(Document {
        home: home(state),
        ..Document::default()
    });
    let room = &mut state.rooms.plans;
    let name = room.drafts.free_name(name);
    room.drafts.put([Draft::new(name, document, None)]);
    look_at(state, ListKind::Plan);
}

/// Shows a list from its first item.
pub(super) fn look_at(state: &mut State, list: ListKind) {
    let room = &mut state.rooms.plans;
    (room.list, room.row, room.mark) = (list, 0, None);
    room.figures_top = None;
    view::see(state);
    come_back(state);
}

/// If the cursor was left far away at a draft shown earlier, moves the map and its cursor to the
/// current draft, or to the vehicles if that draft has no home.
fn come_back(state: &mut State) {
    let draft = state.rooms.plans.drafts.current();
    let own = draft.and_then(|draft| draft.document().home);
    let Some(home) = own.or_else(|| home(state)) else {
        return;
    };
    let home = LatLon::from_e7(home.x, home.y);
    // A cursor so far from home was left at another draft.
    if cursor(state).is_some_and(|at| at.distance_m(home) > FAR_M) {
        view::fit(state);
        let size = view::layout(state.display.grid()).canvas;
        view::point_at(&mut state.rooms.plans.map, size, home);
    }
}

/// Begins a draft if there is none.
pub(super) fn ensure(state: &mut State) {
    if state.rooms.plans.drafts.current().is_none() {
        begin(state, FIRST_NAME);
    }
}

/// Changes the current draft; without one, the change begins a new draft.
///
/// # Errors
/// The reason why the change is not possible.
pub(super) fn edit(state: &mut State, edit: &Edit) -> Result<(), Refusal> {
    ensure(state);
    let around = surroundings(state);
    let room = &mut state.rooms.plans;
    let Some(draft) = room.drafts.current_mut() else {
        return Ok(());
    };
    let is_level = is_over_unknown_ground(draft.document(), edit, &around.ground);
    let item = draft.edit(edit, &around)?;
    room.tried = None;
    if !matches!(edit, Edit::Home(_)) {
        room.list = edit.list();
    }
    if let Some(item) = item {
        (room.row, room.mark) = (item, None);
    }
    view::see(state);
    if item.is_some() {
        view::point_at_item(state);
    }
    if is_level {
        state.say(Severity::Notice, text!("draft-ground-level"));
    }
    Ok(())
}

/// Whether a change depends on the height of ground that is unknown.
fn is_over_unknown_ground(document: &Document, edit: &Edit, ground: &Terrain) -> bool {
    match edit {
        Edit::Plan(PlanEdit::Frame { items, frame }) => {
            needs_ground(document, *items, *frame, ground)
        }
        Edit::Plan(
            PlanEdit::Add { .. }
            | PlanEdit::Reorder { .. }
            | PlanEdit::Split(_)
            | PlanEdit::Command { .. },
        )
        | Edit::Fence(_)
        | Edit::Items { .. }
        | Edit::Rally { .. }
        | Edit::Home(_) => false,
    }
}

/// Changes the current draft by a key press; shows a refusal on the last line.
pub(super) fn try_edit(state: &mut State, change: &Edit) {
    if let Err(refusal) = edit(state, change) {
        state.say(Severity::Warning, refusal.reason);
    }
}

/// Undoes or redoes a change.
pub(super) fn travel(state: &mut State, back: bool) {
    let draft = state.rooms.plans.drafts.current_mut();
    let is_done = draft.is_some_and(|draft| if back { draft.undo() } else { draft.redo() });
    (state.rooms.plans.mark, state.rooms.plans.tried) = (None, None);
    if !is_done {
        let text = if back {
            text!("bench-nothing-to-undo")
        } else {
            text!("bench-nothing-to-redo")
        };
        state.say(Severity::Notice, text);
    }
}
