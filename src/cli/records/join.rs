//! `sortie records join`: puts a vehicle's own log on the timeline of a record.

use std::path::PathBuf;

use clap::Args;

use super::RecordsCommands;
use crate::cli::Failure;
use crate::replay::{Film, join_log};
use crate::store::read_log;
use crate::text;
use crate::text::Text;

/// Options of `sortie records join`.
#[derive(Debug, Args)]
pub(super) struct JoinArguments {
    /// The vehicle's `DataFlash` log.
    #[arg(value_name = "FILE.bin")]
    file: PathBuf,
    /// The number in the list, or a file; by default the newest record.
    #[arg(default_value = "1")]
    record: String,
    /// Use this vehicle if the log does not name one.
    #[arg(long, value_name = "ID")]
    vehicle: Option<u16>,
    /// Print one JSON document instead of a table.
    #[arg(long)]
    json: bool,
}

impl RecordsCommands<'_> {
    /// Joins a log to a record, and prints the added moments.
    pub(super) fn join(&self, arguments: &JoinArguments) -> Result<(), Failure> {
        let invalid =
            |fault: Text| Failure::Invalid(format!("sortie: {}", self.locale.text(&fault)));
        let files = self.find(&arguments.record)?;
        if files.is_written() {
            let name = files.stem.as_str();
            return Err(invalid(text!("records-in-use", name = name)));
        }
        let none = || invalid(text!("replay-no-frames", file = files.stem.as_str()));
        let film = Film::open(files.frames.as_deref().ok_or_else(none)?).map_err(invalid)?;
        let log = &arguments.file;
        let bytes = read_log(log).map_err(invalid)?;
        let name = log.file_name().unwrap_or_default().to_string_lossy();
        let joined = join_log(&film, &bytes, &name, arguments.vehicle).map_err(|fault| {
            let file = log.display().to_string();
            invalid(text!("log-unreadable", file = file, error = fault))
        })?;
        let stored = files.write_joined(&joined)?;
        if arguments.json {
            say!("{}", joined.to_json().trim_end())?;
            return Ok(());
        }
        if let Some(damage) = joined.damage.text() {
            say!("{}", self.locale.text(&damage))?;
        }
        let moments = joined.moments();
        let text = text!(
            "log-joined",
            count = moments.len(),
            vehicle = joined.vehicle,
            by = joined.aligned_by.text(),
            path = stored.display().to_string()
        );
        say!("{}", self.locale.text(&text))?;
        self.say_moments(&moments, film.clock())
    }
}
