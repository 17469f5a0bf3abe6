//! Who watches a run: tells what is said, and keeps the record.

use std::time::{Duration, SystemTime};

use super::RunArguments;
use crate::mission::Flight;
use crate::mission::record::Occasion;
use crate::notice::Notice;
use crate::store::{RunFile, Runs, StoreError, utc};
use crate::text;
use crate::text::{Locale, Text};

/// A record is written in pieces of this length, so that a fast run does not write a line at a time.
const PIECE_LEN: usize = 16 * 1024;

/// Watches a run.
pub(super) struct Witness<'a> {
    options: &'a RunArguments,
    locale: &'a Locale,
    when: String,
    file: Option<RunFile>,
    /// What is not written yet.
    piece: String,
}

impl<'a> Witness<'a> {
    /// Begins the record, if one is wanted. A folder that cannot be written is told and harms nothing.
    pub fn new(options: &'a RunArguments, locale: &'a Locale, mission: &str) -> Self {
        let mut witness = Self {
            options,
            locale,
            when: utc(SystemTime::now()),
            file: None,
            piece: String::new(),
        };
        if let Some(folder) = &options.record {
            match Runs::at(folder).begin(mission, &witness.when) {
                Ok(file) => witness.file = Some(file),
                Err(error) => witness.complain(&error),
            }
        }
        witness
    }

    /// Makes a flight ready for it.
    pub fn prepare(&self, flight: &mut Flight, backend: &str) {
        flight.set_attempt(self.options.attempt);
        if self.file.is_some() {
            flight.start_record(&Occasion {
                when: self.when.clone(),
                backend: backend.to_owned(),
                ..Occasion::default()
            });
        }
    }

    /// Says what is to be heard.
    pub fn tell(&self, notice: Notice) {
        let words = match notice.vehicle {
            Some(id) => text!("debrief-vehicle", vehicle = id, what = &notice.text),
            None => notice.text,
        };
        let at = clock(notice.at);
        tracing::info!("{at} {words}");
        if !self.options.json {
            eprintln!("{at} {}", self.locale.text(&words));
        }
    }

    /// Writes what the flight has recorded, once there is enough of it, and all of it at the end.
    pub fn keep(&mut self, flight: &mut Flight) {
        let Some(file) = &mut self.file else { return };
        self.piece.push_str(&flight.take_record());
        if self.piece.len() < PIECE_LEN && flight.outcome().is_none() {
            return;
        }
        if let Err(error) = file.append(&std::mem::take(&mut self.piece)) {
            self.file = None;
            flight.stop_record();
            self.complain(&error);
        }
    }

    fn complain(&self, error: &StoreError) {
        let text = text!("record-unwritable", fault = Text::from(error));
        eprintln!("sortie: {}", self.locale.text(&text));
    }
}

fn clock(at: Duration) -> String {
    let seconds = at.as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}
