//! What would be lost if the session ended now.

use crate::app::State;
use crate::app::state::Activity;
use crate::crew::Role;
use crate::mission::Stake;
use crate::text;
use crate::text::Text;
use crate::vehicle_id::ranges;

/// A text that describes the loss if the session ended now; `None` if nothing would be lost.
pub fn loss(state: &State) -> Option<Text> {
    if state.is_following() {
        return duty_loss(state);
    }
    let session = &state.session;
    // A mission that has not begun is only cancelled.
    let is_mission = matches!(session.activity, Some(Activity::Mission { .. }));
    let is_waiting = session.is_starting() || (is_mission && !session.has_flight_begun());
    let has_not_begun = is_waiting && session.armed() == 0;
    if session.task.over || session.activity.is_none() || state.replay.is_some() {
        return None;
    }
    if has_not_begun {
        let place = state.class.seat();
        let is_try = place.is_some_and(|place| place.flown_try().is_some());
        return is_try.then(|| text!("class-exam-ask-leave"));
    }
    let count = session.armed();
    let armed = (count > 0).then(|| text!("ask-armed", count = count));
    let mission = session.task.progress.is_some().then(|| mission_loss(state));
    let reasons: Vec<Text> = mission.into_iter().chain(armed).collect();
    (!reasons.is_empty()).then(|| Text::joined("; ", reasons))
}

/// What the crew loses if a member leaves it in flight.
fn duty_loss(state: &State) -> Option<Text> {
    let place = state.crew.member().filter(|it| it.is_connected())?;
    let host = &place.viewpoint()?.host;
    if state.session.task.over || state.session.activity.is_none() {
        return None;
    }
    let own = state.session.pilots.own().unwrap_or_default();
    match place.role() {
        _ if !own.is_empty() => Some(text!(
            "crew-ask-quit-vehicles",
            host = host.name(),
            vehicles = ranges(own)
        )),
        role @ (Role::Sensors | Role::Safety) => {
            Some(text!("crew-ask-quit-role", role = role.text()))
        }
        Role::Pilot | Role::Observer => None,
    }
}

/// What the end of a mission that is not over means.
fn mission_loss(state: &State) -> Text {
    match state.session.activity {
        Some(Activity::Mission { .. }) if state.has_open_try() => text!("class-exam-ask-end-try"),
        Some(Activity::Mission {
            stake: Stake::Exam, ..
        }) => text!("ask-exam-ends"),
        Some(Activity::Mission {
            stake: Stake::Graded | Stake::Daily,
            ..
        }) => text!("ask-given-up"),
        Some(
            Activity::Mission {
                stake: Stake::Practice,
                ..
            }
            | Activity::Free
            | Activity::Connected { .. },
        )
        | None => text!("ask-mission-lost"),
    }
}
