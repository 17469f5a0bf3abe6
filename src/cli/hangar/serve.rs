//! `sortie hangar` without a subcommand: the service.

use std::io::{self, Write as _};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::{Args, ValueEnum};
use futures_util::future::join_all;
use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::super::programs::ProgramOptions;
use super::super::settings::CliSettings;
use super::super::{Failure, runtime};
use crate::hangar::programs::{self, Missing};
use crate::hangar::service::{
    self, InstanceChange, PORT, Program, ServiceBounds, ServiceSetup, changes,
};
use crate::hangar::{
    Hangar, HangarLimits, HangarSetup, HangarToken, Instance, Instances, Restart, SitlStage,
};
use crate::sitl::SitlKind;

/// How long a program may take to identify itself.
const IDENTIFIED: Duration = Duration::from_secs(3);

/// Options of the service.
#[derive(Debug, Args)]
#[command(next_help_heading = "Service")]
pub(super) struct ServeArguments {
    /// Listen on this address; with port 0, the system chooses a port, which is printed.
    #[arg(long, value_name = "HOST:PORT", default_value_t = format!("127.0.0.1:{PORT}"), value_parser = parse_listen)]
    listen: String,
    /// Run at most this many instances at the same time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=254))]
    instances: Option<u16>,
    /// Limit the address space of each instance to this many mebibytes.
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u64).range(64..=65_536))]
    memory: Option<u64>,
    /// Restart instances that end without a request: never or always.
    #[arg(long, value_name = "WHEN")]
    restart: Option<RestartWhen>,
    /// Keep the instances' files in this folder.
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Read the token from this file, which is created if it does not exist.
    #[arg(long, value_name = "FILE")]
    token_file: Option<PathBuf>,
    /// Require the token also on loopback, from programs of the same user.
    #[arg(long)]
    require_token: bool,
    /// Also offer each vehicle's MAVLink on a loopback TCP port, for other ground stations. Every user of this machine
    /// can then fly the vehicle.
    #[arg(long)]
    expose: bool,
    #[command(flatten)]
    programs: ProgramOptions,
}

/// When an instance that has ended by itself is started again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RestartWhen {
    /// The instance stays down until you start it again.
    Never,
    /// At once, then after growing delays, until it has failed five times in a row.
    Always,
}

impl From<RestartWhen> for Restart {
    fn from(when: RestartWhen) -> Self {
        match when {
            RestartWhen::Never => Self::Never,
            RestartWhen::Always => Self::Always,
        }
    }
}

fn parse_listen(text: &str) -> Result<String, String> {
    let (host, port) = text
        .rsplit_once(':')
        .filter(|(host, _)| !host.is_empty())
        .ok_or_else(|| format!("expected HOST:PORT, such as 127.0.0.1:{PORT}"))?;
    if port.parse::<u16>().is_err() {
        return Err(format!("`{port}` is not a port: expected 0 to 65535"));
    }
    Ok(format!("{host}:{port}"))
}

/// Logs a line for the service's operator; does nothing if standard error is closed.
fn log(words: std::fmt::Arguments<'_>) {
    let _ = writeln!(io::stderr(), "sortie hangar: {words}");
}

pub(super) fn serve(options: &ServeArguments, settings: &CliSettings) -> Result<ExitCode, Failure> {
    settings.complain();
    let config = config(options, settings)?;
    let token_file = super::token_file(options.token_file.as_deref(), settings)?;
    let token = HangarToken::load_or_create(&token_file)
        .map_err(|error| Failure::Invalid(format!("sortie: {error}")))?;
    let mut setup = ServiceSetup {
        token,
        require_token: options.require_token,
        expose: options.expose,
        bounds: ServiceBounds::default(),
        owner: service::owner,
        programs: Vec::new(),
        restart: config.restart,
        limits: config.limits,
    };
    runtime()?.block_on(async {
        let cancel = CancellationToken::new();
        let ended = end_by_signal(cancel.clone())?;
        let listener = listen(&options.listen).await?;
        let hangar = Hangar::open(config)?;
        let address = listener.local_addr()?;
        say!("listening on http://{address}")?;
        warn(address, options);
        log(format_args!("the token is in {}", token_file.display()));
        let reporting = tokio::spawn(report(hangar.instances()));
        setup.programs = programs(options, settings).await;
        for leftover in hangar.leftovers().await {
            log(format_args!("left over: {leftover}"));
        }
        service::serve(listener, hangar, setup, cancel).await?;
        ended.abort();
        // The reports end when their sender is gone.
        let _ = reporting.await;
        log(format_args!("ended"));
        Ok(ExitCode::SUCCESS)
    })
}

fn config(options: &ServeArguments, settings: &CliSettings) -> Result<HangarSetup, Failure> {
    let set = &settings.config.hangar;
    let folder = options
        .folder
        .clone()
        .or_else(|| set.folder.clone().map(PathBuf::from));
    let in_state = || Some(settings.folders.as_ref()?.state.join("hangar"));
    let folder = folder.or_else(in_state).ok_or_else(|| {
        Failure::Invalid("sortie: no home folder: name one with --folder".to_owned())
    })?;
    let limits = HangarLimits {
        instances: options.instances.unwrap_or(set.instances),
        memory_mib: options.memory.unwrap_or(set.memory),
        ..HangarLimits::default()
    };
    Ok(HangarSetup {
        programs: options.programs.find(settings).paths(),
        folder,
        limits,
        restart: options.restart.map_or(set.restart, Restart::from),
        sortie: std::env::current_exe()?,
    })
}

/// The programs that can be started, for display; errors are reported now.
async fn programs(options: &ServeArguments, settings: &CliSettings) -> Vec<Program> {
    let found = options.programs.find(settings);
    for &kind in SitlKind::ALL {
        // A program that was named is always reported if it is missing; of the others, only the default kind.
        match found.of(kind) {
            Err(fault @ Missing::Named { .. }) => log(format_args!("warning: {fault}")),
            Err(fault) if kind == SitlKind::default() => {
                log(format_args!(
                    "warning: {fault}: name one with --{}",
                    kind.program()
                ));
            }
            _ => {}
        }
    }
    let asked = found.paths().into_iter().map(async |(kind, file)| {
        let identity = match programs::identify(&file, IDENTIFIED).await {
            Ok(identity) => format!(
                "{} {} ({})",
                identity.kind.name(),
                identity.version,
                identity.hash
            ),
            Err(unknown) => {
                log(format_args!("warning: {unknown}"));
                "unknown".to_owned()
            }
        };
        let file = file.display().to_string();
        Program {
            kind,
            file,
            identity,
        }
    });
    join_all(asked).await
}

async fn listen(address: &str) -> Result<TcpListener, Failure> {
    TcpListener::bind(address).await.map_err(|error| {
        let advice = match error.kind() {
            io::ErrorKind::AddrInUse => {
                ": something listens there already, perhaps another `sortie hangar`; choose another port with --listen"
            }
            io::ErrorKind::PermissionDenied => ": choose a port above 1023 with --listen",
            _ => ": choose another address with --listen",
        };
        anyhow::anyhow!("cannot listen on {address}: {error}{advice}").into()
    })
}

fn warn(address: SocketAddr, options: &ServeArguments) {
    if !address.ip().is_loopback() {
        log(format_args!(
            "warning: {address} can be reached from other machines, and HTTP is not encrypted: the token and the \
             vehicles' MAVLink can be read on the way. Listen on 127.0.0.1 and use `ssh -L {PORT}:127.0.0.1:{PORT} HOST` \
             where that matters"
        ));
    }
    if options.expose {
        log(format_args!(
            "warning: --expose lets every user of this machine fly the vehicles: their ports need no token"
        ));
    }
}

/// Cancels the token on any of the signals that usually end a program.
fn end_by_signal(cancel: CancellationToken) -> io::Result<tokio::task::JoinHandle<()>> {
    let mut terminate = signal(SignalKind::terminate())?;
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut hangup = signal(SignalKind::hangup())?;
    Ok(tokio::spawn(async move {
        let name = tokio::select! {
            _ = terminate.recv() => "SIGTERM",
            _ = interrupt.recv() => "SIGINT",
            _ = hangup.recv() => "SIGHUP",
        };
        log(format_args!("{name}: ending all vehicles"));
        cancel.cancel();
    }))
}

/// Reports when instances start, become ready and end, until the hangar is gone.
async fn report(mut seen: watch::Receiver<Instances>) {
    let mut before = Instances::default();
    loop {
        let now = Arc::clone(&seen.borrow_and_update());
        for change in changes(&before, &now) {
            match change {
                InstanceChange::Gone(id) => log(format_args!("vehicle {id}: ended")),
                InstanceChange::Vehicle(instance) => {
                    if let Some(words) = words(before.get(&instance.id), &instance) {
                        log(format_args!("vehicle {}: {words}", instance.id));
                    }
                }
            }
        }
        before = now;
        if seen.changed().await.is_err() {
            return;
        }
    }
}

/// The log line about a change to an instance; `None` for a change that is not logged.
fn words(before: Option<&Instance>, now: &Instance) -> Option<String> {
    let is_new = before.is_none_or(|before| before.pid != now.pid);
    if let Some(pid) = now.pid.filter(|_| is_new) {
        let (kind, system) = (now.kind.program(), now.system);
        let again = match now.restarts {
            0 => String::new(),
            times => format!(", start {}", times + 1),
        };
        return Some(format!(
            "started {kind} (system {system}, pid {pid}{again})"
        ));
    }
    if before.is_some_and(|before| before.stage == now.stage) {
        return None;
    }
    match now.stage {
        SitlStage::Ready => Some("ready to arm".to_owned()),
        SitlStage::Ended => {
            let fault = now.fault.as_deref().unwrap_or("it has ended");
            let last = now
                .last_output
                .last()
                .map(|line| format!("; its last output: {line}"));
            Some(format!("crashed: {fault}{}", last.unwrap_or_default()))
        }
        SitlStage::Queued
        | SitlStage::Process
        | SitlStage::Heartbeat
        | SitlStage::Parameters
        | SitlStage::Position
        | SitlStage::Stopping => None,
    }
}
