//! Recording a flight while it is flown.

use super::Flight;
use crate::ledger::Ledger;
use crate::mission::record::{Head, Occasion, Recorder};
use crate::scoring::Report;

impl Flight {
    /// Records all inputs and commands of the flight from now on, before its first step; the head's mission, seed,
    /// attempt and drones are those of the flight.
    pub fn start_record(&mut self, occasion: &Occasion) {
        let head = Head::of(&self.mission, self.seed, self.clues.attempt(), occasion);
        self.flown_by = Some(occasion.flown_by);
        self.recorder = Some(Box::new(Recorder::new(&head)));
    }

    /// Notes the number of simulator steps so far. If the simulator has its own clock, the record
    /// pairs the steps of the mission with the steps that the simulator had made by then.
    pub fn note_simulated(&mut self, steps: u64) {
        if let Some(recorder) = &mut self.recorder {
            recorder.note_simulated(steps);
        }
    }

    /// The complete lines recorded since the last call.
    pub fn take_record(&mut self) -> String {
        let recorder = self.recorder.as_mut();
        recorder.map_or_else(String::new, |recorder| recorder.take())
    }

    /// Stops recording; called when the record cannot be written.
    pub fn stop_record(&mut self) {
        self.recorder = None;
    }

    /// Ends the record and returns the report.
    pub fn close(&mut self, ledger: &Ledger) -> Report {
        let report = self.report(ledger);
        if let Some(recorder) = &mut self.recorder {
            recorder.end(ledger, &report);
        }
        report
    }
}
