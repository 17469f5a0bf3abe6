//! The room of that name.

use crate::app::action::Action;
use crate::app::effect::Effect;
use crate::app::keymap::Row;
use crate::app::state::State;

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Mission {}

/// Its keys.
pub const KEYS: &[Row] = &[];

/// What its actions do.
pub fn act(_state: &mut State, _action: Action) -> Option<Vec<Effect>> {
    None
}
