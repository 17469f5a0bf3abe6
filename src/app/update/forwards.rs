//! Forwards: sharing the links with other ground stations.

use crate::app::State;
use crate::app::effect::{Effect, Effects, ForwardChange, SessionEffect};
use crate::app::state::{Activity, ForwardSummary, Room};
use crate::forward::ForwardSpec;
use crate::language::ForwardLine;
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Opens or closes a forward of the session.
///
/// # Errors
/// There is no session, the line names no valid forward, the forward is open already or does not exist, or a
/// mission would get a forward that is not read-only.
pub fn carry_out(state: &mut State, line: ForwardLine) -> Result<Effects, Text> {
    let Some(activity) = &state.session.activity else {
        return Err(text!("forward-no-session"));
    };
    let is_mission = is_mission(activity);
    let change = match line {
        ForwardLine::Add(words) => {
            let spec: ForwardSpec = words.parse().map_err(|fault| Text::from(&fault))?;
            if is_mission && !spec.read_only {
                return Err(text!("forward-mission"));
            }
            if is_open(state, &spec.address) {
                return Err(text!("forward-open-already", address = spec.address));
            }
            state.say(
                Severity::Notice,
                text!("forward-opened", forward = spec.to_string()),
            );
            ForwardChange::Open(spec)
        }
        ForwardLine::Remove(address) => {
            if !is_open(state, &address) {
                return Err(text!("forward-none-there", address = address));
            }
            state.say(
                Severity::Notice,
                text!("forward-closed", address = &address),
            );
            ForwardChange::Close(address)
        }
    };
    Ok(Effects::from(Effect::Session(SessionEffect::Forward(
        change,
    ))))
}

/// Stores the state of the forwards. In a mission, a notice names each forward whose stations have
/// sent messages, because these do not reach the vehicles.
pub fn changed(state: &mut State, forwards: Vec<ForwardSummary>) {
    let is_mission = state.session.activity.as_ref().is_some_and(is_mission);
    let before = std::mem::replace(&mut state.session.connections.forwards, forwards);
    let was_held = |name: &str| {
        let mut known = before.iter();
        known.any(|forward| forward.name == name && forward.held_back > 0)
    };
    let now = state.session.connections.forwards.iter();
    let held = now.filter(|forward| forward.held_back > 0 && !was_held(&forward.name));
    let notices: Vec<Notice> = held
        .filter(|_| is_mission)
        .filter_map(|forward| {
            let address = forward.name.split(' ').next()?;
            let text = text!("forward-listens", address = address);
            Some(Notice::general(state.now, Severity::Warning, text))
        })
        .collect();
    if state.room == Room::Links || !notices.is_empty() {
        state.touch();
    }
    for notice in notices {
        state.notices.push(notice);
    }
}

fn is_mission(activity: &Activity) -> bool {
    matches!(activity, Activity::Mission { .. })
}

fn is_open(state: &State, address: &str) -> bool {
    let forwards = state.session.connections.forwards.iter();
    forwards
        .filter_map(|forward| forward.name.split(' ').next())
        .any(|open| open == address)
}
