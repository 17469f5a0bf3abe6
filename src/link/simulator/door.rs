//! The ways into a simulated world. None of them ever waits.

use std::io;

use futures_util::FutureExt as _;
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream};
use tokio::net::{TcpListener, TcpStream, UdpSocket};

use crate::link::tlog::frame_len;
use crate::sim::{PortId, World};

/// Clients per vehicle; further ones are turned away.
const CLIENT_CAP: usize = 16;
const READ_LEN: usize = 4096;
/// How often a door is read per round, so that nobody can keep the world from being stepped by talking.
const READS_PER_ROUND: usize = 16;
/// What surely fits into one UDP packet of an Ethernet.
const DATAGRAM_LEN: usize = 1400;

/// All ways into a world.
#[derive(Default)]
pub(super) struct Doors {
    pub(super) pipes: Vec<PipeDoor>,
    pub(super) servers: Vec<TcpDoor>,
    pub(super) stations: Vec<UdpDoor>,
}

impl Doors {
    /// Gives the world what has come.
    pub(super) fn read(&mut self, world: &mut World) {
        self.pipes.retain_mut(|pipe| pipe.0.read(world));
        for server in &mut self.servers {
            server.accept(world);
            server.clients.retain_mut(|client| client.read(world));
        }
        for station in &mut self.stations {
            station.read(world);
        }
    }

    /// Sends what the world has to say, as far as there is room.
    pub(super) fn write(&mut self, world: &mut World) {
        self.pipes.retain_mut(|pipe| pipe.write(world));
        for server in &mut self.servers {
            server.clients.retain_mut(|client| client.write(world));
        }
        for station in &mut self.stations {
            station.write(world);
        }
    }
}

/// A byte stream that can be tried without waiting.
pub(super) trait Stream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize>;
    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize>;
}

impl Stream for DuplexStream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let tried = self.read(buffer).now_or_never();
        tried.unwrap_or(Err(io::ErrorKind::WouldBlock.into()))
    }

    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let tried = self.write(bytes).now_or_never();
        tried.unwrap_or(Err(io::ErrorKind::WouldBlock.into()))
    }
}

impl Stream for TcpStream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        TcpStream::try_read(self, buffer)
    }

    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        TcpStream::try_write(self, bytes)
    }
}

/// One ground station on one vehicle.
pub(super) struct Client<S> {
    stream: S,
    port: PortId,
    /// Taken from the world and not sent yet. Refilled only when empty: for a client that does not read,
    /// the world itself keeps what it thinks worth keeping.
    output: Vec<u8>,
}

impl<S: Stream> Client<S> {
    fn new(stream: S, port: PortId) -> Self {
        Self {
            stream,
            port,
            output: Vec::new(),
        }
    }

    /// Returns whether the client is still there.
    fn read(&mut self, world: &mut World) -> bool {
        let mut buffer = [0; READ_LEN];
        for _ in 0..READS_PER_ROUND {
            match self.stream.try_read(&mut buffer) {
                Ok(len) if len > 0 => world.receive(self.port, &buffer[..len]),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                _ => {
                    world.disconnect(self.port);
                    return false;
                }
            }
        }
        true
    }

    /// Returns whether the connection stands: the vehicle ends it by a reboot. A client that has gone is
    /// noticed when it is read.
    fn write(&mut self, world: &mut World) -> bool {
        self.flush();
        if self.output.is_empty() {
            world.take_output(self.port, &mut self.output);
            self.flush();
        }
        let is_open = world.is_open(self.port);
        if !is_open {
            world.disconnect(self.port);
        }
        is_open
    }

    fn flush(&mut self) {
        while !self.output.is_empty() {
            match self.stream.try_write(&self.output) {
                Ok(count) if count > 0 => drop(self.output.drain(..count)),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return,
                _ => self.output.clear(),
            }
        }
    }
}

/// A pipe to one vehicle. It outlasts the vehicle's reboots.
pub(super) struct PipeDoor(Client<DuplexStream>, usize);

impl PipeDoor {
    pub(super) fn new(stream: DuplexStream, vehicle: usize, world: &mut World) -> Self {
        Self(Client::new(stream, world.connect(vehicle)), vehicle)
    }

    fn write(&mut self, world: &mut World) -> bool {
        if !self.0.write(world) {
            self.0.port = world.connect(self.1);
        }
        true
    }
}

/// A TCP server for one vehicle.
pub(super) struct TcpDoor {
    listener: TcpListener,
    vehicle: usize,
    clients: Vec<Client<TcpStream>>,
}

impl TcpDoor {
    pub(super) fn new(listener: TcpListener, vehicle: usize) -> Self {
        Self {
            listener,
            vehicle,
            clients: Vec::new(),
        }
    }

    fn accept(&mut self, world: &mut World) {
        // A failure to accept is the client's loss and passes, or is met again in the next round.
        while let Some(Ok((stream, _))) = self.listener.accept().now_or_never() {
            if self.clients.len() >= CLIENT_CAP {
                continue;
            }
            // Without it answers are late, not lost.
            let _ = stream.set_nodelay(true);
            let port = world.connect(self.vehicle);
            self.clients.push(Client::new(stream, port));
        }
    }
}

/// One UDP socket between all vehicles and a ground station.
pub(super) struct UdpDoor {
    socket: UdpSocket,
    ports: Vec<PortId>,
    output: Vec<u8>,
}

impl UdpDoor {
    pub(super) fn new(socket: UdpSocket, world: &mut World) -> Self {
        let ports = (0..world.vehicles()).map(|v| world.connect(v)).collect();
        Self {
            socket,
            ports,
            output: Vec::new(),
        }
    }

    /// Every vehicle hears everything, as on a radio; each obeys what is addressed to it.
    fn read(&mut self, world: &mut World) {
        let mut buffer = [0; READ_LEN];
        for _ in 0..READS_PER_ROUND {
            match self.socket.try_recv(&mut buffer) {
                Ok(len) => {
                    for &port in &self.ports {
                        world.receive(port, &buffer[..len]);
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                // Nobody listens there yet.
                Err(_) => {}
            }
        }
    }

    fn write(&mut self, world: &mut World) {
        self.output.clear();
        for (vehicle, port) in self.ports.iter_mut().enumerate() {
            world.take_output(*port, &mut self.output);
            if !world.is_open(*port) {
                world.disconnect(*port);
                *port = world.connect(vehicle);
            }
        }
        for datagram in datagrams(&self.output) {
            // What does not go out now is lost, as it may be with UDP.
            let _ = self.socket.try_send(datagram);
        }
    }
}

/// Cuts a run of whole frames into datagrams of whole frames.
fn datagrams(mut frames: &[u8]) -> impl Iterator<Item = &[u8]> {
    std::iter::from_fn(move || {
        let mut len = 0;
        while let Some(&[start, payload_len, flags, ..]) = frames.get(len..) {
            let next = len + frame_len(start, payload_len, flags);
            if len > 0 && next > DATAGRAM_LEN {
                break;
            }
            len = next.min(frames.len());
        }
        let (datagram, rest) = frames.split_at_checked(len)?;
        frames = rest;
        (len > 0).then_some(datagram)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::{Encoder, Outgoing};

    #[test]
    fn datagrams_hold_whole_frames_and_lose_none() {
        let mut encoder = Encoder::new(1, 1);
        let mut bytes = Vec::new();
        let mut ends = vec![0];
        for len in (1..=255).chain([255; 40]) {
            let payload = vec![0x5A; len];
            encoder.encode(&Outgoing::Raw { id: 253, payload }, &mut bytes);
            ends.push(bytes.len());
        }
        let mut position = 0;
        for datagram in datagrams(&bytes) {
            assert!(datagram.len() <= DATAGRAM_LEN);
            position += datagram.len();
            assert!(ends.contains(&position), "cut inside a frame at {position}");
        }
        assert_eq!(position, bytes.len());
    }
}
