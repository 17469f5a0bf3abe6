//! Carriers of a class: they bring lines from seats to the desk and back, and say who is at the other end.
//!
//! [`DeskPlace::open`] makes a [`DeskPort`] at the desk, and [`ClassPlace::join`] a [`SeatPort`] at a seat. Everything
//! above the ports is the same for all carriers, and so are the tests. Whoever uses a port waits only for what arrives.
//! What is sent goes to a bounded queue: if that is full, the message is not taken, and the caller offers a newer one
//! later.
//!
//! A connection brings lines in order and without gaps until it ends. What was lost at its end is said again on the
//! next one: see [`sortie_class`].
//!
//! # How the parts fit
//! - `ports` are the two ends as the console sees them, `place` says where they are, and `fault` why they cannot be.
//! - `calling` connects a seat to its desk again and again, over either carrier.
//! - `unix` is the carrier on one host: a Unix socket in a folder of the instructor (`host`). `exchange` moves lines
//!   between a stream and a port. `on_host` opens and joins such a place for lines of another kind, those of a crew.
//! - `network` is the carrier on several machines, over Eclipse Zenoh (feature `zenoh`). A seat finds its desk with a
//!   [`JoinLine`] (`join_line`); `new_class` and `secret_file` are for the files of such a class.
//! - [`socket`] opens Unix sockets, also for the interface for programs. [`lines`] reads lines up to a limit.

mod address;
mod calling;
mod exchange;
mod fault;
mod host;
mod join_line;
pub mod lines;
#[cfg(feature = "zenoh")]
mod network;
mod new_class;
mod on_host;
mod place;
mod ports;
mod secret_file;
pub mod socket;
mod unix;

#[cfg(test)]
mod tests;

pub use address::{is_loopback, with_port};
pub use fault::{ClassFault, NetworkFault, StartFault, SystemError};
pub use host::{HostPlace, own_user_name};
pub use join_line::{JoinLine, JoinLineFault};
#[cfg(feature = "zenoh")]
pub use network::NetworkDesk;
pub use new_class::NewClass;
pub use place::{ClassPlace, DeskPlace, EVERY_ADDRESS, make_class, own_address, remove_seat};
pub use ports::{CarrierPeer, DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort};
