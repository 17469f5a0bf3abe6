//! What the system says about processes and about who holds the other end of a connection.
//!
//! All of it may be out of date when it is read: a process that is gone meanwhile is `None`, never an error.

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

/// An address as the system's tables of sockets have it.
pub(super) fn address(text: &str) -> Option<SocketAddr> {
    system::address(text)
}

/// A process, told apart from any that has had or will have the same number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct ProcessIdentity {
    pub pid: u32,
    /// When it was started, in ticks since the system was.
    pub started: u64,
    /// Names this run of the system.
    pub boot: String,
    /// Names the space in which the number is valid: containers have their own.
    pub namespace: String,
}

impl ProcessIdentity {
    /// Whether equal numbers of both mean the same process: they are counted by the same system since it was started.
    pub fn has_numbers_of(&self, other: &Self) -> bool {
        (&self.boot, &self.namespace) == (&other.boot, &other.namespace)
    }
}

/// What a process uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ProcessUsage {
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Processor time of all its threads since it was started.
    pub cpu: Duration,
}

/// An answer that may not be had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Belongs {
    Yes,
    No,
    /// The system does not tell, or the connection is gone.
    Unknown,
}

/// Who a process is that runs now. One that has ended and waits for its parent does not run.
pub(super) fn identity(pid: u32) -> Option<ProcessIdentity> {
    system::identity(pid)
}

/// Whether exactly this process runs.
pub(super) fn is_running(identity: &ProcessIdentity) -> bool {
    self::identity(identity.pid).as_ref() == Some(identity)
}

/// The user for whom a process acts.
pub(super) fn user(pid: u32) -> Option<u32> {
    system::user(pid)
}

/// The user for whom this program acts.
pub(super) fn own_user() -> u32 {
    nix::unistd::geteuid().as_raw()
}

/// The file that a process runs.
pub(super) fn executable(pid: u32) -> Option<PathBuf> {
    system::executable(pid)
}

/// The folder in which a process is.
pub(super) fn folder(pid: u32) -> Option<PathBuf> {
    system::folder(pid)
}

/// The processes of the session that this process leads or has led, itself left out.
pub(super) fn session(pid: u32) -> Vec<u32> {
    system::session(pid)
}

/// What a process uses.
pub(super) fn usage(pid: u32) -> Option<ProcessUsage> {
    system::usage(pid)
}

/// A connection over loopback, as the end that has accepted it sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Connection {
    /// The address of who has connected.
    pub peer: SocketAddr,
    /// The address that was connected to.
    pub local: SocketAddr,
}

impl Connection {
    /// Of an accepted stream; `None` if it is gone.
    pub fn of(stream: &tokio::net::TcpStream) -> Option<Self> {
        Some(Self {
            peer: plain(stream.peer_addr().ok()?),
            local: plain(stream.local_addr().ok()?),
        })
    }

    /// The user whose process it comes from; `None` if the system does not tell, or the connection is gone.
    pub fn user(self) -> Option<u32> {
        system::socket(self).map(|socket| socket.user)
    }

    /// Whether it comes from this process, or from one of the session that it leads.
    pub fn is_of_process(self, pid: u32) -> Belongs {
        let Some(socket) = system::socket(self) else {
            return Belongs::Unknown;
        };
        let holds = |pid| system::holds(pid, socket.inode);
        match holds(pid) {
            Some(true) => Belongs::Yes,
            None => Belongs::Unknown,
            // What was started may be a script that starts the program.
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

/// An address without the clothes in which a socket for both versions of IP shows it.
fn plain(address: SocketAddr) -> SocketAddr {
    let ip: IpAddr = address.ip().to_canonical();
    SocketAddr::new(ip, address.port())
}
