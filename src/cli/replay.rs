//! `sortie replay`: recorded flights in the console.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::settings::CliSettings;
use super::{Failure, fly};
use crate::replay::Film;
use crate::shell::Opening;

/// Options of `sortie replay`.
#[derive(Debug, Args)]
pub(super) struct ReplayArguments {
    /// A record's file, or a tlog; by default the newest record.
    file: Option<PathBuf>,
}

/// Replays a recording.
pub(super) fn replay(
    arguments: &ReplayArguments,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    let path = match &arguments.file {
        Some(path) => path.clone(),
        None => newest(&settings)?,
    };
    // Faults are reported before the screen opens.
    Film::open(&path).map_err(|fault| Failure::Invalid(format!("sortie: {fault}")))?;
    fly::open(fly::options(Opening::Replay(path), settings)?, false)
}

fn newest(settings: &CliSettings) -> Result<PathBuf, Failure> {
    let newest = settings.records().and_then(|it| it.newest());
    newest.ok_or_else(|| {
        let text = "sortie: nothing is recorded yet: fly first, or give a file";
        Failure::Invalid(text.to_owned())
    })
}
