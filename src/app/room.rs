//! The rooms of the console. A room remembers something ([`Rooms`]), has keys, and gives actions a meaning
//! ([`RoomModel`]); what concerns more than the room, it asks for ([`RoomRequest`]).

use super::action::Action;
use super::keymap::{KeyHint, KeyRow};
use super::room_list::for_each_room;
use super::state;

mod context;
pub mod debrief;
pub mod fly;
mod footer_keys;
pub mod hangar;
pub mod home;
mod keys;
pub mod ledger;
pub mod links;
pub mod map;
pub mod messages;
pub mod mission;
pub mod parameters;
mod request;
pub mod standing;
pub mod vehicle;
pub mod workshop;

pub use super::room_list::Room;
pub use request::RoomRequest;

/// Everything that the console shows.
pub type State = state::State<Rooms>;

/// What a room remembers, and how it answers keys.
pub trait RoomModel: Default {
    const KEYS: &'static [KeyRow];

    /// What the last line of the screen says about keys.
    fn hints(state: &State) -> &'static [KeyHint];

    /// Does an action in the room; `None` where the action means what it means everywhere.
    fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>>;

    /// The room is entered.
    fn entered(_state: &mut State) {}

    /// Shows only the lines that contain a text.
    fn filter(_state: &mut State, _text: &str) {}

    /// Forgets what belongs to the session that has ended.
    fn forget_session(&mut self) {
        *self = Self::default();
    }
}

/// What a room does, without its type.
struct RoomBehaviour {
    keys: &'static [KeyRow],
    hints: fn(&State) -> &'static [KeyHint],
    act: fn(&mut State, Action) -> Option<Vec<RoomRequest>>,
    entered: fn(&mut State),
    filter: fn(&mut State, &str),
}

impl RoomBehaviour {
    const fn of<M: RoomModel>() -> Self {
        Self {
            keys: M::KEYS,
            hints: M::hints,
            act: M::act,
            entered: M::entered,
            filter: M::filter,
        }
    }
}

macro_rules! declare_models {
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Model:ty;)+) => {
        /// What every room remembers. It survives leaving the room.
        #[derive(Debug, Clone, Default)]
        pub struct Rooms {
            $($(#[$about])* pub(in crate::app) $module: $Model,)+
        }

        impl Rooms {
            $($(#[$about])* pub fn $module(&self) -> &$Model {
                &self.$module
            })+

            /// Forgets what belongs to the session that has ended.
            pub fn forget_session(&mut self) {
                $(self.$module.forget_session();)+
            }
        }

        const fn behaviour(room: Room) -> RoomBehaviour {
            match room {
                $(Room::$Room => RoomBehaviour::of::<$Model>(),)+
            }
        }
    };
}
for_each_room!(declare_models);

/// The keys that a room has of its own.
pub const fn keys(room: Room) -> &'static [KeyRow] {
    behaviour(room).keys
}

/// What the last line of the screen says about keys in the room that is shown.
pub fn hints(state: &State) -> impl Iterator<Item = KeyHint> {
    let all = (behaviour(state.room).hints)(state).iter().copied();
    all.filter(|&hint| footer_keys::is_of_use(state, hint))
}

/// Does an action in the room that is shown; `None` where the action means what it means everywhere.
pub fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
    (behaviour(state.room).act)(state, action)
}

/// A room is entered.
pub fn entered(state: &mut State, room: Room) {
    (behaviour(room).entered)(state);
}

/// Shows only the lines of a room that contain a text.
pub fn filter(state: &mut State, room: Room, text: &str) {
    (behaviour(room).filter)(state, text);
}
