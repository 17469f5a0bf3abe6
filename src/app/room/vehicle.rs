//! The vehicle under the cursor of the swarm, in detail.

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, SelectAction, Step, ViewAction};
use crate::app::keymap::{ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::fly;
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::Window;

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Vehicle {
    /// The time span of the curves.
    pub(in crate::app) window: Window,
    /// The page shown if the screen is too small for everything, modulo the number of pages.
    pub(in crate::app) page: usize,
}

impl Vehicle {
    /// The time span of the curves.
    pub fn window(&self) -> Window {
        self.window
    }

    /// The page shown if the screen is too small for everything, modulo the number of pages.
    pub fn page(&self) -> usize {
        self.page
    }
}

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::BACK,
    hint(
        &[
            Action::View(ViewAction::PreviousVehicle),
            Action::View(ViewAction::NextVehicle),
        ],
        "hint-vehicle",
    ),
    hint(&[Action::View(ViewAction::Window)], "hint-window"),
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    hint(&[Action::Select(SelectAction::Toggle)], "hint-select"),
    hint(&[Action::Show(Room::Parameters)], "room-parameters"),
    hint(&[Action::Show(Room::Map)], "room-map"),
    hint(&[Action::Show(Room::Fly)], "room-fly"),
];

impl RoomModel for Vehicle {
    const KEYS: &'static [KeyRow] = &[
        does(key('['), Action::View(ViewAction::PreviousVehicle)),
        does(key(']'), Action::View(ViewAction::NextVehicle)),
        does(key('w'), Action::View(ViewAction::Window)),
        does(
            Press::Plain(KeyCode::Tab),
            Action::View(ViewAction::NextPage),
        ),
        does(ESCAPE, Action::Escape),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    /// Leaves the room, once no vehicles are typed or selected.
    fn escape(state: &mut State) -> Answer {
        let is_all_else_taken_back =
            state.typing.targets.is_empty() && state.session.choice.selection.is_empty();
        is_all_else_taken_back.then(|| vec![RoomRequest::Show(Room::Fly)])
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        let room = &mut state.rooms.vehicle;
        match action {
            ViewAction::NextVehicle => fly::move_cursor(state, Step::Down),
            ViewAction::PreviousVehicle => fly::move_cursor(state, Step::Up),
            ViewAction::Window => room.window = room.window.next(),
            ViewAction::NextPage => room.page = room.page.wrapping_add(1),
            ViewAction::Filter | ViewAction::Sort | ViewAction::SortReverse => return None,
        }
        Some(Vec::new())
    }
}
