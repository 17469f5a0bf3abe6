//! Sharing the console's links with other ground stations: the routes of frames, and the stations'
//! commands.
//!
//! Pure: the transports are in [`link`](crate::link), whose relay consults a [`Router`] for every
//! frame.

mod answers;
mod commands;
mod routes;
mod spec;
mod stray;
#[cfg(test)]
mod tests;
mod watch;

pub use commands::{Deed, NamedCommand, deed_of};
pub use routes::{FrameFacts, Port, Reach, Route, Router, receiver_of};
pub use spec::{ForwardFault, ForwardSpec};
pub use stray::SentCommands;
pub use watch::StationWatch;
