//! The one integration-test binary.

mod arducopter;
mod command_line;
mod console;
mod fixtures;
mod fleet;
mod harness;
mod layering;
mod missions;
mod pty;
mod recordings;
mod screens;
mod terminal;
mod terminals;
mod texts;
