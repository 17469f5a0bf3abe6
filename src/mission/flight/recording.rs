//! The record of a flight, while it is flown.

use super::Flight;
use crate::ledger::Ledger;
use crate::mission::record::{Head, Occasion, Recorder};
use crate::scoring::Report;

impl Flight {
    /// Records everything that the flight is shown and asked from now on, before its first step; the mission, seed, try and
    /// drones of the head are the flight's own.
    pub fn start_record(&mut self, occasion: &Occasion) {
        let head = Head::of(&self.mission, self.seed, self.clues.attempt(), occasion);
        self.flown_by = Some(occasion.flown_by);
        self.recorder = Some(Box::new(Recorder::new(&head)));
    }

    /// Says how many steps the simulator of its vehicles has made by now: where that goes by a clock of its own, the
    /// record tells which of its steps was seen in which of the mission's.
    pub fn note_simulated(&mut self, steps: u64) {
        if let Some(recorder) = &mut self.recorder {
            recorder.note_simulated(steps);
        }
    }

    /// What was recorded since the last call: whole lines.
    pub fn take_record(&mut self) -> String {
        let recorder = self.recorder.as_mut();
        recorder.map_or_else(String::new, |recorder| recorder.take())
    }

    /// Records no more: there is nowhere to write it.
    pub fn stop_record(&mut self) {
        self.recorder = None;
    }

    /// The report, and the end of the record.
    pub fn close(&mut self, ledger: &Ledger) -> Report {
        let report = self.report(ledger);
        if let Some(recorder) = &mut self.recorder {
            recorder.end(ledger, &report);
        }
        report
    }
}
