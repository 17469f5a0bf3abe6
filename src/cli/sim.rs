//! `sortie sim`: the embedded simulator as a server.

use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use clap::Args;
use nix::sys::resource::{Resource, getrlimit, setrlimit};
use tokio_util::sync::CancellationToken;

use super::backend::frame;
use super::home::StartPlace;
use super::{Failure, parse_speedup, runtime};
use crate::hash::fnv1a;
use crate::link::{Endpoint, Simulator, StartedSimulator};
use crate::sim::{BootPace, SYSTEMS, VehicleKind, World, WorldConfig};

/// Options of `sortie sim`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie sim --vehicles 4\n  \
    sortie sim --udp 127.0.0.1:14550 --home 50.45,30.52,180,90")]
pub(super) struct SimArguments {
    /// Simulate this many vehicles; their system ids are 1 to 254 and then start again at 1.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=5000))]
    vehicles: u16,
    /// Serve TCP: vehicle i, counted from 0, on PORT + 10 * i (serial 0), and on the ports 2 and 3 above that (serial 1
    /// and 2), as ArduPilot's SITL does. By default on 127.0.0.1:5760.
    #[arg(long, value_name = "HOST:PORT")]
    tcp: Option<HostPort>,
    /// Send over UDP to a ground station that listens on this address, often on port 14550.
    #[arg(long, value_name = "HOST:PORT", value_parser = parse_target)]
    udp: Option<HostPort>,
    /// Once a vehicle has a signing key, drop unsigned packets on serial 0 as well.
    #[arg(long)]
    strict_signing: bool,
    /// Run this many times as fast as real time.
    #[arg(long, default_value_t = 1.0, value_parser = parse_speedup)]
    speedup: f64,
    /// Use this seed for the noise of the simulation.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Boot as slowly as the real autopilot: the first heartbeat after 1 s, ready for GUIDED after 42 s.
    #[arg(long)]
    realistic_boot: bool,
    /// Let vehicles announce which ground station is in control of them, and refuse the commands of others
    /// (`CONTROL_STATUS`). ArduCopter 4.6 lacks this.
    #[arg(long)]
    operator_control: bool,
    /// Place the first vehicle here: latitude, longitude, height above sea level in metres, heading in degrees.
    #[arg(
        long,
        default_value = "-35.363262,149.165237,584,0",
        allow_hyphen_values = true
    )]
    home: StartPlace,
    /// Use this airframe: a JSON frame file of ArduPilot's SITL. Repeat the option for several vehicles: one file for
    /// each; the last one applies to all further vehicles.
    #[arg(long = "frame", value_name = "FILE")]
    frames: Vec<PathBuf>,
    /// Simulate this kind of vehicle: copter, rover (steered wheels), rover-skid (turns on the spot) or motorboat. Repeat
    /// the option for several vehicles: one kind for each; the last one applies to all further vehicles.
    #[arg(long = "kind", value_name = "KIND", value_parser = parse_kind)]
    kinds: Vec<VehicleKind>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct HostPort {
    host: String,
    port: u16,
}

impl FromStr for HostPort {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (host, port) = text
            .rsplit_once(':')
            .ok_or("expected HOST:PORT, such as 127.0.0.1:5760")?;
        let port = port
            .parse()
            .map_err(|_| format!("`{port}` is not a port: expected 0 to 65535"))?;
        Ok(Self {
            host: host.to_owned(),
            port,
        })
    }
}

/// Parses a kind of vehicle.
pub(super) fn parse_kind(text: &str) -> Result<VehicleKind, String> {
    VehicleKind::named(text).ok_or_else(|| {
        let names = VehicleKind::ALL.map(VehicleKind::name);
        format!("there is no such kind: use {}", names.join(", "))
    })
}

/// Parses an address to send to; its port must not be 0.
fn parse_target(text: &str) -> Result<HostPort, String> {
    match text.parse()? {
        HostPort { port: 0, .. } => Err(
            "port 0 cannot be reached: use the port of the ground station, often 14550".to_owned(),
        ),
        target => Ok(target),
    }
}

pub(super) fn serve(options: &SimArguments) -> Result<ExitCode, Failure> {
    let airframes: Result<Vec<_>, Failure> =
        options.frames.iter().map(|path| frame(path)).collect();
    let config = WorldConfig {
        seed: options.seed,
        airframes: airframes?,
        kinds: options.kinds.clone(),
        boot: if options.realistic_boot {
            BootPace::Realistic
        } else {
            BootPace::Quick
        },
        ..WorldConfig::row(usize::from(options.vehicles), options.home.0)
    };
    let endpoints = endpoints(options);
    let mut world = World::new(&config);
    if options.strict_signing {
        world.require_signatures();
    }
    world.mark_boards(place(&endpoints));
    if options.operator_control {
        world.announce_control();
    }
    allow_many_files();
    runtime()?.block_on(async {
        let cancel = CancellationToken::new();
        let started = Simulator::start(world, options.speedup, &endpoints, cancel.clone()).await?;
        say_where(&started)?;
        if let Some(HostPort { host, port }) = &options.udp {
            say!("sending to {host}:{port} over UDP")?;
        }
        if usize::from(options.vehicles) > SYSTEMS {
            say!("system ids repeat after {SYSTEMS}: only the TCP ports distinguish the vehicles")?;
        }
        say!("{} vehicle(s); stop with Ctrl-C", options.vehicles)?;
        tokio::signal::ctrl_c().await?;
        cancel.cancel();
        Ok(ExitCode::SUCCESS)
    })
}

/// The endpoints for ground stations: TCP on loopback by default.
fn endpoints(options: &SimArguments) -> Vec<Endpoint> {
    let mut endpoints = Vec::new();
    if let Some(HostPort { host, port }) = options.udp.clone() {
        endpoints.push(Endpoint::Udp { host, port });
    }
    if options.tcp.is_some() || endpoints.is_empty() {
        let HostPort { host, port } = options.tcp.clone().unwrap_or(HostPort {
            host: "127.0.0.1".to_owned(),
            port: 5760,
        });
        endpoints.push(Endpoint::Tcp { host, port });
    }
    endpoints
}

/// A number for the place of the simulator, from the first of its addresses: as with ArduPilot's SITL, the ids of the
/// boards depend on it.
fn place(endpoints: &[Endpoint]) -> u64 {
    endpoints.first().map_or(0, |endpoint| match endpoint {
        Endpoint::Pipes => 0,
        Endpoint::Tcp { host, port } | Endpoint::Udp { host, port } => {
            fnv1a(format!("{host}:{port}").as_bytes())
        }
    })
}

/// Raises the limit on open files, usually 1024, as any user may: each TCP server needs one file.
/// If that is not enough, the simulator reports the error.
fn allow_many_files() {
    if let Ok((_, hard)) = getrlimit(Resource::RLIMIT_NOFILE) {
        let _ = setrlimit(Resource::RLIMIT_NOFILE, hard, hard);
    }
}

/// Prints the TCP ports: of each vehicle if there are few, otherwise of the first and the last.
fn say_where(started: &StartedSimulator) -> Result<(), Failure> {
    let all: Vec<_> = started
        .addresses
        .iter()
        .zip(&started.further_addresses)
        .collect();
    let few = 10;
    for (place, (address, [one, two])) in all.iter().enumerate() {
        if all.len() <= few || place == 0 || place + 1 == all.len() {
            let (one, two) = (one.port(), two.port());
            say!("serving {address} (serial 1 and 2: {one} and {two})")?;
        } else if place == 1 {
            say!("serving {} more in between", all.len() - 2)?;
        }
    }
    Ok(())
}
