//! One file per room of the console.

use ratatui::buffer::Buffer;

use crate::app::State;
use crate::app::room_list::{Room, for_each_room};
use crate::ui::panel::Panel;

pub mod debrief;
pub mod files;
pub mod fly;
pub mod hangar;
pub mod home;
pub mod ledger;
pub mod links;
pub mod map;
pub mod messages;
pub mod mission;
pub mod parameters;
pub mod plans;
pub mod review;
mod site;
pub mod small;
pub mod standing;
pub mod vehicle;
pub mod workshop;

macro_rules! declare_drawing {
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Model:ty;)+) => {
        /// Draws the current room.
        pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
            match state.room() {
                $(Room::$Room => $module::draw(state, panel, buffer),)+
            }
        }
    };
}
for_each_room!(declare_drawing);
