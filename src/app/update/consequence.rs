//! Carries out actions that have been confirmed, or that need no confirmation.

use super::home::go_home;
use super::{batch, class, order};
use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::room::{plans, workshop};
use crate::app::state::Consequence;
use crate::text;
use crate::vehicle::Severity;

/// Carries out an action that has been confirmed, or that needs no confirmation.
pub fn carry_out(state: &mut State, consequence: Consequence) -> Effects {
    match consequence {
        Consequence::Order(order) => order::dispatch_confirmed(state, order),
        Consequence::Uploads(orders) => order::upload(state, orders),
        Consequence::CloseDraft => {
            plans::close(state);
            Effects::none()
        }
        Consequence::Effect(effect) => {
            if let Effect::Session(session) = &effect {
                announce(state, session);
            }
            Effects::from(effect)
        }
        Consequence::JoinClass => {
            class::join(state);
            Effects::none()
        }
        Consequence::BeginExam { exam, seats } => class::begin_exam(state, *exam, &seats),
        Consequence::EndExam => class::end_exam(state),
        Consequence::EndExamAndQuit => {
            let mut effects = class::end_exam(state);
            effects.extend(Effects::from(Effect::Quit));
            effects
        }
        Consequence::Instruct { seats, deed } => {
            class::instruct(state, &seats, &deed);
            Effects::none()
        }
        Consequence::ReplayHandedIn(found) => class::replay_found(state, found),
        Consequence::Parameters(settings) => batch::begin(state, settings),
        Consequence::Design(design) => {
            workshop::lay(state, design);
            Effects::none()
        }
    }
}

/// Applies those changes of the session that take effect before the shell has done its part.
fn announce(state: &mut State, effect: &SessionEffect) {
    match effect {
        SessionEffect::Leave => go_home(state),
        SessionEffect::StartMission(_) => {
            state.say(Severity::Info, text!("home-starting-mission"));
        }
        SessionEffect::StartFree => state.say(Severity::Info, text!("home-starting-simulator")),
        SessionEffect::StartArduPilot
        | SessionEffect::Connect(_)
        | SessionEffect::Forward(_)
        | SessionEffect::Radio { .. }
        | SessionEffect::Sticks { .. }
        | SessionEffect::Forget(_)
        | SessionEffect::Restart { .. }
        | SessionEffect::Process(..)
        | SessionEffect::Inject(_)
        | SessionEffect::Pause
        | SessionEffect::Continue
        | SessionEffect::Speedup(_)
        | SessionEffect::Replay { .. }
        | SessionEffect::Bookmark(_)
        | SessionEffect::Ghost(_)
        | SessionEffect::Abandon
        | SessionEffect::Situation(_)
        | SessionEffect::Stop => {}
    }
}
