//! What is shown and said of a session's links.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;

use crate::app::event::{Event, LinkEvent};
use crate::app::state::LinkSummary;
use crate::link::{LinkId, LinkState, LinkStatus};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{ComponentId, SystemId};

/// The links of a session.
#[derive(Default)]
pub(super) struct SessionLinks {
    all: Vec<watch::Receiver<LinkStatus>>,
    /// What was said of each last.
    said: Vec<LinkNews>,
    /// How many had ended when they were shown last.
    ended: usize,
}

impl SessionLinks {
    /// Adds a link that was opened.
    pub fn add(&mut self, link: watch::Receiver<LinkStatus>) {
        self.all.push(link);
        self.said.push(LinkNews::Silent);
    }

    /// All of them, in their order.
    pub fn all(&self) -> &[watch::Receiver<LinkStatus>] {
        &self.all
    }

    /// What a human should hear of them: that one is down and why, and that it is up again.
    pub fn hear(&mut self, now: Duration) -> impl Iterator<Item = Notice> {
        let links = self.all.iter().zip(&mut self.said);
        links.filter_map(move |(link, said)| {
            let status = link.borrow();
            let news = LinkNews::of(&status);
            if news == LinkNews::Silent || news == *said {
                return None;
            }
            let before = std::mem::replace(said, news.clone());
            let is_usual = before == LinkNews::Silent && news == LinkNews::Up;
            (!is_usual).then(|| news.notice(&status.name, now))
        })
    }

    /// How they are, if that has changed.
    pub fn changed(&mut self, vehicles: &[watch::Receiver<Arc<Vehicle>>]) -> Option<Event> {
        // A link that has ended has changed for the last time; its last state still has to be shown.
        let links = self.all.iter();
        let ended = links.filter(|link| link.has_changed().is_err()).count();
        let has_changed = |link: &watch::Receiver<LinkStatus>| link.has_changed().unwrap_or(false);
        if ended == self.ended && !self.all.iter().any(has_changed) {
            return None;
        }
        self.ended = ended;
        let summaries = self.all.iter_mut().map(|link| {
            let status = link.borrow_and_update();
            let round_trip = round_trip(vehicles, status.id);
            summary(&status, round_trip)
        });
        Some(LinkEvent::Summaries(summaries.collect()).into())
    }
}

/// What is worth saying of a link.
#[derive(Debug, Clone, PartialEq, Eq)]
enum LinkNews {
    /// Nothing has been heard yet.
    Silent,
    /// The link carries data.
    Up,
    /// It does not, for this reason.
    Down(Text),
    /// Closed for good, as a recording that has been played to its end.
    Ended,
}

impl LinkNews {
    fn of(status: &LinkStatus) -> Self {
        match (status.state, &status.last_error) {
            (LinkState::Up, _) => Self::Up,
            (_, Some(error)) => Self::Down(error.clone()),
            (LinkState::Ended, None) => Self::Ended,
            _ => Self::Silent,
        }
    }

    fn notice(&self, name: &str, now: Duration) -> Notice {
        let (severity, text) = match self {
            Self::Silent | Self::Up => (Severity::Info, text!("transport-is-up", link = name)),
            Self::Ended => (Severity::Notice, text!("transport-has-ended", link = name)),
            Self::Down(reason) => {
                let text = text!("transport-is-down", link = name, reason = reason);
                (Severity::Error, text)
            }
        };
        Notice {
            at: now,
            vehicle: None,
            severity,
            kind: None,
            text,
        }
    }
}

/// The shortest round trip of the vehicles that are heard by a link.
fn round_trip(vehicles: &[watch::Receiver<Arc<Vehicle>>], link: LinkId) -> Option<Duration> {
    let quality = |vehicle: &watch::Receiver<Arc<Vehicle>>| vehicle.borrow().link;
    vehicles
        .iter()
        .map(quality)
        .filter(|quality| quality.via == Some(link.0))
        .filter_map(|quality| quality.round_trip)
        .min()
}

/// The senders whose frames are missing, and how many.
fn lost(status: &LinkStatus) -> Vec<((SystemId, ComponentId), u64)> {
    let senders = status.numbered.iter();
    senders
        .filter(|(_, frames)| frames.lost > 0)
        .map(|(&sender, frames)| (sender, frames.lost))
        .collect()
}

fn summary(status: &LinkStatus, round_trip: Option<Duration>) -> LinkSummary {
    let up = status.state == LinkState::Up;
    LinkSummary {
        name: status.name.clone(),
        state: status.state.text(),
        up,
        error: status.last_error.clone().filter(|_| !up),
        peers: status.peers,
        bytes_in_per_s: f64::from(status.rates.bytes_in_s),
        bytes_out_per_s: f64::from(status.rates.bytes_out_s),
        messages_in_per_s: f64::from(status.rates.messages_in_s),
        messages_out_per_s: f64::from(status.rates.messages_out_s),
        bad_crc: status.decoder.crc_errors,
        skipped_bytes: status.decoder.skipped_bytes,
        unknown: status.decoder.unknown_messages,
        undecoded: status.decoder.undecoded,
        lost: lost(status),
        unsent: status.dropped_out,
        reconnects: status.reconnects,
        round_trip,
    }
}
