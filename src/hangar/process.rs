//! The system's information on processes and on the owner of a connection's other end.
//!
//! The information may be outdated when it is read: a process that is gone by then is `None`, never an error.

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::time::Duration;

use serde::{Deserialize, Serialize};

#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_os = "linux")]
use linux as system;
#[cfg(not(target_os = "linux"))]
mod elsewhere;
#[cfg(not(target_os = "linux"))]
use elsewhere as system;
#[cfg(all(test, target_os = "linux"))]
mod tests;

/// Parses an address in the format of the system's socket tables.
pub(super) fn address(text: &str) -> Option<SocketAddr> {
    system::address(text)
}

/// A process, distinguished from earlier and later ones with the same number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct ProcessIdentity {
    pub pid: u32,
    /// Its start time, in ticks since the system booted.
    pub started: u64,
    /// The boot id of the system.
    pub boot: String,
    /// The namespace of the number: containers have their own.
    pub namespace: String,
}

impl ProcessIdentity {
    /// Whether equal process numbers mean the same process: both identities are of the same boot
    /// and namespace.
    pub fn has_numbers_of(&self, other: &Self) -> bool {
        (&self.boot, &self.namespace) == (&other.boot, &other.namespace)
    }
}

/// The resources of a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ProcessUsage {
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// The processor time of all the process's threads since it was started.
    pub cpu: Duration,
}

/// Whether a connection belongs to a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Belongs {
    Yes,
    No,
    /// The system cannot determine this, or the connection is gone.
    Unknown,
}

/// The identity of a running process. A process that has ended and waits for its parent does not count as running.
pub(super) fn identity(pid: u32) -> Option<ProcessIdentity> {
    system::identity(pid)
}

/// Whether this particular process runs.
pub(super) fn is_running(identity: &ProcessIdentity) -> bool {
    self::identity(identity.pid).as_ref() == Some(identity)
}

/// The effective user id of a process.
pub(super) fn user(pid: u32) -> Option<u32> {
    system::user(pid)
}

/// The effective user id of this program.
pub(super) fn own_user() -> u32 {
    nix::unistd::geteuid().as_raw()
}

/// The file that a process runs.
pub(super) fn executable(pid: u32) -> Option<PathBuf> {
    system::executable(pid)
}

/// The working folder of a process.
pub(super) fn folder(pid: u32) -> Option<PathBuf> {
    system::folder(pid)
}

/// The other processes of the session that this process leads or has led.
pub(super) fn session(pid: u32) -> Vec<u32> {
    system::session(pid)
}

/// Whether a process is stopped by a signal, such as SIGSTOP.
pub(super) fn is_stopped(pid: u32) -> bool {
    system::is_stopped(pid)
}

/// The resources of a process.
pub(super) fn usage(pid: u32) -> Option<ProcessUsage> {
    system::usage(pid)
}

/// A connection over loopback, from the accepting end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Connection {
    /// The address of the client.
    pub peer: SocketAddr,
    /// The address to which the process connected.
    pub local: SocketAddr,
}

impl Connection {
    /// The connection of an accepted stream; `None` if it is gone.
    pub fn of(stream: &tokio::net::TcpStream) -> Option<Self> {
        Some(Self {
            peer: plain(stream.peer_addr().ok()?),
            local: plain(stream.local_addr().ok()?),
        })
    }

    /// The user of the process that the connection comes from; `None` if the system cannot
    /// determine it, or the connection is gone.
    pub fn user(self) -> Option<u32> {
        system::socket(self).map(|socket| socket.user)
    }

    /// Whether the connection comes from this process, or from another process of its session.
    pub fn is_of_process(self, pid: u32) -> Belongs {
        let Some(socket) = system::socket(self) else {
            return Belongs::Unknown;
        };
        let holds = |pid| system::holds(pid, socket.inode);
        match holds(pid) {
            Some(true) => Belongs::Yes,
            None => Belongs::Unknown,
            // The started file may be a script that starts the program.
            Some(false) if session(pid).into_iter().any(|pid| holds(pid) == Some(true)) => {
                Belongs::Yes
            }
            Some(false) => Belongs::No,
        }
    }
}

/// The other end's socket.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ProcessSocket {
    user: u32,
    inode: u64,
}

/// An address without the IPv4-in-IPv6 form that dual-stack sockets use.
fn plain(address: SocketAddr) -> SocketAddr {
    let ip: IpAddr = address.ip().to_canonical();
    SocketAddr::new(ip, address.port())
}
