//! The course of a session: pause, end, once more.

use super::act::{ask, guarded, leave, loss};
use super::replay;
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects, Launch, SessionEffect};
use crate::app::room::Room;
use crate::app::state::{Activity, TimeFlow};
use crate::campaign::Stake;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// A mission begins once another room is shown than its brief.
pub fn leave_brief(state: &mut State) {
    if state.room != Room::Mission && !state.session.is_starting() {
        state.session.leave_brief();
    }
}

/// Lets the session stand still, or go on where it does.
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

/// Lets the session stand still, where that is possible; says why where it is not.
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

/// Lets the session go on.
pub fn go_on(state: &mut State) -> Effects {
    if state.replay.is_some() {
        return replay::play(true);
    }
    if state.session.is_paused() {
        return Effects::from(Effect::Session(SessionEffect::Continue));
    }
    state.say(Severity::Notice, text!("pause-is-none"));
    Effects::none()
}

/// It stands still from now on, or goes on.
pub fn paused(state: &mut State, paused: bool) {
    state.session.flow = if paused {
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

/// Why the session cannot stand still.
fn obstacle(state: &State) -> Option<Text> {
    let session = &state.session;
    let forbidden = || session.listing.as_ref().is_some_and(|it| !it.pausable);
    match &session.activity {
        None => Some(text!("mission-none")),
        _ if session.over => Some(text!("deed-over")),
        _ if session.is_paused() => Some(text!("pause-is-one")),
        _ if session.hangar.is_some() => Some(text!("pause-not-processes")),
        Some(Activity::Connected { .. }) => Some(text!("pause-not-real")),
        Some(Activity::Mission { .. } | Activity::Free) => {
            let not_begun = || session.is_reading().then(|| text!("pause-not-begun"));
            forbidden()
                .then(|| text!("pause-not-allowed"))
                .or_else(not_begun)
        }
    }
}

/// Starts a mission, after a question where something would be lost. One that is locked for the trainee is not
/// started.
pub fn start(state: &mut State, launch: Launch) -> Effects {
    if let Some(reason) = state.lock(&launch.mission) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    guarded(
        state,
        text!("ask-start"),
        Effect::Session(SessionEffect::StartMission(launch)),
    )
}

/// Starts the exam of a mission, after a question: it is not like other flights.
pub fn start_exam(state: &mut State, mission: &str) -> Effects {
    if let Some(reason) = state.lock(mission) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    let reason = match loss(state) {
        Some(lost) => Text::joined("; ", vec![lost, text!("ask-exam-reason")]),
        None => text!("ask-exam-reason"),
    };
    let launch = Launch {
        stake: Stake::Exam,
        ..state.launch(mission)
    };
    ask(
        state,
        text!("ask-exam"),
        reason,
        Effect::Session(SessionEffect::StartMission(launch)),
    )
}

/// Flies the same mission again, `alike` if chance is to play the same again; asks first where something would be
/// lost.
pub fn restart(state: &mut State, alike: bool) -> Effects {
    if state.flown_mission().is_none() {
        state.say(Severity::Notice, text!("mission-none"));
        return Effects::none();
    }
    let effect = Effect::Session(SessionEffect::Restart { alike });
    guarded(state, text!("ask-restart"), effect)
}

/// Ends the mission, after a question.
pub fn abandon(state: &mut State) -> Effects {
    if state.flown_mission().is_none() || state.session.over || state.replay.is_some() {
        state.say(Severity::Notice, text!("mission-none"));
        return Effects::none();
    }
    // Nothing was tried yet, so that there is nothing to judge.
    if !state.session.has_flight_begun() {
        return leave(state);
    }
    let reason = text!("ask-abandon-reason");
    ask(
        state,
        text!("ask-abandon"),
        reason,
        Effect::Session(SessionEffect::Abandon),
    )
}
