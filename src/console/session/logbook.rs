//! The record of the mission that is flown, written once a second.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use crate::mission::Flight;
use crate::mission::record::Occasion;
use crate::scoring::TryReport;
use crate::store::{RunFile, Runs, StoreError, utc};
use crate::text;
use crate::text::Text;

/// A crash loses no more than this of a flight.
const WRITE_EVERY: Duration = Duration::from_secs(1);

/// Writes the record of a flight.
pub(super) struct Logbook {
    runs: Runs,
    /// The file, or what keeps it from being written, until that is said.
    file: Result<RunFile, Option<Text>>,
    written: Option<Duration>,
}

impl Logbook {
    /// Begins the record of a flight, which is told which try it is.
    pub fn begin(runs: Runs, flight: &mut Flight, occasion: Occasion) -> Self {
        let mission = flight.mission().clone();
        let finished = runs.tries_at(&mission.id, mission.rev);
        let finished = finished.iter().filter(|one| one.score.is_some()).count();
        flight.set_attempt(u32::try_from(finished + 1).unwrap_or(u32::MAX));
        let when = utc(SystemTime::now());
        let file = runs.begin(&mission.id, &when);
        if file.is_ok() {
            flight.start_record(&Occasion { when, ..occasion });
        }
        Self {
            runs,
            file: file.map_err(|error| Some(unwritable(&error))),
            written: None,
        }
    }

    /// Writes what is due, everything once the flight is over; returns what is to be said of it.
    pub fn keep(&mut self, flight: &mut Flight, now: Duration) -> Option<Text> {
        let file = match &mut self.file {
            Ok(file) => file,
            Err(fault) => return fault.take(),
        };
        let since = self.written.map(|written| now.saturating_sub(written));
        let is_due = since.is_none_or(|since| since >= WRITE_EVERY);
        if !is_due && flight.outcome().is_none() {
            return None;
        }
        self.written = Some(now);
        let fault = file.append(&flight.take_record()).err()?;
        self.file = Err(None);
        flight.stop_record();
        Some(unwritable(&fault))
    }

    /// The file, as long as it can be written.
    pub fn path(&self) -> Option<PathBuf> {
        let file = self.file.as_ref().ok()?;
        Some(file.path().to_owned())
    }

    /// The tries at a revision of a mission, oldest first.
    pub fn tries(&self, mission: &str, revision: u32) -> Vec<TryReport> {
        self.runs.tries_at(mission, revision)
    }
}

fn unwritable(error: &StoreError) -> Text {
    text!("record-unwritable", fault = Text::from(error))
}
