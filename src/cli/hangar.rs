//! `sortie hangar`: SITL processes on this host.

use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::Failure;
use super::settings::CliSettings;

mod command;
mod identify;
mod serve;
pub(super) mod services;
mod status;

use services::token_file;

/// Options of `sortie hangar`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct HangarArguments {
    #[command(subcommand)]
    task: Option<HangarTask>,
    #[command(flatten)]
    serve: serve::ServeArguments,
}

/// The subcommand; without one, the hangar serves.
#[derive(Debug, Subcommand)]
enum HangarTask {
    /// Prints how to start SITL by hand: folders, files and command lines, ready to paste into a shell.
    Command(command::CommandArguments),
    /// Prints the vehicle type and the version of SITL programs.
    Identify(identify::IdentifyArguments),
    /// Shows the state of services: the programs that they can start, and the instances that run.
    Status(status::StatusArguments),
}

/// Runs the service or the subcommand.
pub(super) fn hangar(
    options: &HangarArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    match &options.task {
        None => serve::serve(&options.serve, settings),
        Some(HangarTask::Command(options)) => command::command(options, settings),
        Some(HangarTask::Identify(options)) => identify::identify(options, settings),
        Some(HangarTask::Status(options)) => status::status(options, settings),
    }
}
