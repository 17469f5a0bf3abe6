//! Link addresses, in the common notations.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::text;
use crate::text::Text;

const DEFAULT_BAUD: u32 = 115_200;
/// The host of an address that is only a port: this machine.
const LOOPBACK: &str = "127.0.0.1";

/// The address of a link.
///
/// Read from text by [`FromStr`], in sortie's notation or in those of pymavlink, `MAVProxy` and rust-mavlink; its
/// [`Display`](fmt::Display) is sortie's notation and parses to the same address.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Address {
    /// Connects to a TCP server: `tcp:HOST:PORT` (also `tcpout:`, and a bare `HOST:PORT`).
    Tcp {
        /// A name or an IP address.
        host: String,
        port: u16,
    },
    /// Waits for TCP clients: `tcpin:HOST:PORT`.
    TcpIn {
        /// The local address to listen on.
        host: String,
        /// The port to listen on; 0 lets the system choose.
        port: u16,
    },
    /// Sends UDP to one address and receives the answers: `udp:HOST:PORT` (also `udpout:`).
    Udp {
        /// A name or an IP address.
        host: String,
        /// The port to send to.
        port: u16,
    },
    /// Waits for UDP and answers each sender at its own address: `udpin:HOST:PORT`.
    UdpIn {
        /// The local address to listen on.
        host: String,
        /// The port to listen on; 0 lets the system choose.
        port: u16,
    },
    /// Sends UDP to a broadcast address and receives the answers: `udpbcast:HOST:PORT`.
    UdpBroadcast {
        /// The broadcast address, such as `192.168.1.255`.
        host: String,
        /// The port to send to.
        port: u16,
    },
    /// A serial port: `serial:PATH:BAUD` (also pymavlink's `PATH,BAUD`).
    Serial {
        /// The device, such as `/dev/ttyACM0` or `COM3`.
        path: String,
        baud: u32,
    },
    /// Plays a recording: `file:PATH` (also a bare path that ends in `.tlog`).
    File { path: PathBuf },
}

/// Text that is not a link address.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", Text::from(self))]
pub struct AddressError {
    text: String,
    problem: Text,
}

impl From<&AddressError> for Text {
    fn from(error: &AddressError) -> Self {
        let AddressError { text, problem } = error;
        text!("transport-no-address", address = text, problem = problem)
    }
}

impl FromStr for Address {
    type Err = AddressError;

    /// Reads an address.
    ///
    /// `udp:` means to send, as in rust-mavlink and QGroundControl's targets; pymavlink's own `udp:` listens, which is
    /// `udpin:` here. A bare `HOST:PORT` connects by TCP, because a wrong guess then fails at once. A network address
    /// without a host (`udpin:14550`) means this machine only.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        parse(text.trim()).map_err(|problem| AddressError {
            text: text.to_owned(),
            problem,
        })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (kind, host, port) = match self {
            Self::Tcp { host, port } => ("tcp", host, port),
            Self::TcpIn { host, port } => ("tcpin", host, port),
            Self::Udp { host, port } => ("udp", host, port),
            Self::UdpIn { host, port } => ("udpin", host, port),
            Self::UdpBroadcast { host, port } => ("udpbcast", host, port),
            Self::Serial { path, baud } => return write!(f, "serial:{path}:{baud}"),
            Self::File { path } => return write!(f, "file:{}", path.display()),
        };
        if host.contains(':') {
            write!(f, "{kind}:[{host}]:{port}")
        } else {
            write!(f, "{kind}:{host}:{port}")
        }
    }
}

fn parse(text: &str) -> Result<Address, Text> {
    if text.is_empty() {
        return Err(text!("transport-address-empty"));
    }
    let (kind, rest) = text.split_once(':').unwrap_or(("", text));
    match kind {
        "tcp" | "tcpout" => target(rest).map(|(host, port)| Address::Tcp { host, port }),
        "tcpin" => socket(rest).map(|(host, port)| Address::TcpIn { host, port }),
        "udp" | "udpout" => target(rest).map(|(host, port)| Address::Udp { host, port }),
        "udpin" => socket(rest).map(|(host, port)| Address::UdpIn { host, port }),
        "udpbcast" => target(rest).map(|(host, port)| Address::UdpBroadcast { host, port }),
        "serial" => serial(rest),
        "file" if rest.is_empty() => Err(text!("transport-file-missing")),
        "file" => Ok(Address::File { path: rest.into() }),
        _ => bare(text),
    }
}

/// An address without a scheme.
fn bare(text: &str) -> Result<Address, Text> {
    if Path::new(text)
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("tlog"))
    {
        return Ok(Address::File { path: text.into() });
    }
    if text.starts_with('/') || text.contains(',') || text.starts_with("COM") {
        return serial(text);
    }
    match text.rsplit_once(':') {
        Some((host, _)) if !host.is_empty() && (!host.contains(':') || host.starts_with('[')) => {
            target(text).map(|(host, port)| Address::Tcp { host, port })
        }
        Some(_) => {
            let kind = text.split(':').next().unwrap_or_default();
            Err(text!("transport-no-kind", kind = kind))
        }
        None => Err(text!("transport-no-kind-no-port")),
    }
}

/// Host and port of a remote address, which cannot have port 0.
fn target(text: &str) -> Result<(String, u16), Text> {
    match socket(text)? {
        (_, 0) => Err(text!("transport-port-zero")),
        found => Ok(found),
    }
}

/// `HOST:PORT`, `[IPV6]:PORT`, `:PORT` or `PORT`.
fn socket(text: &str) -> Result<(String, u16), Text> {
    let (host, port) = text.rsplit_once(':').unwrap_or(("", text));
    let port = port.parse().map_err(|_| match port {
        "" => text!("transport-port-missing"),
        _ => text!("transport-no-port", port = port),
    })?;
    let host = match host.strip_prefix('[') {
        Some(inner) => inner
            .strip_suffix(']')
            .ok_or_else(|| text!("transport-no-bracket", host = host))?,
        None if host.contains(':') => {
            let address = format!("[{host}]:{port}");
            return Err(text!("transport-brackets", address = address));
        }
        None => host,
    };
    let host = if host.is_empty() { LOOPBACK } else { host };
    Ok((host.to_owned(), port))
}

/// `PATH:BAUD`, `PATH,BAUD` or `PATH`. A path may contain colons (`/dev/serial/by-path/pci-0:2:1.0-port0`), so the text
/// after the last one is a baud rate unless it looks like part of a path.
fn serial(text: &str) -> Result<Address, Text> {
    let split = text.rsplit_once(',').or_else(|| {
        text.rsplit_once(':')
            .filter(|(_, tail)| !is_part_of_path(tail))
    });
    let (path, baud) = match split {
        Some((path, baud)) => (path, rate(baud)?),
        None => (text, DEFAULT_BAUD),
    };
    if path.is_empty() {
        return Err(text!("transport-serial-missing"));
    }
    Ok(Address::Serial {
        path: path.to_owned(),
        baud,
    })
}

/// Whether the text after a colon belongs to a device's path: `1.0-port0` and `1.0/tty` do, `57600` and `abc` do not.
fn is_part_of_path(tail: &str) -> bool {
    tail.contains(['/', '.']) || tail.rfind('-').is_some_and(|at| at > 0)
}

fn rate(text: &str) -> Result<u32, Text> {
    match text.parse() {
        Ok(baud) if baud > 0 => Ok(baud),
        _ if text.is_empty() => Err(text!("transport-baud-missing")),
        _ => Err(text!("transport-no-baud", baud = text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_spelling_of_the_field_is_understood() {
        let table = [
            ("tcp:10.0.0.2:5760", "tcp:10.0.0.2:5760"),
            ("tcpout:sitl:5760", "tcp:sitl:5760"),
            ("tcp:5760", "tcp:127.0.0.1:5760"),
            ("10.0.0.2:5760", "tcp:10.0.0.2:5760"),
            ("[::1]:5760", "tcp:[::1]:5760"),
            ("tcpin:0.0.0.0:5760", "tcpin:0.0.0.0:5760"),
            ("tcpin::0", "tcpin:127.0.0.1:0"),
            ("udp:10.0.0.2:14550", "udp:10.0.0.2:14550"),
            ("udpout:10.0.0.2:14550", "udp:10.0.0.2:14550"),
            ("udpin:14550", "udpin:127.0.0.1:14550"),
            ("udpin:[::]:14550", "udpin:[::]:14550"),
            ("udpbcast:10.0.0.255:14550", "udpbcast:10.0.0.255:14550"),
            ("serial:/dev/ttyACM0:57600", "serial:/dev/ttyACM0:57600"),
            ("serial:/dev/ttyACM0", "serial:/dev/ttyACM0:115200"),
            ("/dev/ttyUSB0,57600", "serial:/dev/ttyUSB0:57600"),
            ("/dev/ttyUSB0", "serial:/dev/ttyUSB0:115200"),
            ("COM3,57600", "serial:COM3:57600"),
            (
                "serial:/dev/serial/by-path/pci-0:2:1.0-port0",
                "serial:/dev/serial/by-path/pci-0:2:1.0-port0:115200",
            ),
            ("file:flight.tlog", "file:flight.tlog"),
            ("logs/a b.TLOG", "file:logs/a b.TLOG"),
            (" udpin:14550 ", "udpin:127.0.0.1:14550"),
        ];
        for (text, canonical) in table {
            let address: Address = text.parse().expect(text);
            assert_eq!(address.to_string(), canonical, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_named_and_the_forms_are_listed() {
        let table = [
            ("", "the address is empty"),
            ("ftp:host:21", "unknown kind of link \"ftp\""),
            ("host", "neither a kind of link nor a port"),
            ("tcp:host", "\"host\" is not a port"),
            ("tcp:host:", "the port is missing"),
            ("tcp:host:70000", "\"70000\" is not a port"),
            ("tcp:host:0", "port 0"),
            ("tcp:::1:5760", "needs brackets: [::1]:5760"),
            ("tcp:[::1:5760", "closing bracket"),
            ("serial:", "path is missing"),
            ("serial:/dev/ttyACM0:0", "baud rate"),
            ("/dev/ttyACM0,fast", "baud rate \"fast\" is not"),
            ("serial:/dev/ttyACM0:abc", "baud rate \"abc\" is not"),
            ("serial:/dev/ttyACM0:57600x", "baud rate \"57600x\" is not"),
            ("serial:/dev/ttyACM0:-9600", "baud rate \"-9600\" is not"),
            ("serial:/dev/ttyACM0:", "baud rate is missing"),
            ("COM3:fast", "baud rate \"fast\" is not"),
            ("serial:/dev/ttyACM0:4294967296", "baud rate"),
            ("file:", "file is missing"),
        ];
        for (text, problem) in table {
            let error = text.parse::<Address>().expect_err(text).to_string();
            assert!(error.contains(problem), "{text}: {error}");
            assert!(error.contains("udpin:HOST:PORT (listen)"), "{error}");
        }
    }

    proptest! {
        #[test]
        fn an_address_reads_back_from_its_own_text(
            kind in 0..7,
            host in "[a-z][a-z0-9.-]{0,12}|[0-9]{1,3}\\.0\\.0\\.1|::1|fe80::[0-9a-f]{1,4}",
            port in 1u16..,
            path in "/[a-zA-Z0-9:._ -]{0,20}[a-z]",
            baud in 1u32..,
        ) {
            let address = match kind {
                0 => Address::Tcp { host, port },
                1 => Address::TcpIn { host, port },
                2 => Address::Udp { host, port },
                3 => Address::UdpIn { host, port },
                4 => Address::UdpBroadcast { host, port },
                5 => Address::Serial { path, baud },
                _ => Address::File { path: path.into() },
            };
            prop_assert_eq!(address.to_string().parse(), Ok(address));
        }

        #[test]
        fn no_text_panics(text in "\\PC{0,30}|[a-z:,/\\[\\]0-9]{0,20}") {
            let _ = text.parse::<Address>();
        }
    }
}
