//! `sortie`, `sortie fly` and `sortie connect`: the console.

use std::io::IsTerminal as _;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;

use super::{Failure, parse_speedup, runtime};
use crate::console::{self, Opening, Options};
use crate::diagnostic::nearest;
use crate::link::Address;
use crate::terminal;
use crate::ui::{Look, Theme};

/// Simulated vehicles in free flight, unless told otherwise.
const VEHICLES: u8 = 4;

/// Options of `sortie fly`.
#[derive(Debug, Args)]
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
pub(super) fn home(theme: Theme) -> Result<ExitCode, Failure> {
    open(Opening::Home, theme, VEHICLES, 1, 1.0)
}

/// A mission or free flight.
pub(super) fn fly(options: &FlyArguments, theme: Theme) -> Result<ExitCode, Failure> {
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
        theme,
        options.vehicles,
        options.seed,
        options.speedup,
    )
}

/// Vehicles that are already there.
pub(super) fn connect(addresses: Vec<Address>, theme: Theme) -> Result<ExitCode, Failure> {
    open(Opening::Connect(addresses), theme, VEHICLES, 1, 1.0)
}

/// The theme of that name, in the colours that the terminal has.
pub(super) fn theme(name: Option<&str>) -> Result<Theme, Failure> {
    let theme = match name {
        None => Theme::default(),
        Some(name) => Theme::named(name).ok_or_else(|| {
            let names: Vec<&str> = Theme::names().collect();
            let guess = nearest(name, names.iter().copied())
                .map_or(String::new(), |guess| format!("; did you mean `{guess}`?"));
            Failure::Invalid(format!(
                "sortie: there is no theme `{name}`: choose one of {}{guess}",
                names.join(", ")
            ))
        })?,
    };
    Ok(theme.for_colours(terminal::colour_depth()))
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

fn open(
    opening: Opening,
    theme: Theme,
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
    let options = Options {
        opening,
        vehicles,
        seed,
        speedup,
        look: Look {
            theme,
            ..Look::default()
        },
    };
    let runtime = runtime()?;
    let outcome = runtime.block_on(console::run(options));
    // Tasks that still wait for a socket are not worth waiting for.
    runtime.shutdown_background();
    outcome?;
    Ok(ExitCode::SUCCESS)
}
