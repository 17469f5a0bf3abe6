//! sortie: a terminal ground-control and training console for drone swarms.

pub mod app;
pub mod cli;
pub mod commands;
pub mod console;
pub mod debrief;
pub mod diagnostic;
pub mod fleet;
pub mod geo;
pub mod headless;
pub mod language;
pub mod ledger;
pub mod link;
pub mod messages;
pub mod mission;
pub mod notice;
pub mod scoring;
pub mod session;
pub mod sim;
pub mod store;
pub mod terminal;
pub mod ui;
pub mod vehicle;
pub mod wire;
