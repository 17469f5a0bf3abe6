//! The record of a session: its frames and its journal.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::app::event::{Started, VehicleEvent};
use crate::app::state::Activity;
use crate::fleet::FleetClock;
use crate::link::{FrameSink, InputSink};
use crate::pilot_in_command::Person;
use crate::record::{ForeignLine, Happening, Head, JournalLine, PathLine, RowLine, Subject};
use crate::store::{Recording, Records, utc};
use crate::text;
use crate::text::Text;

/// How long the end of a session may wait for the last inputs of the simulated vehicles.
const LAST_INPUTS_WITHIN: Duration = Duration::from_millis(250);

/// How long a mission is still recorded after its end, so that a replay shows the result.
const AFTER_MISSION: Duration = Duration::from_secs(2);

/// How long after its end a record may still be in memory.
const WRITTEN_WITHIN: Duration = Duration::from_secs(1);

/// Whose flight is recorded.
#[derive(Debug, Clone, Copy)]
pub(super) struct RecordedUser<'a> {
    /// The name of the pilot's profile, if there is one.
    pub profile: Option<&'a str>,
    /// The name that members of a crew know, if there is a crew.
    pub host: Option<&'a Person>,
}

/// How far a record has got.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordPoint {
    /// The path of its frames.
    pub frames: PathBuf,
    /// A time since its beginning.
    pub at: Duration,
}

/// Records a session by the session's clock, which stops in a pause.
pub(super) struct FlightRecorder {
    sink: FrameSink,
    /// Inputs of simulated vehicles that wait to be recorded.
    inputs: InputSink,
    began_unix_us: u64,
    /// When the recording began, on the program's clock.
    began_at: Duration,
    recording: Option<Recording>,
    /// When the record ends, once its mission has ended.
    ends_at: Option<Duration>,
    /// Whether the record has ended, while the session continues.
    has_ended: bool,
    fault: Option<Text>,
    /// Whether dropped frames have been reported.
    has_told_loss: bool,
}

impl FlightRecorder {
    /// Starts to collect frames.
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
            ends_at: None,
            has_ended: false,
            fault: None,
            has_told_loss: false,
        }
    }

    /// The sink for frames.
    pub fn sink(&self) -> FrameSink {
        self.sink.clone()
    }

    /// The sink for inputs of simulated vehicles.
    pub fn inputs(&self) -> InputSink {
        self.inputs.clone()
    }

    /// Passes the waiting inputs of simulated vehicles to the recording.
    pub fn pass_inputs(&self) {
        if let Some(recording) = &self.recording {
            recording.note_inputs(&self.inputs.take());
        }
    }

    /// Creates the files of a session that has started; those of a mission have its run's name.
    pub fn begin(
        &mut self,
        records: &Records,
        started: &Started,
        whose: RecordedUser<'_>,
        run_id: Option<&str>,
    ) {
        let head = Head {
            profile: whose.profile.map(str::to_owned),
            host: whose.host.cloned(),
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

    pub fn note(&self, now: Duration, what: Happening) {
        if let Some(recording) = self.recording.as_ref().filter(|_| !self.has_ended) {
            let at = now.saturating_sub(self.began_at);
            recording.note(JournalLine::new(at, what));
        }
    }

    /// Ends the record shortly after the end of its mission: later events are not part of the
    /// flight. The inputs of the simulated vehicles are recorded to the end of the session.
    pub fn end_after_mission(&mut self, now: Duration) {
        let ends_at = *self.ends_at.get_or_insert(now + AFTER_MISSION);
        if now >= ends_at && !self.has_ended {
            self.has_ended = true;
            self.sink.close();
            self.note_end();
        }
    }

    /// Whether the session is still recorded.
    pub fn is_recording(&self) -> bool {
        self.recording.is_some() && !self.has_ended
    }

    /// Whether nothing more is written, except for inputs after the end of the mission.
    pub fn is_written(&self, now: Duration) -> bool {
        let ended_at = self.ends_at.filter(|_| self.has_ended);
        self.recording.is_none() || ended_at.is_some_and(|at| now >= at + WRITTEN_WITHIN)
    }

    /// Ends the record; the session's simulator must have been asked to end. An empty record, or
    /// one that is not to be kept, is removed.
    pub fn end(&mut self, is_kept: bool) {
        self.inputs.wait_for_end(LAST_INPUTS_WITHIN);
        self.pass_inputs();
        if !self.has_ended {
            self.note_end();
        }
        if let Some(recording) = self.recording.take() {
            recording.finish(is_kept);
        }
    }

    fn note_end(&self) {
        if let Some(recording) = &self.recording {
            recording.note_end();
        }
    }

    /// Writes more often from now on, because others follow the record.
    pub fn note_followed(&self) {
        if let Some(recording) = &self.recording {
            recording.note_followed();
        }
    }

    /// How far the record has got; `None` if nothing is recorded.
    pub fn sight(&self, now: Duration) -> Option<RecordPoint> {
        let frames = self.frames()?.to_owned();
        // Nothing is recorded after its end, when the vehicles would only seem to be silent.
        let to = self.ends_at.map_or(now, |end| end.min(now));
        let at = to.saturating_sub(self.began_at);
        Some(RecordPoint { frames, at })
    }

    /// The path of the frames, if recorded.
    pub fn frames(&self) -> Option<&Path> {
        self.recording.as_ref().map(Recording::frames)
    }

    /// A fault to report, once: why recording has stopped, or that frames were dropped.
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

/// The journal entry for an event; `None` if a replay can derive the event from telemetry or the
/// mission.
pub(super) fn happening(event: &VehicleEvent) -> Option<Happening> {
    match event {
        VehicleEvent::Row(row) => Some(Happening::Row(RowLine::of(row))),
        VehicleEvent::Foreign(command) => Some(Happening::Foreign(ForeignLine::of(command))),
        VehicleEvent::Paths(paths) => Some(Happening::Paths(PathLine::all(paths))),
        // Orders are recorded when they are given.
        VehicleEvent::Telemetry(_)
        | VehicleEvent::Folder(_)
        | VehicleEvent::Rehearsed(_)
        | VehicleEvent::Parameters { .. }
        // The change that led to it is.
        | VehicleEvent::Pilots(_)
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
