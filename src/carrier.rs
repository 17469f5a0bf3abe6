//! Carriers of a class: they bring lines from seats to the desk and back, and say who is at the other end.
//!
//! A carrier makes a [`DeskPort`] at the desk and a [`SeatPort`] at a seat. Everything above the ports is the same for
//! all carriers, and so are the tests. Whoever uses a port waits only for what arrives. What is sent goes to a bounded
//! queue: if that is full, the message is not taken, and the caller offers a newer one later.
//!
//! # How the parts fit
//! - `ports` are the two ends as the console sees them. `exchange` moves lines between a stream and a port.
//! - [`unix`] is the carrier on one host: a Unix socket in a folder of the instructor.
//! - `socket` opens Unix sockets, also for the interface for programs. [`lines`] reads lines up to a limit.

mod exchange;
pub mod lines;
mod place;
mod ports;
pub mod socket;
pub mod unix;

#[cfg(test)]
mod tests;

pub use place::{ClassFault, ClassPlace, own_user_name};
pub use ports::{CarrierPeer, DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort};
