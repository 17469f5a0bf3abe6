//! The keys of the map and what they do.

use crossterm::event::KeyCode;

use super::{Aim, Map, Size, refit};
use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::{RoomModel, RoomRequest, footer_keys};
use crate::geo::LatLon;
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Cells that the cursor goes with Page Up and Page Down.
const PAGE: i32 = 10;

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(
        &[
            Action::Move(Step::Left),
            Action::Move(Step::Down),
            Action::Move(Step::Up),
            Action::Move(Step::Right),
        ],
        "hint-cursor",
    ),
    hint(&[Action::ZoomIn, Action::ZoomOut], "hint-zoom"),
    hint(&[Action::Fit], "hint-fit"),
    hint(&[Action::Follow], "hint-follow"),
    hint(&[Action::GotoHere], "hint-goto"),
    hint(&[Action::Ruler], "hint-ruler"),
    hint(&[Action::NextVehicle], "hint-vehicle"),
    hint(&[Action::Legend], "hint-signs"),
    hint(&[Action::Trails], "hint-trails"),
];

impl RoomModel for Map {
    const KEYS: &'static [KeyRow] = &[
        does(key('h'), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Left), Action::Move(Step::Left)),
        does(key('l'), Action::Move(Step::Right)),
        does(Press::Plain(KeyCode::Right), Action::Move(Step::Right)),
        does(key('+'), Action::ZoomIn),
        does(key('='), Action::ZoomIn),
        does(key('-'), Action::ZoomOut),
        does(key('z'), Action::Fit),
        does(key('f'), Action::Follow),
        does(key('.'), Action::Centre),
        does(key('u'), Action::Ruler),
        does(key('g'), Action::GotoHere),
        does(Press::Plain(KeyCode::Tab), Action::NextVehicle),
        does(Press::Plain(KeyCode::BackTab), Action::PreviousVehicle),
        does(key('w'), Action::Trails),
        does(key('s'), Action::NextSensor),
        does(key('i'), Action::Legend),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
        let map = &mut state.rooms.map;
        let size = map.canvas(state.size);
        match action {
            Action::Move(step) => go(state, size, step),
            // The key of the vehicle list `3-9`, while such a list is being typed.
            Action::ZoomOut if !state.typed.is_empty() => state.typed.push('-'),
            Action::ZoomIn | Action::ZoomOut => map.zoom(size, action == Action::ZoomIn),
            Action::Fit => {
                refit(state);
                state.rooms.map.cursor = None;
            }
            Action::Follow => follow(state, size),
            Action::Centre => {
                let pointed = map.view(size).map(|view| map.pointed(&view))?;
                map.centre_on(size, pointed);
            }
            Action::Ruler => measure(state, size),
            Action::Escape if map.mark.is_some() && state.typed.is_empty() => map.mark = None,
            Action::GotoHere => return Some(goto_here(state, size)),
            Action::NextVehicle => turn_to(state, size, 1),
            Action::PreviousVehicle => turn_to(state, size, -1),
            Action::Submit if state.typed.is_empty() => pick_nearest(state, size),
            Action::Trails => map.trails_hidden = !map.trails_hidden,
            Action::NextSensor => next_sensor(state),
            Action::Legend => {
                let shown = map.shows_legend(state.size);
                map.legend = Some(!shown);
            }
            _ => return None,
        }
        Some(Vec::new())
    }

    fn forget_session(&mut self) {
        *self = self.for_next_session();
    }
}

fn go(state: &mut State, size: Size, step: Step) {
    let vehicle = state.session.under_cursor();
    let (right, down) = match step {
        Step::Left => (-1, 0),
        Step::Right => (1, 0),
        Step::Up => (0, -1),
        Step::Down => (0, 1),
        Step::PageUp => (0, -PAGE),
        Step::PageDown => (0, PAGE),
        Step::First | Step::Last => {
            let place = vehicle.and_then(|vehicle| match step {
                Step::First => vehicle.home.map(|home| home.at_point),
                _ => vehicle.global.map(|global| global.at_point),
            });
            return match place {
                Some(place) => point_at(state, size, place),
                None => state.say(Severity::Notice, text!("map-no-vehicle")),
            };
        }
    };
    state.rooms.map.step(size, right, down);
}

/// Puts the cursor on a place; the view moves there if it has to.
fn point_at(state: &mut State, size: Size, place: LatLon) {
    let map = &mut state.rooms.map;
    map.cursor = Some(place);
    if map
        .view(size)
        .is_some_and(|view| view.cell(place).is_none())
    {
        map.centre_on(size, place);
    }
}

fn follow(state: &mut State, size: Size) {
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

/// The ruler begins under the cursor; where it has begun already, it is taken away.
fn measure(state: &mut State, size: Size) {
    let map = &mut state.rooms.map;
    if map.mark.take().is_none()
        && let Some(view) = map.view(size)
    {
        map.mark = Some(map.pointed(&view));
    }
}

/// Writes the command that sends the vehicles here: nothing flies before the user has seen it and pressed Enter.
fn goto_here(state: &State, size: Size) -> Vec<RoomRequest> {
    let map = &state.rooms.map;
    let Some(view) = map.view(size) else {
        return Vec::new();
    };
    let place = map.pointed(&view);
    let line = format!("goto {:.7} {:.7} ", place.lat_deg, place.lon_deg);
    vec![RoomRequest::Write(line)]
}

/// Makes the next vehicle by number that of the cursor, and points at it.
fn turn_to(state: &mut State, size: Size, by: i32) {
    let rows = state.rooms.fly.rows();
    if rows.is_empty() {
        return state.say(Severity::Notice, text!("map-no-vehicle"));
    }
    let row = state.rooms.fly.row_of(state.session.cursor) as i32 + by;
    let next = rows[row.rem_euclid(rows.len() as i32) as usize];
    state.session.place_cursor(next);
    let place = state.session.under_cursor().and_then(|it| it.global);
    if let Some(global) = place {
        state.rooms.map.followed(global.at_point);
        point_at(state, size, global.at_point);
    }
}

fn pick_nearest(state: &mut State, size: Size) {
    let map = &state.rooms.map;
    let Some(view) = map.view(size) else {
        return;
    };
    let place = map.pointed(&view);
    let away = |id: &VehicleId| {
        let global = state.session.vehicles.get(id)?.global?;
        Some(global.at_point.distance_m(place))
    };
    let placed = state.session.vehicles.keys().copied();
    let placed = placed.filter_map(|id| Some((id, away(&id)?)));
    let nearest = placed.min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((id, _)) = nearest {
        state.session.place_cursor(id);
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
