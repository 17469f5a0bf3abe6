//! `sortie hangar identify`: what the programs of SITL are.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::super::Failure;
use super::super::programs::ProgramOptions;
use super::super::settings::Settings;
use crate::sitl::Kind;

/// Options of `sortie hangar identify`.
#[derive(Debug, Args)]
pub(super) struct IdentifyArguments {
    /// The programs; by default those that would be started.
    files: Vec<PathBuf>,
    #[command(flatten)]
    programs: ProgramOptions,
}

/// Asks and prints.
pub(super) fn identify(
    options: &IdentifyArguments,
    settings: &Settings,
) -> Result<ExitCode, Failure> {
    let programs = options.programs.find(settings);
    for kind in Kind::ALL {
        match programs.of(kind) {
            Ok(found) => say!("{} ({})", found.file.display(), found.by)?,
            Err(missing) => say!("{missing}")?,
        }
    }
    Ok(ExitCode::SUCCESS)
}
