//! What there is to tell of a flight: notices for humans, events for the report, and the rules that were broken.

use std::time::Duration;

use crate::mission::feedback::Feedback;
use crate::notice::Notice;
use crate::scoring::{EventKind, EventReport, SafetyEvent, SafetyKind, SafetyLog, rounded};
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The journal of one flight.
#[derive(Debug, Default)]
pub(super) struct FlightJournal {
    now: Duration,
    events: Vec<EventReport>,
    safety: SafetyLog,
    feedback: Feedback,
    /// What was said and nobody has taken yet.
    notices: Vec<Notice>,
}

impl FlightJournal {
    /// Begins a step; what is said from now on is said at this mission time.
    pub fn begin(&mut self, now: Duration) {
        self.now = now;
    }

    /// Mission time of the step.
    pub fn now(&self) -> Duration {
        self.now
    }

    pub fn tell(&mut self, vehicle: Option<VehicleId>, severity: Severity, text: Text) {
        self.notices.push(Notice {
            at: self.now,
            vehicle,
            severity,
            kind: None,
            text,
        });
    }

    /// Tells a human, and takes it down for the report.
    pub fn say(
        &mut self,
        kind: EventKind,
        vehicle: Option<VehicleId>,
        severity: Severity,
        text: Text,
    ) {
        self.tell(vehicle, severity, text.clone());
        self.record(kind, vehicle, text);
    }

    /// Takes something down for the report.
    pub fn record(&mut self, kind: EventKind, vehicle: Option<VehicleId>, text: Text) {
        self.events.push(EventReport {
            at_s: rounded(self.now.as_secs_f64(), 1),
            kind,
            vehicle,
            text,
        });
    }

    /// A rule is broken; it is said once, however long that lasts.
    pub fn break_rule(&mut self, kind: SafetyKind, id: VehicleId, text: &Text) {
        if self.safety.note(kind, id, self.now, text) {
            let severity = if kind.is_loss() {
                Severity::Critical
            } else {
                Severity::Warning
            };
            self.say(EventKind::Rule, Some(id), severity, text.clone());
        }
    }

    /// What was said since the last call.
    pub fn take(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// The same at the end of a step, from which the line of feedback is made.
    pub fn end_step(&mut self) -> Vec<Notice> {
        let notices = self.take();
        self.feedback.hear(&notices, self.now);
        notices
    }

    /// What was taken down, in its order.
    pub fn events(&self) -> &[EventReport] {
        &self.events
    }

    /// The rules that were broken.
    pub fn broken_rules(&self) -> &[SafetyEvent] {
        self.safety.events()
    }

    /// The line of feedback.
    pub fn feedback(&self) -> Option<&Text> {
        self.feedback.line()
    }
}
