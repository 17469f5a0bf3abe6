//! `sortie`, `sortie fly` and `sortie connect`: the console.

use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;

use super::backend::{self, BackendArguments};
use super::designs::DesignArguments;
use super::free::FreeOptions;
use super::hosting::HostArguments;
use super::seat::{JoinArguments, SeatArguments, Seating};
use super::settings::CliSettings;
use super::{Failure, parse_speedup, runtime};
use crate::forward::{ForwardFault, ForwardSpec};
use crate::hangar::VehicleBackend;
use crate::link::{Address, Signer, signing_clock};
use crate::scoring::FlownBy;
use crate::shell::{self, ApiOptions, ConsoleOptions, Opening, Preferences};
use crate::store::{History, KeyFile};
use crate::terminal::Environment;
use crate::text;
use crate::text::{Locale, Text};
use crate::ui::Look;

/// The default number of simulated vehicles in free flight.
const VEHICLES: u8 = 4;

/// Options of `sortie fly`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie fly 00\n  \
    sortie fly 05 --design searcher\n  \
    sortie fly --vehicles 8 --speedup 4\n  \
    sortie fly missions/my-mission.toml --seed 7\n  \
    sortie fly 06 --crew alpha                 others join with sortie crew join alpha\n  \
    sortie fly 01 --backend ardupilot --arducopter build/sitl/bin/arducopter\n  \
    sortie fly --kind rover --vehicles 2 --home 50.45,30.52,180,90 --param WP_SPEED=3\n  \
    sortie fly --kind boat --ardurover build/sitl/bin/ardurover")]
pub(super) struct FlyArguments {
    /// A mission file, or the name or number of a mission; without one, free flight.
    mission: Option<String>,
    /// Start this many simulated vehicles in free flight.
    #[arg(long, default_value_t = VEHICLES, value_parser = clap::value_parser!(u8).range(1..=250))]
    vehicles: u8,
    /// Connect to running vehicles at these addresses instead of starting simulated ones.
    #[arg(long, value_name = "ADDR", num_args = 1.., conflicts_with_all = ["mission", "vehicles"])]
    connect: Vec<Address>,
    /// Use this seed for the mission's world; by default a new one for each attempt.
    #[arg(long)]
    seed: Option<u64>,
    /// Run this many times as fast as real time.
    #[arg(long, default_value_t = 1.0, value_parser = parse_speedup)]
    speedup: f64,
    #[command(flatten)]
    forwards: ForwardArguments,
    #[command(flatten)]
    api: ApiArguments,
    #[command(flatten)]
    seat: SeatArguments,
    #[command(flatten)]
    crew: HostArguments,
    /// Print lines of text instead of drawing a screen, for screen readers and pipes.
    #[arg(long)]
    plain: bool,
    #[command(flatten)]
    designs: DesignArguments,
    #[command(flatten)]
    free: FreeOptions,
    #[command(flatten)]
    backend: BackendArguments,
}

/// The forwards of `sortie fly` and `sortie connect`.
#[derive(Debug, Args)]
pub(super) struct ForwardArguments {
    /// Share the links with ground stations at this address: "ADDR [read-only] [only NAMES] [except NAMES] [rate
    /// HZ]", such as udp:127.0.0.1:14550 or "tcpin:127.0.0.1:5790 read-only"; repeat the option for several
    /// addresses.
    #[arg(long = "forward", value_name = "ADDR", value_parser = forward)]
    forwards: Vec<ForwardSpec>,
}

/// The interface for programs of `sortie fly` and `sortie connect`.
#[derive(Debug, Args)]
pub(super) struct ApiArguments {
    /// Let your own programs use the console through a Unix socket at this path: they read its state and give
    /// commands. Flights then count as practice, as flown by a script.
    #[arg(long, value_name = "SOCKET")]
    api: Option<PathBuf>,
    /// Let programs only read the console's state through this socket; flights count as usual.
    #[arg(long, value_name = "SOCKET", conflicts_with = "api")]
    api_read_only: Option<PathBuf>,
}

impl ApiArguments {
    fn options(&self) -> Option<ApiOptions> {
        let commands = self.api.is_some();
        let socket = self.api.as_ref().or(self.api_read_only.as_ref())?.clone();
        Some(ApiOptions { socket, commands })
    }
}

fn forward(words: &str) -> Result<ForwardSpec, String> {
    let spec: ForwardSpec = words
        .parse()
        .map_err(|fault: ForwardFault| fault.to_string())?;
    let address: Result<Address, _> = spec.address.parse();
    match address {
        Ok(Address::File { .. }) => Err(text!("forward-file", address = spec.address).to_string()),
        Ok(_) => Ok(spec),
        Err(error) => Err(error.to_string()),
    }
}

impl ForwardArguments {
    /// The forwards that were named, or those of the configuration if none were.
    fn or_configured(&self, settings: &CliSettings) -> Result<Vec<ForwardSpec>, Failure> {
        if !self.forwards.is_empty() {
            return Ok(self.forwards.clone());
        }
        let configured = settings.config.connect.forward.iter();
        configured
            .map(|words| forward(words))
            .collect::<Result<_, _>>()
            .map_err(|fault| Failure::Invalid(format!("sortie: connect.forward: {fault}")))
    }
}

/// The heading of the options that `sortie` takes without a command; a command has its own after it.
const HOME_OPTIONS: &str = "Options without a command";

/// Options of `sortie` without a command.
#[derive(Debug, Args)]
pub(super) struct HomeArguments {
    /// Use this seed for the missions' worlds; by default a new one for each attempt.
    #[arg(long, help_heading = HOME_OPTIONS)]
    seed: Option<u64>,
    /// Run this many times as fast as real time.
    #[arg(long, value_parser = parse_speedup, help_heading = HOME_OPTIONS)]
    speedup: Option<f64>,
    #[command(flatten)]
    seat: SeatArguments,
}

impl HomeArguments {
    /// Whether all values are the defaults.
    pub fn is_default(&self) -> bool {
        self.seed.is_none() && self.speedup.is_none() && self.seat.is_default()
    }
}

/// Opens the home screen. The options apply to every mission chosen there.
pub(super) fn home(arguments: &HomeArguments, settings: CliSettings) -> Result<ExitCode, Failure> {
    let options = ConsoleOptions {
        seed: arguments.seed,
        speedup: arguments.speedup.unwrap_or(1.0),
        ..seated(&arguments.seat, Opening::Home, settings)?
    };
    open(options, false)
}

/// Opens the home screen in the class of a join line.
pub(super) fn join(arguments: &JoinArguments, settings: CliSettings) -> Result<ExitCode, Failure> {
    let options = ConsoleOptions {
        class: Some(arguments.class()?),
        ..options(Opening::Home, settings)?
    };
    open(options, false)
}

/// Opens the console on a mission or on free flight.
pub(super) fn fly(arguments: &FlyArguments, settings: CliSettings) -> Result<ExitCode, Failure> {
    let opening = match &arguments.mission {
        _ if !arguments.connect.is_empty() => Opening::Connect(arguments.connect.clone()),
        Some(mission) => {
            // Faults are shown here, with the lines around them, rather than inside the console.
            let mission = super::run::load_mission(mission)?;
            Opening::Mission(Arc::new(arguments.designs.equip(mission, &settings)?))
        }
        None => Opening::Free,
    };
    // Faults are reported before the screen opens.
    let backend = arguments
        .backend
        .choose(&arguments.free.asked(), &settings)?;
    let options = ConsoleOptions {
        forwards: arguments.forwards.or_configured(&settings)?,
        api: arguments.api.options(),
        backend: VehicleBackend {
            free: arguments.free.flight(backend.ardupilot.is_some())?,
            ..backend
        },
        vehicles: arguments.vehicles,
        seed: arguments.seed,
        speedup: arguments.speedup,
        ..together(&arguments.seat, &arguments.crew, opening, settings)?
    };
    open(options, arguments.plain)
}

/// The options of `sortie connect` about others who take part.
#[derive(Clone, Copy)]
pub(super) struct JoinedArguments<'a> {
    pub forwards: &'a ForwardArguments,
    pub api: &'a ApiArguments,
    pub seat: &'a SeatArguments,
    pub crew: &'a HostArguments,
}

/// Opens the console on running vehicles.
pub(super) fn connect(
    addresses: Vec<Address>,
    joined: JoinedArguments<'_>,
    plain: bool,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    let options = ConsoleOptions {
        forwards: joined.forwards.or_configured(&settings)?,
        api: joined.api.options(),
        ..together(
            joined.seat,
            joined.crew,
            Opening::Connect(addresses),
            settings,
        )?
    };
    open(options, plain)
}

/// Reports a recording that does not exist: it will not appear later, so there is no point in trying again.
fn check_recording(address: &Address) -> Result<(), Failure> {
    if let Address::File { path } = address
        && let Err(error) = std::fs::File::open(path)
    {
        let path = path.display();
        return Err(Failure::Invalid(format!(
            "sortie: cannot read the recording {path}: {error}"
        )));
    }
    Ok(())
}

/// The look of the console: as configured, otherwise chosen by the terminal's capabilities.
fn look(settings: &CliSettings) -> Look {
    let environment = Environment::of_process();
    Look {
        theme: settings.theme.for_colours(environment.colour_depth()),
        locale: Arc::new(Locale::new(settings.language())),
        symbols: settings.symbols(),
        ..Look::default()
    }
}

/// The console's options. Faults of the user's files are printed before the console starts, so that
/// they are visible after it ends.
pub(super) fn options(
    opening: Opening,
    mut settings: CliSettings,
) -> Result<ConsoleOptions, Failure> {
    if let Opening::Connect(addresses) = &opening {
        for address in addresses {
            check_recording(address)?;
        }
    }
    let documents = settings.read_parameter_documents()?;
    let events = settings.read_event_documents()?;
    settings.complain();
    let ardupilot = backend::found(&settings);
    let folders = settings.folders.as_ref();
    let mut warnings = settings.warnings();
    let signer = signer(&settings, &mut warnings);
    Ok(ConsoleOptions {
        opening,
        backend: VehicleBackend::default(),
        ardupilot,
        vehicles: VEHICLES,
        seed: None,
        speedup: 1.0,
        typed_by: FlownBy::Hand,
        api: None,
        class: None,
        crew: None,
        forwards: Vec::new(),
        look: look(&settings),
        preferences: Preferences {
            history: folders.map(|folders| History::within(&folders.state)),
            runs: settings.data.runs(),
            records: settings
                .records()
                .filter(|_| settings.config.records.enabled),
            data: settings.data.path().map(Path::to_owned),
            profile: settings.config.profile.clone(),
            signer: Some(signer),
            warnings,
            is_lang_given: settings.sources.is_flag("lang"),
            config: settings.config,
            keymap: settings.keymap,
            documents: Arc::new(documents),
            events: Arc::new(events),
            themes: settings.themes,
        },
    })
}

/// The console's options with the crew or in the class of the arguments: a console with a crew is in no class.
fn together(
    seat: &SeatArguments,
    crew: &HostArguments,
    opening: Opening,
    settings: CliSettings,
) -> Result<ConsoleOptions, Failure> {
    match crew.options() {
        None => seated(seat, opening, settings),
        crew => Ok(ConsoleOptions {
            crew,
            ..options(opening, settings)?
        }),
    }
}

/// The options of a trainee's console, which may be in a class.
fn seated(
    seat: &SeatArguments,
    opening: Opening,
    settings: CliSettings,
) -> Result<ConsoleOptions, Failure> {
    let Seating { class, warning } = seat.or_configured(&settings)?;
    let mut options = options(opening, settings)?;
    options.class = class;
    options.preferences.warnings.extend(warning);
    Ok(options)
}

/// A signer with the user's keys. If they cannot be used, a warning gives the reason.
fn signer(settings: &CliSettings, warnings: &mut Vec<Text>) -> Signer {
    let opened = match settings.data.path() {
        Some(data) => KeyFile::open(data).map_err(|fault| Text::from(&fault)),
        None => Err(text!("signing-no-folder")),
    };
    if let (Err(fault), true) = (&opened, settings.data.path().is_some()) {
        warnings.push(fault.clone());
    }
    let is_required = settings.config.connect.require_signing;
    Signer::new(opened, is_required, signing_clock)
}

pub(super) fn open(options: ConsoleOptions, plain: bool) -> Result<ExitCode, Failure> {
    if !plain && let Some(fault) = no_screen() {
        let fault = options.look.text(&fault);
        return Err(Failure::Failed(anyhow::anyhow!(fault)));
    }
    let runtime = runtime()?;
    let outcome = runtime.block_on(async {
        if plain {
            let typed_by = if std::io::stdin().is_terminal() {
                FlownBy::Hand
            } else {
                FlownBy::Script
            };
            Box::pin(shell::plain::run(ConsoleOptions {
                typed_by,
                ..options
            }))
            .await
        } else {
            Box::pin(shell::run(options)).await.map(|()| true)
        }
    });
    // The runtime does not wait for tasks that are blocked on a socket.
    runtime.shutdown_background();
    Ok(ExitCode::from(u8::from(!outcome?)))
}

/// The reason why no screen can be opened, if there is one.
fn no_screen() -> Option<Text> {
    if std::io::stdout().is_terminal() && std::io::stdin().is_terminal() {
        Environment::of_process().fault()
    } else {
        Some(text!("terminal-missing"))
    }
}
