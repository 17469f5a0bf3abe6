//! A session's links for display, and their notices.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;

use crate::app::event::{Event, LinkEvent};
use crate::app::state::{LinkCounters, LinkSummary};
use crate::link::{LinkId, LinkState, LinkStatus};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{ComponentId, SystemId};

/// How long a link must stay up before it is reported as up again.
const UP_HOLDS: Duration = Duration::from_secs(2);

/// The status of a session's links, and the last reported state of each.
#[derive(Default)]
pub(super) struct SessionLinks {
    all: Vec<watch::Receiver<LinkStatus>>,
    /// Their status at the last display.
    shown: Vec<LinkStatus>,
    heard: Vec<LinkHeard>,
    /// The number of ended links at the last display.
    ended: usize,
}

impl SessionLinks {
    /// Adds a link that was opened.
    pub fn add(&mut self, link: watch::Receiver<LinkStatus>) {
        self.shown.push(link.borrow().clone());
        self.all.push(link);
        self.heard.push(LinkHeard::new());
    }

    /// All links, in their order.
    pub fn all(&self) -> &[watch::Receiver<LinkStatus>] {
        &self.all
    }

    /// The status of all links at the last display, in their order.
    pub fn shown(&self) -> &[LinkStatus] {
        &self.shown
    }

    /// Notices of links that are down, with the reason, or up again.
    pub fn hear(&mut self, now: Duration) -> impl Iterator<Item = Notice> {
        let links = self.all.iter().zip(&mut self.heard);
        links.filter_map(move |(link, heard)| {
            let status = link.borrow();
            let news = heard.note(LinkNews::of(&status), now)?;
            Some(news.notice(&status.name, now))
        })
    }

    /// The state of all links, if it has changed.
    pub fn changed(&mut self, vehicles: &[watch::Receiver<Arc<Vehicle>>]) -> Option<Event> {
        // An ended link no longer changes, but its last state must still be shown.
        let links = self.all.iter();
        let ended = links.filter(|link| link.has_changed().is_err()).count();
        let has_changed = |link: &watch::Receiver<LinkStatus>| link.has_changed().unwrap_or(false);
        if ended == self.ended && !self.all.iter().any(has_changed) {
            return None;
        }
        self.ended = ended;
        for (link, shown) in self.all.iter_mut().zip(&mut self.shown) {
            if link.has_changed().unwrap_or(true) {
                shown.clone_from(&link.borrow_and_update());
            }
        }
        let summaries = self.shown.iter().map(|status| {
            let round_trip = round_trip(vehicles, status.id);
            summary(status, round_trip)
        });
        Some(LinkEvent::Summaries(summaries.collect()).into())
    }
}

/// The state and the last notice of a link.
pub(super) struct LinkHeard {
    seen: LinkNews,
    since: Duration,
    /// The last notice given.
    said: LinkNews,
}

impl LinkHeard {
    pub fn new() -> Self {
        Self {
            seen: LinkNews::Silent,
            since: Duration::ZERO,
            said: LinkNews::Silent,
        }
    }

    /// The notice that is due, if any. A link counts as up again only after `UP_HOLDS`; a link that
    /// keeps going up and down repeats the same notice, which is folded.
    pub fn note(&mut self, news: LinkNews, now: Duration) -> Option<LinkNews> {
        if news == LinkNews::Silent {
            return None;
        }
        let is_new = news != self.seen;
        if is_new {
            self.seen = news;
            self.since = now;
        }
        let is_said = match self.seen {
            // The first start of a link is normal.
            LinkNews::Up if self.said == LinkNews::Silent => {
                self.said = LinkNews::Up;
                false
            }
            LinkNews::Up => self.said != LinkNews::Up && now >= self.since + UP_HOLDS,
            LinkNews::Down(_) | LinkNews::Ended => is_new,
            LinkNews::Silent => false,
        };
        is_said.then(|| {
            self.said.clone_from(&self.seen);
            self.seen.clone()
        })
    }
}

/// A state of a link that is worth a notice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum LinkNews {
    /// Nothing has been heard yet.
    Silent,
    /// The link carries data.
    Up,
    /// The link does not carry data, for this reason.
    Down(Text),
    /// The link is closed for good: for example, its recording has been played to the end.
    Ended,
}

impl LinkNews {
    pub fn of(status: &LinkStatus) -> Self {
        match (status.state, &status.last_error) {
            (LinkState::Up, _) => Self::Up,
            (LinkState::Connecting | LinkState::Waiting { .. } | LinkState::Ended, Some(error)) => {
                Self::Down(error.clone())
            }
            (LinkState::Ended, None) => Self::Ended,
            (LinkState::Connecting | LinkState::Waiting { .. }, None) => Self::Silent,
        }
    }

    fn notice(&self, name: &Text, now: Duration) -> Notice {
        let (severity, text) = match self {
            Self::Silent | Self::Up => (Severity::Info, text!("transport-is-up", link = name)),
            Self::Ended => (Severity::Notice, text!("transport-has-ended", link = name)),
            Self::Down(reason) => {
                let text = text!("transport-is-down", link = name, reason = reason);
                (Severity::Error, text)
            }
        };
        Notice::general(now, severity, text)
    }
}

/// The shortest round trip of the vehicles heard on a link.
fn round_trip(vehicles: &[watch::Receiver<Arc<Vehicle>>], link: LinkId) -> Option<Duration> {
    let quality = |vehicle: &watch::Receiver<Arc<Vehicle>>| vehicle.borrow().link;
    vehicles
        .iter()
        .map(quality)
        .filter(|quality| quality.via == Some(link.0))
        .filter_map(|quality| quality.round_trip)
        .min()
}

/// The senders with missing frames, and how many frames each is missing.
fn lost(status: &LinkStatus) -> Vec<((SystemId, ComponentId), u64)> {
    let senders = status.numbered.iter();
    senders
        .filter(|(_, frames)| frames.lost > 0)
        .map(|(&sender, frames)| (sender, frames.lost))
        .collect()
}

/// The senders that are ground stations.
fn stations(status: &LinkStatus) -> BTreeSet<(SystemId, ComponentId)> {
    let senders = status.numbered.iter();
    let stations = senders.filter(|(_, frames)| frames.is_station);
    stations.map(|(&sender, _)| sender).collect()
}

fn summary(status: &LinkStatus, round_trip: Option<Duration>) -> LinkSummary {
    let up = status.state == LinkState::Up;
    LinkSummary {
        name: status.name.clone(),
        state: status.state.text(),
        up,
        error: status.last_error.clone().filter(|_| !up),
        bytes_in_per_s: f64::from(status.rates.bytes_in_s),
        bytes_out_per_s: f64::from(status.rates.bytes_out_s),
        messages_in_per_s: f64::from(status.rates.messages_in_s),
        messages_out_per_s: f64::from(status.rates.messages_out_s),
        counters: Some(LinkCounters {
            peers: status.peers,
            bad_crc: status.decoder.crc_errors,
            skipped_bytes: status.decoder.skipped_bytes,
            unknown: status.decoder.unknown_messages,
            undecoded: status.decoder.undecoded,
            lost: lost(status),
            stations: stations(status),
            unsent: status.dropped_out,
            reconnects: status.reconnects,
            seals: status.seals(),
        }),
        round_trip,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes the state ten times a second during this time; returns the notices.
    fn said(heard: &mut LinkHeard, from_ms: u64, to_ms: u64, news: &LinkNews) -> Vec<LinkNews> {
        (from_ms..to_ms)
            .step_by(100)
            .filter_map(|ms| heard.note(news.clone(), Duration::from_millis(ms)))
            .collect()
    }

    #[test]
    fn a_link_that_goes_up_and_down_says_the_same_again_and_again() {
        let down = LinkNews::Down("connection reset".into());
        let mut heard = LinkHeard::new();
        assert_eq!(said(&mut heard, 0, 5000, &LinkNews::Up), [], "as usual");
        for round in 0..20 {
            let at = 5000 + round * 500;
            let told = said(&mut heard, at, at + 200, &down);
            assert_eq!(told, std::slice::from_ref(&down));
            assert_eq!(said(&mut heard, at + 200, at + 500, &LinkNews::Up), []);
        }
        assert_eq!(
            said(&mut heard, 15_000, 20_000, &LinkNews::Up),
            [LinkNews::Up],
            "once it has held"
        );
    }
}
