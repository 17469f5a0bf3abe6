//! The keys of the map.

use crossterm::event::KeyCode;

use super::{Aim, Map, refit};
use crate::app::State;
use crate::app::action::{Action, MapAction, Step, ViewAction};
use crate::app::keymap::{KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::{Answer, RoomModel, RoomRequest, footer_keys};
use crate::geo::{GridSize, LatLon, Viewport};
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Cells that Page Up and Page Down move the cursor.
const PAGE: i32 = 10;

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::BACK,
    hint(
        &[
            Action::Move(Step::Left),
            Action::Move(Step::Down),
            Action::Move(Step::Up),
            Action::Move(Step::Right),
        ],
        "hint-cursor",
    ),
    hint(
        &[
            Action::Map(MapAction::ZoomIn),
            Action::Map(MapAction::ZoomOut),
        ],
        "hint-zoom",
    ),
    hint(&[Action::Map(MapAction::Fit)], "hint-fit"),
    hint(&[Action::Map(MapAction::Follow)], "hint-follow"),
    hint(&[Action::Map(MapAction::GotoHere)], "hint-goto"),
    hint(&[Action::Map(MapAction::Ruler)], "hint-ruler"),
    hint(&[Action::View(ViewAction::NextVehicle)], "hint-vehicle"),
    hint(&[Action::Map(MapAction::Legend)], "hint-signs"),
    hint(&[Action::Map(MapAction::Trails)], "hint-trails"),
];

impl RoomModel for Map {
    const KEYS: &'static [KeyRow] = &[
        does(key('h'), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Left), Action::Move(Step::Left)),
        does(key('l'), Action::Move(Step::Right)),
        does(Press::Plain(KeyCode::Right), Action::Move(Step::Right)),
        does(key('+'), Action::Map(MapAction::ZoomIn)),
        does(key('='), Action::Map(MapAction::ZoomIn)),
        does(key('-'), Action::Map(MapAction::ZoomOut)),
        does(key('z'), Action::Map(MapAction::Fit)),
        does(key('f'), Action::Map(MapAction::Follow)),
        does(key('.'), Action::Map(MapAction::Centre)),
        does(key('u'), Action::Map(MapAction::Ruler)),
        does(key('g'), Action::Map(MapAction::GotoHere)),
        does(
            Press::Plain(KeyCode::Tab),
            Action::View(ViewAction::NextVehicle),
        ),
        does(
            Press::Plain(KeyCode::BackTab),
            Action::View(ViewAction::PreviousVehicle),
        ),
        does(key('w'), Action::Map(MapAction::Trails)),
        does(key('s'), Action::Map(MapAction::NextSensor)),
        does(key('i'), Action::Map(MapAction::Legend)),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let size = state.rooms.map.canvas(state.display().grid());
        go(state, size, step);
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        if !state.typing.targets.is_empty() {
            return None;
        }
        let size = state.rooms.map.canvas(state.display().grid());
        pick_nearest(state, size);
        Some(Vec::new())
    }

    /// Ends the ruler; otherwise leaves the room, once no vehicles are typed or selected.
    fn escape(state: &mut State) -> Answer {
        let map = &mut state.rooms.map;
        if !state.typing.targets.is_empty() {
            return None;
        }
        if map.mark.take().is_some() {
            return Some(Vec::new());
        }
        let came_from = map.came_from;
        let is_nothing_selected = state.session.choice.selection.is_empty();
        is_nothing_selected.then(|| vec![RoomRequest::Show(came_from)])
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        let size = state.rooms.map.canvas(state.display().grid());
        match action {
            ViewAction::NextVehicle => turn_to(state, size, 1),
            ViewAction::PreviousVehicle => turn_to(state, size, -1),
            ViewAction::Filter
            | ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextPage
            | ViewAction::Window => return None,
        }
        Some(Vec::new())
    }

    fn forget_session(&mut self) {
        *self = self.for_next_session();
    }
}

pub fn act(state: &mut State, action: MapAction) -> Vec<RoomRequest> {
    let screen = state.display().grid();
    let map = &mut state.rooms.map;
    let size = map.canvas(screen);
    match action {
        MapAction::ZoomIn => map.zoom(size, true),
        // `-` belongs to the vehicle list (`3-9`) while one is being typed.
        MapAction::ZoomOut if !state.typing.targets.is_empty() => state.typing.targets.push('-'),
        MapAction::ZoomOut => map.zoom(size, false),
        MapAction::Fit => {
            refit(state);
            state.rooms.map.cursor = None;
        }
        MapAction::Follow => follow(state, size),
        MapAction::Centre => {
            if let Some(pointed) = map.view(size).map(|view| map.pointed(&view)) {
                map.centre_on(size, pointed);
            }
        }
        MapAction::Ruler => measure(state, size),
        MapAction::GotoHere => return goto_here(state, size),
        MapAction::Trails => map.trails_hidden = !map.trails_hidden,
        MapAction::NextSensor => next_sensor(state),
        MapAction::Legend => {
            let shown = map.shows_legend(screen);
            map.legend = Some(!shown);
        }
    }
    Vec::new()
}

fn go(state: &mut State, size: GridSize, step: Step) {
    let vehicle = state.session.under_cursor();
    let (right, down) = match step {
        Step::Left => (-1, 0),
        Step::Right => (1, 0),
        Step::Up => (0, -1),
        Step::Down => (0, 1),
        Step::PageUp => (0, -PAGE),
        Step::PageDown => (0, PAGE),
        // The map has no lines.
        Step::Row(_) => (0, 0),
        Step::First => {
            let home = vehicle.and_then(|vehicle| vehicle.home);
            return point_at_or_say(state, size, home.map(|home| home.at_point));
        }
        Step::Last => {
            let here = vehicle.and_then(|vehicle| vehicle.global);
            return point_at_or_say(state, size, here.map(|here| here.at_point));
        }
    };
    state.rooms.map.step(size, right, down);
}

/// Puts the cursor on a vehicle's place, or reports that its position is unknown.
fn point_at_or_say(state: &mut State, size: GridSize, place: Option<LatLon>) {
    match place {
        Some(place) => point_at(state, size, place),
        None => state.say(Severity::Notice, text!("map-no-vehicle")),
    }
}

fn point_at(state: &mut State, size: GridSize, place: LatLon) {
    let map = &mut state.rooms.map;
    map.cursor = Some(place);
    if map
        .view(size)
        .is_some_and(|view| view.cell(place).is_none())
    {
        map.centre_on(size, place);
    }
}

fn follow(state: &mut State, size: GridSize) {
    let map = &mut state.rooms.map;
    if let Aim::Vehicle(place, zoom) = map.aim {
        map.aim = Aim::Place(place, zoom);
        return;
    }
    let place = state.session.under_cursor().and_then(|it| it.global);
    match place {
        Some(global) => map.follow(size, global.at_point),
        None => state.say(Severity::Notice, text!("map-no-vehicle")),
    }
}

/// Starts the ruler at the cursor, or removes it.
fn measure(state: &mut State, size: GridSize) {
    let map = &mut state.rooms.map;
    if map.mark.take().is_none()
        && let Some(view) = map.view(size)
    {
        map.mark = Some(map.pointed(&view));
    }
}

/// Types the command that sends the vehicles to the cursor; the user must press Enter to give it.
fn goto_here(state: &State, size: GridSize) -> Vec<RoomRequest> {
    let map = &state.rooms.map;
    let Some(view) = map.view(size) else {
        return Vec::new();
    };
    let place = map.pointed(&view);
    let line = match name_of(state, &view, place) {
        Some(name) => format!("goto {name} "),
        None => format!("goto {:.7} {:.7} ", place.lat_deg, place.lon_deg),
    };
    vec![RoomRequest::Write(line)]
}

/// The name of the place in the same cell as a point, if any; the nearest if there are several.
fn name_of<'a>(state: &'a State, view: &Viewport, point: LatLon) -> Option<&'a str> {
    let cell = view.cell(point)?;
    let places = state.session.places.iter();
    let here = places.filter(|(_, at)| view.cell(**at) == Some(cell));
    let nearest = here.min_by(|a, b| a.1.distance_m(point).total_cmp(&b.1.distance_m(point)));
    nearest.map(|(name, _)| name.as_str())
}

/// Moves the swarm's cursor by this many rows of the table, wrapping at the ends, and the map's
/// cursor to that vehicle.
fn turn_to(state: &mut State, size: GridSize, by: i32) {
    let rows = state.rooms.fly.rows();
    if rows.is_empty() {
        return state.say(Severity::Notice, text!("map-no-vehicle"));
    }
    let row = state.rooms.fly.row_of(state.session.choice.cursor) as i32 + by;
    let next = rows[row.rem_euclid(rows.len() as i32) as usize];
    state.session.choice.place_cursor(next);
    let place = state.session.under_cursor().and_then(|it| it.global);
    if let Some(global) = place {
        state.rooms.map.followed(global.at_point);
        point_at(state, size, global.at_point);
    }
}

fn pick_nearest(state: &mut State, size: GridSize) {
    let map = &state.rooms.map;
    let Some(view) = map.view(size) else {
        return;
    };
    let place = map.pointed(&view);
    let away = |id: &VehicleId| {
        let global = state.session.vehicles.get(id)?.global?;
        Some(global.at_point.distance_m(place))
    };
    let ids = state.session.vehicles.keys().copied();
    let placed = ids.filter_map(|id| Some((id, away(&id)?)));
    let nearest = placed.min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((id, _)) = nearest {
        state.session.choice.place_cursor(id);
    }
}

fn next_sensor(state: &mut State) {
    let map = &mut state.rooms.map;
    map.sensor = (map.sensor + 1) % map.samples.fields().len().max(1);
    let said = match map.field() {
        Some((_, field)) => text!("map-shows-sensor", sensor = &field.name),
        None => text!("map-no-samples"),
    };
    state.say(Severity::Info, said);
}
