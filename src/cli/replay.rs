//! `sortie replay`: recorded flights in the console.

use std::process::ExitCode;

use clap::Args;

use super::settings::CliSettings;
use super::{Failure, fly};
use crate::replay::Film;
use crate::shell::Opening;
use crate::text::{Locale, Text};

/// Options of `sortie replay`.
#[derive(Debug, Args)]
pub(super) struct ReplayArguments {
    /// The record: its number in `sortie records list`, its name or file, or a tlog; by default the newest.
    #[arg(default_value = "1")]
    record: String,
}

/// Opens the console on a recording.
pub(super) fn replay(
    arguments: &ReplayArguments,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let invalid = |fault: Text| Failure::Invalid(format!("sortie: {}", locale.text(&fault)));
    let files = settings.find_record(&arguments.record)?;
    let path = files.frames().map_err(invalid)?;
    // Faults are reported before the screen opens.
    Film::open(path).map_err(invalid)?;
    fly::open(
        fly::options(Opening::Replay(path.to_owned()), settings)?,
        false,
    )
}
