//! `sortie hangar command`: how to start SITL by hand.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::net::{SocketAddr, ToSocketAddrs as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use serde::Serialize;

use super::super::home::StartPlace;
use super::super::kind::{KindWord, parse_parameter};
use super::super::programs::ProgramOptions;
use super::super::settings::CliSettings;
use super::super::{Failure, parse_speedup};
use crate::parameters;
use crate::sitl::{
    CommandLine, FormationShape, Recipe, SerialEndpoint, SitlKind, StartFormation, quoted,
};
use crate::store;

/// Options of `sortie hangar command`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie hangar command | sh                                one copter on port 5760; Ctrl-C ends it\n  \
    sortie hangar command --vehicles 3 --formation wedge      three copters, to paste into a shell\n  \
    sortie hangar command --frame hexa.json --param RTL_ALT=3000\n  \
    sortie hangar command --kind rover --connect-out 127.0.0.1:5760")]
pub(super) struct CommandArguments {
    /// Start this kind of vehicle.
    #[arg(long, value_enum, default_value = "copter")]
    kind: KindWord,
    /// Use this SITL model: quad (a plus frame), x, hexa, ..; by default the one that suits the kind and the frame.
    #[arg(long, value_name = "NAME")]
    model: Option<String>,
    /// Use this airframe for a multirotor: a frame file of SITL, in JSON.
    #[arg(long, value_name = "FILE")]
    frame: Option<PathBuf>,
    /// Place the first vehicle here: latitude, longitude, height above sea level in metres, heading in degrees.
    #[arg(
        long,
        default_value = "-35.363262,149.165237,584,0",
        allow_hyphen_values = true
    )]
    home: StartPlace,
    /// Give the first vehicle this system id, and further vehicles the next ones.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=254))]
    system: u8,
    /// Run this many times as fast as real time.
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = parse_speedup)]
    speedup: f64,
    /// Start this many vehicles.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=254))]
    vehicles: u8,
    /// Place the vehicles in this formation; the first one is at home, and all have its heading.
    #[arg(long, value_enum, default_value = "row")]
    formation: ShapeWord,
    /// Leave this many metres between neighbours in the formation.
    #[arg(long, value_name = "METRES", default_value_t = 5.0, value_parser = parse_spacing)]
    spacing: f64,
    /// Set a parameter; repeat the option for each one. The vehicle silently ignores unknown names: version 4.7 has
    /// `SIM_GPS1_NUMSATS` instead of `SIM_GPS_NUMSATS` in 4.6.
    #[arg(long = "param", value_name = "NAME=VALUE", value_parser = parse_parameter)]
    set: Vec<(String, f64)>,
    /// Set the parameters in this file, one `NAME VALUE` per line.
    #[arg(long, value_name = "FILE")]
    params: Option<PathBuf>,
    /// Give the first vehicle this SITL instance number I: it listens on port 5760 + 10 * I.
    #[arg(
        long,
        value_name = "I",
        default_value_t = 0,
        conflicts_with = "connect_out"
    )]
    listen_instance: u16,
    /// Connect to a ground station that listens on this address, instead of listening.
    #[arg(long, value_name = "HOST:PORT", value_parser = parse_address)]
    connect_out: Option<SocketAddr>,
    /// Print one JSON document instead of a script.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    programs: ProgramOptions,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ShapeWord {
    Row,
    Column,
    Grid,
    Circle,
    Wedge,
}

impl From<ShapeWord> for FormationShape {
    fn from(word: ShapeWord) -> Self {
        match word {
            ShapeWord::Row => Self::Row,
            ShapeWord::Column => Self::Column,
            ShapeWord::Grid => Self::Grid,
            ShapeWord::Circle => Self::Circle,
            ShapeWord::Wedge => Self::Wedge,
        }
    }
}

fn parse_spacing(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    number
        .filter(|metres: &f64| (0.1..=10_000.0).contains(metres))
        .ok_or_else(|| "expected a number of metres from 0.1 to 10000".to_owned())
}

/// Parses an address and resolves its host name, because SITL accepts only a numeric address.
fn parse_address(text: &str) -> Result<SocketAddr, String> {
    let mut found = text
        .to_socket_addrs()
        .map_err(|error| format!("{error}: expected HOST:PORT, such as 127.0.0.1:5760"))?;
    found
        .find(|address| address.is_ipv4() && address.port() > 0)
        .ok_or_else(|| "SITL connects only to IPv4 addresses and ports above 0".to_owned())
}

/// One instance to start.
#[derive(Debug, Serialize)]
struct WrittenStart {
    system: u8,
    folder: String,
    program: String,
    arguments: Vec<String>,
    files: BTreeMap<&'static str, String>,
    /// The address for a ground station.
    connect: String,
    /// Ports on which the instance listens, by default on all interfaces.
    ports: Vec<u16>,
    /// The command line, for a shell in the folder.
    command: String,
    #[serde(skip)]
    preparation: String,
}

pub(super) fn command(
    options: &CommandArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let kind = SitlKind::from(options.kind);
    let programs = options.programs.find(settings);
    let (program, missing) = match programs.of(kind) {
        Ok(found) => (found.file.display().to_string(), None),
        Err(missing) => (kind.program().to_owned(), Some(missing.to_string())),
    };
    let orders = orders(options, &program)?;
    if options.json {
        say!("{}", serde_json::to_string_pretty(&orders)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(missing) = missing {
        tell!("sortie: {missing}");
        tell!(
            "sortie: the script starts `{program}`: put it on the PATH, or name it with --{program}"
        );
    }
    say!("{}", script(options, &orders).trim_end())?;
    Ok(ExitCode::SUCCESS)
}

fn orders(options: &CommandArguments, program: &str) -> Result<Vec<WrittenStart>, Failure> {
    let wrong = |what: String| Failure::Invalid(format!("sortie: {what}"));
    let vehicles = usize::from(options.vehicles);
    let last = usize::from(options.system) + vehicles - 1;
    if last > 254 {
        return Err(wrong(format!(
            "{vehicles} vehicles from system id {} on would end at {last}, but the highest is 254: use a lower id",
            options.system
        )));
    }
    let read =
        |path: &PathBuf, what| store::read(path, what).map_err(|error| wrong(error.to_string()));
    let airframe = options
        .frame
        .as_ref()
        .map(|path| read(path, "file-frame"))
        .transpose()?
        .map(|source| source.text);
    let parameters = given_parameters(options)?;
    let formation = StartFormation {
        shape: options.formation.into(),
        spacing_m: options.spacing,
    };
    let starts = formation.starts(vehicles, options.home.0);
    let usual = || options.kind.model().map(str::to_owned);
    let places = (0_u16..).zip(starts);
    places
        .map(|(place, start)| {
            let recipe = Recipe {
                kind: options.kind.into(),
                model: options.model.clone().or_else(usual),
                airframe: airframe.clone(),
                start,
                system: options.system + place as u8,
                speedup: options.speedup,
                parameters: parameters.clone(),
            };
            let endpoint = match options.connect_out {
                Some(address) => SerialEndpoint::Outwards(address),
                None => SerialEndpoint::Listening(options.listen_instance.saturating_add(place)),
            };
            order(&recipe, endpoint, program).map_err(|unfit| wrong(unfit.to_string()))
        })
        .collect()
}

fn order(
    recipe: &Recipe,
    endpoint: SerialEndpoint,
    program: &str,
) -> Result<WrittenStart, crate::sitl::SitlUnfit> {
    let line = recipe.command_line(endpoint)?;
    let ports = endpoint.ports()?;
    let folder = format!("sitl-{}", recipe.system);
    let connect = match endpoint {
        SerialEndpoint::Outwards(address) => format!("tcpin:{address}"),
        SerialEndpoint::Listening(_) => format!("tcp:127.0.0.1:{}", ports.first().unwrap_or(&0)),
    };
    let command = line.line(program);
    let preparation = line.preparation(&folder);
    let CommandLine { arguments, files } = line;
    Ok(WrittenStart {
        system: recipe.system,
        folder,
        program: program.to_owned(),
        arguments,
        files: files.into_iter().collect(),
        connect,
        ports,
        command,
        preparation,
    })
}

/// The parameters of the file, overridden by those of the command line.
fn given_parameters(options: &CommandArguments) -> Result<BTreeMap<String, f64>, Failure> {
    let mut all = BTreeMap::new();
    if let Some(path) = &options.params {
        all.extend(parameter_file(path)?);
    }
    all.extend(options.set.iter().cloned());
    Ok(all)
}

fn parameter_file(path: &Path) -> Result<Vec<(String, f64)>, Failure> {
    let source = store::read(path, "file-parameters")
        .map_err(|error| Failure::Invalid(format!("sortie: {error}")))?;
    let values = parameters::parse(&source.text).map_err(|faults| {
        let faults = faults.iter();
        let lines: Vec<_> = faults
            .map(|fault| format!("sortie: {}", fault.one_line(&source.name, &source.text)))
            .collect();
        Failure::Invalid(lines.join("\n"))
    })?;
    Ok(values
        .into_iter()
        .map(|(name, value)| (name.to_uppercase(), parameters::decimal(value)))
        .collect())
}

/// A script for a POSIX shell. It runs in a subshell, so pasting it does not change the user's
/// shell. The subshell stays the parent of the instances, because SITL ends with its parent.
fn script(options: &CommandArguments, orders: &[WrittenStart]) -> String {
    let mut text = String::from("(\npids=\n");
    for order in orders {
        let folder = quoted(&order.folder);
        text.push_str(&order.preparation);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "(cd {folder} && exec {}) > {folder}/output.log 2>&1 &\npids=\"$pids $!\"",
            order.command
        );
    }
    for remark in remarks(options, orders) {
        let _ = writeln!(text, "# {remark}");
    }
    text.push_str("trap 'kill $pids 2>/dev/null' EXIT\ntrap 'exit 130' HUP INT TERM\nwait\n)\n");
    text
}

fn remarks(options: &CommandArguments, orders: &[WrittenStart]) -> Vec<String> {
    let mut lines = Vec::new();
    let connect: Vec<&str> = orders.iter().map(|order| order.connect.as_str()).collect();
    if let Some(address) = options.connect_out {
        lines.push(format!(
            "Before you run this, start a ground station that listens on {address}: sortie connect tcpin:{address}"
        ));
        lines.push("An instance that finds no listener ends; it does not try again.".to_owned());
    } else {
        lines.push(format!(
            "Each boots once a client has connected: sortie connect {}",
            connect.join(" ")
        ));
        let all = orders.iter().flat_map(|order| &order.ports);
        let (first, last) = (all.clone().min().unwrap_or(&0), all.max().unwrap_or(&0));
        lines.push(format!(
            "TCP ports {first} to {last} are open on all interfaces, to anyone who can reach this machine."
        ));
    }
    lines
        .push("UDP ports for RC input are open as well: SITL has no option against it.".to_owned());
    lines.push("Ctrl-C ends them all; their output is in output.log in each folder.".to_owned());
    lines
}
