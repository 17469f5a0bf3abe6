//! Which parameter lists are downloaded: those on the screen, a few at a time.

use std::time::Duration;

use super::Other;
use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::app::room::Room;
use crate::app::state::Overlay;
use crate::language::{self, Kind};
use crate::parameters::Fetching;
use crate::vehicle::VehicleId;

/// The maximum number of lists downloaded at a time: vehicles may share a slow radio.
const AT_ONCE: usize = 4;
/// If a vehicle has not started to send its list within this time, the list is requested again.
const BEGIN_WITHIN: Duration = Duration::from_secs(5);

/// Requests the lists that are needed and missing; called at every tick, because the need depends on the screen.
pub fn wanted(state: &mut State) -> Effects {
    let now = state.now;
    let candidates = candidates(state);
    let room = &mut state.rooms.parameters;
    room.asked.retain(|_, at| now < *at + BEGIN_WITHIN);
    if candidates.is_empty() {
        return Effects::none();
    }
    let vehicles = &state.session.vehicles;
    let is_heard = |id: &VehicleId| vehicles.get(id).is_some_and(|it| !it.link.lost);
    let coming = room
        .lists
        .iter()
        .filter(|(id, known)| known.fetching.is_under_way() && is_heard(id));
    let free = AT_ONCE.saturating_sub(coming.count() + room.asked.len());
    let due: Vec<VehicleId> = candidates
        .into_iter()
        .filter(|id| is_heard(id) && !room.asked.contains_key(id))
        .take(free)
        .collect();
    if due.is_empty() {
        return Effects::none();
    }
    for &id in &due {
        room.asked.insert(id, now);
        room.anew.remove(&id);
    }
    Effects::from(Effect::FetchParameters(due))
}

/// Vehicles whose lists are needed and have not been requested.
fn candidates(state: &State) -> Vec<VehicleId> {
    let room = &state.rooms.parameters;
    let mut wanted = Vec::new();
    if state.room == Room::Parameters {
        wanted.extend(state.session.choice.cursor);
        wanted.extend(&state.session.choice.selection);
        if let Some(Other::Vehicle(other)) = room.comparison.as_ref().map(|it| &it.with) {
            wanted.push(*other);
        }
    }
    // The command line completes names once they are known.
    if let Some(Overlay::Palette(palette)) = &state.overlay
        && language::begun(palette.input.value()).is_some_and(|row| row.takes(Kind::Parameter))
    {
        wanted.extend(state.addressed().first());
    }
    let is_new = |id: &VehicleId| {
        let known = room.lists.get(id).map(|known| known.fetching);
        known.unwrap_or_default() == Fetching::NotAsked
    };
    let is_free = |id: &VehicleId| {
        let known = room.lists.get(id);
        known.is_none_or(|known| !known.fetching.is_under_way())
    };
    wanted.retain(is_new);
    wanted.extend(room.anew.iter().filter(|id| is_free(id)));
    let mut seen = std::collections::BTreeSet::new();
    wanted.retain(|id| seen.insert(*id));
    wanted
}
