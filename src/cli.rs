//! The command line, for terminals and scripts. Errors go to standard error.
//!
//! # How the parts fit
//! - What all subcommands share: `settings` collects flags, environment and files, with the source of each value;
//!   `backend`, `home`, `programs` and `designs` are options of several subcommands; `fault` prints faults with their
//!   places; `table` aligns columns and writes Markdown and CSV; `trainee` opens profiles; `socket` connects to a
//!   running console.
//! - Flying: `fly` (the console, also for `connect`), `run` (a mission with a pilot script), `replay`, `sim` and
//!   `hangar` (vehicles for other programs).
//! - A class: `class` opens the instructor's desk; `seat` are the options of trainees' consoles, and `sortie join`.
//! - A crew: `hosting` is the option of the commands that fly with one, and `crew` joins one.
//! - A running console: `say` gives it lines, `watch` prints its state, `mcp` offers it to language models.
//! - After a flight: `debrief` scores it again, `verify` flies it again and compares, `records` lists, exports, signs
//!   and joins records.
//! - The trainee: `profile`, `report`, and `progress`, which has the columns of both and of the CSV.
//! - Files and designs: `check` finds faults, `plan` makes, converts and rehearses plans, `workshop` predicts the
//!   performance of a design.
//! - The program: `log` writes the log file, `doctor` examines this machine, `config` shows every setting, `manual`
//!   makes the manual pages and completions, `bench` measures.

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::link::Address;
use crate::text::{Language, Locale};
use crate::vehicle_id::VehicleIds;
use failure::{Failure, is_closed_pipe};
use settings::{CliSettings, Common};

/// Prints a line on standard output; unlike `println!` it reports a full disk or a closed pipe as an error.
macro_rules! say {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        let printed = crate::notice::sanitised_lines(&format!($($words)*));
        writeln!(std::io::stdout(), "{printed}")
    }};
}

/// Prints a line on standard error; does nothing if that is closed.
macro_rules! tell {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        let printed = crate::notice::sanitised_lines(&format!($($words)*));
        drop(writeln!(std::io::stderr(), "{printed}"));
    }};
}

mod backend;
mod bench;
mod check;
mod class;
mod config;
mod crew;
mod debrief;
mod designs;
mod doctor;
mod failure;
mod fault;
mod fly;
mod free;
mod hangar;
mod home;
mod hosting;
mod kind;
mod log;
mod manual;
mod mcp;
mod plan;
mod profile;
mod programs;
mod progress;
mod records;
mod replay;
mod report;
mod run;
mod say;
mod seat;
mod settings;
mod sim;
mod socket;
mod table;
mod trainee;
mod verify;
mod watch;
mod workshop;

/// The exit codes, as `--help` shows them.
const EXIT_CODES: &str = "\
0  success; for run: the mission was passed; for check: no faults; for plan rehearse: no conflict, fence kept
1  the command failed; for run: the mission was not passed; for check: there are faults
2  wrong usage or an invalid file
";

/// A terminal ground-control and training console for drone swarms.
#[derive(Debug, Parser)]
#[command(
    name = "sortie",
    version = env!("SORTIE_VERSION"),
    long_about = "A terminal ground-control and training console for drone swarms.\n\n\
                  Without a command, it opens the console's home screen, with the embedded simulator.",
    after_help = "Examples:\n  \
                  sortie                                     the home screen\n  \
                  sortie --speedup 4                         the same, with missions at four times real time\n  \
                  sortie fly 00                              the first mission\n  \
                  sortie connect tcp:127.0.0.1:5760          running vehicles\n  \
                  sortie run 01 --pilot 01-air-sample --json without a console"
)]
pub struct CliArguments {
    #[command(subcommand)]
    command: Option<CliCommand>,
    #[command(flatten)]
    home: fly::HomeArguments,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    /// Starts a mission, or free flight if none is named.
    Fly(fly::FlyArguments),
    /// Connects the console to running vehicles.
    #[command(after_help = "Examples:\n  \
                            sortie connect tcp:127.0.0.1:5760 tcp:127.0.0.1:5770\n  \
                            sortie connect udpin:0.0.0.0:14550 --expect 1-4\n  \
                            sortie connect serial:/dev/ttyACM0:115200\n  \
                            sortie connect flight.tlog")]
    Connect {
        /// Addresses of the vehicles: tcp:HOST:PORT, tcpin:HOST:PORT, udp:HOST:PORT, udpin:HOST:PORT,
        /// serial:DEVICE:BAUD, or a recording FILE.tlog.
        #[arg(required = true, value_name = "ADDR")]
        addresses: Vec<Address>,
        /// Limit the swarm to these vehicles, such as 1-4,7: `all` does not address any other vehicle in contact.
        #[arg(long, value_name = "IDS", value_parser = vehicle_ids)]
        expect: Option<VehicleIds>,
        #[command(flatten)]
        forwards: fly::ForwardArguments,
        #[command(flatten)]
        api: fly::ApiArguments,
        #[command(flatten)]
        seat: seat::SeatArguments,
        #[command(flatten)]
        crew: hosting::HostArguments,
        /// Print lines of text instead of drawing a screen, for screen readers and pipes.
        #[arg(long)]
        plain: bool,
    },
    /// Replays a recorded flight in the console: a record of this program, or any tlog.
    #[command(after_help = "Examples:\n  \
                            sortie replay                       the newest record\n  \
                            sortie replay flight.tlog")]
    Replay(replay::ReplayArguments),
    /// Lists, shows, exports and deletes the records of flights.
    Records(records::RecordsArguments),
    /// Flies a mission with a pilot script, without a console, and prints the debrief.
    Run(run::RunArguments),
    /// Flies a recorded flight again in the embedded simulator and checks that the outcome matches the record.
    Verify(verify::VerifyArguments),
    /// Opens the instructor's desk of a class, makes a class for several machines, and shows the results of a class.
    Class(class::ClassArguments),
    /// Opens the home screen in a class on several machines. Other commands join with --class and the same file.
    #[command(after_help = "Examples:\n  \
                            sortie join seat-07.join\n  \
                            sortie join seat-07.join --desk 192.168.1.9:7447   the desk has moved\n  \
                            sortie fly 00 --class seat-07.join                 a mission at once")]
    Join(seat::JoinArguments),
    /// Joins a crew, whose host flies with `sortie fly --crew NAME`.
    Crew(crew::CrewArguments),
    /// Sends lines to a console that was started with --api, and prints their outcomes.
    #[command(after_help = "Examples:\n  \
                            sortie say /tmp/lab.sock \"all arm\" \"all takeoff 20\"\n  \
                            sortie say /tmp/lab.sock --confirm \"all kill\"")]
    Say(say::SayArguments),
    /// Prints every change in the state of a console that was started with --api, as JSON lines.
    #[command(after_help = "Examples:\n  \
                            sortie watch /tmp/lab.sock ledger notices\n  \
                            sortie watch /tmp/lab.sock vehicles --every 5\n  \
                            sortie watch --schema")]
    Watch(watch::WatchArguments),
    /// Offers a console that was started with --api to language models, as a server of the Model Context Protocol (MCP)
    /// on standard input and output.
    #[command(after_help = "Examples:\n  \
                            sortie mcp --api /tmp/lab.sock                     tools that read\n  \
                            sortie mcp --api /tmp/lab.sock --allow-commands    also a tool that gives commands")]
    Mcp(mcp::McpArguments),
    /// Scores a recorded run again and prints its debrief.
    Debrief(debrief::DebriefArguments),
    /// Makes, checks, converts and rehearses plans, fences and rally points in files.
    Plan(plan::PlanArguments),
    /// Serves the embedded simulator to any ground station.
    Sim(sim::SimArguments),
    /// Checks this machine (terminal, folders, SITL, ports) and shows how to fix each problem.
    Doctor(doctor::DoctorArguments),
    /// Runs ArduPilot SITL processes on this host as a service, or prints how to start one by hand.
    Hangar(Box<hangar::HangarArguments>),
    /// Checks missions, pilot scripts, themes, keymaps, configurations and plans, and prints each fault with its line
    /// and column.
    #[command(after_help = "Examples:\n  \
                            sortie check missions/*.toml missions/pilots/*.pilot\n  \
                            sortie check ~/.config/sortie/*.toml\n  \
                            sortie check --fly 01 --seeds 20")]
    Check(check::CheckArguments),
    /// Creates, lists, shows, exports, imports and deletes profiles, and buys parts.
    Profile(profile::ProfileArguments),
    /// Prints the progress of a profile over time, as Markdown, CSV or JSON.
    Report(report::ReportArguments),
    /// Shows parts and designs of drones, robots and boats, and the predicted performance of a design.
    Workshop(workshop::WorkshopArguments),
    /// Prints every setting and its source: flag, environment, file or default.
    Config(config::ConfigArguments),
    /// Measures how much time, output and memory the program uses.
    #[command(subcommand)]
    Bench(bench::BenchCommand),
    /// Prints the completions of this command line for a shell.
    #[command(after_help = "Examples:\n  \
                            sortie completions bash > ~/.local/share/bash-completion/completions/sortie\n  \
                            sortie completions zsh > ~/.zfunc/_sortie\n  \
                            sortie completions fish > ~/.config/fish/completions/sortie.fish")]
    Completions {
        /// The shell to write completions for.
        shell: clap_complete::Shell,
    },
    /// Prints the manual page: this command line and the command language.
    #[command(after_help = "Examples:\n  \
                            sortie man | man -l -\n  \
                            sortie man --dir ~/.local/share/man/man1")]
    Man {
        /// Write pages to this folder instead: `sortie.1`, and one for each subcommand, such as `sortie-fly.1`.
        #[arg(long, value_name = "DIR")]
        dir: Option<PathBuf>,
    },
}

impl CliCommand {
    /// Whether the command opens the console, which shows notices itself.
    fn opens_console(&self) -> bool {
        matches!(
            self,
            Self::Fly(_)
                | Self::Connect { .. }
                | Self::Join(_)
                | Self::Crew(_)
                | Self::Replay(_)
                | Self::Class(_)
        )
    }

    /// Whether the command only reads the data folder: it creates no folder and changes no mode.
    fn only_reads(&self) -> bool {
        match self {
            Self::Profile(options) => options.only_reads(),
            Self::Replay(_)
            | Self::Records(_)
            | Self::Verify(_)
            | Self::Say(_)
            | Self::Watch(_)
            | Self::Mcp(_)
            | Self::Debrief(_)
            | Self::Doctor(_)
            | Self::Check(_)
            | Self::Report(_)
            | Self::Config(_)
            | Self::Completions { .. }
            | Self::Man { .. } => true,
            Self::Fly(_)
            | Self::Connect { .. }
            | Self::Class(_)
            | Self::Join(_)
            | Self::Crew(_)
            | Self::Run(_)
            | Self::Plan(_)
            | Self::Sim(_)
            | Self::Hangar(_)
            | Self::Workshop(_)
            | Self::Bench(_) => false,
        }
    }
}

/// Prints rendered faults of files on standard error.
fn show(faults: &str) {
    drop(writeln!(io::stderr(), "{faults}"));
}

/// Runs the program and returns its exit code.
pub fn main(arguments: CliArguments) -> ExitCode {
    let outcome = settings::gather(&arguments.common).and_then(|mut settings| {
        let only_reads = arguments
            .command
            .as_ref()
            .is_some_and(CliCommand::only_reads);
        if !only_reads {
            settings.share_results();
        }
        let locale = Locale::new(settings.language());
        let is_console = arguments
            .command
            .as_ref()
            .is_none_or(CliCommand::opens_console);
        if settings.sources.is_flag("lang")
            && !is_console
            && let Some(text) = settings.withheld_language_text()
        {
            tell!("sortie: {text}");
        }
        log::start(&settings)
            .and_then(|()| dispatch(arguments.command, &arguments.home, settings))
            .map_err(|failure| failure.said_in(&locale))
    });
    outcome.unwrap_or_else(told)
}

/// Prints why a command failed, and returns the exit code.
fn told(failure: Failure) -> ExitCode {
    match failure {
        // A closed output means that its reader needs no more of it: no error.
        Failure::Failed(error) if is_closed_pipe(&error) => ExitCode::from(1),
        Failure::Failed(error) => {
            tell!("sortie: {error:#}");
            ExitCode::from(1)
        }
        Failure::Invalid(text) => {
            tell!("{text}");
            ExitCode::from(2)
        }
        Failure::Shown(text) => {
            show(&text);
            ExitCode::from(2)
        }
        // Both have been put into words above.
        Failure::Wrong(texts) => {
            for text in texts {
                tell!("sortie: {text}");
            }
            ExitCode::from(2)
        }
        Failure::Faulty(fault) => {
            show(&fault.explained(&Locale::new(Language::English)));
            ExitCode::from(2)
        }
    }
}

/// Prints the help, the version or a usage error, and returns the exit code: 0 for what was requested, 2 for an error, 1 if
/// it could not be written.
pub fn refuse(outcome: &clap::Error) -> ExitCode {
    let written = outcome.print().and_then(|()| io::stdout().flush());
    match written {
        Ok(()) if outcome.use_stderr() => ExitCode::from(2),
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::from(1),
        Err(error) => {
            tell!("sortie: {error}");
            ExitCode::from(1)
        }
    }
}

fn dispatch(
    command: Option<CliCommand>,
    home: &fly::HomeArguments,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    match command {
        None => fly::home(home, settings),
        Some(_) if !home.is_default() => Err(Failure::Invalid(
            "sortie: --seed, --speedup, --class and --desk go after the command".to_owned(),
        )),
        Some(CliCommand::Fly(options)) => fly::fly(&options, settings),
        Some(CliCommand::Connect {
            addresses,
            expect,
            forwards,
            api,
            seat,
            crew,
            plain,
        }) => {
            let mut settings = settings;
            if expect.is_some() {
                settings.config.connect.expect = expect;
            }
            let joined = fly::JoinedArguments {
                forwards: &forwards,
                api: &api,
                seat: &seat,
                crew: &crew,
            };
            fly::connect(addresses, joined, plain, settings)
        }
        Some(CliCommand::Records(options)) => records::records(&options, settings.complained()),
        Some(CliCommand::Replay(options)) => replay::replay(&options, settings),
        Some(CliCommand::Run(options)) => run::run(&options, settings.complained()),
        Some(CliCommand::Verify(options)) => verify::verify(&options, settings.complained()),
        Some(CliCommand::Class(options)) => class::class(&options, settings),
        Some(CliCommand::Join(options)) => fly::join(&options, settings),
        Some(CliCommand::Crew(options)) => crew::crew(&options, settings),
        Some(CliCommand::Say(options)) => say::say(&options),
        Some(CliCommand::Watch(options)) => watch::watch(&options),
        Some(CliCommand::Mcp(options)) => mcp::serve(&options),
        Some(CliCommand::Debrief(options)) => debrief::debrief(&options, settings.complained()),
        Some(CliCommand::Plan(options)) => plan::plan(&options, settings.complained()),
        Some(CliCommand::Sim(options)) => {
            settings.complain();
            sim::serve(&options)
        }
        Some(CliCommand::Doctor(options)) => doctor::doctor(&options, &settings),
        Some(CliCommand::Hangar(options)) => hangar::hangar(&options, settings.complained()),
        Some(CliCommand::Check(options)) => check::check(&options, &settings),
        Some(CliCommand::Profile(options)) => profile::profile(&options, settings.complained()),
        Some(CliCommand::Report(options)) => report::report(&options, settings.complained()),
        Some(CliCommand::Workshop(options)) => workshop::workshop(&options, settings.complained()),
        Some(CliCommand::Config(options)) => config::config(&options, &settings),
        Some(CliCommand::Bench(bench)) => bench::bench(&bench, &settings),
        Some(CliCommand::Completions { shell }) => manual::completions(shell),
        Some(CliCommand::Man { dir }) => manual::man(dir.as_deref()),
    }
}

/// Parses vehicle ids such as `1-4,7`.
fn vehicle_ids(text: &str) -> Result<VehicleIds, String> {
    text.parse()
        .map_err(|reason: crate::text::Text| reason.to_string())
}

/// Parses a speed-up from 0.01 to 1000.
fn parse_speedup(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|times: &f64| (0.01..=1000.0).contains(times))
        .ok_or_else(|| "expected a number from 0.01 to 1000".to_owned())
}

fn runtime() -> io::Result<tokio::runtime::Runtime> {
    tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .enable_all()
        .build()
}
