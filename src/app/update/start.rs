//! The start of a session, flown or recorded.

use std::time::Duration;

use crate::app::State;
use crate::app::event::Started;
use crate::app::room::Room;
use crate::app::room::map;
use crate::app::state::{
    Activity, FlightView, Hangar, NoticeLog, ReplayView, SessionPace, TimeFlow,
};
use crate::vehicle_id::VehicleIds;

/// Begins a session. It replaces the previous one, and ends a replay.
pub fn started(state: &mut State, started: Started) {
    begin(state, started, None);
}

/// Begins the session of a recording.
pub fn opened(state: &mut State, view: ReplayView, started: Started) {
    begin(state, started, Some(view));
}

/// Begins a session, of a recording if `replay` is given. Every session begins here, so that neither the previous
/// session nor its replay stays on the screen.
fn begin(state: &mut State, started: Started, replay: Option<ReplayView>) {
    let is_again = started.is_again || replay.is_some();
    let is_from_debrief = state.room == Room::Debrief;
    let reward = state.training.reward.take();
    if state.replay.is_none() {
        state.rooms.debrief.keep(reward);
    }
    state.now = match replay {
        Some(_) => Duration::ZERO,
        None => state.clock,
    };
    let mut session = session(state, started);
    // A debrief has been read in the meantime: a flight from there begins with its brief, like a chosen one.
    // A member of a crew reads it, too, until the host's mission begins.
    let is_past = replay.as_ref().is_some_and(|it| !it.is_live);
    let is_at_once = is_past || replay.is_none() && is_again && !is_from_debrief;
    session.first_room = first_room(&session, is_at_once, replay.as_ref());
    if session.first_room == Room::Mission && replay.is_none() {
        session.timing.flow = TimeFlow::AwaitsReader;
    }
    if is_again {
        session.choice.groups = std::mem::take(&mut state.session.choice.groups);
    }
    state.replay = replay;
    state.session = session;
    // Earlier notices and drops belong to the previous session.
    state.notices = NoticeLog::default();
    state.ghost = None;
    state.rooms.forget_session();
    state.rooms.review.is_from_debrief = is_from_debrief;
    map::began(state);
    state.typing.targets.clear();
    // Until the vehicles are there, the hangar shows their start.
    state.room = if state.session.is_starting() {
        Room::Hangar
    } else {
        state.session.first_room
    };
    state.overlay = None;
    state.hush();
    state.session.alerts.mute(&state.config.alerts.mute);
}

/// A new session, with no data of its vehicles yet.
fn session(state: &State, started: Started) -> FlightView {
    let mut session = FlightView::new(started.activity, started.places);
    session.task.listing = started.mission;
    session.task.areas = started.areas;
    session.timing.pace = SessionPace::new(started.speedup);
    session.begin(state.now);
    if let Some(Activity::Connected { .. }) = session.activity {
        let expected = state.config.connect.expect.iter();
        session.expected = expected.flat_map(VehicleIds::iter).collect();
    }
    let starting = |expected| Hangar {
        expected,
        ..Hangar::default()
    };
    session.hangar = started.processes.map(starting);
    session
}

/// The first room of a session: the review if the recording was opened for it, the brief of a
/// mission that does not begin at once, otherwise the flight.
fn first_room(session: &FlightView, is_at_once: bool, replay: Option<&ReplayView>) -> Room {
    if replay.is_some_and(|it| it.is_review) {
        Room::Review
    } else if session.task.listing.is_some() && !is_at_once {
        Room::Mission
    } else {
        Room::Fly
    }
}
