//! Sharing the console's links with other ground stations: the routes of frames, and the stations'
//! commands.
//!
//! Pure: the transports are in [`link`](crate::link), whose relay consults a [`Router`] for every
//! frame.

mod commands;
mod routes;
mod spec;
mod stray;
#[cfg(test)]
mod tests;

pub use commands::{Deed, StationId, deed_of, station_of_ack};
pub use routes::{FrameFacts, Port, Reach, Route, Router, receiver_of};
pub use spec::{ForwardFault, ForwardSpec};
pub use stray::SentCommands;
