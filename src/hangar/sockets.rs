//! The sockets of this host and of its processes, as Linux lists them under `/proc`.

use std::collections::BTreeSet;
use std::fs;
use std::net::SocketAddr;

use serde::Serialize;

use super::process;

/// The transport protocol of a socket.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Protocol {
    /// A listening TCP socket.
    Tcp,
    /// A UDP socket that receives from any sender.
    Udp,
}

/// A socket that others can send to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct ListeningSocket {
    pub protocol: Protocol,
    pub at: SocketAddr,
    /// Its owner, by user id.
    pub uid: u32,
    #[serde(skip)]
    inode: u64,
}

impl ListeningSocket {
    /// Whether only this machine can reach the socket.
    pub fn is_loopback(&self) -> bool {
        self.at.ip().to_canonical().is_loopback()
    }
}

/// States of `/proc/net`: TCP that listens, UDP without a peer.
const OPEN: [(&str, Protocol, &str); 4] = [
    ("tcp", Protocol::Tcp, "0A"),
    ("tcp6", Protocol::Tcp, "0A"),
    ("udp", Protocol::Udp, "07"),
    ("udp6", Protocol::Udp, "07"),
];

/// The sockets of this host that other programs can reach; empty without `/proc`.
pub fn open() -> Vec<ListeningSocket> {
    let mut all = Vec::new();
    for (file, protocol, state) in OPEN {
        let text = fs::read_to_string(format!("/proc/net/{file}")).unwrap_or_default();
        all.extend(
            text.lines()
                .skip(1)
                .filter_map(|line| read(line, protocol, state)),
        );
    }
    all.sort();
    all
}

/// The sockets of a process; empty for another user's process.
pub fn of_process(pid: u32) -> Vec<ListeningSocket> {
    let Ok(files) = fs::read_dir(format!("/proc/{pid}/fd")) else {
        return Vec::new();
    };
    let inode = |file: fs::DirEntry| {
        let target = fs::read_link(file.path()).ok()?;
        let inode = target
            .to_str()?
            .strip_prefix("socket:[")?
            .strip_suffix(']')?;
        inode.parse().ok()
    };
    let inodes: BTreeSet<u64> = files.flatten().filter_map(inode).collect();
    let all = open().into_iter();
    all.filter(|socket| inodes.contains(&socket.inode))
        .collect()
}

/// A line of `/proc/net`: number, local address, remote address, state, queues, timer, retransmits, user, timeout,
/// inode.
fn read(line: &str, protocol: Protocol, state: &str) -> Option<ListeningSocket> {
    let fields: Vec<&str> = line.split_ascii_whitespace().collect();
    if *fields.get(3)? != state {
        return None;
    }
    Some(ListeningSocket {
        protocol,
        at: process::address(fields.get(1)?)?,
        uid: fields.get(7)?.parse().ok()?,
        inode: fields.get(9)?.parse().ok()?,
    })
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::net::{TcpListener, UdpSocket};

    use super::*;

    #[test]
    fn the_sockets_of_a_process_are_found_and_judged() {
        let tcp = TcpListener::bind("127.0.0.1:0").expect("it binds");
        let tcp6 = TcpListener::bind("[::1]:0");
        let udp = UdpSocket::bind("127.0.0.1:0").expect("it binds");
        let known = of_process(std::process::id());
        let found = |protocol, at| {
            let mut known = known.iter();
            known.any(|it| it.protocol == protocol && it.at == at && it.is_loopback())
        };
        assert!(found(Protocol::Tcp, tcp.local_addr().expect("bound")));
        assert!(found(Protocol::Udp, udp.local_addr().expect("bound")));
        // Not every machine has IPv6.
        if let Ok(tcp6) = tcp6 {
            assert!(found(Protocol::Tcp, tcp6.local_addr().expect("bound")));
        }
        assert!(of_process(u32::MAX).is_empty());
    }

    #[test]
    fn lines_are_read() {
        let line = "  12: 00000000:1EA5 00000000:0000 07 00000000:00000000 00:00000000 00000000  1000        0 4242 2 0";
        let socket = read(line, Protocol::Udp, "07").expect("it is one");
        assert!(!socket.is_loopback());
        assert_eq!(
            (socket.at.port(), socket.uid, socket.inode),
            (7845, 1000, 4242)
        );
        assert_eq!(read(line, Protocol::Udp, "0A"), None);
        assert_eq!(read("nonsense", Protocol::Udp, "07"), None);
    }
}
