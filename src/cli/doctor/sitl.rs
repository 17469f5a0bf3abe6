//! Checks of SITL: whether it can be started, and which of its ports others can reach.

use std::collections::BTreeSet;

use super::super::settings::CliSettings;
use super::{HostFinding, host};
use crate::hangar::programs::{self, Missing, PATIENCE, ProgramIdentity, Programs, Unknown};
use crate::hangar::sockets::{self, ListeningSocket, Protocol};
use crate::sitl::SitlKind;

/// The first port of SITL's TCP listeners.
const FIRST_TCP: u16 = 5760;
/// The first port of SITL's RC inputs.
const FIRST_RC: u16 = 5501;
/// The distance between the ports of two instances.
const APART: u16 = 10;
/// The number of instances whose ports are checked.
const INSTANCES: u16 = 64;

const GET: &str = "https://ardupilot.org/dev/docs/building-setup-linux.html, then ./waf configure --board sitl && \
                   ./waf copter; or use the embedded simulator, which needs nothing else";

/// The programs: their paths, their identities, and the sockets that they open.
pub(super) async fn programs(all: &Programs) -> Vec<HostFinding> {
    let mut findings = Vec::new();
    for &kind in SitlKind::ALL {
        match all.of(kind) {
            Ok(found) => findings.extend(program(kind, &found.file, &found.by).await),
            Err(Missing::Nowhere { program, .. }) => {
                // Missions need multirotors, so only a missing `arducopter` gets advice.
                let found = "neither on the PATH nor in a usual build folder";
                findings.push(if kind == SitlKind::Copter {
                    let mend = format!("name one with --{program}, SORTIE_ARDUCOPTER or the configuration; to get one: {GET}");
                    HostFinding::note(program, found, mend)
                } else {
                    HostFinding::ok(program, format!("not needed by missions, and {found}"))
                });
            }
            Err(missing) => findings.push(HostFinding::fault(
                kind.program(),
                missing.to_string(),
                "name another one, or remove the setting: sortie then searches for one",
            )),
        }
    }
    findings
}

async fn program(kind: SitlKind, file: &std::path::Path, by: &str) -> Vec<HostFinding> {
    let about = kind.program();
    let identity = match programs::identify(file, PATIENCE).await {
        Ok(identity) => identity,
        Err(unknown) => {
            let mend = match unknown {
                Unknown::Host { .. } => {
                    "SITL needs /proc, a free port and a folder for temporary files (TMPDIR)"
                        .to_owned()
                }
                Unknown::NoProgram { .. }
                | Unknown::Start(_)
                | Unknown::Ended { .. }
                | Unknown::Flood { .. }
                | Unknown::Silent { .. }
                | Unknown::OtherVehicle { .. } => {
                    format!("named by {by}: name an {about} built for SITL")
                }
            };
            return vec![HostFinding::fault(about, unknown.to_string(), mend)];
        }
    };
    let ProgramIdentity {
        kind: is,
        version,
        hash,
        sockets,
    } = identity;
    let what = format!(
        "{} is a {} {version} ({hash}) [{by}]",
        file.display(),
        is.name()
    );
    if is != kind {
        let mend = format!("name an {about}; this one would be started as the wrong vehicle");
        return vec![HostFinding::fault(about, what, mend)];
    }
    let mut findings = vec![HostFinding::ok(about, what)];
    if !sockets.is_empty() {
        let list: Vec<_> = sockets.iter().map(purpose).collect();
        findings.push(HostFinding::note(
            "open to others",
            format!("each {about} opens {}", list.join(", ")),
            "SITL has no option against it: anyone who can reach this machine could steer vehicles whose failsafes heed RC; a firewall rule closes it",
        ));
    }
    findings
}

fn purpose(socket: &ListeningSocket) -> String {
    match socket.protocol {
        Protocol::Udp => {
            "a UDP port for RC input on all interfaces (a different number each time)".to_owned()
        }
        Protocol::Tcp => format!("TCP port {} on all interfaces", socket.at.port()),
    }
}

/// Whether the ports of a SITL started by hand are free, and which users hold them.
pub(super) fn ports() -> Vec<HostFinding> {
    let own = nix::unistd::geteuid().as_raw();
    let all = sockets::open();
    let taken: Vec<&ListeningSocket> = all.iter().filter(|socket| is_usual(socket)).collect();
    if taken.is_empty() {
        let found = format!(
            "TCP {FIRST_TCP}, {} … and UDP {FIRST_RC} … are free",
            FIRST_TCP + APART
        );
        return vec![HostFinding::ok("ports", found)];
    }
    let users: BTreeSet<u32> = taken.iter().map(|socket| socket.uid).collect();
    let user = |uid: u32| {
        let of_user = taken.iter().filter(|socket| socket.uid == uid);
        let ports: Vec<_> = of_user
            .clone()
            .map(|socket| socket.at.port().to_string())
            .collect();
        let whose = if uid == own {
            "yours".to_owned()
        } else {
            format!("of user {uid}")
        };
        let found = format!("in use, {whose}: {}", ports.join(", "));
        let is_open = of_user.clone().any(|socket| !socket.is_loopback());
        if uid == own && is_open {
            let mend = "anyone who can reach this machine can connect to them; the hangar's vehicles have no such ports";
            HostFinding::note("ports", format!("{found}, open to others"), mend)
        } else {
            HostFinding::note(
                "ports",
                found,
                "start SITL by hand with another --listen-instance; the hangar needs none of these ports",
            )
        }
    };
    users.into_iter().map(user).collect()
}

fn is_usual(socket: &ListeningSocket) -> bool {
    let (first, offsets): (u16, &[u16]) = match socket.protocol {
        Protocol::Tcp => (FIRST_TCP, &[0, 2, 3]),
        Protocol::Udp => (FIRST_RC, &[0]),
    };
    let above = socket.at.port().checked_sub(first);
    above.is_some_and(|above| above < INSTANCES * APART && offsets.contains(&(above % APART)))
}

/// Processes left by earlier hangars.
pub(super) fn leftovers(settings: &CliSettings) -> Vec<HostFinding> {
    let Some(folder) = host::hangar_folder(settings) else {
        return Vec::new();
    };
    let (found, skipped) = crate::hangar::leftovers(&folder);
    let mut findings: Vec<_> = found
        .iter()
        .map(|leftover| {
            HostFinding::fault(
                "leftovers",
                format!(
                    "process {} ({}) of an earlier hangar still runs in {}",
                    leftover.pid, leftover.program, leftover.folder
                ),
                format!("kill {}; the next hangar also ends it", leftover.pid),
            )
        })
        .collect();
    findings.extend(skipped.into_iter().map(|text| {
        HostFinding::note("leftovers", text, "check it, and remove it if it is yours")
    }));
    if findings.is_empty() {
        findings.push(HostFinding::ok("leftovers", "none from earlier hangars"));
    }
    findings
}
