//! Events: numbered reports of a vehicle, which are requested again if they were lost (`EVENT`,
//! `CURRENT_EVENT_SEQUENCE`, `REQUEST_EVENT`, `RESPONSE_EVENT_ERROR`). PX4 sends them. Their texts are in metadata, which
//! is read from the vehicle (`param docs`) or from a file; without it, a notice names the event by its number.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    CURRENT_EVENT_SEQUENCE_DATA, EVENT_DATA, MavEventCurrentSequenceFlags, MavMessage,
    REQUEST_EVENT_DATA,
};

use super::Output;
use crate::metadata::EventDocuments;
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::GROUND_STATION_SYSTEM;

/// The time between requests for lost events.
const ASK_EVERY: Duration = Duration::from_millis(500);
/// How many requests without a missing event in between are sent before the missing events count as lost.
const TRIES: u8 = 5;
/// The maximum number of missing events that are requested: vehicles keep few.
const MOST_MISSING: u16 = 32;
/// A sequence number that is further ahead belongs to an earlier event.
const HALF: u16 = 0x8000;
/// External log levels from this one on are for other programs (8), or disabled.
const NOT_FOR_PEOPLE: u8 = 8;

/// The events of a vehicle's autopilot.
#[derive(Debug, Clone, Default)]
pub(super) struct Events {
    /// The sequence number of the newest event.
    last: Option<u16>,
    missing: BTreeSet<u16>,
    /// When the missing events are requested next.
    next_request: Duration,
    tries: u8,
    documents: Arc<EventDocuments>,
}

impl Events {
    /// Handles a message of the autopilot; returns a notice about an event, or about events that are lost for good.
    pub fn receive(
        &mut self,
        message: &MavMessage,
        vehicle: &Vehicle,
        now: Duration,
    ) -> Option<Notice> {
        match message {
            MavMessage::EVENT(event) => self.take(event, vehicle, now),
            MavMessage::CURRENT_EVENT_SEQUENCE(current) => {
                self.compare(current, now);
                None
            }
            MavMessage::RESPONSE_EVENT_ERROR(error)
                if error.target_system == GROUND_STATION_SYSTEM =>
            {
                let oldest = error.sequence_oldest_available;
                let gone =
                    |sequence: &u16| oldest.wrapping_sub(*sequence) < HALF && *sequence != oldest;
                let before = self.missing.len();
                self.missing
                    .retain(|sequence| !gone(sequence) && *sequence != error.sequence);
                lost(before - self.missing.len(), vehicle, now)
            }
            _ => None,
        }
    }

    /// Requests missing events; returns a notice if they are given up.
    pub fn poll(
        &mut self,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Option<Notice> {
        if self.missing.is_empty() || now < self.next_request {
            return None;
        }
        if self.tries >= TRIES {
            let count = std::mem::take(&mut self.missing).len();
            return lost(count, vehicle, now);
        }
        let first = *self.missing.first()?;
        let mut last = first;
        while self.missing.contains(&last.wrapping_add(1)) && last != u16::MAX {
            last += 1;
        }
        output.send(vec![MavMessage::REQUEST_EVENT(REQUEST_EVENT_DATA {
            first_sequence: first,
            last_sequence: last,
            target_system: vehicle.system,
            target_component: vehicle.component,
        })]);
        self.tries += 1;
        self.next_request = now + ASK_EVERY;
        None
    }

    /// Whether events are missing.
    pub fn is_busy(&self) -> bool {
        !self.missing.is_empty()
    }

    /// Forgets all events: a reboot begins the numbers anew.
    pub fn forget(&mut self) {
        *self = Self {
            documents: Arc::clone(&self.documents),
            ..Self::default()
        };
    }

    /// Shows events by these texts.
    pub fn use_documents(&mut self, documents: Arc<EventDocuments>) {
        self.documents = documents;
    }

    fn take(&mut self, event: &EVENT_DATA, vehicle: &Vehicle, now: Duration) -> Option<Notice> {
        if !self.is_new(event.sequence, now) {
            return None;
        }
        let is_ours = [0, GROUND_STATION_SYSTEM].contains(&event.destination_system);
        let level = event.log_levels & 0x0f;
        if !is_ours || level >= NOT_FOR_PEOPLE {
            return None;
        }
        let severity = Severity::from_wire(level);
        let text = match self.documents.text(event.id, &event.arguments) {
            Some(text) => Text::verbatim(text),
            None => text!(
                "heard-event",
                id = event.id.to_string(),
                level = level_word(severity)
            ),
        };
        Some(Notice::about(vehicle.id, now, severity, text))
    }

    /// Notes a sequence number; whether its event has not been received before.
    fn is_new(&mut self, sequence: u16, now: Duration) -> bool {
        if self.missing.remove(&sequence) {
            self.tries = 0;
            return true;
        }
        let Some(last) = self.last else {
            self.last = Some(sequence);
            return true;
        };
        let ahead = sequence.wrapping_sub(last);
        if ahead == 0 || ahead >= HALF {
            return false;
        }
        self.miss(last, ahead - 1, now);
        self.last = Some(sequence);
        true
    }

    /// Compares the vehicle's newest number with the last one that was received.
    fn compare(&mut self, current: &CURRENT_EVENT_SEQUENCE_DATA, now: Duration) {
        let reset = MavEventCurrentSequenceFlags::MAV_EVENT_CURRENT_SEQUENCE_FLAGS_RESET;
        let ahead = self.last.map(|last| current.sequence.wrapping_sub(last));
        match (self.last, ahead) {
            (Some(last), Some(ahead)) if ahead < HALF && !current.flags.contains(reset) => {
                self.miss(last, ahead, now);
            }
            (Some(_), Some(0)) => {}
            (Some(_), Some(_)) if !current.flags.contains(reset) => return,
            _ => self.missing.clear(),
        }
        self.last = Some(current.sequence);
    }

    /// Notes `count` events after `last` as missing, at most the newest ones.
    fn miss(&mut self, last: u16, count: u16, now: Duration) {
        if count == 0 {
            return;
        }
        let kept = count.min(MOST_MISSING);
        let newest = last.wrapping_add(count);
        let numbers = (0..kept).map(|back| newest.wrapping_sub(back));
        self.missing.extend(numbers);
        self.tries = 0;
        self.next_request = now;
    }
}

/// The notice that events are lost for good; `None` if there are none.
fn lost(count: usize, vehicle: &Vehicle, now: Duration) -> Option<Notice> {
    let text = text!("heard-events-lost", count = count);
    (count > 0).then(|| Notice::about(vehicle.id, now, Severity::Warning, text))
}

fn level_word(severity: Severity) -> Text {
    match severity {
        Severity::Emergency => text!("event-emergency"),
        Severity::Alert => text!("event-alert"),
        Severity::Critical => text!("event-critical"),
        Severity::Error => text!("event-error"),
        Severity::Warning => text!("event-warning"),
        Severity::Notice => text!("event-notice"),
        Severity::Info => text!("event-info"),
        Severity::Debug => text!("event-debug"),
    }
}
