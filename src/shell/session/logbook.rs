//! The record of the mission in flight, written once a second.

use std::time::{Duration, SystemTime};

use crate::campaign::{is_practice, next_try};
use crate::class::RecordHead;
use crate::mission::Flight;
use crate::mission::record::Occasion;
use crate::scoring::{Report, TryReport};
use crate::store::{RunFile, Runs, StoreError, utc};
use crate::text;
use crate::text::Text;

/// The time between writes, and so the most that a crash can lose.
const WRITE_EVERY: Duration = Duration::from_secs(1);
/// The time between writes while others follow the record.
const WRITE_EVERY_FOR_OTHERS: Duration = Duration::from_millis(100);

/// Writes the record of a flight.
pub(super) struct Logbook {
    occasion: Occasion,
    run_id: String,
    /// The trainee's attempts before this flight, oldest first.
    earlier: Vec<TryReport>,
    /// The file, or the error that prevents writing until it is reported.
    file: Result<RunFile, Option<Text>>,
    /// The file, if it was cut off. It stays locked during the flight: without its lock, another program would take
    /// the flight for one that was left.
    cut: Option<RunFile>,
    written: Option<Duration>,
    /// The time between writes.
    every: Duration,
}

impl Logbook {
    /// Starts the record of a flight and sets its attempt number; `earlier` holds the attempts
    /// before it.
    pub fn begin(
        runs: &Runs,
        flight: &mut Flight,
        occasion: Occasion,
        earlier: Vec<TryReport>,
    ) -> Self {
        flight.set_attempt(next_try(&earlier));
        flight.set_flown_by(Some(occasion.flown_by));
        flight.set_stake(occasion.stake);
        let when = utc(SystemTime::now());
        let mission = flight.mission().id.clone();
        let file = runs.begin(&mission, &when);
        let occasion = Occasion { when, ..occasion };
        let run_id = match &file {
            Ok(file) => file.id().to_owned(),
            Err(_) => format!("{}_{mission}_{}", occasion.when, std::process::id()),
        };
        if file.is_ok() {
            flight.start_record(&occasion);
        }
        Self {
            occasion,
            run_id,
            earlier,
            file: file.map_err(|error| Some(unwritable(&error))),
            cut: None,
            written: None,
            every: WRITE_EVERY,
        }
    }

    /// Writes more often from now on, because others follow the record.
    pub fn note_followed(&mut self) {
        self.every = WRITE_EVERY_FOR_OTHERS;
    }

    /// Writes the lines that are due, and all lines once the flight is over; returns a notice, if
    /// any.
    pub fn keep(&mut self, flight: &mut Flight, now: Duration) -> Option<Text> {
        let file = match &mut self.file {
            Ok(file) => file,
            Err(fault) => return fault.take(),
        };
        let since = self.written.map(|written| now.saturating_sub(written));
        let is_due = since.is_none_or(|since| since >= self.every);
        if !is_due && !flight.is_over() {
            return None;
        }
        self.written = Some(now);
        let fault = file.append(&flight.take_record()).err()?;
        self.cut = std::mem::replace(&mut self.file, Err(None)).ok();
        flight.stop_record();
        Some(unwritable(&fault))
    }

    /// Writes the remaining part of the record of a flight that is left early.
    pub fn finish(self, flight: &mut Flight) {
        if let Ok(mut file) = self.file {
            // No console is left to show a fault.
            drop(file.append(&flight.take_record()));
        }
    }

    pub fn discard(self) {
        if let Ok(file) = self.file {
            file.discard();
        }
    }

    /// The file of a record that was cut off.
    pub fn take_cut(&mut self) -> Option<RunFile> {
        self.cut.take()
    }

    /// The unique id of the run.
    pub fn run_id(&self) -> &str {
        &self.run_id
    }

    /// How far the record has grown.
    pub fn head(&self) -> Option<RecordHead> {
        self.file.as_ref().ok()?.head()
    }

    /// Whether the record is complete so far.
    pub fn is_whole(&self) -> bool {
        self.file.is_ok()
    }

    /// The career and the stake of the flight.
    pub fn occasion(&self) -> &Occasion {
        &self.occasion
    }

    /// The attempts at the mission; the attempt with this report is last.
    pub fn tries(&self, report: &Report) -> Vec<TryReport> {
        let mut tries = self.earlier.clone();
        tries.push(TryReport {
            attempt: report.attempt,
            when: self.occasion.when.clone(),
            score: Some(report.score),
            medal: report.medal,
            passed: report.passed,
            seed: report.seed,
            revision: report.revision,
            is_practice: is_practice(self.occasion.stake, Some(self.occasion.flown_by)),
        });
        tries
    }
}

fn unwritable(error: &StoreError) -> Text {
    text!("record-unwritable", fault = Text::from(error))
}
