//! The journal of a flight: notices for the trainee, events for the report, and broken rules.

use std::time::Duration;

use crate::alert::AlertKind;
use crate::ledger::EntryId;
use crate::mission::feedback::Feedback;
use crate::notice::Notice;
use crate::scoring::{EventKind, EventReport, EventSubject, SafetyEvent, SafetyKind, SafetyLog};
use crate::text::{Text, rounded};
use crate::vehicle::{Severity, VehicleId};

/// The events, broken rules, feedback and notices of one flight.
#[derive(Debug, Clone, Default)]
pub(super) struct FlightJournal {
    now: Duration,
    events: Vec<JournalEvent>,
    safety: SafetyLog,
    feedback: Feedback,
    notices: Vec<Notice>,
}

/// A notice, an event for the report, or both.
#[derive(Debug, Clone)]
pub(super) struct JournalEntry {
    pub kind: EventKind,
    pub severity: Severity,
    pub vehicle: Option<VehicleId>,
    /// The vehicle alert that the occurrence raises, if any.
    pub alert: Option<AlertKind>,
    pub about: Option<JournalSubject>,
    pub text: Text,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JournalSubject {
    /// An alert that must be answered, by its index among the flight's alerts.
    Alert(usize),
    Command(EntryId),
}

#[derive(Debug, Clone)]
struct JournalEvent {
    at: Duration,
    entry: JournalEntry,
}

impl JournalEntry {
    /// An entry that is not about a vehicle.
    pub fn new(kind: EventKind, severity: Severity, text: Text) -> Self {
        Self {
            kind,
            severity,
            vehicle: None,
            alert: None,
            about: None,
            text,
        }
    }
}

impl FlightJournal {
    /// Begins a step; entries from now on have this mission time.
    pub fn begin(&mut self, now: Duration) {
        self.now = now;
    }

    /// Mission time of the step.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Adds a notice about a vehicle; the notice is not part of the report.
    pub fn tell(&mut self, vehicle: VehicleId, severity: Severity, text: Text) {
        let notice = Notice::about(vehicle, self.now, severity, text);
        self.notices.push(notice);
    }

    /// Adds a notice and an event for the report.
    pub fn say(&mut self, entry: JournalEntry) {
        self.notices.push(Notice {
            vehicle: entry.vehicle,
            kind: entry.alert,
            ..Notice::general(self.now, entry.severity, entry.text.clone())
        });
        self.record(entry);
    }

    /// Adds an event for the report.
    pub fn record(&mut self, entry: JournalEntry) {
        self.events.push(JournalEvent {
            at: self.now,
            entry,
        });
    }

    /// Records a broken rule; the notice appears only once, however long the violation lasts.
    pub fn break_rule(&mut self, kind: SafetyKind, id: VehicleId, text: &Text) {
        if self.safety.note(kind, id, self.now, text) {
            let is_loss = kind.is_loss();
            let severity = if is_loss {
                Severity::Critical
            } else {
                Severity::Warning
            };
            self.say(JournalEntry {
                vehicle: Some(id),
                alert: is_loss.then_some(AlertKind::Crash),
                ..JournalEntry::new(EventKind::Rule, severity, text.clone())
            });
        }
    }

    /// The notices since the last call.
    pub fn take(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// Takes the notices at the end of a step and updates the feedback line from them.
    pub fn end_step(&mut self) -> Vec<Notice> {
        let notices = self.take();
        self.feedback.hear(&notices, self.now);
        notices
    }

    /// The events in order, each with the position of its command in the report.
    pub fn events(&self, place_of: impl Fn(EntryId) -> Option<usize>) -> Vec<EventReport> {
        let subject = |about| match about {
            JournalSubject::Alert(place) => Some(EventSubject::Alert(place)),
            JournalSubject::Command(id) => place_of(id).map(EventSubject::Command),
        };
        let report = |event: &JournalEvent| EventReport {
            at_s: rounded(event.at.as_secs_f64(), 1),
            kind: event.entry.kind,
            vehicle: event.entry.vehicle,
            text: event.entry.text.clone(),
            about: event.entry.about.and_then(subject),
        };
        self.events.iter().map(report).collect()
    }

    pub fn broken_rules(&self) -> &[SafetyEvent] {
        self.safety.events()
    }

    /// The feedback line, if any.
    pub fn feedback(&self) -> Option<&Text> {
        self.feedback.line()
    }
}
