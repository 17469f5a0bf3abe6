//! `sortie`, `sortie fly` and `sortie connect`: the console.

use std::io::IsTerminal as _;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;

use super::settings::Settings;
use super::{Failure, parse_speedup, runtime};
use crate::console::{self, Opening, Options, Preferences};
use crate::link::Address;
use crate::store::History;
use crate::terminal;
use crate::text::Locale;
use crate::ui::Look;

/// Simulated vehicles in free flight, unless told otherwise.
const VEHICLES: u8 = 4;

/// Options of `sortie fly`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie fly 01\n  \
    sortie fly --vehicles 8 --speedup 4\n  \
    sortie fly missions/my-mission.toml --seed 7")]
pub(super) struct FlyArguments {
    /// A mission file, or the name or number of an embedded mission; free flight without one.
    mission: Option<String>,
    /// Simulated vehicles in free flight.
    #[arg(long, default_value_t = VEHICLES, value_parser = clap::value_parser!(u8).range(1..=250))]
    vehicles: u8,
    /// Fly vehicles that are already there instead of simulated ones.
    #[arg(long, value_name = "ADDR", num_args = 1.., conflicts_with_all = ["mission", "vehicles"])]
    connect: Vec<Address>,
    /// What varies the mission's world.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Simulated seconds per second.
    #[arg(long, default_value_t = 1.0, value_parser = parse_speedup)]
    speedup: f64,
}

/// The home screen.
pub(super) fn home(settings: Settings) -> Result<ExitCode, Failure> {
    open(Opening::Home, settings, VEHICLES, 1, 1.0)
}

/// A mission or free flight.
pub(super) fn fly(options: &FlyArguments, settings: Settings) -> Result<ExitCode, Failure> {
    let opening = match &options.mission {
        _ if !options.connect.is_empty() => Opening::Connect(options.connect.clone()),
        Some(mission) => {
            // Faults are shown here, with the lines around them, rather than inside the console.
            Opening::Mission(Arc::new(super::run::load_mission(mission)?))
        }
        None => Opening::Free,
    };
    open(
        opening,
        settings,
        options.vehicles,
        options.seed,
        options.speedup,
    )
}

/// Vehicles that are already there.
pub(super) fn connect(addresses: Vec<Address>, settings: Settings) -> Result<ExitCode, Failure> {
    open(Opening::Connect(addresses), settings, VEHICLES, 1, 1.0)
}

/// A recording that is not there will not appear later, so it is no case for trying again.
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

fn look(settings: &Settings) -> Look {
    let config = &settings.config;
    Look {
        theme: settings.theme.for_colours(terminal::colour_depth()),
        locale: Arc::new(Locale::new(config.lang.unwrap_or_default())),
        symbols: config.symbols.unwrap_or_default(),
    }
}

fn preferences(settings: Settings) -> Preferences {
    let folders = settings.folders.as_ref();
    Preferences {
        history: folders.map(|folders| History::within(&folders.state)),
        warnings: settings.warnings(),
        config: settings.config,
        keymap: settings.keymap,
        themes: settings.themes,
    }
}

fn open(
    opening: Opening,
    settings: Settings,
    vehicles: u8,
    seed: u64,
    speedup: f64,
) -> Result<ExitCode, Failure> {
    if !std::io::stdout().is_terminal() || !std::io::stdin().is_terminal() {
        return Err(Failure::Failed(anyhow::anyhow!(
            "the console needs a terminal on standard input and output; `sortie run` works without one"
        )));
    }
    if let Opening::Connect(addresses) = &opening {
        for address in addresses {
            check_recording(address)?;
        }
    }
    // Under the console, so that it is there when the console is left.
    settings.complain();
    let options = Options {
        opening,
        vehicles,
        seed,
        speedup,
        look: look(&settings),
        preferences: preferences(settings),
    };
    let runtime = runtime()?;
    let outcome = runtime.block_on(console::run(options));
    // Tasks that still wait for a socket are not worth waiting for.
    runtime.shutdown_background();
    outcome?;
    Ok(ExitCode::SUCCESS)
}
