//! Opening an address, with clear errors.

use std::io;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr};
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream, UdpSocket, lookup_host};
use tokio::time::timeout;

use super::core::{ConnectionEnd, LinkCore};
use super::{Address, datagram, server, stream};
use crate::text;
use crate::text::Text;

/// How long a TCP server may take to answer.
const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);
/// A TCP connection is reopened after this long without data, since a vehicle sends something every second.
const TCP_SILENCE: Duration = Duration::from_secs(10);

/// Opens an address once and carries its data until it ends.
pub(super) async fn attempt(link: &mut LinkCore, address: &Address) -> ConnectionEnd {
    let opened = match link.meanwhile(open(address)).await {
        None => return ConnectionEnd::Cancelled,
        Some(Err(outcome)) => return outcome,
        Some(Ok(opened)) => opened,
    };
    match opened {
        OpenedTransport::Stream(socket) => {
            link.up(socket.local_addr().ok());
            stream::session(link, socket, Some(TCP_SILENCE)).await
        }
        OpenedTransport::Listener(listener) => {
            link.up(listener.local_addr().ok());
            server::session(link, listener).await
        }
        OpenedTransport::Datagrams(socket, target) => {
            link.up(socket.local_addr().ok());
            datagram::session(link, socket, target).await
        }
        #[cfg(feature = "serial")]
        OpenedTransport::Serial(port) => {
            link.up(None);
            stream::session(link, port, None).await
        }
    }
}

enum OpenedTransport {
    Stream(TcpStream),
    Listener(TcpListener),
    /// Datagrams, with the target address if it is known from the start.
    Datagrams(UdpSocket, Option<SocketAddr>),
    #[cfg(feature = "serial")]
    Serial(tokio_serial::SerialStream),
}

async fn open(address: &Address) -> Result<OpenedTransport, ConnectionEnd> {
    let opened = match address {
        Address::Tcp { host, port } => tcp(host, *port).await.map(OpenedTransport::Stream),
        Address::TcpIn { host, port } => TcpListener::bind((host.as_str(), *port))
            .await
            .map(OpenedTransport::Listener)
            .map_err(|error| bind_failure(host, *port, &error)),
        Address::UdpIn { host, port } => UdpSocket::bind((host.as_str(), *port))
            .await
            .map(|socket| OpenedTransport::Datagrams(socket, None))
            .map_err(|error| bind_failure(host, *port, &error)),
        Address::Udp { host, port } => udp_to(host, *port, false).await,
        Address::UdpBroadcast { host, port } => udp_to(host, *port, true).await,
        Address::Serial { path, baud } => return serial(path, *baud),
        Address::File { .. } => return Err(ConnectionEnd::Final(None)), // played, not opened
    };
    opened.map_err(ConnectionEnd::Lost)
}

async fn tcp(host: &str, port: u16) -> Result<TcpStream, Text> {
    let socket = match timeout(CONNECT_TIMEOUT, TcpStream::connect((host, port))).await {
        Ok(Ok(socket)) => socket,
        Ok(Err(error)) if error.kind() == io::ErrorKind::ConnectionRefused => {
            return Err(text!("transport-refused", host = host, port = port));
        }
        Ok(Err(error)) => {
            return Err(text!(
                "transport-unreachable",
                host = host,
                port = port,
                error = error.to_string()
            ));
        }
        Err(_) => {
            let seconds = CONNECT_TIMEOUT.as_secs();
            return Err(text!("transport-no-answer", host = host, seconds = seconds));
        }
    };
    // Commands are small and must not wait for one another.
    socket
        .set_nodelay(true)
        .map(|()| socket)
        .map_err(|error| error.to_string().into())
}

async fn udp_to(host: &str, port: u16, broadcast: bool) -> Result<OpenedTransport, Text> {
    let target = resolve(host, port).await?;
    let any: SocketAddr = match target {
        SocketAddr::V4(_) => (Ipv4Addr::UNSPECIFIED, 0).into(),
        SocketAddr::V6(_) => (Ipv6Addr::UNSPECIFIED, 0).into(),
    };
    let socket = UdpSocket::bind(any)
        .await
        .and_then(|socket| socket.set_broadcast(broadcast).map(|()| socket))
        .map_err(|error| text!("transport-no-udp-socket", error = error.to_string()))?;
    Ok(OpenedTransport::Datagrams(socket, Some(target)))
}

/// The address of a host, IPv4 if it has both, because most vehicles listen only on IPv4.
pub(super) async fn resolve(host: &str, port: u16) -> Result<SocketAddr, Text> {
    let mut found: Vec<_> = lookup_host((host, port))
        .await
        .map_err(|error| {
            text!(
                "transport-not-found",
                host = host,
                error = error.to_string()
            )
        })?
        .collect();
    found.sort_by_key(SocketAddr::is_ipv6);
    let first = found.first().copied();
    first.ok_or_else(|| text!("transport-without-address", host = host))
}

/// The error for a port that cannot be listened on.
pub(super) fn bind_failure(host: &str, port: u16, error: &io::Error) -> Text {
    match error.kind() {
        io::ErrorKind::AddrInUse => {
            text!("transport-port-in-use", host = host, port = port)
        }
        io::ErrorKind::AddrNotAvailable => {
            text!("transport-not-here", host = host)
        }
        _ => text!(
            "transport-cannot-listen",
            host = host,
            port = port,
            error = error.to_string()
        ),
    }
}

#[cfg(feature = "serial")]
fn serial(path: &str, baud: u32) -> Result<OpenedTransport, ConnectionEnd> {
    tokio_serial::SerialStream::open(&tokio_serial::new(path, baud))
        .map(OpenedTransport::Serial)
        .map_err(|error| {
            let error = error.to_string();
            ConnectionEnd::Lost(text!(
                "transport-no-serial",
                path = path,
                baud = baud,
                error = error
            ))
        })
}

#[cfg(not(feature = "serial"))]
fn serial(path: &str, _baud: u32) -> Result<OpenedTransport, ConnectionEnd> {
    let reason = text!("transport-without-serial", path = path);
    Err(ConnectionEnd::Final(Some(reason)))
}
