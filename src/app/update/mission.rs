//! The course of a session: pause, end, restart.

use std::path::Path;

use super::ending::{ask, guarded, hosts_flight, leave};
use super::loss::loss;
use super::replay;
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects, Launch, SessionEffect};
use crate::app::room::Room;
use crate::app::state::{Activity, SeatPlace, TimeFlow};
use crate::campaign::Stake;
use crate::doctor::Way;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Begins a mission when its brief is left for another room.
pub fn leave_brief(state: &mut State) {
    if state.room == Room::Mission || state.session.is_starting() {
        return;
    }
    if state.holds_brief().is_some() {
        return;
    }
    // In Fly, the clock itself shows that it runs.
    if state.session.is_reading() && state.room != Room::Fly {
        let key = state.key(Action::PauseMission);
        state.say(Severity::Notice, text!("mission-brief-left", key = key));
    }
    state.session.leave_brief();
}

/// Pauses or resumes the session or the replay.
pub fn turn(state: &mut State) -> Effects {
    if let Some(view) = &state.replay {
        return replay::play(!view.position.is_playing);
    }
    if state.session.is_paused() {
        go_on(state)
    } else {
        pause(state)
    }
}

/// Pauses the session, or shows why that is not possible; in a replay, pauses the replay.
pub fn pause(state: &mut State) -> Effects {
    if state.replay.is_some() {
        return replay::play(false);
    }
    match obstacle(state) {
        Some(reason) => {
            state.say(Severity::Notice, reason);
            Effects::none()
        }
        None => Effects::from(Effect::Session(SessionEffect::Pause)),
    }
}

pub fn go_on(state: &mut State) -> Effects {
    if state.replay.is_some() {
        return replay::play(true);
    }
    if let Some(reason) = state.keeps_frozen() {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    if state.session.is_paused() {
        return Effects::from(Effect::Session(SessionEffect::Continue));
    }
    state.say(Severity::Notice, text!("pause-is-none"));
    Effects::none()
}

/// Records that the session was paused or resumed.
pub fn paused(state: &mut State, paused: bool) {
    state.session.timing.flow = if paused {
        TimeFlow::Paused
    } else {
        TimeFlow::Passes
    };
    let text = if paused {
        text!("pause-begins", key = state.key(Action::PauseMission))
    } else {
        text!("pause-ends")
    };
    state.say(Severity::Notice, text);
}

/// The reason why the session cannot be paused; `None` if it can.
fn obstacle(state: &State) -> Option<Text> {
    let session = &state.session;
    let forbidden = || session.task.listing.as_ref().is_some_and(|it| !it.pausable);
    match &session.activity {
        None => Some(text!("mission-none")),
        _ if session.task.over => Some(text!("deed-over")),
        _ if session.is_paused() => Some(text!("pause-is-one")),
        _ if session.hangar.is_some() => Some(text!("pause-not-processes")),
        Some(Activity::Connected { addresses }) if is_a_recording(addresses) => {
            Some(text!("pause-recording"))
        }
        Some(Activity::Connected { .. }) => Some(text!("pause-not-real")),
        Some(Activity::Mission { .. } | Activity::Free) => {
            let not_begun = || session.is_reading().then(|| text!("pause-not-begun"));
            forbidden()
                .then(|| text!("pause-not-allowed"))
                .or_else(not_begun)
        }
    }
}

/// Whether everything that is heard comes from recordings.
fn is_a_recording(addresses: &[String]) -> bool {
    let is_tlog = |address: &String| {
        Path::new(address)
            .extension()
            .is_some_and(|it| it == "tlog")
    };
    let is_file = |address: &String| Way::of(address) == Way::File || is_tlog(address);
    !addresses.is_empty() && addresses.iter().all(is_file)
}

/// Starts a mission, after a question if something would be lost; a locked one is refused.
pub fn start(state: &mut State, launch: Launch) -> Effects {
    if let Some(reason) = state.training().lock(&launch.mission) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    guarded(
        state,
        text!("ask-start"),
        Effect::Session(SessionEffect::StartMission(launch)),
    )
}

/// Starts the exam of a mission, after a question with its rules.
pub fn start_exam(state: &mut State, mission: &str) -> Effects {
    if let Some(reason) = hosts_flight(state) {
        state.say(Severity::Notice, reason);
        return Effects::none();
    }
    if let Some(reason) = state.training().lock(mission) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    let reason = match loss(state) {
        Some(lost) => Text::joined("; ", vec![lost, text!("ask-exam-reason")]),
        None => text!("ask-exam-reason"),
    };
    let launch = Launch {
        stake: Stake::Exam,
        ..state.training().launch(mission)
    };
    ask(
        state,
        text!("ask-exam"),
        reason,
        Effect::Session(SessionEffect::StartMission(launch)),
    )
}

/// Flies the same mission again, with the same seed if `alike`; asks first if something would be
/// lost.
pub fn restart(state: &mut State, alike: bool) -> Effects {
    if let Some(launch) = debriefed(state, alike) {
        return start(state, launch);
    }
    if state.replay.is_some() {
        state.say(Severity::Notice, text!("restart-not-replay"));
        return Effects::none();
    }
    if let Some(reason) = state.keeps_frozen().or_else(|| state.holds_brief()) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    // Also after its end: the desk opens the tries of an exam.
    let is_try = |place: &SeatPlace| place.flown_try().is_some();
    if state.class.seat().is_some_and(is_try) {
        let reason = text!("class-exam-no-restart");
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    if state.flown_mission().is_none() {
        state.say(Severity::Notice, text!("mission-none"));
        return Effects::none();
    }
    let effect = Effect::Session(SessionEffect::Restart { alike });
    guarded(state, text!("ask-restart"), effect)
}

/// The mission of a debrief whose session has ended, with the same seed if `alike`, which is then practice.
fn debriefed(state: &State, alike: bool) -> Option<Launch> {
    let debriefs = &state.rooms.debrief;
    let has_ended = debriefs.shows_earlier() || state.session.activity.is_none();
    let is_here = state.room == Room::Debrief && has_ended;
    let report = debriefs.shown().filter(|_| is_here)?.report();
    let launch = state.training().launch(&report.mission);
    Some(if alike {
        Launch {
            stake: Stake::Practice,
            seed: Some(report.seed),
            ..launch
        }
    } else {
        launch
    })
}

/// Ends the mission, after a question; leaves it if the flight has not begun.
pub fn abandon(state: &mut State) -> Effects {
    if state.flown_mission().is_none() || state.session.task.over || state.replay.is_some() {
        state.say(Severity::Notice, text!("mission-none"));
        return Effects::none();
    }
    // Nothing has been tried yet, so there is nothing to score.
    if !state.session.has_flight_begun() {
        return leave(state);
    }
    let reason = if state.has_open_try() {
        text!("class-exam-ask-end-try")
    } else {
        text!("ask-abandon-reason")
    };
    ask(
        state,
        text!("ask-abandon"),
        reason,
        Effect::Session(SessionEffect::Abandon),
    )
}
