//! The rooms of the console. A room remembers something ([`Rooms`]), has keys, and gives actions a meaning
//! ([`RoomModel`]); what concerns more than the room, it asks for ([`RoomRequest`]). The actions of one room alone go to
//! that room only.

use super::action::{Action, SelectAction, StartAction, Step, ViewAction};
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
pub mod review;
pub mod standing;
pub mod vehicle;
pub mod workshop;

pub use super::room_list::Room;
pub use request::RoomRequest;

/// Everything that the console shows.
pub type State = state::State<Rooms>;

/// What comes of an action in a room; `None` where the action means what it means everywhere.
pub type Answer = Option<Vec<RoomRequest>>;

/// What a room remembers, and how it answers keys.
pub trait RoomModel: Default {
    const KEYS: &'static [KeyRow];

    /// What the last line of the screen says about keys.
    fn hints(state: &State) -> &'static [KeyHint];

    /// The cursor moves, or the text scrolls.
    fn step(_state: &mut State, _step: Step) -> Answer {
        None
    }

    /// What is under the cursor is taken.
    fn submit(_state: &mut State) -> Answer {
        None
    }

    /// The last thing is taken back.
    fn escape(_state: &mut State) -> Answer {
        None
    }

    /// The list is shown otherwise.
    fn view(_state: &mut State, _action: ViewAction) -> Answer {
        None
    }

    /// Something else is selected.
    fn select(_state: &mut State, _action: SelectAction) -> Answer {
        None
    }

    /// The mission under the cursor is flown in another way.
    fn start(_state: &mut State, _action: StartAction) -> Answer {
        None
    }

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
    step: fn(&mut State, Step) -> Answer,
    submit: fn(&mut State) -> Answer,
    escape: fn(&mut State) -> Answer,
    view: fn(&mut State, ViewAction) -> Answer,
    select: fn(&mut State, SelectAction) -> Answer,
    start: fn(&mut State, StartAction) -> Answer,
    entered: fn(&mut State),
    filter: fn(&mut State, &str),
}

impl RoomBehaviour {
    const fn of<M: RoomModel>() -> Self {
        Self {
            keys: M::KEYS,
            hints: M::hints,
            step: M::step,
            submit: M::submit,
            escape: M::escape,
            view: M::view,
            select: M::select,
            start: M::start,
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

/// Does an action in the room that is shown.
pub fn act(state: &mut State, action: Action) -> Answer {
    let room = behaviour(state.room);
    match action {
        Action::Move(step) => (room.step)(state, step),
        Action::Submit => (room.submit)(state),
        Action::Escape => (room.escape)(state),
        Action::View(action) => (room.view)(state, action),
        Action::Select(action) => (room.select)(state, action),
        Action::Start(action) => (room.start)(state, action),
        Action::Debrief(action) => Room::Debrief.alone(state, |it| debrief::act(it, action)),
        Action::Map(action) => Room::Map.alone(state, |it| map::act::act(it, action)),
        Action::Ledger(action) => Room::Ledger.alone(state, |it| ledger::act(it, action)),
        Action::Parameters(action) => {
            Room::Parameters.alone(state, |it| parameters::act(it, action))
        }
        Action::Messages(action) => {
            Room::Messages.alone(state, |it| messages::act::act(it, action))
        }
        Action::Hangar(action) => Room::Hangar.alone(state, |it| hangar::act(it, action)),
        Action::Workshop(action) => {
            Room::Workshop.alone(state, |it| workshop::act::act(it, action))
        }
        Action::Show(_)
        | Action::CommandLine
        | Action::Help
        | Action::Notices
        | Action::Brief
        | Action::Again
        | Action::AgainAlike
        | Action::Profiles
        | Action::Aids
        | Action::PauseMission
        | Action::Faster
        | Action::UsualPace
        | Action::Replay(_)
        | Action::Abandon
        | Action::Leave
        | Action::Acknowledge
        | Action::Line(_)
        | Action::Quit => None,
    }
}

impl Room {
    /// Does what only this room knows, if it is the one that is shown.
    fn alone(self, state: &mut State, act: impl FnOnce(&mut State) -> Vec<RoomRequest>) -> Answer {
        (state.room == self).then(|| act(state))
    }
}

/// A room is entered.
pub fn entered(state: &mut State, room: Room) {
    (behaviour(room).entered)(state);
}

/// Shows only the lines of a room that contain a text.
pub fn filter(state: &mut State, room: Room, text: &str) {
    (behaviour(room).filter)(state, text);
}
