//! Tells what is said during a run, and keeps its record.

use std::time::{Duration, SystemTime};

use crate::exercise::Exercise;
use crate::mission::Flight;
use crate::mission::record::Occasion;
use crate::notice::Notice;
use crate::store::{InputsFile, Landing, RunFile, Runs, StoreError};
use crate::text;
use crate::text::{Locale, Text};

/// A record is written in pieces of this length, so that a fast run does not write a line at a time.
const PIECE_LEN: usize = 16 * 1024;

/// What is told and recorded of a run.
pub(super) struct RecordingPlan {
    /// Whether what is said is said aloud.
    pub is_heard: bool,
    /// Which try it is.
    pub attempt: u32,
    /// Where it is recorded, if it is.
    pub runs: Option<Runs>,
    /// What the record says of it.
    pub occasion: Occasion,
}

/// Tells and records a run.
pub(super) struct RunRecorder<'a> {
    plan: RecordingPlan,
    locale: &'a Locale,
    /// The unique name of the run.
    id: String,
    file: Option<RunFile>,
    /// Where what enters simulated vehicles is recorded.
    inputs: Option<InputsFile>,
    /// What is not written yet.
    piece: String,
}

impl<'a> RunRecorder<'a> {
    /// Begins the record, if one is wanted. Says so if the folder cannot be written; the run is flown all the same.
    pub fn new(plan: RecordingPlan, mission: &str, locale: &'a Locale) -> Self {
        let when = &plan.occasion.when;
        let runs = plan.runs.as_ref();
        let begun = runs.map(|runs| runs.begin(mission, when));
        let process = std::process::id();
        let mut recorder = Self {
            id: format!("{}_{mission}_{process}", when.replace(':', "-")),
            plan,
            locale,
            file: None,
            inputs: None,
            piece: String::new(),
        };
        match begun {
            Some(Ok(file)) => {
                file.id().clone_into(&mut recorder.id);
                recorder.file = Some(file);
            }
            Some(Err(error)) => recorder.complain(&error),
            None => {}
        }
        recorder
    }

    /// Makes a flight ready for it.
    pub fn prepare(&self, flight: &mut Flight) {
        flight.set_attempt(self.plan.attempt);
        flight.set_flown_by(Some(self.plan.occasion.flown_by));
        flight.set_stake(self.plan.occasion.stake);
        if self.file.is_some() {
            flight.start_record(&self.plan.occasion);
        }
    }

    /// Makes a flight in the embedded simulator ready for it.
    pub fn prepare_embedded(&mut self, exercise: &mut Exercise) {
        self.prepare(exercise.flight_mut());
        match self.file.as_ref().map(RunFile::begin_inputs) {
            Some(Ok(file)) => {
                self.inputs = Some(file);
                exercise.record_inputs();
            }
            Some(Err(error)) => self.complain(&error),
            None => {}
        }
    }

    /// Writes what has entered the simulated vehicles, as often as the run is written, and as long as it is.
    pub fn keep_inputs(&mut self, exercise: &mut Exercise) {
        if self.file.is_none() {
            self.inputs = None;
        }
        let Some(file) = self.inputs.as_mut().filter(|_| self.piece.is_empty()) else {
            return;
        };
        let lines = exercise.take_inputs();
        if let Err(error) = file.append(&lines) {
            self.inputs = None;
            self.complain(&error);
        }
    }

    /// What the run is called, now that it has ended.
    pub fn landing(&self) -> Landing {
        Landing {
            id: self.id.clone(),
            is_recorded: self.file.is_some(),
            when: SystemTime::now(),
            stake: self.plan.occasion.stake,
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
        if self.plan.is_heard {
            tell!("{at} {}", self.locale.text(&words));
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
        tell!("sortie: {}", self.locale.text(&text));
    }
}

fn clock(at: Duration) -> String {
    let seconds = at.as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}
