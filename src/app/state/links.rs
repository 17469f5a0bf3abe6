//! The counters of the links.

use std::time::Duration;

use crate::text::Text;
use crate::wire::{ComponentId, SystemId};

/// What a link counts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinkSummary {
    pub name: String,
    /// Its state in words, such as `up` or `down, next try in 4 s`.
    pub state: Text,
    /// Whether it carries data.
    pub up: bool,
    /// Why it does not.
    pub error: Option<Text>,
    /// Senders at its other end.
    pub peers: usize,
    /// Bytes per second received.
    pub bytes_in_per_s: f64,
    /// Bytes per second sent.
    pub bytes_out_per_s: f64,
    /// Messages per second received.
    pub messages_in_per_s: f64,
    /// Messages per second sent.
    pub messages_out_per_s: f64,
    /// Frames dropped for their checksum.
    pub bad_crc: u64,
    /// Bytes skipped to find the next frame.
    pub skipped_bytes: u64,
    /// Messages that the dialect does not have.
    pub unknown: u64,
    /// Messages whose fields the dialect does not have.
    pub undecoded: u64,
    /// Frames missing by sequence numbers, per sender.
    pub lost: Vec<((SystemId, ComponentId), u64)>,
    /// Messages that could not be sent.
    pub unsent: u64,
    /// How often it has come up again.
    pub reconnects: u32,
    /// Round trip by TIMESYNC.
    pub round_trip: Option<Duration>,
}
