//! The transports of a simulated world. None of them ever blocks.

use std::io;
use std::pin::Pin;
use std::sync::Arc;

use futures_util::FutureExt as _;
use futures_util::stream::{FuturesUnordered, StreamExt as _};
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream};
use tokio::net::{TcpListener, TcpStream, UdpSocket};

use crate::sim::{PortId, Serial, World};
use crate::wire::frame_len;

/// The maximum number of clients per TCP port; others are refused.
const CLIENT_CAP: usize = 16;
/// The maximum number of clients accepted per round, so that connecting cannot stop the simulation.
const ACCEPTS_PER_ROUND: usize = 64;
const READ_LEN: usize = 4096;
/// The maximum number of reads of a stream per round, so that sending cannot stop the simulation; far above the fastest
/// serial port.
const READS_PER_ROUND: usize = 4;
const DATAGRAMS_PER_ROUND: usize = 16;
/// The capacity above which a buffer is freed once it is empty.
const OUTPUT_KEPT: usize = 4096;
/// The number of bytes that are sure to fit into one UDP packet on Ethernet.
const DATAGRAM_LEN: usize = 1400;

/// All transports of a world.
pub(super) struct Transports {
    pub(super) pipes: Vec<PipeTransport>,
    pub(super) servers: Servers,
    pub(super) stations: Vec<UdpTransport>,
    input: Box<[u8; READ_LEN]>,
}

impl Default for Transports {
    fn default() -> Self {
        Self {
            pipes: Vec::new(),
            servers: Servers::default(),
            stations: Vec::new(),
            input: Box::new([0; READ_LEN]),
        }
    }
}

impl Transports {
    /// Passes received bytes to the world.
    pub(super) fn read(&mut self, world: &mut World) {
        let input = self.input.as_mut_slice();
        self.pipes.retain_mut(|pipe| pipe.0.read(world, input));
        self.servers.accept(world);
        self.servers.read(world, input);
        for station in &mut self.stations {
            station.read(world, input);
        }
    }

    /// Drops what waits on the way to the world, and from it to pipes.
    pub(super) fn drop_traffic(&mut self, world: &mut World) {
        self.read(world);
        for pipe in &mut self.pipes {
            pipe.0.output.clear();
        }
    }

    /// Sends as much of the world's output as there is room for.
    pub(super) fn write(&mut self, world: &mut World) {
        self.pipes.retain_mut(|pipe| pipe.write(world));
        self.servers.write(world);
        for station in &mut self.stations {
            station.write(world);
        }
    }
}

/// A non-blocking byte stream.
pub(super) trait ClientStream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize>;
    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize>;
}

impl ClientStream for DuplexStream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let tried = self.read(buffer).now_or_never();
        tried.unwrap_or(Err(io::ErrorKind::WouldBlock.into()))
    }

    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let tried = self.write(bytes).now_or_never();
        tried.unwrap_or(Err(io::ErrorKind::WouldBlock.into()))
    }
}

impl ClientStream for TcpStream {
    fn try_read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        TcpStream::try_read(self, buffer)
    }

    fn try_write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        TcpStream::try_write(self, bytes)
    }
}

/// One ground station on one vehicle.
pub(super) struct StreamClient<S> {
    stream: S,
    port: PortId,
    /// Output taken from the world and not sent yet. Refilled only when empty: for a client that does not read, the
    /// world itself decides what to keep.
    output: Vec<u8>,
}

impl<S: ClientStream> StreamClient<S> {
    fn new(stream: S, port: PortId) -> Self {
        Self {
            stream,
            port,
            output: Vec::new(),
        }
    }

    /// Reads from the client; returns whether it is still there.
    fn read(&mut self, world: &mut World, input: &mut [u8]) -> bool {
        for _ in 0..READS_PER_ROUND {
            match self.stream.try_read(input) {
                Ok(len) if len > 0 => world.receive(self.port, &input[..len]),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                _ => {
                    world.disconnect(self.port);
                    return false;
                }
            }
        }
        true
    }

    /// Writes to the client; returns whether the connection is open: the vehicle closes it with a
    /// reboot. A client that has gone is detected on reading.
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
        if self.output.capacity() > OUTPUT_KEPT {
            self.output = Vec::new();
        }
    }
}

/// A pipe to one vehicle. It outlasts the vehicle's reboots.
pub(super) struct PipeTransport(StreamClient<DuplexStream>, usize);

impl PipeTransport {
    pub(super) fn new(stream: DuplexStream, vehicle: usize, world: &mut World) -> Self {
        Self(StreamClient::new(stream, world.connect(vehicle)), vehicle)
    }

    fn write(&mut self, world: &mut World) -> bool {
        if !self.0.write(world) {
            self.0.port = world.connect(self.1);
        }
        true
    }
}

type Accepted = (usize, io::Result<TcpStream>);

/// The TCP servers and their clients. There may be thousands of servers: they are awaited rather than polled in turn.
#[derive(Default)]
pub(super) struct Servers {
    listeners: Vec<PortListener>,
    accepting: FuturesUnordered<Pin<Box<dyn Future<Output = Accepted> + Send>>>,
    /// The clients with the index of their listener.
    clients: Vec<(usize, StreamClient<TcpStream>)>,
}

/// A TCP server for one serial port of a vehicle.
struct PortListener {
    socket: Arc<TcpListener>,
    vehicle: usize,
    serial: Serial,
    clients: usize,
}

impl Servers {
    pub(super) fn open(&mut self, socket: TcpListener, vehicle: usize, serial: Serial) {
        self.listeners.push(PortListener {
            socket: Arc::new(socket),
            vehicle,
            serial,
            clients: 0,
        });
        self.await_client(self.listeners.len() - 1);
    }

    fn await_client(&mut self, place: usize) {
        if let Some(listener) = self.listeners.get(place) {
            let socket = Arc::clone(&listener.socket);
            let accept = async move { (place, socket.accept().await.map(|(stream, _)| stream)) };
            self.accepting.push(Box::pin(accept));
        }
    }

    fn accept(&mut self, world: &mut World) {
        for _ in 0..ACCEPTS_PER_ROUND {
            let Some(Some((place, accepted))) = self.accepting.next().now_or_never() else {
                return;
            };
            self.await_client(place);
            // A failure to accept is temporary, or occurs again in the next round.
            let (Ok(stream), Some(listener)) = (accepted, self.listeners.get_mut(place)) else {
                return;
            };
            if listener.clients < CLIENT_CAP {
                listener.clients += 1;
                // Without this option, answers are late, but not lost.
                let _ = stream.set_nodelay(true);
                let port = world.connect_to(listener.vehicle, listener.serial);
                self.clients.push((place, StreamClient::new(stream, port)));
            }
        }
    }

    fn read(&mut self, world: &mut World, input: &mut [u8]) {
        self.keep(|client| client.read(world, input));
    }

    fn write(&mut self, world: &mut World) {
        self.keep(|client| client.write(world));
    }

    fn keep(&mut self, mut is_there: impl FnMut(&mut StreamClient<TcpStream>) -> bool) {
        let listeners = &mut self.listeners;
        self.clients.retain_mut(|(place, client)| {
            let stays = is_there(client);
            if !stays && let Some(listener) = listeners.get_mut(*place) {
                listener.clients -= 1;
            }
            stays
        });
    }
}

/// One UDP socket between all vehicles and a ground station.
pub(super) struct UdpTransport {
    socket: UdpSocket,
    ports: Vec<PortId>,
    output: Vec<u8>,
}

impl UdpTransport {
    pub(super) fn new(socket: UdpSocket, world: &mut World) -> Self {
        let ports = (0..world.vehicles()).map(|v| world.connect(v)).collect();
        Self {
            socket,
            ports,
            output: Vec::new(),
        }
    }

    /// Every vehicle receives everything, as by radio, and obeys only the messages addressed to it.
    fn read(&mut self, world: &mut World, input: &mut [u8]) {
        for _ in 0..DATAGRAMS_PER_ROUND {
            match self.socket.try_recv(input) {
                Ok(len) => {
                    for &port in &self.ports {
                        world.receive(port, &input[..len]);
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => break,
                // No program is listening there yet.
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
            // Unsent datagrams are lost, as UDP allows.
            let _ = self.socket.try_send(datagram);
        }
    }
}

/// Cuts a run of whole frames into datagrams of whole frames.
fn datagrams(mut frames: &[u8]) -> impl Iterator<Item = &[u8]> {
    std::iter::from_fn(move || {
        let mut len = 0;
        let frame_at = |at: usize| frame_len(*frames.get(at..)?.first_chunk()?);
        while let Some(frame) = frame_at(len) {
            let next = len + frame;
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
