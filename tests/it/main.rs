//! The one integration-test binary.

mod console;
mod fixtures;
mod fleet;
mod harness;
mod layering;
mod missions;
mod recordings;
mod screens;
