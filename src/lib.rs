//! sortie: a terminal ground-control and training console for drone swarms.
pub mod commands;
pub mod diagnostic;
pub mod geo;
pub mod ledger;
pub mod notice;
pub mod ui;
pub mod vehicle;
pub mod wire;
