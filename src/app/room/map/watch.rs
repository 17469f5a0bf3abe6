//! Updates of the map during a flight, even while another room is shown.

use super::{Aim, planned, wires};
use crate::app::State;
use crate::geo::{LatLon, Outline};
use crate::mission::{AreaKind, Progress};
use crate::vehicle::{Vehicle, VehicleId};

/// Only every nth point of a trail counts towards the extent of everything.
const TRAIL_STEP: usize = 4;

/// Handles the start of a session, with its areas.
pub fn began(state: &mut State) {
    refit(state);
}

/// Handles new telemetry of a vehicle.
pub fn heard(state: &mut State, id: VehicleId) {
    let Some(vehicle) = state.session.vehicles.get(&id) else {
        return;
    };
    let map = &mut state.rooms.map;
    if let Some(home) = vehicle.home {
        map.overview.see(home.at_point);
    }
    let Some(global) = vehicle.global else {
        return;
    };
    map.overview.see(global.at_point);
    if let Some((_, target)) = leg(vehicle) {
        map.overview.see(target);
    }
    if vehicle.armed() {
        map.trails.entry(id).or_default().add(global.at_point);
    }
    if state.session.choice.cursor == Some(id) {
        map.followed(global.at_point);
    }
}

/// The start and the end of a vehicle's current leg; `None` if it is disarmed, or without a
/// position or a target.
pub fn leg(vehicle: &Vehicle) -> Option<(LatLon, LatLon)> {
    let here = vehicle.global?.at_point;
    let target = vehicle.target?.at_point?;
    vehicle.armed().then_some((here, target))
}

/// Adds the sensors' readings.
pub fn measured(state: &mut State, progress: &Progress) {
    for reading in &progress.readings {
        let Some(vehicle) = state.session.vehicles.get(&reading.vehicle) else {
            continue;
        };
        if let Some(global) = vehicle.global
            && vehicle.airborne()
            && !vehicle.link.lost
        {
            let samples = &mut state.rooms.map.samples;
            samples.add(
                reading.sensor.clone(),
                reading.unit,
                global.at_point,
                reading.value,
            );
        }
    }
    if state.session.task.progress.is_none() {
        for cell in &progress.cells {
            for corner in Outline::square(cell.centre, cell.side_m).corners() {
                state.rooms.map.overview.see(corner);
            }
        }
    }
}

pub fn tick(state: &mut State) {
    if state.rooms.map.overview.is_due(state.now) {
        let places = places(state);
        let map = &mut state.rooms.map;
        let before = map.overview.frame().copied();
        // Plans may arrive at any time.
        for &place in &places {
            map.overview.see(place);
        }
        map.overview.settle(places.into_iter());
        if map.overview.frame().copied() != before && map.aim == Aim::All {
            state.touch();
        }
    }
}

/// Fits the view to everything.
pub fn refit(state: &mut State) {
    let places = places(state);
    state.rooms.map.overview.fit(places.into_iter());
    state.rooms.map.aim = Aim::All;
}

/// Whether an area widens the view of everything, in a mission with a task area: where to fly, and what to fly around.
/// Limits such as a fence, and the radio's shadows, are larger than the task.
fn widens_view(kind: AreaKind) -> bool {
    match kind {
        AreaKind::Task | AreaKind::NoFly | AreaKind::Jamming | AreaKind::People => true,
        AreaKind::Geofence | AreaKind::Radio => false,
    }
}

/// The positions that the view of everything must contain.
fn places(state: &State) -> Vec<LatLon> {
    let session = &state.session;
    let vehicles = session.vehicles.values().flat_map(|vehicle| {
        let home = vehicle.home.map(|home| home.at_point);
        let here = vehicle.global.map(|global| global.at_point);
        let target = leg(vehicle).map(|(_, target)| target);
        home.into_iter().chain(here).chain(target)
    });
    let has_task = session
        .task
        .areas
        .iter()
        .any(|area| area.kind == AreaKind::Task);
    let all_areas = session.task.areas.iter();
    let framed = all_areas.filter(|area| !has_task || widens_view(area.kind));
    let areas = framed.flat_map(|area| area.outline.corners());
    let pylons = wires(state).flat_map(|wire| wire.pylons.iter().copied());
    let named = session.places.values().copied();
    let all_cells = session
        .task
        .progress
        .iter()
        .flat_map(|progress| &progress.cells);
    let cells = all_cells.flat_map(|cell| Outline::square(cell.centre, cell.side_m).corners());
    let map = &state.rooms.map;
    let shown_trails = map.trails.values().filter(|_| !map.trails_hidden);
    let trails = shown_trails.flat_map(|trail| trail.points().iter().step_by(TRAIL_STEP).copied());
    let known = vehicles
        .chain(areas)
        .chain(pylons)
        .chain(named)
        .chain(cells)
        .chain(trails);
    known.chain(planned(state)).collect()
}
