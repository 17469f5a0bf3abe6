//! The way home after a session.

use crate::app::State;
use crate::app::room::Room;

/// Drops the session and shows the home screen. The debrief stays until the next one.
pub fn go_home(state: &mut State) {
    let session = std::mem::take(&mut state.session);
    state.notices.keep_times(&session);
    if state.replay.is_some() {
        state.rooms.debrief.end_replay();
    }
    state.leave_replay();
    state.ghost = None;
    let debriefs = std::mem::take(&mut state.rooms.debrief);
    state.rooms.forget_session();
    state.rooms.debrief = debriefs;
    state.typing.targets.clear();
    state.room = Room::Home;
}
