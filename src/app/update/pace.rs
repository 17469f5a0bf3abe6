//! How fast simulated time passes: faster while nothing happens, as usual again once something does.

use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::event::{Event, SessionEvent, VehicleEvent};
use crate::app::state::{Activity, rate};
use crate::ledger::RowUpdate;
use crate::mission::Progress;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// How fast free flight may pass.
const FREE_FLIGHT_MOST: f64 = 100.0;
/// Every press of a key makes time pass so many times as fast.
const KEY_FACTOR: f64 = 2.0;

/// Twice as fast as now, as far as it may go.
pub fn faster(state: &mut State) -> Effects {
    let wanted = state.session.pace.now * KEY_FACTOR;
    let most = most(state).max(state.session.pace.usual);
    set(state, wanted.min(most))
}

/// As fast as the session began.
pub fn usual(state: &mut State) -> Effects {
    set(state, state.session.pace.usual)
}

/// Has time pass so many times as fast as the clock on the wall, where that is possible; says why where it is not.
pub fn set(state: &mut State, speedup: f64) -> Effects {
    match obstacle(state, speedup) {
        Some(reason) => {
            state.say(Severity::Notice, reason);
            Effects::none()
        }
        None => Effects::from(Effect::Session(SessionEffect::Speedup(speedup))),
    }
}

/// Time passes so fast from now on.
pub fn changed(state: &mut State, speedup: f64) {
    state.session.pace.now = speedup;
    let text = if state.session.pace.is_fast() {
        text!(
            "speedup-is",
            rate = rate(speedup),
            key = state.key(Action::UsualPace)
        )
    } else {
        text!("speedup-usual", rate = rate(speedup))
    };
    state.say(Severity::Notice, text);
}

/// How many alerts want to be noticed, if that matters now.
pub fn alerts(state: &State) -> Option<usize> {
    let pressing = || state.session.alarms.pressing();
    state
        .session
        .pace
        .is_fast()
        .then(|| pressing().map_or(0, |it| it.vehicles.len() + it.others))
}

/// Whether an event is a reason to look at what happens.
pub fn is_news(state: &State, event: &Event) -> bool {
    match event {
        Event::Vehicle(VehicleEvent::Row(row)) => ends_a_movement(state, row),
        Event::Session(SessionEvent::Mission(progress)) => has_something_to_say(state, progress),
        Event::Notice(notice) => notice.severity <= Severity::Warning,
        Event::Tick { .. }
        | Event::Terminal(_)
        | Event::Vehicle(_)
        | Event::Link(_)
        | Event::Process(_)
        | Event::Session(_)
        | Event::Career(_)
        | Event::File(_)
        | Event::NoticesDropped(_)
        | Event::Answer(_)
        | Event::Failed(_) => false,
    }
}

/// Lets time pass as usual again, because something has happened.
pub fn fall_back(state: &State) -> Effects {
    let usual = state.session.pace.usual;
    Effects::from(Effect::Session(SessionEffect::Speedup(usual)))
}

fn ends_a_movement(state: &State, row: &RowUpdate) -> bool {
    let entry = state.session.ledger.entry(row.entry);
    let moves = entry.is_some_and(|entry| entry.verb.movement.moves());
    row.state.is_failure() || (moves && row.state.is_final())
}

fn has_something_to_say(state: &State, progress: &Progress) -> bool {
    let known = state.session.mission.as_ref();
    known.is_some_and(|known| {
        let more_alerts = progress.alerts.len() > known.alerts.len();
        more_alerts || (progress.feedback.is_some() && progress.feedback != known.feedback)
    })
}

/// How fast time may pass.
fn most(state: &State) -> f64 {
    let listing = state.session.listing.as_ref();
    listing.map_or(FREE_FLIGHT_MOST, |listing| listing.most_speedup)
}

/// Why time cannot pass so fast.
fn obstacle(state: &State, speedup: f64) -> Option<Text> {
    let session = &state.session;
    match &session.activity {
        None => Some(text!("speedup-nothing")),
        _ if session.over => Some(text!("deed-over")),
        _ if session.hangar.is_some() => Some(text!("speedup-not-processes")),
        Some(Activity::Connected { .. }) => Some(text!("speedup-not-real")),
        Some(Activity::Free) => (speedup > FREE_FLIGHT_MOST)
            .then(|| text!("speedup-too-much", most = rate(FREE_FLIGHT_MOST))),
        Some(Activity::Mission { .. }) => {
            let (usual, most) = (session.pace.usual, most(state));
            if speedup < usual {
                Some(text!("speedup-too-little", least = rate(usual)))
            } else if speedup > most && most <= 1.0 {
                Some(text!("speedup-not-allowed"))
            } else {
                let is_too_much = speedup > most.max(usual);
                is_too_much.then(|| text!("speedup-too-much", most = rate(most)))
            }
        }
    }
}
