//! The end of a session or of the program, after a question if something would be lost.

use super::consequence;
use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::room;
use crate::app::state::{Activity, Consequence};
use crate::mission::Stake;
use crate::text;
use crate::text::Text;

/// Quits the program; asks first if something would be lost.
pub fn quit(state: &mut State) -> Effects {
    let at_risk = state.training.at_risk;
    if at_risk > 0 {
        let unstored = text!("career-ask-quit-reason", count = at_risk);
        let reasons = loss(state).into_iter().chain([unstored]).collect();
        let reason = Text::joined("; ", reasons);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    if loss(state).is_none() && !room::workshop::is_saved(state) {
        let name = state.rooms.workshop.bench.design().name.clone();
        let reason = text!("bench-ask-quit-reason", name = name);
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    if loss(state).is_none() && !room::plans::is_kept(state) {
        let reason = text!("draft-ask-quit-reason");
        return ask(state, text!("ask-quit"), reason, Effect::Quit);
    }
    guarded(state, text!("ask-quit"), Effect::Quit)
}

/// Carries out an effect that ends the session; asks first if something would be lost.
pub fn guarded(state: &mut State, question: Text, effect: Effect) -> Effects {
    match loss(state) {
        Some(reason) => ask(state, question, reason, effect),
        None => consequence::carry_out(state, Consequence::Effect(effect)),
    }
}

/// Leaves the session; asks first if something would be lost.
pub fn leave(state: &mut State) -> Effects {
    guarded(
        state,
        text!("ask-leave"),
        Effect::Session(SessionEffect::Leave),
    )
}

/// A text that describes the loss if the session ended now; `None` if nothing would be lost.
pub fn loss(state: &State) -> Option<Text> {
    let session = &state.session;
    // A mission that has not begun is only cancelled.
    let is_mission = matches!(session.activity, Some(Activity::Mission { .. }));
    let is_waiting = session.is_starting() || (is_mission && !session.has_flight_begun());
    let has_not_begun = is_waiting && session.armed() == 0;
    if session.task.over || session.activity.is_none() || has_not_begun || state.replay.is_some() {
        return None;
    }
    let count = session.armed();
    let armed = (count > 0).then(|| text!("ask-armed", count = count));
    let mission = session.task.progress.is_some().then(|| mission_loss(state));
    let reasons: Vec<Text> = mission.into_iter().chain(armed).collect();
    (!reasons.is_empty()).then(|| Text::joined("; ", reasons))
}

/// What the end of a mission that is not over means.
fn mission_loss(state: &State) -> Text {
    match state.session.activity {
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

/// Asks for a confirmation of an effect.
pub fn ask(state: &mut State, question: Text, reason: Text, effect: Effect) -> Effects {
    state.ask(question, reason, Consequence::Effect(effect));
    Effects::none()
}
