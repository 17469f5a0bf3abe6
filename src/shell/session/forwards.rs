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

/// The time for which own frames that come back are counted, and the number that shows a loop: heartbeats alone are one
/// a second, and a single frame may come back when a station is restarted.
const COUNTED_FOR: Duration = Duration::from_secs(10);
const RETURNS_ENOUGH: u64 = 5;

/// The open forwards of a session, and the state last shown.
#[derive(Default)]
pub(super) struct SessionForwards {
    open: Vec<(ForwardFeed, LinkHeard, Returns)>,
    shown: Vec<ForwardSummary>,
}

/// The console's own frames that come back over a forward.
#[derive(Debug, Clone, Copy, Default)]
struct Returns {
    since: Duration,
    before: u64,
    is_told: bool,
}

impl Returns {
    /// Whether so many have come back that the forward is part of a loop; true only once.
    fn show_a_loop(&mut self, returned: u64, now: Duration) -> bool {
        if now < self.since + COUNTED_FOR {
            return false;
        }
        let is_loop = returned >= self.before + RETURNS_ENOUGH;
        (self.since, self.before) = (now, returned);
        is_loop && !std::mem::replace(&mut self.is_told, true)
    }
}

impl SessionForwards {
    pub fn add(&mut self, feed: ForwardFeed) {
        self.open.push((feed, LinkHeard::new(), Returns::default()));
    }

    /// Notices of forwards that carry no data, or that are part of a loop.
    pub fn hear(&mut self, now: Duration) -> Vec<Notice> {
        let notice = |(feed, heard, returns): &mut (ForwardFeed, LinkHeard, Returns)| {
            if returns.show_a_loop(feed.counts().returned, now) {
                let text = text!("forward-loop", address = &feed.spec.address);
                return Some(Notice::general(now, Severity::Notice, text));
            }
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
        self.open.retain(|(feed, ..)| {
            let is_over = feed.status.borrow().state == LinkState::Ended;
            !is_over
        });
        let summaries: Vec<_> = self.open.iter().map(|(feed, ..)| summary(feed)).collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_frames_that_keep_coming_back_are_a_loop_once() {
        let mut returns = Returns::default();
        let at = |second| Duration::from_secs(second);
        let counts = [(9, 9), (10, 3), (20, 7), (29, 20), (30, 20), (40, 60)];
        let told = counts.map(|(second, count)| returns.show_a_loop(count, at(second)));
        assert_eq!(told, [false, false, false, false, true, false]);
    }
}
