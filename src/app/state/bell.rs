//! Signals beyond the screen: the terminal's bell and desktop notifications.
//!
//! An alert gives a signal when it begins and each time it becomes worse, if it is critical or more serious, its kind
//! is not muted, and it is not a failed pre-arm check. There is no reminder while it stands unacknowledged.
//! `active_alerts` decides when an alert begins: one that ends and returns within 10 s is the same one. A critical
//! notice also gives a signal if its vehicle has no alert of the same kind, and again only after 10 s without it.
//! Nothing rings in a replay.
//!
//! Signals that come together are merged: the bell rings at once, covers the next two seconds, and rings at most
//! every 5 s; a notification waits a second for others, and at least 10 s for the next notification.

use std::time::Duration;

use crate::alert::AlertKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The least serious severity that gives a signal.
const LEAST: Severity = Severity::Critical;
const RING_EVERY: Duration = Duration::from_secs(5);
/// A ring also covers further alerts within this time, because faults tend to come together.
const COVERED: Duration = Duration::from_secs(2);
/// How long a notification waits for others to merge with.
const GATHER: Duration = Duration::from_secs(1);
const NOTE_EVERY: Duration = Duration::from_secs(10);
/// The same alert of the same vehicle is not repeated within this time after its last occurrence.
const OLD_NEWS: Duration = Duration::from_secs(10);

/// An alert that may need a signal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BellCall {
    pub kind: AlertKind,
    pub severity: Severity,
    /// The vehicle; `None` if the alert concerns no single vehicle.
    pub vehicle: Option<VehicleId>,
    pub text: Text,
    /// Whether the alert has just become more serious.
    pub worse: bool,
}

/// The signals that are due.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Due {
    pub ring: bool,
    pub note: Option<Text>,
}

/// An alert that was signalled, and when. Messages are distinguished by text, other alerts by kind.
#[derive(Debug, Clone)]
struct Told {
    vehicle: Option<VehicleId>,
    kind: AlertKind,
    message: Option<Text>,
    at: Duration,
}

/// The bell and its pending signals.
#[derive(Debug, Clone, Default)]
pub struct Bell {
    news: Vec<Told>,
    owes_ring: bool,
    owed: Vec<BellCall>,
    owed_since: Duration,
    rang_at: Option<Duration>,
    noted_at: Option<Duration>,
}

impl Bell {
    /// Queues a signal for an alert. Minor alerts are ignored, and so are repeated ones that have
    /// not become more serious.
    pub fn call(&mut self, now: Duration, call: BellCall) {
        let is_minor = call.severity > LEAST || call.kind == AlertKind::Prearm;
        if is_minor {
            return;
        }
        if self.is_old_news(now, &call) && !call.worse {
            return;
        }
        let is_covered = self
            .rang_at
            .is_some_and(|at| now.saturating_sub(at) < COVERED);
        self.owes_ring |= !is_covered;
        if self.owed.is_empty() {
            self.owed_since = now;
        }
        self.owed.push(call);
    }

    /// Whether the same alert was signalled recently; records it as signalled now.
    fn is_old_news(&mut self, now: Duration, call: &BellCall) -> bool {
        self.news
            .retain(|told| now.saturating_sub(told.at) < OLD_NEWS);
        let is_message = call.kind == AlertKind::Message;
        let message = is_message.then(|| call.text.clone());
        let same = |told: &&mut Told| {
            told.vehicle == call.vehicle && told.kind == call.kind && told.message == message
        };
        if let Some(told) = self.news.iter_mut().find(same) {
            told.at = now;
            return true;
        }
        self.news.push(Told {
            vehicle: call.vehicle,
            kind: call.kind,
            message,
            at: now,
        });
        false
    }

    /// Returns the due signals and marks them as given.
    pub fn due(&mut self, now: Duration) -> Due {
        let long_ago =
            |at: Option<Duration>, time| at.is_none_or(|at| now.saturating_sub(at) >= time);
        let mut due = Due::default();
        if self.owes_ring && long_ago(self.rang_at, RING_EVERY) {
            self.owes_ring = false;
            self.rang_at = Some(now);
            due.ring = true;
        }
        let gathered = now.saturating_sub(self.owed_since) >= GATHER;
        if !self.owed.is_empty() && gathered && long_ago(self.noted_at, NOTE_EVERY) {
            self.noted_at = Some(now);
            due.note = Some(folded(&std::mem::take(&mut self.owed)));
        }
        due
    }
}

/// The alerts in one line: the most serious kind with its vehicles, and the number of others.
fn folded(calls: &[BellCall]) -> Text {
    let Some(worst) = calls.iter().min_by_key(|call| call.severity) else {
        return Text::default();
    };
    let (same, others): (Vec<&BellCall>, Vec<&BellCall>) =
        calls.iter().partition(|call| call.kind == worst.kind);
    let equal = same.iter().all(|call| call.text == worst.text);
    let what = if equal {
        worst.text.clone()
    } else {
        worst.kind.title()
    };
    let mut vehicles: Vec<VehicleId> = same.iter().filter_map(|call| call.vehicle).collect();
    vehicles.sort_unstable();
    vehicles.dedup();
    let first = match vehicles.as_slice() {
        [] => what,
        [one] => text!("alert-of-one", vehicle = *one, what = what),
        many => text!("alert-of-many", count = many.len(), what = what),
    };
    if others.is_empty() {
        first
    } else {
        text!("alert-and-more", first = first, count = others.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(vehicle: VehicleId, kind: AlertKind) -> BellCall {
        BellCall {
            kind,
            severity: Severity::Alert,
            vehicle: Some(vehicle),
            text: kind.title(),
            worse: false,
        }
    }

    fn at(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    #[test]
    fn many_calls_are_one_ring_and_one_note() {
        let mut bell = Bell::default();
        for vehicle in 1..=4 {
            bell.call(at(1), call(vehicle, AlertKind::LinkLost));
        }
        assert_eq!(
            bell.due(at(1)),
            Due {
                ring: true,
                note: None
            }
        );
        bell.call(at(1), call(5, AlertKind::Fence));
        let due = bell.due(at(2));
        let note = due.note.map(|text| text.to_string());
        assert_eq!(note.as_deref(), Some("4 vehicles: LINK LOST (+1)"));
        assert_eq!(bell.due(at(60)), Due::default(), "one ring for all of them");
        bell.call(at(61), call(6, AlertKind::LinkLost));
        assert!(bell.due(at(61)).ring);
        bell.call(at(64), call(7, AlertKind::LinkLost));
        assert!(!bell.due(at(65)).ring, "not so soon again");
        assert!(bell.due(at(66)).ring);
    }

    #[test]
    fn old_news_rings_only_when_it_has_become_worse() {
        let mut bell = Bell::default();
        bell.call(at(1), call(1, AlertKind::Battery));
        assert!(bell.due(at(2)).ring);
        bell.call(at(8), call(1, AlertKind::Battery));
        assert!(!bell.due(at(20)).ring);
        let worse = BellCall {
            worse: true,
            ..call(1, AlertKind::Battery)
        };
        bell.call(at(21), worse);
        assert!(bell.due(at(21)).ring);
    }

    #[test]
    fn what_is_not_serious_and_reasons_not_to_arm_are_silent() {
        let mut bell = Bell::default();
        bell.call(at(1), call(1, AlertKind::Prearm));
        let minor = BellCall {
            severity: Severity::Error,
            ..call(1, AlertKind::Fence)
        };
        bell.call(at(1), minor);
        assert_eq!(bell.due(at(30)), Due::default());
    }
}
