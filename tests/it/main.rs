//! The one integration-test binary.

mod console;
mod fixtures;
mod fleet;
mod harness;
mod layering;
mod recordings;
mod screens;
