//! sortie: a terminal ground-control and training console for drone swarms.

pub mod app;
pub mod commands;
pub mod debrief;
pub mod diagnostic;
pub mod geo;
pub mod language;
pub mod ledger;
pub mod messages;
pub mod mission;
pub mod notice;
pub mod scoring;
pub mod sim;
pub mod ui;
pub mod vehicle;
pub mod wire;
