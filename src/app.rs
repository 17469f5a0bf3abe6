//! The console's mind: what it shows ([`state`]), what happened ([`event`]), what the user wants
//! ([`action`]), what the shell has to do ([`effect`]), and the one function that turns the second and third
//! into the first and fourth ([`update()`]).
//!
//! Nothing in here waits, reads a clock or touches a terminal: the run loop feeds events in, carries effects out
//! and draws when [`state::State::revision`] has moved.

pub mod action;
pub mod console;
pub mod effect;
pub mod event;
pub mod keymap;
pub mod lines;
pub mod room;
pub mod setting;
pub mod state;
mod update;

pub use update::update;
