//! Prints the notices of a run, and keeps its record.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use crate::exercise::Exercise;
use crate::mission::record::Occasion;
use crate::notice::Notice;
use crate::record::{Head, Subject};
use crate::store::{Landing, RecordPiece, RecordWriter, Records, RunFile, Runs, StoreError};
use crate::text;
use crate::text::{Locale, Text};

/// The size, in bytes, of the pieces in which a record is written, so that a fast run does not
/// write each line separately.
const PIECE_LEN: usize = 64 * 1024;
/// If the program is killed, it loses at most this much of the record.
const WRITE_EVERY: Duration = Duration::from_millis(250);

/// The plan for reporting and recording a run.
pub(super) struct RecordingPlan {
    /// Whether notices are printed.
    pub is_heard: bool,
    /// The number of this attempt at the mission.
    pub attempt: u32,
    /// The folder for the data that decide the score, if they are recorded.
    pub runs: Option<Runs>,
    /// The folder for frames, journal and inputs of simulated vehicles, if they are recorded.
    pub records: Option<Records>,
    /// The circumstances of the run, as the record states them.
    pub occasion: Occasion,
}

/// Prints the notices of a run, and records it.
pub(super) struct RunRecorder<'a> {
    plan: RecordingPlan,
    locale: &'a Locale,
    /// The unique name of the run.
    id: String,
    file: Option<RunFile>,
    record: Option<RecordWriter>,
    /// Lines of the run that are not written yet.
    piece: String,
    /// Inputs of simulated vehicles that are not written yet.
    inputs: String,
    written: Instant,
}

impl<'a> RunRecorder<'a> {
    /// Begins the record, if one is wanted. If the folder cannot be written, prints a warning, and
    /// the run is flown without a record.
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
            record: None,
            piece: String::new(),
            inputs: String::new(),
            written: Instant::now(),
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

    /// Configures a flight, and starts its recording if one is wanted.
    pub fn prepare<L>(&mut self, exercise: &mut Exercise<L>) {
        let flight = exercise.flight_mut();
        flight.set_attempt(self.plan.attempt);
        flight.set_flown_by(Some(self.plan.occasion.flown_by));
        flight.set_stake(self.plan.occasion.stake);
        if self.file.is_none() {
            return;
        }
        flight.start_record(&self.plan.occasion);
        let Some(records) = &self.plan.records else {
            return;
        };
        let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH);
        let began_unix_us = since_1970.unwrap_or_default().as_micros() as u64;
        let mission = exercise.flight().mission().id.clone();
        let head = Head {
            profile: self.plan.occasion.profile.clone(),
            places: exercise.places().clone(),
            ..Head::new(Subject::Mission(mission), began_unix_us)
        };
        match records.create(&head, Some(&self.id), &self.plan.occasion.when) {
            Ok(record) => {
                self.record = Some(record);
                exercise.record(began_unix_us);
            }
            Err(error) => self.complain(&error),
        }
    }

    /// Configures a flight in the embedded simulator, and starts its recording, with inputs, if one
    /// is wanted.
    pub fn prepare_embedded(&mut self, exercise: &mut Exercise) {
        self.prepare(exercise);
        if self.record.is_some() {
            exercise.record_inputs();
        }
    }

    /// Takes the inputs of the simulated vehicles; keeps them if the run is recorded.
    pub fn take_inputs(&mut self, exercise: &mut Exercise) {
        let inputs = exercise.take_inputs();
        if self.record.is_some() {
            self.inputs.push_str(&inputs);
        }
    }

    /// The data about the end of the run: its name, whether it is recorded, the time, and its
    /// stake.
    pub fn landing(&self) -> Landing {
        Landing {
            id: self.id.clone(),
            is_recorded: self.file.is_some(),
            when: SystemTime::now(),
            stake: self.plan.occasion.stake,
        }
    }

    /// Prints a notice, if notices are printed.
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

    /// Writes the recorded data of a flight once `PIECE_LEN` bytes wait, or `WRITE_EVERY` has
    /// passed since the last write.
    pub fn keep<L>(&mut self, exercise: &mut Exercise<L>) {
        self.piece.push_str(&exercise.flight_mut().take_record());
        let frames = exercise.log_mut().map_or(0, |log| log.waiting());
        let waiting = self.piece.len() + self.inputs.len() + frames;
        if waiting >= PIECE_LEN || self.written.elapsed() >= WRITE_EVERY {
            self.write(exercise);
        }
    }

    /// Writes the remaining data of a flight that has ended.
    pub fn finish<L>(&mut self, exercise: &mut Exercise<L>) {
        if let Some(log) = exercise.log_mut() {
            log.end();
        }
        self.piece.push_str(&exercise.flight_mut().take_record());
        self.write(exercise);
    }

    fn write<L>(&mut self, exercise: &mut Exercise<L>) {
        self.written = Instant::now();
        let piece = std::mem::take(&mut self.piece);
        let inputs = std::mem::take(&mut self.inputs);
        if let Some(file) = &mut self.file
            && let Err(error) = file.append(&piece)
        {
            self.file = None;
            exercise.flight_mut().stop_record();
            self.complain(&error);
        }
        let (Some(record), Some(log)) = (&mut self.record, exercise.log_mut()) else {
            return;
        };
        let written = record.append(&RecordPiece {
            frames: &log.take_frames(),
            lines: &log.take_lines(),
            inputs: &inputs,
        });
        if let Err(fault) = written {
            self.record = None;
            exercise.stop_recording();
            tell!("sortie: {}", self.locale.text(&Text::from(&fault)));
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
