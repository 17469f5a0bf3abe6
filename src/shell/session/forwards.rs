//! A session's forwards for display, and their notices.

use std::time::Duration;

use super::RunningSession;
use super::links::{LinkHeard, LinkNews};
use crate::app::effect::ForwardChange;
use crate::app::event::{Event, LinkEvent};
use crate::app::state::ForwardSummary;
use crate::fleet::ForwardFeed;
use crate::forward::ForwardSpec;
use crate::link::{AddressError, LinkState};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// The open forwards of a session, and the state last shown.
#[derive(Default)]
pub(super) struct SessionForwards {
    open: Vec<(ForwardFeed, LinkHeard)>,
    shown: Vec<ForwardSummary>,
}

impl SessionForwards {
    pub fn add(&mut self, feed: ForwardFeed) {
        self.open.push((feed, LinkHeard::new()));
    }

    /// Notices of forwards that carry no data.
    pub fn hear(&mut self, now: Duration) -> Vec<Notice> {
        let notice = |(feed, heard): &mut (ForwardFeed, LinkHeard)| {
            let news = LinkNews::of(&feed.status.borrow());
            let LinkNews::Down(reason) = heard.note(news, now)? else {
                return None;
            };
            let address = &feed.spec.address;
            let text = text!("forward-down", address = address, reason = reason);
            Some(Notice::general(now, Severity::Error, text))
        };
        self.open.iter_mut().filter_map(notice).collect()
    }

    /// The state of the forwards, if it has changed. Closed ones are left out.
    pub fn changed(&mut self) -> Option<Event> {
        self.open.retain(|(feed, _)| {
            let is_over = feed.status.borrow().state == LinkState::Ended;
            !is_over
        });
        let summaries: Vec<_> = self.open.iter().map(|(feed, _)| summary(feed)).collect();
        if summaries == self.shown {
            return None;
        }
        self.shown.clone_from(&summaries);
        Some(LinkEvent::Forwards(summaries).into())
    }
}

fn summary(feed: &ForwardFeed) -> ForwardSummary {
    // Before the status is borrowed: a task that holds the lock of the forwards reads the status, and a writer that
    // waits in between would block both.
    let counts = feed.counts();
    let status = feed.status.borrow();
    ForwardSummary {
        name: feed.spec.to_string(),
        up: status.state == LinkState::Up,
        error: status.last_error.clone(),
        peers: status.peers,
        received_bytes: status.decoder.bytes,
        received_messages: status.decoder.frames + status.decoder.unknown_messages,
        sent_bytes: status.sent_bytes,
        sent_messages: status.sent_messages,
        dropped: status.dropped_out,
        filtered: counts.filtered,
        held_back: counts.held_back + counts.unknown,
        repeated: counts.repeated,
    }
}

impl RunningSession {
    /// Opens or closes a forward.
    ///
    /// # Errors
    /// The address is not valid, or the fleet has ended.
    pub fn change_forwards(&self, change: &ForwardChange) -> Result<(), Text> {
        match change {
            ForwardChange::Open(spec) => self.forward(spec.clone()),
            ForwardChange::Close(address) => Ok(self.fleet.unforward(address)?),
        }
    }

    /// Opens a forward.
    ///
    /// # Errors
    /// The address is not valid, or the fleet has ended.
    pub fn forward(&self, spec: ForwardSpec) -> Result<(), Text> {
        let address = spec
            .address
            .parse()
            .map_err(|error: AddressError| Text::from(&error))?;
        Ok(self.fleet.forward(spec, address)?)
    }
}
