//! The rooms of the console. A room has state ([`Rooms`]), keys, and a behaviour for actions ([`RoomModel`]); changes
//! beyond the room are requests ([`RoomRequest`]). The actions of a single room go only to that room.
//!
//! # How the parts fit
//! - Before and after a flight: `home` (what to fly), `mission` (brief and objectives), `debrief`, `review`,
//!   `standing`, `workshop`.
//! - In flight: `fly` (the table), `map`, `vehicle`, `ledger`, `plans` (drafts), `parameters` and `files` of a
//!   vehicle.
//! - Around it: `class` (the seats of an instructor's desk).
//! - Behind it: `links` and `messages` (the traffic), `hangar` (the processes).
//! - What several rooms use: `keys` and `footer_keys` (default keys, and hints), `page` (text with meaning),
//!   `context` (views of the state that need the rooms), `request` (what a room asks of the console).

use super::action::{Action, SelectAction, StartAction, Step, ViewAction};
use super::keymap::{KeyHint, KeyRow};
use super::room_list::for_each_room;
use super::state;

pub mod class;
mod context;
pub mod debrief;
pub mod files;
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
pub mod page;
pub mod parameters;
pub mod plans;
mod request;
pub mod review;
pub mod standing;
pub mod vehicle;
pub mod workshop;

pub use super::room_list::Room;
pub use request::RoomRequest;

/// Everything that the console shows.
pub type State = state::State<Rooms>;

/// The result of an action in a room: the requests it causes, or `None` if the room leaves the
/// action to the console.
pub type Answer = Option<Vec<RoomRequest>>;

/// A room's state and behaviour.
pub trait RoomModel: Default {
    const KEYS: &'static [KeyRow];

    /// The key hints on the last line of the screen.
    fn hints(state: &State) -> &'static [KeyHint];

    /// Moves the cursor, or scrolls.
    fn step(_state: &mut State, _step: Step) -> Answer {
        None
    }

    /// Chooses the item under the cursor.
    fn submit(_state: &mut State) -> Answer {
        None
    }

    /// Reverses the last opening, selection or filter.
    fn escape(_state: &mut State) -> Answer {
        None
    }

    /// Changes how the list is shown.
    fn view(_state: &mut State, _action: ViewAction) -> Answer {
        None
    }

    fn select(_state: &mut State, _action: SelectAction) -> Answer {
        None
    }

    /// Flies the mission under the cursor as an exam, for practice or with the seed of the day, or
    /// flies its drill.
    fn start(_state: &mut State, _action: StartAction) -> Answer {
        None
    }

    /// Called when the room is entered.
    fn entered(_state: &mut State) {}

    /// Shows only the lines that contain a text.
    fn filter(_state: &mut State, _text: &str) {}

    /// Drops the state of the session that has ended.
    fn forget_session(&mut self) {
        *self = Self::default();
    }
}

/// The functions of a [`RoomModel`] as pointers, so rooms can be looked up at run time.
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
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Scope:ident, $Model:ty;)+) => {
        /// The state of every room. It is kept when the user leaves the room.
        #[derive(Debug, Clone, Default)]
        pub struct Rooms {
            $($(#[$about])* pub(in crate::app) $module: $Model,)+
        }

        impl Rooms {
            $($(#[$about])* pub fn $module(&self) -> &$Model {
                &self.$module
            })+

            /// Drops the state of the session that has ended.
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

/// A room's own keys.
pub const fn keys(room: Room) -> &'static [KeyRow] {
    behaviour(room).keys
}

/// The key hints of the current room.
pub fn hints(state: &State) -> impl Iterator<Item = KeyHint> {
    let all = (behaviour(state.room).hints)(state).iter().copied();
    all.filter(|&hint| footer_keys::is_of_use(state, hint))
}

/// Performs an action in the current room.
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
        Action::Files(action) => Room::Files.alone(state, |it| files::act(it, action)),
        Action::Plans(action) => Room::Plans.alone(state, |it| plans::act(it, action)),
        Action::Draw(action) => Room::Plans.alone(state, |it| plans::draw(it, action)),
        Action::Messages(action) => {
            Room::Messages.alone(state, |it| messages::act::act(it, action))
        }
        Action::Hangar(action) => Room::Hangar.alone(state, |it| hangar::act(it, action)),
        Action::Class(action) => Room::Class.alone(state, |it| class::act(it, action)),
        Action::Workshop(action) => {
            Room::Workshop.alone(state, |it| workshop::act::act(it, action))
        }
        Action::Show(_)
        | Action::TakeSticks
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
    /// Performs an action that only one room has, if that room is the current one.
    fn alone(self, state: &mut State, act: impl FnOnce(&mut State) -> Vec<RoomRequest>) -> Answer {
        (state.room == self).then(|| act(state))
    }
}

/// Calls the entry hook of a room.
pub fn entered(state: &mut State, room: Room) {
    (behaviour(room).entered)(state);
}

/// Shows only the lines of a room that contain a text.
pub fn filter(state: &mut State, room: Room, text: &str) {
    (behaviour(room).filter)(state, text);
}
