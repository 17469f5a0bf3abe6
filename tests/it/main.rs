//! The one integration-test binary.

mod fixtures;
mod harness;
mod screens;
