//! What the server needs of a simulation.

use std::time::Duration;

/// A world of vehicles that speak MAVLink, stepped from outside. The embedded simulator's is the one that is
/// served; tests serve others that reboot or flood on demand.
pub trait Simulation: Send + 'static {
    /// A ground station's connection to one vehicle.
    type Port: Copy + Send;
    /// What one step advances the world by.
    const STEP: Duration;
    /// How many vehicles there are.
    fn vehicles(&self) -> usize;
    /// Attaches a ground station to a vehicle, counted from 0.
    fn connect(&mut self, vehicle: usize) -> Self::Port;
    /// Detaches it.
    fn disconnect(&mut self, port: Self::Port);
    /// Whether the vehicle still holds the connection; it does not after a reboot.
    fn is_open(&self, port: Self::Port) -> bool;
    /// Hands over what the ground station sent.
    fn receive(&mut self, port: Self::Port, bytes: &[u8]);
    /// Advances the world.
    fn step(&mut self);
    /// Appends what the vehicle sends, in whole frames. What is not taken is kept within bounds.
    fn take_output(&mut self, port: Self::Port, into: &mut Vec<u8>);
}
