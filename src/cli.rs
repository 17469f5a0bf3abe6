//! The command line: what scripts rely on.
//!
//! Exit codes: 0 done (for `run`: mission passed), 1 the thing asked for failed (for `run`: mission not
//! passed), 2 wrong usage or an invalid file. Errors go to standard error.

use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;

use clap::{Args, Parser, Subcommand};

use crate::link::Address;

/// Prints a line on standard output; unlike `println!` it reports a full disk or a closed pipe as an error.
macro_rules! say {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        writeln!(std::io::stdout(), $($words)*)
    }};
}

mod bench;
mod check;
mod fly;
mod run;
mod sim;

/// A terminal ground-control and training console for drone swarms.
#[derive(Debug, Parser)]
#[command(
    name = "sortie",
    version,
    after_help = "Without a command: the console's home screen, on the embedded simulator.\n\n\
                  Examples:\n  sortie\n  sortie fly 01\n  sortie connect tcp:127.0.0.1:5760\n  \
                  sortie run 01 --pilot 01-air-sample --json"
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    show: fly::ShowArguments,
    #[command(flatten)]
    common: Common,
}

/// Options of every command.
#[derive(Debug, Args)]
struct Common {
    /// Write a log to FILE (levels by `SORTIE_LOG`, such as `info` or `sortie::link=debug`).
    #[arg(long, global = true, value_name = "FILE")]
    log: Option<PathBuf>,
    /// The console's theme: dark, light, high-contrast, monochrome.
    #[arg(long, global = true, value_name = "NAME")]
    theme: Option<String>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Straight into a mission, or into free flight without one.
    Fly(fly::FlyArguments),
    /// The console on vehicles that are already there.
    Connect {
        /// Where they are: tcp:HOST:PORT, tcpin:HOST:PORT, udp:HOST:PORT, udpin:HOST:PORT, serial:DEVICE:BAUD, or a recording FILE.tlog.
        #[arg(required = true, value_name = "ADDR")]
        addresses: Vec<Address>,
        #[command(flatten)]
        show: fly::ShowArguments,
    },
    /// A pilot script flies a mission without a console; prints the debrief.
    Run(run::RunArguments),
    /// The embedded simulator as a server for any ground station.
    Sim(sim::SimArguments),
    /// Checks missions and pilot scripts; faults are printed with their line and column.
    Check {
        /// Files ending in .toml (missions, themes) or .pilot.
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
    },
    /// Measurements.
    #[command(subcommand)]
    Bench(bench::Bench),
}

/// Why a command did not do what it was asked.
#[derive(Debug)]
enum Failure {
    /// The thing asked for failed; exit code 1.
    Failed(anyhow::Error),
    /// Wrong usage or an invalid file; exit code 2. The text may have several lines.
    Invalid(String),
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Runs the program and returns its exit code.
pub fn main(arguments: Arguments) -> ExitCode {
    let outcome = start_log(&arguments.common).and_then(|()| dispatch(arguments));
    match outcome {
        Ok(code) => code,
        // Whoever reads our output has had enough of it: nothing to complain about.
        Err(Failure::Failed(error)) if is_closed_pipe(&error) => ExitCode::from(1),
        Err(Failure::Failed(error)) => {
            eprintln!("sortie: {error:#}");
            ExitCode::from(1)
        }
        Err(Failure::Invalid(text)) => {
            eprintln!("{text}");
            ExitCode::from(2)
        }
    }
}

fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<io::Error>()
        .is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

fn dispatch(arguments: Arguments) -> Result<ExitCode, Failure> {
    let theme = fly::theme(arguments.common.theme.as_deref())?;
    match arguments.command {
        None => fly::home(&arguments.show, theme),
        Some(Command::Fly(options)) => fly::fly(&options, theme),
        Some(Command::Connect { addresses, show }) => fly::connect(addresses, &show, theme),
        Some(Command::Run(options)) => run::run(&options),
        Some(Command::Sim(options)) => sim::serve(&options),
        Some(Command::Check { files }) => check::check(&files),
        Some(Command::Bench(bench)) => bench::bench(&bench),
    }
}

fn start_log(common: &Common) -> Result<(), Failure> {
    let Some(path) = &common.log else {
        return Ok(());
    };
    let file = File::create(path).map_err(|error| {
        Failure::Invalid(format!(
            "sortie: cannot write the log {}: {error}",
            path.display()
        ))
    })?;
    let levels = tracing_subscriber::EnvFilter::try_from_env("SORTIE_LOG")
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("info"));
    tracing_subscriber::fmt()
        .with_writer(Mutex::new(file))
        .with_ansi(false)
        .with_env_filter(levels)
        .init();
    Ok(())
}

/// A factor that a simulation can keep up with.
fn parse_speedup(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|times: &f64| (0.01..=1000.0).contains(times))
        .ok_or_else(|| "expected a number from 0.01 to 1000".to_owned())
}

/// The runtime of commands that have tasks.
fn runtime() -> io::Result<tokio::runtime::Runtime> {
    tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .enable_all()
        .build()
}
