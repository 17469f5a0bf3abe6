//! `sortie`, `sortie fly` and `sortie connect`: the console.

use std::io::IsTerminal as _;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::{Failure, parse_speedup, runtime};
use crate::config::{Config, Symbols};
use crate::console::{self, Opening, Options};
use crate::diagnostic::nearest;
use crate::link::Address;
use crate::terminal::Environment;
use crate::text::{Language, Locale, Text, text};
use crate::ui::{Look, Theme};

/// Simulated vehicles in free flight, unless told otherwise.
const VEHICLES: u8 = 4;

/// How the console is shown.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct ShowArguments {
    /// Frames per second at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=60))]
    fps: Option<u8>,
    /// What curves and maps are drawn with; by default what the terminal has.
    #[arg(long, value_name = "KIND")]
    symbols: Option<SymbolsArgument>,
    /// Listen to the mouse: its wheel moves the cursor.
    #[arg(long)]
    mouse: bool,
    /// Lines of text instead of a screen: for screen readers and pipes.
    #[arg(long)]
    plain: bool,
}

/// [`Symbols`] on the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum SymbolsArgument {
    /// Braille patterns.
    Braille,
    /// Blocks and box characters.
    Block,
    /// Nothing but ASCII.
    Ascii,
}

impl From<SymbolsArgument> for Symbols {
    fn from(argument: SymbolsArgument) -> Self {
        match argument {
            SymbolsArgument::Braille => Self::Braille,
            SymbolsArgument::Block => Self::Block,
            SymbolsArgument::Ascii => Self::Ascii,
        }
    }
}

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
    #[command(flatten)]
    show: ShowArguments,
}

/// The home screen.
pub(super) fn home(show: &ShowArguments, theme: Theme) -> Result<ExitCode, Failure> {
    if show.plain {
        return Err(Failure::Invalid(
            "sortie: --plain has no home screen: use `sortie fly --plain` or `sortie connect ADDR --plain`".to_owned(),
        ));
    }
    open(options(Opening::Home, show, theme), false)
}

/// A mission or free flight.
pub(super) fn fly(arguments: &FlyArguments, theme: Theme) -> Result<ExitCode, Failure> {
    let opening = match &arguments.mission {
        _ if !arguments.connect.is_empty() => Opening::Connect(arguments.connect.clone()),
        Some(mission) => {
            // Faults are shown here, with the lines around them, rather than inside the console.
            Opening::Mission(Arc::new(super::run::load_mission(mission)?))
        }
        None => Opening::Free,
    };
    let options = Options {
        vehicles: arguments.vehicles,
        seed: arguments.seed,
        speedup: arguments.speedup,
        ..options(opening, &arguments.show, theme)
    };
    open(options, arguments.show.plain)
}

/// Vehicles that are already there.
pub(super) fn connect(
    addresses: Vec<Address>,
    show: &ShowArguments,
    theme: Theme,
) -> Result<ExitCode, Failure> {
    open(
        options(Opening::Connect(addresses), show, theme),
        show.plain,
    )
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
    Ok(theme.for_colours(Environment::of_process().colour_depth()))
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

/// How the console is set up by what was asked for, the configuration and the terminal.
fn options(opening: Opening, show: &ShowArguments, theme: Theme) -> Options {
    let environment = Environment::of_process();
    let config = Config::default();
    let asked = show.symbols.map(Symbols::from).or(config.symbols);
    let symbols = asked.unwrap_or_else(|| environment.symbols());
    // Words of other scripts would be nothing but question marks.
    let language = match symbols {
        Symbols::Ascii => Language::English,
        _ => config.lang.unwrap_or_default(),
    };
    Options {
        opening,
        vehicles: VEHICLES,
        seed: 1,
        speedup: 1.0,
        look: Look {
            theme,
            locale: Arc::new(Locale::new(language)),
            symbols,
        },
        fps: show.fps.unwrap_or(config.fps),
        mouse: show.mouse || config.mouse,
    }
}

fn open(options: Options, plain: bool) -> Result<ExitCode, Failure> {
    if !plain && let Some(fault) = no_screen() {
        let fault = options.look.text(&fault);
        return Err(Failure::Failed(anyhow::anyhow!(fault)));
    }
    if let Opening::Connect(addresses) = &options.opening {
        for address in addresses {
            check_recording(address)?;
        }
    }
    let runtime = runtime()?;
    let outcome = runtime.block_on(async {
        if plain {
            console::plain::run(options, std::io::stdin().is_terminal()).await
        } else {
            console::run(options).await.map(|()| true)
        }
    });
    // Tasks that still wait for a socket are not worth waiting for.
    runtime.shutdown_background();
    Ok(ExitCode::from(u8::from(!outcome?)))
}

/// Why there can be no screen, if there can be none.
fn no_screen() -> Option<Text> {
    if std::io::stdout().is_terminal() && std::io::stdin().is_terminal() {
        Environment::of_process().fault()
    } else {
        Some(text!("terminal-missing"))
    }
}
