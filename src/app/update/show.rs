//! Which room or overlay the screen shows.

use crate::app::State;
use crate::app::room::{self, Room};
use crate::app::state::{Log, Overlay, ReplayView};

pub fn show(state: &mut State, room: Room) {
    state.hush();
    if room == Room::Review && state.room != room {
        state.rooms.review.is_from_debrief = state.room == Room::Debrief;
    }
    if room == Room::Map && state.room != room {
        state.rooms.map.came_from = state.room;
    }
    state.room = room;
    room::entered(state, room);
}

/// Opens a log: notices at the newest entry, traffic at the most urgent aircraft, moments at the
/// moment shown.
pub fn look_back(state: &mut State, log: Log) {
    let cursor = match log {
        Log::Notices => None,
        Log::Traffic => Some(0),
        Log::Moments => state.replay.as_ref().and_then(ReplayView::current_index),
    };
    state.overlay = Some(Overlay::Log { log, cursor });
}

/// Shows the mission's brief.
pub fn brief(state: &mut State) {
    show(state, Room::Mission);
}
