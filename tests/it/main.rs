//! The one integration-test binary.

mod fixtures;
mod fleet;
mod harness;
mod layering;
mod recordings;
mod screens;
