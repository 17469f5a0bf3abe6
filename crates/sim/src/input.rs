//! What enters a world, to step it again with the same outcome.

use super::Serial;

/// Something that has entered a [`World`](super::World).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// The steps that the world had made before.
    pub step: u64,
    /// The vehicle, counted from 0.
    pub vehicle: usize,
    /// The number of the connection: the world counts them from 0, over all vehicles.
    pub connection: u64,
    /// What came by the connection, or became of it.
    pub what: InputKind,
}

/// What came by a connection, or became of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum InputKind {
    /// A ground station was attached to a serial port.
    Connected(Serial),
    /// It was detached.
    Disconnected,
    /// It sent these bytes.
    Bytes(Vec<u8>),
}
