//! The addresses of a class on several machines, as people write them.

use std::net::IpAddr;

use super::join_line::is_address;

/// The port of a desk for several machines unless another one is said: that of Zenoh.
const DEFAULT_PORT: u16 = 7447;

/// An address as it was written, with the default port if it has none.
pub fn with_port(written: &str) -> String {
    with_this_port(written, DEFAULT_PORT)
}

/// An address as it was written; if it has no port, with that of the first address of its class, at which the seats look.
#[cfg(any(feature = "zenoh", test))]
pub(crate) fn with_port_of(written: &str, addresses: &[String]) -> String {
    let port = addresses.first().and_then(|it| it.rsplit(':').next());
    let port = port.and_then(|port| port.parse().ok());
    with_this_port(written, port.unwrap_or(DEFAULT_PORT))
}

fn with_this_port(written: &str, port: u16) -> String {
    let completed = format!("{written}:{port}");
    let is_number = written.chars().all(|c| c.is_ascii_digit());
    if !is_address(written) && !is_number && is_address(&completed) {
        completed
    } else {
        written.to_owned()
    }
}

/// Whether an address, with or without a port, is one of this machine only.
pub fn is_loopback(address: &str) -> bool {
    let host = address.rsplit_once(':').map_or(address, |(host, _)| host);
    let host = host.trim_matches(['[', ']']);
    let parsed = host.parse::<IpAddr>();
    parsed.map_or(host == "localhost", |address| address.is_loopback())
}
