//! The TCP servers of the vehicles.

use std::io;
use std::net::SocketAddr;

use tokio::net::TcpListener;

use super::SimulatorError;
use super::transport::Transports;
use crate::link::connect::resolve;
use crate::sim::Serial;

/// The distance between two vehicles' ports, as with ArduPilot's SITL instances.
const PORT_STRIDE: usize = 10;
/// The offsets of serial 0, 1 and 2 from the vehicle's first port, as with ArduPilot's SITL.
const SERIAL_OFFSETS: [usize; 3] = [0, 2, 3];
/// The number of the system's error `EMFILE`.
const TOO_MANY_OPEN_FILES: i32 = 24;

/// Opens the TCP servers and returns their addresses, vehicle by vehicle.
pub(super) async fn open_servers(
    transports: &mut Transports,
    vehicles: usize,
    host: &str,
    first_port: u16,
) -> Result<Vec<[SocketAddr; 3]>, SimulatorError> {
    let listen = Listen {
        host,
        vehicles,
        at: host_address(host, first_port).await?,
    };
    let last = usize::from(first_port) + PORT_STRIDE * vehicles.saturating_sub(1);
    if first_port != 0 && last + SERIAL_OFFSETS[2] > usize::from(u16::MAX) {
        return Err(SimulatorError::TooManyPorts {
            vehicles,
            port: first_port,
        });
    }
    let mut addresses = Vec::with_capacity(vehicles);
    for vehicle in 0..vehicles {
        let mut own = [listen.at; 3];
        for (serial, address) in Serial::ALL.into_iter().zip(&mut own) {
            let above = PORT_STRIDE * vehicle + SERIAL_OFFSETS[serial.index()];
            let port = match first_port {
                0 => 0,
                first => first.saturating_add(above as u16),
            };
            let listener = listen.on(port).await?;
            *address = listener.local_addr().map_err(|e| listen.failure(port, e))?;
            transports.servers.open(listener, vehicle, serial);
        }
        addresses.push(own);
    }
    Ok(addresses)
}

/// The address to listen on; a name is looked up once, not once per port.
async fn host_address(host: &str, port: u16) -> Result<SocketAddr, SimulatorError> {
    resolve(host, port)
        .await
        .map_err(|reason| SimulatorError::Listen {
            host: host.to_owned(),
            port,
            source: io::Error::other(reason.to_string()),
        })
}

/// Where servers listen, and for which vehicles.
struct Listen<'a> {
    host: &'a str,
    vehicles: usize,
    at: SocketAddr,
}

impl Listen<'_> {
    async fn on(&self, port: u16) -> Result<TcpListener, SimulatorError> {
        TcpListener::bind(SocketAddr::new(self.at.ip(), port))
            .await
            .map_err(|error| self.failure(port, error))
    }

    fn failure(&self, port: u16, source: io::Error) -> SimulatorError {
        let host = self.host.to_owned();
        match source.kind() {
            io::ErrorKind::AddrInUse => SimulatorError::PortInUse { host, port },
            _ if source.raw_os_error() == Some(TOO_MANY_OPEN_FILES) => {
                SimulatorError::TooManyFiles {
                    vehicles: self.vehicles,
                    needed: self.vehicles * Serial::ALL.len(),
                }
            }
            _ => SimulatorError::Listen { host, port, source },
        }
    }
}
