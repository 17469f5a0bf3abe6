//! Everything about one vehicle: the one under the cursor of the swarm.

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::fly;
use crate::app::room::{Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::Window;

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Vehicle {
    /// How far back its curves reach.
    pub(in crate::app) window: Window,
    /// Which page is shown where the screen is too small for everything at once; it is counted round.
    pub(in crate::app) page: usize,
}

impl Vehicle {
    /// How far back its curves reach.
    pub fn window(&self) -> Window {
        self.window
    }

    /// Which page is shown where the screen is too small for everything at once; it is counted round.
    pub fn page(&self) -> usize {
        self.page
    }
}

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(
        &[Action::PreviousVehicle, Action::NextVehicle],
        "hint-vehicle",
    ),
    hint(&[Action::Window], "hint-window"),
    hint(&[Action::NextPage], "hint-page"),
    hint(&[Action::Toggle], "hint-select"),
    hint(&[Action::Show(Room::Parameters)], "room-parameters"),
    hint(&[Action::Show(Room::Map)], "room-map"),
    hint(&[Action::Show(Room::Fly)], "room-fly"),
];

impl RoomModel for Vehicle {
    const KEYS: &'static [KeyRow] = &[
        does(key('['), Action::PreviousVehicle),
        does(key(']'), Action::NextVehicle),
        does(key('w'), Action::Window),
        does(Press::Plain(KeyCode::Tab), Action::NextPage),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
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
}
