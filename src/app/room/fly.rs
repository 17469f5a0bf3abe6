//! The swarm in flight.

use crate::app::action::Action;
use crate::app::effect::Effect;
use crate::app::keymap::{Row, writes};
use crate::app::state::State;

/// Its keys.
pub const KEYS: &[Row] = &[writes('h', "hold")];

/// What its actions do: nothing of their own.
pub fn act(_state: &mut State, _action: Action) -> Option<Vec<Effect>> {
    None
}
