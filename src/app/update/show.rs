//! Which room or overlay the screen shows.

use crate::app::State;
use crate::app::room::{self, Room};
use crate::app::state::{Log, Overlay};

pub fn show(state: &mut State, room: Room) {
    state.hush();
    state.room = room;
    room::entered(state, room);
}

/// Opens a log at its newest entry.
pub fn look_back(state: &mut State, log: Log) {
    state.overlay = Some(Overlay::Log { log, cursor: None });
}

/// Shows the mission's brief.
pub fn brief(state: &mut State) {
    show(state, Room::Mission);
}
