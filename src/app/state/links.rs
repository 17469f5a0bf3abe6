//! The links: their counters, their forwards, and their faults.

use std::collections::BTreeSet;
use std::time::Duration;

use crate::doctor::{Cause, LinkFinding, SealCounts, Weight};
use crate::text::Text;
use crate::wire::{ComponentId, SystemId};

/// The links of a session.
#[derive(Debug, Clone, Default)]
pub struct Connections {
    /// The links, in the order of their addresses.
    pub(in crate::app) links: Vec<LinkSummary>,
    /// The forwards to other ground stations.
    pub(in crate::app) forwards: Vec<ForwardSummary>,
    /// The findings of the link doctor, worst first.
    pub(in crate::app) findings: Vec<LinkFinding>,
    /// The number of times that a reset of the message statistics was requested.
    pub(in crate::app) statistics_resets: u32,
    /// The file that the next count of the messages is exported to.
    pub(in crate::app) export_to: Option<String>,
    /// Findings already reported, by link and name.
    told: BTreeSet<(usize, &'static str)>,
}

impl Connections {
    /// Records a finding as reported; returns whether it was not reported before.
    pub(in crate::app) fn report(&mut self, finding: &LinkFinding) -> bool {
        self.told.insert((finding.link, finding.cause.name()))
    }

    /// The doctor's explanation of why no vehicle is heard; `None` for a closed link, which shows
    /// its own error.
    pub(super) fn worst_finding(&self) -> Option<&LinkFinding> {
        let worst = self.findings.first()?;
        let leaves_none = worst.cause.weight() == Weight::Fatal || worst.cause == Cause::SystemZero;
        let is_reported = leaves_none && worst.cause != Cause::NotOpen;
        is_reported.then_some(worst)
    }
}

/// The counters of a forward, through which other ground stations use the links.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ForwardSummary {
    /// The forward's address and filters.
    pub name: String,
    /// Whether the forward carries data.
    pub up: bool,
    /// Why the forward passes no data.
    pub error: Option<Text>,
    /// The number of stations at the forward's other end.
    pub peers: usize,
    /// Bytes received from the stations.
    pub received_bytes: u64,
    /// Messages received from the stations.
    pub received_messages: u64,
    /// Bytes sent to the stations.
    pub sent_bytes: u64,
    /// Messages sent to the stations.
    pub sent_messages: u64,
    /// Messages to the stations that were dropped because a station does not read fast enough.
    pub dropped: u64,
    /// Messages to the stations that the filters left out.
    pub filtered: u64,
    /// Messages from the stations that were not passed on because the forward is read-only, or the
    /// receiver is unknown.
    pub held_back: u64,
    /// Messages that arrived a second time, over another path.
    pub repeated: u64,
}

/// The state, traffic and counters of a link.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinkSummary {
    pub name: Text,
    /// The link's state as text, such as `up` or `down, next try in 4 s`.
    pub state: Text,
    /// Whether the link carries data.
    pub up: bool,
    /// Why the link carries no data.
    pub error: Option<Text>,
    /// Bytes per second received.
    pub bytes_in_per_s: f64,
    /// Bytes per second sent.
    pub bytes_out_per_s: f64,
    /// Messages per second received.
    pub messages_in_per_s: f64,
    /// Messages per second sent.
    pub messages_out_per_s: f64,
    /// The counters of the link itself; `None` in a replay, because a record contains only frames.
    pub counters: Option<LinkCounters>,
    /// The round-trip time measured with TIMESYNC.
    pub round_trip: Option<Duration>,
}

/// The counters of a link while it is open.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinkCounters {
    /// The number of senders at the link's other end.
    pub peers: usize,
    /// Frames dropped because of a wrong checksum.
    pub bad_crc: u64,
    /// Bytes skipped to find the next frame.
    pub skipped_bytes: u64,
    /// Messages unknown to the dialect.
    pub unknown: u64,
    /// Messages that the dialect could not decode.
    pub undecoded: u64,
    /// Frames missing according to their sequence numbers, by sender.
    pub lost: Vec<((SystemId, ComponentId), u64)>,
    /// The senders that are ground stations.
    pub stations: BTreeSet<(SystemId, ComponentId)>,
    /// Messages that could not be sent.
    pub unsent: u64,
    /// The number of reconnections.
    pub reconnects: u32,
    /// The number of frames of all senders by the state of their signature; `None` if no signatures
    /// are used on the link.
    pub seals: Option<SealCounts>,
}

impl LinkCounters {
    /// Frames missing according to their sequence numbers, of all senders except other ground stations: vehicles forward
    /// only some of their frames.
    pub fn all_lost(&self) -> u64 {
        let lost = self.lost.iter();
        let of_vehicles = lost.filter(|(sender, _)| !self.stations.contains(sender));
        of_vehicles.map(|(_, count)| count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_of_another_ground_station_are_not_lost_frames() {
        let counters = LinkCounters {
            lost: vec![((1, 1), 3), ((252, 230), 205)],
            stations: [(252, 230)].into(),
            ..LinkCounters::default()
        };
        assert_eq!(counters.all_lost(), 3);
    }
}
