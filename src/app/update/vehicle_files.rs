//! Lines about the files of vehicles that the room gives by itself.

use super::order;
use crate::app::State;
use crate::app::effect::Effects;
use crate::app::room::files;
use crate::vehicle::Severity;

/// Lists the folder on the screen, if it has not been listed since it last changed.
pub fn wanted(state: &mut State) -> Effects {
    match files::wanted(state) {
        Some(line) => give(state, &line),
        None => Effects::none(),
    }
}

/// Carries out a line, or asks before a dangerous one; a fault is reported on the last line.
pub fn give(state: &mut State, line: &str) -> Effects {
    match order::prepare(state, line) {
        Ok(order) => order::give(state, order),
        Err(fault) => {
            state.say(Severity::Warning, fault.message);
            Effects::none()
        }
    }
}
