//! The one integration-test binary.

mod arducopter;
mod bench_scale;
mod clients;
mod command_line;
mod console;
mod determinism;
mod doctor;
mod fidelity;
mod fixtures;
mod fleet;
mod hangar;
mod harness;
mod inspector;
mod layering;
mod missions;
mod pty;
mod recordings;
mod screens;
mod settings;
mod simulator;
mod stand_in;
mod terminal;
mod terminals;
mod texts;
mod ukrainian;
