//! sortie: a terminal ground-control and training console for drone swarms.
pub mod commands;
pub mod diagnostic;
pub mod geo;
pub mod language;
pub mod ledger;
pub mod notice;
pub mod vehicle;
pub mod wire;
