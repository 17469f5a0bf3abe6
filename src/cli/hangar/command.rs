//! `sortie hangar command`: how to start SITL by hand.

use std::process::ExitCode;

use clap::Args;

use super::super::Failure;
use super::super::programs::ProgramOptions;
use super::super::settings::Settings;

/// Options of `sortie hangar command`.
#[derive(Debug, Args)]
pub(super) struct CommandArguments {
    #[command(flatten)]
    programs: ProgramOptions,
}

/// Prints.
pub(super) fn command(
    options: &CommandArguments,
    settings: &Settings,
) -> Result<ExitCode, Failure> {
    drop(options.programs.find(settings));
    Ok(ExitCode::SUCCESS)
}
