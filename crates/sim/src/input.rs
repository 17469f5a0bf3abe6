//! The inputs of a world, from which it can be repeated exactly.

use super::Serial;

/// One input of a [`World`](super::World).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// The number of steps that the world had made before.
    pub step: u64,
    /// The vehicle, counted from 0.
    pub vehicle: usize,
    /// The number of the connection: the world counts them from 0, over all vehicles.
    pub connection: u64,
    /// The content of the input.
    pub what: InputKind,
}

/// The kind of an input from a connection.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum InputKind {
    /// A ground station was attached to a serial port.
    Connected(Serial),
    /// The ground station was detached.
    Disconnected,
    /// The ground station sent these bytes.
    Bytes(Vec<u8>),
}
