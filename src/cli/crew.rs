//! `sortie crew`: joins a crew.

use std::path::Path;
use std::process::ExitCode;

use clap::{Args, Subcommand, ValueEnum};

use super::hosting::short;
use super::settings::CliSettings;
use super::{Failure, fly};
use crate::carrier::HostPlace;
use crate::crew::Role;
use crate::shell::{ConsoleOptions, CrewOptions, Opening};
use crate::text;
use crate::text::Text;

/// Options of `sortie crew`.
#[derive(Debug, Args)]
pub(super) struct CrewArguments {
    #[command(subcommand)]
    task: CrewTask,
}

#[derive(Debug, Subcommand)]
enum CrewTask {
    /// Joins a crew: shows the flight of its host as it is flown, and commands the vehicles that you fly.
    #[command(after_help = "Examples:\n  \
                            sortie crew join alpha                    the next free place of the mission\n  \
                            sortie crew join alpha --role safety\n  \
                            sortie crew join alpha --observe          look on")]
    Join(JoinCrewArguments),
}

#[derive(Debug, Args)]
struct JoinCrewArguments {
    /// The crew with this name, or in this folder.
    #[arg(value_name = "NAME|PATH")]
    name: String,
    /// What you do: fly your own vehicles, report and operate the payloads of every vehicle, or make every vehicle safe.
    /// By default, what the mission provides next.
    #[arg(long, value_enum)]
    role: Option<RoleArgument>,
    /// Only look on.
    #[arg(long, conflicts_with = "role")]
    observe: bool,
    /// Print lines of text instead of drawing a screen, for screen readers and pipes.
    #[arg(long)]
    plain: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum RoleArgument {
    Pilot,
    Sensors,
    Safety,
}

/// Joins a crew.
pub(super) fn crew(arguments: &CrewArguments, settings: CliSettings) -> Result<ExitCode, Failure> {
    let CrewTask::Join(joining) = &arguments.task;
    let wrong = |text: Text| Failure::Wrong(vec![text]);
    let place = HostPlace::crew(&joining.name, None);
    if !place.is_open() {
        let name = joining.name.as_str();
        return Err(wrong(text!("crew-not-there", name = name)));
    }
    let data = settings.data.path().map(Path::to_owned);
    let role = match joining.role {
        _ if joining.observe => Some(Role::Observer),
        Some(RoleArgument::Pilot) => Some(Role::Pilot),
        Some(RoleArgument::Sensors) => Some(Role::Sensors),
        Some(RoleArgument::Safety) => Some(Role::Safety),
        None => None,
    };
    let options = ConsoleOptions {
        crew: Some(CrewOptions::Member {
            place,
            name: short(&joining.name),
            role,
            data: data.ok_or_else(|| wrong(text!("crew-no-data")))?,
        }),
        ..fly::options(Opening::Home, settings)?
    };
    fly::open(options, joining.plain)
}
