//! System ids that several vehicles share. They are apart because they show only when all links are compared: one id on
//! two of them is a fault of neither.

use std::collections::BTreeMap;
use std::time::Duration;

use super::autopilots;
use super::finding::{Cause, HeardBoard};
use crate::doctor::{Chart, Way};
use crate::wire::SystemId;

/// The heartbeat rate that reveals two autopilots with one id; one autopilot sends one a second.
const TWO_HEARTBEATS_HZ: f64 = 1.5;
/// A vehicle that has changed its port is heard on both ports for less than this; two vehicles are
/// heard for longer.
const BOTH_FOR: Duration = Duration::from_secs(6);

/// The system ids that several vehicles share, and the links on which they are heard.
pub(super) struct SharedIds {
    links: BTreeMap<SystemId, Vec<usize>>,
}

impl SharedIds {
    /// The shared ids on these links. Two vehicles at one end of a link show up as a doubled heartbeat rate and
    /// sequence numbers that jump back and forth.
    pub fn of(charts: &[Chart]) -> Self {
        let mut places: BTreeMap<SystemId, Vec<(usize, u32)>> = BTreeMap::new();
        let mut doubled: BTreeMap<SystemId, Vec<usize>> = BTreeMap::new();
        for (link, chart) in charts.iter().enumerate() {
            if chart.way() == Way::File {
                continue;
            }
            for sender in autopilots(chart) {
                let place = (link, sender.source.peer);
                let known = places.entry(sender.source.system).or_default();
                if sender.known_for >= BOTH_FOR && !known.contains(&place) {
                    known.push(place);
                }
                // Over UDP, two vehicles are two peers; a single peer with jumping numbers has restarted or counts
                // wrongly.
                let may_share = !matches!(chart.way(), Way::Udp | Way::UdpIn);
                // Two alternating sequences: on a route that keeps the order, nothing else steps back so often.
                let numbered = chart.numbered(sender);
                let jumps = may_share && numbered.late > numbered.came / 4;
                if jumps && sender.heartbeat_hz >= TWO_HEARTBEATS_HZ {
                    doubled.entry(sender.source.system).or_default().push(link);
                }
            }
        }
        for (system, places) in places {
            if places.len() > 1 {
                let links = doubled.entry(system).or_default();
                links.extend(places.iter().map(|(link, _)| *link));
                links.sort_unstable();
                links.dedup();
            }
        }
        Self { links: doubled }
    }

    /// The shared ids that are heard on the link with this index, in ascending order.
    pub fn on_link(&self, link: usize) -> impl Iterator<Item = SystemId> {
        let links = self.links.iter();
        let heard = links.filter(move |(_, links)| links.contains(&link));
        heard.map(|(&system, _)| system)
    }
}

/// Why a system id is heard at several places: equal boards are one vehicle.
pub(super) fn cause_of(charts: &[Chart], system: SystemId) -> Cause {
    let heard = heard_boards(charts, system);
    let (first, others) = match heard.split_first() {
        Some((first, others)) if !others.is_empty() => (first.board, others),
        _ => return Cause::DuplicateSystem(system),
    };
    if first.is_some() && others.iter().all(|other| other.board == first) {
        Cause::HeardTwice(system)
    } else {
        Cause::DuplicateSystem(system)
    }
}

/// The places at which the system id of a finding is heard.
pub(super) fn boards(charts: &[Chart], cause: &Cause) -> Vec<HeardBoard> {
    match cause {
        Cause::DuplicateSystem(system) | Cause::HeardTwice(system) => heard_boards(charts, *system),
        _ => Vec::new(),
    }
}

fn heard_boards(charts: &[Chart], system: SystemId) -> Vec<HeardBoard> {
    let heard = charts.iter().enumerate().flat_map(|(link, chart)| {
        let mine = autopilots(chart).filter(|sender| sender.source.system == system);
        mine.map(move |sender| HeardBoard {
            board: sender.board,
            link,
            address: chart.peer_name(sender.source.peer),
        })
    });
    heard.collect()
}
