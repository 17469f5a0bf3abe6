//! Snapshots of a flight in the console, for jumps of a replay.

use std::time::Duration;

use super::State;
use super::room::debrief::Debrief;
use super::room::fly;
use super::room::map::Map;
use super::room::parameters::ParametersSnapshot;
use super::state::{FlightView, NoticeLog};
use crate::text::Text;

/// The console's state of a flight at one time, without the user's selection and view.
#[derive(Debug, Clone)]
pub struct FlightSnapshot {
    session: FlightView,
    notices: NoticeLog,
    map: Map,
    parameters: ParametersSnapshot,
    hints: Vec<Text>,
    debrief: Option<Debrief>,
    now: Duration,
}

impl FlightSnapshot {
    /// A snapshot of the current state.
    pub fn of(state: &State) -> Self {
        Self {
            session: state.session.clone(),
            notices: state.notices.clone(),
            map: state.rooms.map.clone(),
            parameters: state.rooms.parameters.snapshot(),
            hints: state.rooms.mission.hints.clone(),
            debrief: state.rooms.debrief.session.clone(),
            now: state.now,
        }
    }

    /// The snapshot's time, from the beginning of the recording.
    pub fn at(&self) -> Duration {
        self.now
    }
}

/// Restores a snapshot; the selection and the view stay.
pub(super) fn restore(state: &mut State, snapshot: FlightSnapshot) {
    let before = std::mem::replace(&mut state.session, snapshot.session);
    state.session.keep_choices(before);
    state.notices = snapshot.notices;
    state.rooms.map.remember(snapshot.map);
    state.rooms.parameters.restore(snapshot.parameters);
    state.rooms.mission.hints = snapshot.hints;
    state.rooms.debrief.session = snapshot.debrief;
    state.rooms.ledger.spoil();
    state.now = snapshot.now;
    fly::arrange(state);
    state.touch();
}
