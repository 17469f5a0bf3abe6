//! The record of a session: its frames, and what happens beside them.

use std::path::Path;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::app::event::{Started, VehicleEvent};
use crate::app::state::Activity;
use crate::fleet::FleetClock;
use crate::link::{FrameSink, InputSink};
use crate::record::{Happening, Head, JournalLine, RowLine, Subject};
use crate::store::{Recording, Records, utc};
use crate::text;
use crate::text::Text;

/// Records a session. Its clock is the session's, which stands still in a pause.
pub(super) struct FlightRecorder {
    sink: FrameSink,
    /// Where what enters simulated vehicles waits.
    inputs: InputSink,
    began_unix_us: u64,
    /// When it began, on the program's clock.
    began_at: Duration,
    recording: Option<Recording>,
    /// What has to be said of it.
    fault: Option<Text>,
    /// Whether frames that were left out have been told of.
    has_told_loss: bool,
}

impl FlightRecorder {
    /// Takes frames down from now on.
    pub fn new(clock: &FleetClock) -> Self {
        let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH);
        let began_unix_us = micros(since_1970.unwrap_or_default());
        let began_at = clock.now();
        let clock = clock.clone();
        let stamp = move || began_unix_us + micros(clock.now().saturating_sub(began_at));
        Self {
            sink: FrameSink::new(stamp),
            inputs: InputSink::default(),
            began_unix_us,
            began_at,
            recording: None,
            fault: None,
            has_told_loss: false,
        }
    }

    /// Where frames are taken down.
    pub fn sink(&self) -> FrameSink {
        self.sink.clone()
    }

    /// Where what enters simulated vehicles is taken down.
    pub fn inputs(&self) -> InputSink {
        self.inputs.clone()
    }

    /// Hands over what has entered simulated vehicles.
    pub fn pass_inputs(&self) {
        if let Some(recording) = &self.recording {
            recording.note_inputs(&self.inputs.take());
        }
    }

    /// Begins the files of a session that has started; those of a mission are called like its run.
    pub fn begin(
        &mut self,
        records: &Records,
        started: &Started,
        profile: Option<&str>,
        run_id: Option<&str>,
    ) {
        let head = Head {
            profile: profile.map(str::to_owned),
            places: started.places.clone(),
            speedup: started.speedup,
            ..Head::new(subject(&started.activity), self.began_unix_us)
        };
        let when = utc(UNIX_EPOCH + Duration::from_micros(self.began_unix_us));
        let sink = self.sink.clone();
        match records.begin(&head, run_id, &when, move || sink.take().bytes) {
            Ok(recording) => self.recording = Some(recording),
            Err(error) => self.stop(text!("record-not-begun", fault = Text::from(&error))),
        }
    }

    /// Notes that something happened.
    pub fn note(&self, now: Duration, what: Happening) {
        if let Some(recording) = &self.recording {
            let at = now.saturating_sub(self.began_at);
            recording.note(JournalLine::new(at, what));
        }
    }

    /// Notes that the session was ended as usual.
    pub fn end(&self) {
        self.pass_inputs();
        if let Some(recording) = &self.recording {
            recording.note_end();
        }
    }

    /// Where frames are written, if they are.
    pub fn frames(&self) -> Option<&Path> {
        self.recording.as_ref().map(Recording::frames)
    }

    /// Why nothing is recorded any more, once.
    pub fn take_fault(&mut self) -> Option<Text> {
        if let Some(fault) = self.recording.as_ref().and_then(Recording::take_fault) {
            self.recording = None;
            self.stop(Text::from(&fault));
        }
        if self.sink.dropped() > 0 && !std::mem::replace(&mut self.has_told_loss, true) {
            return Some(text!("record-frames-dropped"));
        }
        self.fault.take()
    }

    fn stop(&mut self, fault: Text) {
        self.sink.close();
        self.inputs.close();
        self.fault = Some(fault);
    }
}

impl Drop for FlightRecorder {
    fn drop(&mut self) {
        self.sink.close();
    }
}

/// What of an event goes into the journal: what neither telemetry nor the mission says again.
pub(super) fn happening(event: &VehicleEvent) -> Option<Happening> {
    match event {
        VehicleEvent::Row(row) => Some(Happening::Row(RowLine::of(row))),
        // Orders are noted when they are given.
        VehicleEvent::Telemetry(_)
        | VehicleEvent::Parameters { .. }
        | VehicleEvent::Paths(_)
        | VehicleEvent::Given { .. } => None,
    }
}

fn subject(activity: &Activity) -> Subject {
    match activity {
        Activity::Mission { id, .. } => Subject::Mission(id.clone()),
        Activity::Free => Subject::Free,
        Activity::Connected { addresses } => Subject::Connected(addresses.clone()),
    }
}

fn micros(time: Duration) -> u64 {
    u64::try_from(time.as_micros()).unwrap_or(u64::MAX)
}
