use super::Room;
use crate::app::effect::{Effect, Launch};
use crate::text::Text;

/// A request from a room for a change beyond the room.
#[derive(Debug, Clone, PartialEq)]
pub enum RoomRequest {
    /// Pass an effect to the shell.
    Effect(Effect),
    /// Pass an effect that ends the session to the shell, after a question if data would be lost.
    EndSession {
        question: Text,
        effect: Effect,
    },
    Fly(Launch),
    /// Start the exam of the mission with this id.
    Exam(String),
    /// Open the command line with this text.
    Write(String),
    /// Carry out this line, after a question if it needs one.
    Give(String),
    Show(Room),
    /// At a seat of a class: close what the desk shows.
    LookAway,
    Leave,
    Quit,
}

impl From<Effect> for RoomRequest {
    fn from(effect: Effect) -> Self {
        Self::Effect(effect)
    }
}
