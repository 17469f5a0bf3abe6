//! The parts of the screen, and the view of the map.

use crate::app::State;
use crate::app::room::map::{Aim, Map};
use crate::draft::{Draft, place};
use crate::geo::{Extent, GridSize, LatLon};
use crate::mission::AreaKind;
use crate::plan::{Document, ListKind};

/// Rows of the screen outside the parts of the room: the header, the keys, the footer.
const OTHER_ROWS: u16 = 3;
/// Rows of the details (the item, the cursor and the reports) on small screens.
const FEW_DETAILS: u16 = 5;
/// Rows of the details on large screens.
const DETAILS: u16 = 9;
/// Rows of the height profile and its rule on small screens.
const LOW: u16 = 5;
/// Rows of the height profile and its rule on large screens.
const HIGH: u16 = 11;
/// The minimum number of rows of a large screen.
const TALL: u16 = 36;
/// Pairs of a minimum screen width and the width of the list on such a screen, in columns; `NARROW`
/// applies to narrower screens.
const LISTS: &[(u16, u16)] = &[(150, 92), (110, 58)];
const NARROW: u16 = 40;

/// The minimum side of the area that the map shows, in metres, before there are items;
/// `LEAST_DRAWN_M` applies once there are.
const LEAST_SIDE_M: f64 = 300.0;
const LEAST_DRAWN_M: f64 = 100.0;
/// Rows of the screen above the map: the header, the drafts.
const ROWS_ABOVE: u16 = 2;

/// The sizes of the room's parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlansLayout {
    /// Columns of the list, without the gap to the map.
    pub list: u16,
    /// Rows of the list; the height profile is below it, down to the end of the map.
    pub rows: u16,
    /// The canvas of the map.
    pub canvas: GridSize,
}

/// The sizes on a screen.
pub fn layout(screen: GridSize) -> PlansLayout {
    let wide = LISTS.iter().find(|(least, _)| screen.columns >= *least);
    let list = wide.map_or(NARROW, |(_, list)| *list);
    let (heights, details) = if screen.rows >= TALL {
        (HIGH, DETAILS)
    } else {
        (LOW, FEW_DETAILS)
    };
    let rows = screen.rows.saturating_sub(OTHER_ROWS + 1 + details);
    PlansLayout {
        list,
        rows: rows.saturating_sub(heights),
        canvas: GridSize::new(screen.columns.saturating_sub(list + 1), rows),
    }
}

fn places(document: &Document) -> Vec<LatLon> {
    let lists = ListKind::ALL.into_iter();
    let items = lists.flat_map(|kind| document.list(kind).iter().filter_map(place));
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    home.into_iter().chain(items).collect()
}

/// Fits the view to all drafts, the vehicles, the mission's task areas and the named places.
pub fn fit(state: &mut State) {
    let room = &state.rooms.plans;
    let drawn = room.drafts.all().iter().map(Draft::document);
    let is_drawn = room
        .drafts
        .all()
        .iter()
        .any(|it| it.document().kinds().next().is_some());
    let least_m = if is_drawn {
        LEAST_DRAWN_M
    } else {
        LEAST_SIDE_M
    };
    let mut all: Vec<LatLon> = drawn.flat_map(|document| places(document)).collect();
    for vehicle in state.session.vehicles.values() {
        all.extend(vehicle.home.map(|home| home.at_point));
        all.extend(vehicle.global.map(|global| global.at_point));
    }
    let areas = state.session.task.areas.iter();
    let tasks = areas.filter(|area| area.kind == AreaKind::Task);
    all.extend(tasks.flat_map(|area| area.outline.corners()));
    all.extend(state.session.places.values());
    // Around a single place there is room for a first plan.
    if let Some(extent) = Extent::around(all.iter().copied())
        && let missing_m = least_m - extent.size_m().into_iter().fold(0.0, f64::max)
        && missing_m > 0.0
    {
        let wider = extent.with_margin(0.0, missing_m / 2.0);
        all.extend(wider.corners());
    }
    let map = &mut state.rooms.plans.map;
    map.overview.fit(all.into_iter());
    map.aim = Aim::All;
}

/// Extends the view of everything to a changed draft.
pub fn see(state: &mut State) {
    if state.rooms.plans.map.overview.frame().is_none() {
        return fit(state);
    }
    let room = &mut state.rooms.plans;
    let Some(draft) = room.drafts.current() else {
        return;
    };
    for place in places(draft.document()) {
        room.map.overview.see(place);
    }
}

/// Puts the map's cursor on a place, scrolling if needed.
pub fn point_at(map: &mut Map, size: GridSize, place: LatLon) {
    map.cursor = Some(place);
    let is_hidden = map
        .view(size)
        .is_some_and(|view| view.cell(place).is_none());
    if is_hidden {
        map.centre_on(size, place);
    }
}

/// Puts the map's cursor on the item under the cursor, if that has a place.
pub fn point_at_item(state: &mut State) {
    let size = layout(state.display.grid()).canvas;
    let room = &mut state.rooms.plans;
    let item = room.row().and_then(|row| room.items().get(row));
    if let Some(place) = item.and_then(place) {
        point_at(&mut room.map, size, place);
    }
}

/// Puts the map's cursor on a cell of the screen, if the map covers it.
pub fn click(state: &mut State, column: u16, row: u16) {
    let sizes = layout(state.display.grid());
    let map = &mut state.rooms.plans.map;
    let column = column.checked_sub(sizes.list + 1);
    let row = row.checked_sub(ROWS_ABOVE);
    if let (Some(view), Some(column), Some(row)) = (map.view(sizes.canvas), column, row)
        && row < sizes.canvas.rows
    {
        map.cursor = Some(view.middle_of(column.into(), row.into()));
    }
}
