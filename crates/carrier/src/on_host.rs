//! Connections on one host for lines of any kind: those of a class, or of a crew.

use super::fault::ClassFault;
use super::host::HostPlace;
use super::ports::{DeskPort, SeatPort};
use super::unix::{self, Message};

impl HostPlace {
    /// Opens the place for connections, on which the other side says messages of a kind.
    ///
    /// # Errors
    /// Its folder or its socket cannot be used.
    pub fn open<M: Message>(&self) -> Result<DeskPort<M>, ClassFault> {
        unix::open(self)
    }

    /// Connects to whoever has opened the place, and again whenever the connection ends.
    pub fn join<M: Message>(&self) -> SeatPort<M> {
        unix::join(self.clone())
    }
}
