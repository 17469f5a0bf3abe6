//! One file per room of the console.
//!
//! # How the parts fit
//! - Before and after a flight: `home`, with `site` (a sketch of a mission's area), `mission`, `debrief`, `review`,
//!   `standing`, `workshop`.
//! - In flight: `fly` (table, telemetry, ledger, notices), `map`, `vehicle`, `ledger`, `plans`, `parameters`,
//!   `files`.
//! - Around it: `class`.
//! - Behind it: `links`, `messages`, `hangar`. `small` is shown instead of any room if the terminal is too small.
//!
//! The behaviour of a room is in the file of the same name in `app::room`.

use ratatui::buffer::Buffer;

use crate::app::State;
use crate::app::room_list::{Room, for_each_room};
use crate::ui::panel::Panel;

pub mod class;
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
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Scope:ident, $Model:ty;)+) => {
        /// Draws the current room.
        pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
            match state.room() {
                $(Room::$Room => $module::draw(state, panel, buffer),)+
            }
        }
    };
}
for_each_room!(declare_drawing);
