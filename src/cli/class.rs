//! `sortie class`: the instructor's desk.

use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::Failure;
use super::fly;
use super::settings::CliSettings;
use crate::carrier::{ClassPlace, own_user_name};
use crate::shell::{ClassOptions, ClassPart, ConsoleOptions, Opening};

/// Options of `sortie class`.
#[derive(Debug, Args)]
pub(super) struct ClassArguments {
    #[command(subcommand)]
    task: ClassTask,
}

#[derive(Debug, Subcommand)]
enum ClassTask {
    /// Opens the instructor's desk: a board of all trainees of this host who join the class.
    #[command(after_help = "Examples:\n  \
                            sortie class open                  a class with your user name\n  \
                            sortie class open 9-A              trainees: sortie fly 00 --class 9-A\n  \
                            sortie class open /srv/class/9-A   a folder that you own")]
    Open {
        /// The name of the class, or the path of its folder; by default your user name.
        #[arg(value_name = "NAME|PATH")]
        name: Option<String>,
    },
}

/// Opens the desk of a class.
pub(super) fn class(
    arguments: &ClassArguments,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    let ClassTask::Open { name } = &arguments.task;
    let name = name.clone().unwrap_or_else(own_user_name);
    let class = ClassOptions {
        place: ClassPlace::named(&name, None),
        part: ClassPart::Desk {
            name: name
                .rsplit('/')
                .find(|it| !it.is_empty())
                .unwrap_or(&name)
                .to_owned(),
        },
    };
    let options = ConsoleOptions {
        class: Some(class),
        ..fly::options(Opening::Home, settings)?
    };
    fly::open(options, false)
}
