//! `sortie hangar` without a subcommand: the service.

use std::process::ExitCode;

use clap::Args;

use super::super::Failure;
use super::super::programs::ProgramOptions;
use super::super::settings::Settings;

/// Options of the service.
#[derive(Debug, Args)]
pub(super) struct ServeArguments {
    #[command(flatten)]
    programs: ProgramOptions,
}

/// Serves until interrupted.
pub(super) fn serve(options: &ServeArguments, settings: &Settings) -> Result<ExitCode, Failure> {
    let programs = options.programs.find(settings);
    Err(Failure::Invalid(format!(
        "sortie: the service is not there yet ({} programs)",
        programs.paths().len()
    )))
}
