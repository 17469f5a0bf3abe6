//! The traffic of a recording's link, counted by the frames that it contains.

use std::time::Duration;

use crate::app::state::LinkSummary;
use crate::link::LinkState;
use crate::replay::Film;

/// The time over which rates are measured.
const SPAN: Duration = Duration::from_secs(1);

/// The traffic since the last summary.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Traffic {
    received: Flow,
    sent: Flow,
    since: Duration,
}

#[derive(Debug, Clone, Copy, Default)]
struct Flow {
    bytes: u64,
    messages: u64,
}

impl Flow {
    fn add(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.messages += 1;
    }
}

impl Traffic {
    /// Counts a frame from a vehicle.
    pub fn receive(&mut self, bytes: &[u8]) {
        self.received.add(bytes);
    }

    /// Counts a frame from a ground station.
    pub fn send(&mut self, bytes: &[u8]) {
        self.sent.add(bytes);
    }

    /// The rates of the recording's link, once a second. A recording contains no losses.
    pub fn summary(&mut self, film: &Film, now: Duration) -> Option<LinkSummary> {
        let span = now.saturating_sub(self.since);
        if span < SPAN {
            return None;
        }
        let Self { received, sent, .. } = std::mem::take(self);
        self.since = now;
        let per_s = |count: u64| count as f64 / span.as_secs_f64();
        Some(LinkSummary {
            name: film.name().into(),
            state: LinkState::Up.text(),
            up: true,
            bytes_in_per_s: per_s(received.bytes),
            bytes_out_per_s: per_s(sent.bytes),
            messages_in_per_s: per_s(received.messages),
            messages_out_per_s: per_s(sent.messages),
            ..LinkSummary::default()
        })
    }
}
