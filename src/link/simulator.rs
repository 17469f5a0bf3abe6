//! Serves the embedded simulator, in real time, to pipes within this program and to sockets.
//!
//! One task does everything: it reads what ground stations sent, steps the world, and writes what the vehicles
//! answered, a hundred times a second. Sockets are polled rather than awaited, so that a world of many vehicles
//! costs one wake per step and not one per message.

use std::io;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::io::DuplexStream;
use tokio::net::{TcpListener, UdpSocket};
use tokio::task::{JoinHandle, coop::unconstrained, yield_now};
use tokio::time::{Instant, MissedTickBehavior, interval};
use tokio_util::sync::CancellationToken;

use super::connect::resolve;
use crate::sim::{STEP, World};
use crate::text::Text;

mod door;
#[cfg(test)]
mod tests;

use door::{Doors, PipeDoor, TcpDoor, UdpDoor};

/// Simulated ports are this far apart, as those of ArduPilot's SITL instances are.
const PORT_STRIDE: usize = 10;
/// How much a pipe holds in each direction.
const PIPE_LEN: usize = 64 * 1024;
/// Time that the machine did not give to the simulation is made up for up to this much at once; beyond it the
/// simulation falls behind real time instead of never catching up.
const CATCH_UP: Duration = Duration::from_millis(50);
/// The fastest pace.
const SPEEDUP_MAX: f64 = 1000.0;
/// At high speed, ground stations are served again after this many steps.
const STEPS_PER_ROUND: usize = 10;

/// How ground stations reach the vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Endpoint {
    /// One pipe per vehicle within this program.
    Pipes,
    /// A TCP server per vehicle, for many clients each: vehicle i (from 0) on `port + 10 * i`.
    Tcp {
        /// The local address to listen on.
        host: String,
        /// The first vehicle's port; 0 lets the system choose for each.
        port: u16,
    },
    /// All vehicles send to one ground station by UDP. They share one socket: a ground station that answers
    /// only the last address that it heard reaches them all.
    Udp {
        /// The ground station's name or IP address.
        host: String,
        /// The ground station's port.
        port: u16,
    },
}

/// Why the simulator could not start.
#[derive(Debug, thiserror::Error)]
pub enum SimulatorError {
    /// A port to listen on is taken.
    #[error("port {port} on {host} is in use: choose another with --tcp")]
    PortInUse {
        /// The address to listen on.
        host: String,
        /// The port.
        port: u16,
    },
    /// A port cannot be listened on for another reason.
    #[error("cannot listen on port {port} of {host} (see --tcp): {source}")]
    Listen {
        /// The address to listen on.
        host: String,
        /// The port.
        port: u16,
        /// Why.
        source: io::Error,
    },
    /// The last vehicle's port would be beyond 65535.
    #[error(
        "{vehicles} vehicles from port {port} on need ports beyond 65535: choose a lower one with --tcp"
    )]
    TooManyPorts {
        /// How many vehicles there are.
        vehicles: usize,
        /// The first vehicle's port.
        port: u16,
    },
    /// The ground station's address cannot be sent to.
    #[error("cannot send to {host}:{port} (see --udp): {reason}")]
    Send {
        /// The ground station's host.
        host: String,
        /// The ground station's port.
        port: u16,
        /// Why.
        reason: String,
    },
    /// The speed is no speed.
    #[error("a speedup of {0} is not possible: it must be a number above 0 and at most 1000")]
    Speedup(f64),
}

impl From<SimulatorError> for Text {
    /// What can go wrong lies in the options of a command line, which is English.
    fn from(error: SimulatorError) -> Self {
        Self::verbatim(error.to_string())
    }
}

/// The server of the embedded simulator.
#[derive(Debug)]
pub struct Simulator;

/// A simulator that runs.
#[derive(Debug)]
pub struct Started {
    /// One pipe per vehicle, in order, if they were asked for.
    pub pipes: Vec<DuplexStream>,
    /// Where the TCP servers listen, in the order of the vehicles.
    pub addresses: Vec<SocketAddr>,
    /// Ends when the simulator has been cancelled.
    pub task: JoinHandle<()>,
}

impl Simulator {
    /// Starts to run a world `speedup` times as fast as real time, until it is cancelled. Ground stations can
    /// connect once this has returned.
    ///
    /// # Errors
    /// A port that cannot be listened on, an address that cannot be sent to, or an impossible speedup; nothing
    /// runs then.
    pub async fn start(
        mut world: World,
        speedup: f64,
        endpoints: &[Endpoint],
        cancel: CancellationToken,
    ) -> Result<Started, SimulatorError> {
        if !(speedup > 0.0 && speedup <= SPEEDUP_MAX) {
            return Err(SimulatorError::Speedup(speedup));
        }
        let mut doors = Doors::default();
        let mut pipes = Vec::new();
        let mut addresses = Vec::new();
        for endpoint in endpoints {
            match endpoint {
                Endpoint::Pipes => pipes.extend(open_pipes(&mut doors, &mut world)),
                Endpoint::Tcp { host, port } => {
                    let opened = open_servers(&mut doors, world.vehicles(), host, *port).await?;
                    addresses.extend(opened);
                }
                Endpoint::Udp { host, port } => {
                    let socket = send_to(host, *port).await?;
                    doors.stations.push(UdpDoor::new(socket, &mut world));
                }
            }
        }
        // Without the exemption, tokio would make the sockets of late vehicles look idle in every round, after
        // those of early ones have used up the task's allowance.
        let task = tokio::spawn(unconstrained(run(world, speedup, doors, cancel)));
        Ok(Started {
            pipes,
            addresses,
            task,
        })
    }
}

/// Opens a pipe per vehicle and returns their other ends.
fn open_pipes(doors: &mut Doors, world: &mut World) -> Vec<DuplexStream> {
    (0..world.vehicles())
        .map(|vehicle| {
            let (ours, theirs) = tokio::io::duplex(PIPE_LEN);
            doors.pipes.push(PipeDoor::new(ours, vehicle, world));
            theirs
        })
        .collect()
}

/// Opens a TCP server per vehicle and returns where they listen.
async fn open_servers(
    doors: &mut Doors,
    vehicles: usize,
    host: &str,
    first_port: u16,
) -> Result<Vec<SocketAddr>, SimulatorError> {
    let mut addresses = Vec::new();
    for vehicle in 0..vehicles {
        let port = match first_port {
            0 => Some(0),
            _ => u16::try_from(usize::from(first_port) + PORT_STRIDE * vehicle).ok(),
        };
        let port = port.ok_or(SimulatorError::TooManyPorts {
            vehicles,
            port: first_port,
        })?;
        let (listener, address) = listen(host, port).await?;
        doors.servers.push(TcpDoor::new(listener, vehicle));
        addresses.push(address);
    }
    Ok(addresses)
}

async fn listen(host: &str, port: u16) -> Result<(TcpListener, SocketAddr), SimulatorError> {
    let bound = TcpListener::bind((host, port)).await;
    bound
        .and_then(|listener| listener.local_addr().map(|address| (listener, address)))
        .map_err(|source| {
            let host = host.to_owned();
            match source.kind() {
                io::ErrorKind::AddrInUse => SimulatorError::PortInUse { host, port },
                _ => SimulatorError::Listen { host, port, source },
            }
        })
}

async fn send_to(host: &str, port: u16) -> Result<UdpSocket, SimulatorError> {
    let failure = |reason: String| SimulatorError::Send {
        host: host.to_owned(),
        port,
        reason,
    };
    let target = resolve(host, port)
        .await
        .map_err(|reason| failure(reason.to_string()))?;
    let any = if target.is_ipv4() {
        "0.0.0.0:0"
    } else {
        "[::]:0"
    };
    let socket = UdpSocket::bind(any)
        .await
        .map_err(|error| failure(error.to_string()))?;
    // A connected socket hears nobody but the ground station.
    let connected = socket.connect(target).await;
    connected.map_err(|error| failure(error.to_string()))?;
    Ok(socket)
}

async fn run(mut world: World, speedup: f64, mut doors: Doors, cancel: CancellationToken) {
    let mut wake = interval(STEP);
    wake.set_missed_tick_behavior(MissedTickBehavior::Skip);
    let mut last = Instant::now();
    let mut owed = Duration::ZERO;
    loop {
        tokio::select! {
            () = cancel.cancelled() => return,
            _ = wake.tick() => {}
        }
        let now = Instant::now();
        // A vehicle that was given another pace sets it for all.
        let pace = world.wanted_speedup().unwrap_or(speedup).min(SPEEDUP_MAX);
        owed += (now - last).min(CATCH_UP).mul_f64(pace);
        last = now;
        doors.read(&mut world);
        let mut steps = 0;
        while owed >= STEP {
            owed -= STEP;
            world.step();
            steps += 1;
            if steps % STEPS_PER_ROUND == 0 {
                doors.write(&mut world);
                yield_now().await;
                if cancel.is_cancelled() {
                    return;
                }
                doors.read(&mut world);
            }
        }
        doors.write(&mut world);
    }
}
