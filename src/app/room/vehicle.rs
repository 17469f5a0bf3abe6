//! Everything about one vehicle: the one under the cursor of the swarm.

use crossterm::event::KeyCode;

use crate::app::action::{Action, Step};
use crate::app::effect::Effect;
use crate::app::keymap::{Press, Row, does, key};
use crate::app::room::fly;
use crate::app::state::{State, Window};

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Vehicle {
    /// How far back its curves reach.
    pub window: Window,
    /// Which page is shown where the screen is too small for everything at once; it is counted round.
    pub page: usize,
}

/// Its keys.
pub const KEYS: &[Row] = &[
    does(key('['), Action::PreviousVehicle),
    does(key(']'), Action::NextVehicle),
    does(key('w'), Action::Window),
    does(Press::Plain(KeyCode::Tab), Action::NextPage),
];

/// What its actions do.
pub fn act(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    let room = &mut state.rooms.vehicle;
    match action {
        Action::NextVehicle => fly::move_cursor(state, Step::Down),
        Action::PreviousVehicle => fly::move_cursor(state, Step::Up),
        Action::Window => room.window = room.window.next(),
        Action::NextPage => room.page = room.page.wrapping_add(1),
        _ => return None,
    }
    Some(Vec::new())
}
