//! Queries of `/proc`, as described in its manual page (`proc(5)`).

use std::fs;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::PathBuf;
use std::time::Duration;

use nix::time::ClockId;
use nix::unistd::Pid;

use super::{Connection, ProcessIdentity, ProcessSocket, ProcessUsage, plain};

/// The text that the system appends to the path of a file that was replaced while running.
const DELETED: &str = " (deleted)";
/// Fields of `/proc/PID/stat`, counted from the state, which follows the name.
const STATE: usize = 0;
const SESSION: usize = 3;
const STARTED: usize = 19;
/// Fields of a line of `/proc/net/tcp`.
const LOCAL: usize = 1;
const REMOTE: usize = 2;
const USER: usize = 7;
const INODE: usize = 9;

pub(super) fn identity(pid: u32) -> Option<ProcessIdentity> {
    let stat = Stat::read(pid)?;
    let is_over = matches!(stat.field(STATE)?, "Z" | "X" | "x");
    let boot = fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap_or_default();
    let namespace = fs::read_link("/proc/self/ns/pid").unwrap_or_default();
    (!is_over).then_some(ProcessIdentity {
        pid,
        started: stat.number(STARTED)?,
        boot: boot.trim().to_owned(),
        namespace: namespace.display().to_string(),
    })
}

/// The effective user id, which decides which users may signal the process.
pub(super) fn user(pid: u32) -> Option<u32> {
    let status = read(pid, "status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("Uid:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

pub(super) fn executable(pid: u32) -> Option<PathBuf> {
    let path = fs::read_link(format!("/proc/{pid}/exe")).ok()?;
    let text = path.to_str()?;
    Some(PathBuf::from(text.strip_suffix(DELETED).unwrap_or(text)))
}

pub(super) fn folder(pid: u32) -> Option<PathBuf> {
    fs::read_link(format!("/proc/{pid}/cwd")).ok()
}

pub(super) fn session(leader: u32) -> Vec<u32> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    let is_member = |pid: u32| {
        Stat::read(pid)?
            .number(SESSION)
            .map(|session| session == u64::from(leader))
    };
    numbers
        .filter(|&pid| pid != leader && is_member(pid) == Some(true))
        .collect()
}

pub(super) fn is_stopped(pid: u32) -> bool {
    let stat = Stat::read(pid);
    stat.is_some_and(|stat| stat.field(STATE) == Some("T"))
}

pub(super) fn usage(pid: u32) -> Option<ProcessUsage> {
    let memory_bytes = resident(pid)?;
    let clock = ClockId::pid_cpu_clock_id(Pid::from_raw(i32::try_from(pid).ok()?)).ok()?;
    Some(ProcessUsage {
        memory_bytes,
        cpu: Duration::from(clock.now().ok()?),
    })
}

fn resident(pid: u32) -> Option<u64> {
    let status = read(pid, "status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    // A process that has ended has no memory line.
    let Some(line) = line else { return Some(0) };
    let kibibytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kibibytes * 1024)
}

pub(super) fn socket(connection: Connection) -> Option<ProcessSocket> {
    let found = |table: &str| {
        let text = fs::read_to_string(format!("/proc/self/net/{table}")).ok()?;
        text.lines()
            .skip(1)
            .find_map(|line| socket_of(line, connection))
    };
    found("tcp").or_else(|| found("tcp6"))
}

/// The socket in a line of the system's table, if it is the far end of the connection.
pub(super) fn socket_of(line: &str, connection: Connection) -> Option<ProcessSocket> {
    let fields: Vec<&str> = line.split_whitespace().collect();
    let address = |field: usize| fields.get(field).and_then(|text| address(text)).map(plain);
    let is_it = address(LOCAL) == Some(plain(connection.peer))
        && address(REMOTE) == Some(plain(connection.local));
    let inode = fields.get(INODE)?.parse().ok()?;
    // A closed socket does not belong to a process, and is listed as owned by root.
    (is_it && inode != 0).then_some(ProcessSocket {
        user: fields.get(USER)?.parse().ok()?,
        inode,
    })
}

/// An address as in `0100007F:1F90`: words of 32 bits in memory order, and the port.
pub(super) fn address(text: &str) -> Option<SocketAddr> {
    let (ip, port) = text.split_once(':')?;
    let port = u16::from_str_radix(port, 16).ok()?;
    let mut bytes = Vec::new();
    for at in (0..ip.len()).step_by(8) {
        let word = u32::from_str_radix(ip.get(at..at + 8)?, 16).ok()?;
        bytes.extend(word.to_ne_bytes());
    }
    let ip = match *bytes.as_slice() {
        [a, b, c, d] => IpAddr::V4(Ipv4Addr::new(a, b, c, d)),
        ref all => IpAddr::V6(Ipv6Addr::from(<[u8; 16]>::try_from(all).ok()?)),
    };
    Some(SocketAddr::new(ip, port))
}

pub(super) fn holds(pid: u32, inode: u64) -> Option<bool> {
    let wanted = PathBuf::from(format!("socket:[{inode}]"));
    let open = fs::read_dir(format!("/proc/{pid}/fd")).ok()?;
    let is_it = |path: PathBuf| fs::read_link(path).is_ok_and(|target| target == wanted);
    Some(open.flatten().any(|entry| is_it(entry.path())))
}

fn read(pid: u32, name: &str) -> Option<String> {
    let bytes = fs::read(format!("/proc/{pid}/{name}")).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// The fields of `/proc/PID/stat` after the name, which may contain spaces and parentheses.
struct Stat(String);

impl Stat {
    fn read(pid: u32) -> Option<Self> {
        read(pid, "stat").map(Self)
    }

    fn field(&self, number: usize) -> Option<&str> {
        let (_, fields) = self.0.rsplit_once(')')?;
        fields.split_whitespace().nth(number)
    }

    fn number(&self, field: usize) -> Option<u64> {
        self.field(field)?.parse().ok()
    }
}
