//! Serves the embedded simulator, in real time, to pipes within this program and to sockets.
//!
//! One task does everything: it reads the ground stations' messages, steps the world, and writes
//! the vehicles' answers, a hundred times a second. Sockets are polled rather than awaited, so that
//! a world of many vehicles needs one wake per step, not one per message.

use std::io;
use std::net::SocketAddr;

use tokio::io::DuplexStream;
use tokio::net::UdpSocket;
use tokio::sync::watch;
use tokio::task::{JoinHandle, coop::unconstrained};
use tokio_util::sync::CancellationToken;

use super::connect::resolve;
use crate::record::InputsHead;
use crate::sim::World;
use crate::text::Text;

mod inputs;
mod listen;
mod places;
mod stepped;
#[cfg(test)]
mod tests;
mod transport;

pub use inputs::InputSink;
use inputs::WorldRecord;
use listen::open_servers;
pub use places::{TruePlace, TruePlaces};
use stepped::SteppedWorld;
pub use stepped::{WorldHandle, step_on_threads};
use transport::{PipeTransport, Transports, UdpTransport};

/// The capacity of a pipe in each direction.
const PIPE_LEN: usize = 64 * 1024;
const SPEEDUP_MAX: f64 = 1000.0;
/// How ground stations reach the vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Endpoint {
    /// One pipe per vehicle within this program, to its serial 0.
    Pipes,
    /// TCP servers, for many clients each: serial 0, 1 and 2 of vehicle i (from 0) on `port + 10 * i`, and 2 and 3
    /// above that.
    Tcp {
        /// The local address to listen on.
        host: String,
        /// The first vehicle's serial 0; 0 lets the system choose every port.
        port: u16,
    },
    /// All vehicles send the data of serial 0 to one ground station by UDP. They share one socket: a ground station
    /// that answers only the last sender reaches them all.
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
        port: u16,
    },
    /// Listening on a port fails for another reason.
    #[error("cannot listen on port {port} of {host} (see --tcp): {source}")]
    Listen {
        /// The address to listen on.
        host: String,
        port: u16,
        source: io::Error,
    },
    /// The last vehicle's port would be beyond 65535.
    #[error(
        "{vehicles} vehicle(s) from port {port} on need ports beyond 65535: choose a lower one with --tcp"
    )]
    TooManyPorts {
        /// The number of vehicles.
        vehicles: usize,
        /// The first vehicle's port.
        port: u16,
    },
    /// The system's limit on open files is too low for this number of sockets.
    #[error(
        "{vehicles} vehicle(s) need {needed} sockets, more open files than this system allows: raise the limit \
         (ulimit -n), fly fewer, or serve them over one socket with --udp"
    )]
    TooManyFiles {
        /// The number of vehicles.
        vehicles: usize,
        /// The number of sockets to listen on.
        needed: usize,
    },
    /// Sending to the ground station's address is not possible.
    #[error("cannot send to {host}:{port} (see --udp): {reason}")]
    Send {
        /// The ground station's host.
        host: String,
        /// The ground station's port.
        port: u16,
        reason: String,
    },
    /// The speed-up is not valid.
    #[error("a speed-up of {0} is not possible: it must be a number above 0 and at most 1000")]
    Speedup(f64),
}

impl From<SimulatorError> for Text {
    /// The faults are in command-line options, which are English.
    fn from(error: SimulatorError) -> Self {
        Self::verbatim(error.to_string())
    }
}

/// The pace of simulated time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulatorPace {
    /// Simulated seconds per second.
    pub speedup: f64,
    /// Whether everything is stopped and no client is served.
    pub held: bool,
}

/// The source of a running simulator's pace, which may change.
#[derive(Debug, Clone)]
pub struct PaceFeed(watch::Receiver<SimulatorPace>);

impl From<watch::Receiver<SimulatorPace>> for PaceFeed {
    fn from(feed: watch::Receiver<SimulatorPace>) -> Self {
        Self(feed)
    }
}

impl From<f64> for PaceFeed {
    fn from(speedup: f64) -> Self {
        let pace = SimulatorPace {
            speedup,
            held: false,
        };
        Self(watch::channel(pace).1)
    }
}

/// The server of the embedded simulator.
#[derive(Debug)]
pub struct Simulator;

#[derive(Debug)]
pub struct StartedSimulator {
    /// One pipe per vehicle, in order, if requested.
    pub pipes: Vec<DuplexStream>,
    /// The addresses of serial 0's TCP servers, in the order of the vehicles.
    pub addresses: Vec<SocketAddr>,
    /// The addresses of the servers for serial 1 and 2.
    pub further_addresses: Vec<[SocketAddr; 2]>,
    /// The number of connected ground stations (a pipe or a UDP target counts once per vehicle).
    pub connections: watch::Receiver<usize>,
    /// The number of steps whose output was sent. It does not change while the program is stopped.
    pub steps: watch::Receiver<u64>,
    /// Copies and replaces the world.
    pub world: WorldHandle,
    /// Where the vehicles are in truth.
    pub places: TruePlaces,
    /// Ends when the simulator has been cancelled.
    pub task: JoinHandle<()>,
}

impl Simulator {
    /// Runs a world at a pace until cancelled. Ground stations can connect once this has returned.
    ///
    /// # Errors
    /// A port that cannot be listened on, an address that cannot be sent to, or an impossible
    /// speed-up; nothing runs then.
    pub async fn start(
        world: World,
        pace: impl Into<PaceFeed>,
        endpoints: &[Endpoint],
        cancel: CancellationToken,
    ) -> Result<StartedSimulator, SimulatorError> {
        Self::start_recorded(world, pace, endpoints, None, cancel).await
    }

    /// [`start`](Self::start), with an optional sink that records the vehicles' inputs after the
    /// given head.
    ///
    /// # Errors
    /// As [`start`](Self::start).
    pub async fn start_recorded(
        mut world: World,
        pace: impl Into<PaceFeed>,
        endpoints: &[Endpoint],
        record: Option<(InputsHead, InputSink)>,
        cancel: CancellationToken,
    ) -> Result<StartedSimulator, SimulatorError> {
        let pace = pace.into();
        let speedup = pace.0.borrow().speedup;
        if !(speedup > 0.0 && speedup <= SPEEDUP_MAX) {
            return Err(SimulatorError::Speedup(speedup));
        }
        let record = record.map(|(head, sink)| WorldRecord::begin(&head, sink, &mut world));
        let mut opened = OpenedEndpoint::default();
        for endpoint in endpoints {
            opened.open(endpoint, &mut world).await?;
        }
        let OpenedEndpoint {
            transports,
            pipes,
            addresses,
        } = opened;
        let (stepped, outlets) = SteppedWorld::new(world, transports, record);
        // The task is exempt from tokio's cooperative budget. Otherwise, the sockets of earlier
        // vehicles would use it up, and those of later ones would look idle in every round.
        let task = tokio::spawn(unconstrained(stepped.run(pace, cancel)));
        Ok(StartedSimulator {
            pipes,
            addresses: addresses.iter().map(|[zero, ..]| *zero).collect(),
            further_addresses: addresses.iter().map(|[_, one, two]| [*one, *two]).collect(),
            connections: outlets.connections,
            steps: outlets.steps,
            world: outlets.handle,
            places: outlets.places,
            task,
        })
    }
}

/// The opened transports, and their other ends.
#[derive(Default)]
struct OpenedEndpoint {
    transports: Transports,
    pipes: Vec<DuplexStream>,
    addresses: Vec<[SocketAddr; 3]>,
}

impl OpenedEndpoint {
    async fn open(&mut self, endpoint: &Endpoint, world: &mut World) -> Result<(), SimulatorError> {
        let transports = &mut self.transports;
        match endpoint {
            Endpoint::Pipes => self.pipes.extend(open_pipes(transports, world)),
            Endpoint::Tcp { host, port } => {
                let opened = open_servers(transports, world.vehicles(), host, *port).await?;
                self.addresses.extend(opened);
            }
            Endpoint::Udp { host, port } => {
                let socket = send_to(host, *port).await?;
                transports.stations.push(UdpTransport::new(socket, world));
            }
        }
        Ok(())
    }
}

/// Opens a pipe per vehicle and returns their other ends.
fn open_pipes(transports: &mut Transports, world: &mut World) -> Vec<DuplexStream> {
    (0..world.vehicles())
        .map(|vehicle| {
            let (ours, theirs) = tokio::io::duplex(PIPE_LEN);
            transports
                .pipes
                .push(PipeTransport::new(ours, vehicle, world));
            theirs
        })
        .collect()
}

async fn send_to(host: &str, port: u16) -> Result<UdpSocket, SimulatorError> {
    let failure = |reason: String| SimulatorError::Send {
        host: host.to_owned(),
        port,
        reason,
    };
    if port == 0 {
        let reason =
            "port 0 cannot be reached; use the one that the ground station listens on, often 14550";
        return Err(failure(reason.to_owned()));
    }
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
    // A connected socket receives only from the ground station.
    let connected = socket.connect(target).await;
    connected.map_err(|error| failure(error.to_string()))?;
    Ok(socket)
}
