//! What the console knew of a flight at one time: what a replay goes back to.

use std::time::Duration;

use super::State;
use super::room::debrief::Debrief;
use super::room::map::Map;
use super::state::{FlightView, NoticeLog};
use crate::text::Text;

/// What the console knew of a flight at one time. What its user selected and looks at is not in it.
#[derive(Debug, Clone)]
pub struct FlightSnapshot {
    session: FlightView,
    notices: NoticeLog,
    map: Map,
    hints: Vec<Text>,
    debrief: Option<Debrief>,
    now: Duration,
}

impl FlightSnapshot {
    /// What is known now.
    pub fn of(state: &State) -> Self {
        Self {
            session: state.session.clone(),
            notices: state.notices.clone(),
            map: state.rooms.map.clone(),
            hints: state.rooms.mission.hints.clone(),
            debrief: state.rooms.debrief.clone(),
            now: state.now,
        }
    }

    /// When it was known, from the beginning of the recording.
    pub fn at(&self) -> Duration {
        self.now
    }
}

/// Goes back to what was known then; what is selected and looked at stays.
pub(super) fn restore(state: &mut State, snapshot: FlightSnapshot) {
    let before = std::mem::replace(&mut state.session, snapshot.session);
    state.session.keep_choices(before);
    state.notices = snapshot.notices;
    state.rooms.map.remember(snapshot.map);
    state.rooms.mission.hints = snapshot.hints;
    state.rooms.debrief = snapshot.debrief;
    state.rooms.ledger.spoil();
    state.now = snapshot.now;
    state.touch();
}
