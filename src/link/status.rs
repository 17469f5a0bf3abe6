//! The published state of a link: whether it carries data, and what it has counted.

use std::fmt;
use std::net::SocketAddr;
use std::time::Duration;

use super::LinkId;
use crate::doctor::{NumberedSenders, SealCounts};
use crate::text;
use crate::text::Text;
use crate::wire::Counters;

/// Whether a link carries data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkState {
    Connecting,
    Up,
    /// Failed or lost; another attempt follows.
    Waiting {
        /// The delay before the next attempt, from when this state was published.
        retry_in: Duration,
    },
    /// Closed for good: cancelled, a recording's end, or a pipe whose other end is gone.
    Ended,
}

impl LinkState {
    /// The state in a few words.
    pub fn text(self) -> Text {
        match self {
            Self::Connecting => text!("transport-connecting"),
            Self::Up => text!("transport-up"),
            Self::Waiting { retry_in } => {
                let seconds = format!("{:.1}", retry_in.as_secs_f32());
                text!("transport-waiting", seconds = seconds)
            }
            Self::Ended => text!("transport-ended"),
        }
    }
}

impl fmt::Display for LinkState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().fmt(f)
    }
}

/// Traffic per second, over the last two seconds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rates {
    /// Bytes received, good or bad.
    pub bytes_in_s: f32,
    pub messages_in_s: f32,
    pub bytes_out_s: f32,
    pub messages_out_s: f32,
}

/// The state of a link. Counters run from the link's opening, across reconnections.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkStatus {
    pub id: LinkId,
    /// Its address, or a word for the console's own simulator.
    pub name: Text,
    /// Whether it carries data.
    pub state: LinkState,
    /// The socket's local address, if it is open; it contains the port of a listener.
    pub local: Option<SocketAddr>,
    /// The number of peers: always 1 for an open stream.
    pub peers: usize,
    /// The counters of its decoders.
    pub decoder: Counters,
    /// Bytes sent or queued; a peer that does not read may miss the last ones.
    pub sent_bytes: u64,
    /// Messages sent or queued, including heartbeats; a message to three peers counts three times.
    pub sent_messages: u64,
    /// Dropped messages: the queue was full, the link was down, or the peer was gone or not reading.
    pub dropped_out: u64,
    pub rates: Rates,
    /// The sequence numbers of each sender.
    pub numbered: NumberedSenders,
    /// Whether signatures are used on the link: frames are signed, or have to be.
    pub uses_signing: bool,
    /// The number of reconnections.
    pub reconnects: u32,
    /// The last error; cleared when the link comes up.
    pub last_error: Option<Text>,
}

impl LinkStatus {
    /// The status of a link that is being opened.
    pub(super) fn new(id: LinkId, name: Text, state: LinkState) -> Self {
        Self {
            id,
            name,
            state,
            local: None,
            peers: 0,
            decoder: Counters::default(),
            sent_bytes: 0,
            sent_messages: 0,
            dropped_out: 0,
            rates: Rates::default(),
            numbered: NumberedSenders::new(),
            uses_signing: false,
            reconnects: 0,
            last_error: None,
        }
    }

    /// The frames of all senders by their signatures; `None` if no signatures are used on the link.
    pub fn seals(&self) -> Option<SealCounts> {
        let counts = self.numbered.values().map(|frames| frames.seals);
        let all = counts.fold(SealCounts::default(), SealCounts::plus);
        (self.uses_signing || all.has_signatures()).then_some(all)
    }

    /// Lost frames, from gaps in their senders' sequence numbers.
    pub fn lost(&self) -> u64 {
        self.numbered.values().map(|frames| frames.lost).sum()
    }
}
