use super::Room;
use crate::app::effect::{Effect, Launch};
use crate::text::Text;

/// What a room asks for because it concerns more than the room.
#[derive(Debug, Clone, PartialEq)]
pub enum RoomRequest {
    /// The shell does something.
    Effect(Effect),
    /// The shell does something that ends the session; the question is asked where something would be lost.
    EndSession { question: Text, effect: Effect },
    /// A mission is started.
    Fly(Launch),
    /// The exam of the mission with this id is started.
    Exam(String),
    /// The command line opens with these words in it.
    Write(String),
    /// Another room is shown.
    Show(Room),
    /// The session is left.
    Leave,
    /// The program is left.
    Quit,
}

impl From<Effect> for RoomRequest {
    fn from(effect: Effect) -> Self {
        Self::Effect(effect)
    }
}
