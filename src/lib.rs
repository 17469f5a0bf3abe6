//! sortie: a terminal ground-control and training console for drone swarms.
pub mod commands;
pub mod debrief;
pub mod diagnostic;
pub mod geo;
pub mod ledger;
pub mod mission;
pub mod notice;
pub mod scoring;
pub mod vehicle;
pub mod wire;
