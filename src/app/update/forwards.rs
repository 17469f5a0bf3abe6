//! Forwards: sharing the links with other ground stations.

use crate::app::State;
use crate::app::effect::{Effect, Effects, ForwardChange, SessionEffect};
use crate::app::state::Activity;
use crate::forward::ForwardSpec;
use crate::language::ForwardLine;
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
    let is_mission = matches!(activity, Activity::Mission { .. });
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

fn is_open(state: &State, address: &str) -> bool {
    let forwards = state.session.connections.forwards.iter();
    forwards
        .filter_map(|forward| forward.name.split(' ').next())
        .any(|open| open == address)
}
