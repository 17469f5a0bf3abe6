//! sortie: a terminal ground-control and training console for drone swarms.
pub mod geo;
pub mod link;
pub mod notice;
pub mod sim;
pub mod vehicle;
pub mod wire;
