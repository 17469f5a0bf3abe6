//! The one integration-test binary.

mod console;
mod fixtures;
mod harness;
mod screens;
