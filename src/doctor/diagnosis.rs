//! The diagnosis of links from their charts.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use super::{Chart, ChartChange, HeartbeatRole, Sender, Way};
use crate::geo::maths;
use crate::wire::{
    BoardId, ComponentId, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, SystemId,
};

mod signatures;

use signatures::{last_keyed, signing};

/// The time before a first diagnosis: heartbeats come once a second.
const PATIENCE: Duration = Duration::from_secs(4);
const QUERY_EVERY: Duration = Duration::from_secs(5);
/// The accepted probability, on a link with losses, that a vehicle seems not to answer although it
/// does.
const MISTAKEN: f64 = 0.001;
/// The maximum number of queries to wait for, however many frames the link loses.
const MOST_QUERIES: u32 = 60;
/// The minimum time that a vehicle is given to answer.
const ANSWER_WITHIN: Duration = Duration::from_secs(12);
/// The minimum silence after which a vehicle that has answered before counts as one-way.
const ANSWERS_AGAIN_WITHIN: Duration = Duration::from_secs(30);
/// The maximum number of vehicles without an answer that are listed by number.
const MOST_NAMED: usize = 3;
/// The share of bytes outside frames that counts as noise, and the minimum number of such bytes in the window.
const MOST_NOISE: f64 = 0.5;
const NOISE_THAT_MATTERS: u64 = 2000;
/// The number of sent messages after which an answer is expected.
const ASKED_ENOUGH: u64 = 3;
/// The share of frames with a wrong checksum that counts as a fault; a radio at the limit of its range stays below.
const MOST_DAMAGED: f64 = 0.05;
/// The share of missing frames that counts as a fault.
const MOST_LOST: f64 = 0.10;
/// The heartbeat rate that reveals two autopilots with one id; one autopilot sends one a second.
const TWO_HEARTBEATS_HZ: f64 = 1.5;
/// A vehicle that has changed its port is heard on both ports for less than this; two vehicles are
/// heard for longer.
const BOTH_FOR: Duration = Duration::from_secs(6);
/// The minimum number of garbage bytes that count as noise; fewer may be the end of a frame that
/// began before the link was opened.
const NOISE_ENOUGH: u64 = 40;
/// The minimum number of frames with unknown messages that rules out a coincidence.
const FOREIGN_ENOUGH: u64 = 3;

/// A finding about a link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkFinding {
    /// The index of the link in the list of charts.
    pub link: usize,
    /// Its kind of connection, on which the advice depends.
    pub way: Way,
    pub cause: Cause,
    /// The boards that share a system id, and their places; empty for other causes.
    pub boards: Vec<HeardBoard>,
}

/// A vehicle among several with one system id.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeardBoard {
    /// The id of its board, if known.
    pub board: Option<BoardId>,
    /// The index of its link in the list of charts.
    pub link: usize,
    /// Its address, if the link has several peers.
    pub address: Option<String>,
}

/// The weight of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    Fatal,
    /// A part of the link does not work as it should.
    Fault,
    Remark,
    /// Not a fault, or too early to tell.
    Fine,
}

/// Why a link does or does not work.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The link is not open; its own error gives the reason.
    NotOpen,
    /// Nothing arrives at all.
    Nothing,
    Text,
    /// Bytes arrive, but they contain no frame.
    NoFrame,
    /// Bytes without frames or text on a serial port: its baud rate is probably wrong.
    WrongBaud,
    /// All frames are of messages that the dialect does not have.
    UnknownDialect,
    /// Some frames, this share in percent, are of messages that the dialect does not have.
    ForeignMessages(u8),
    /// Ground stations are heard, but no vehicle.
    OnlyGroundStations,
    /// All frames are heartbeats with the console's own ids.
    OwnEcho,
    /// Components such as cameras are heard, but no autopilot.
    NoAutopilot,
    /// Two vehicles have this system id.
    DuplicateSystem(SystemId),
    /// The vehicle signs with a key that the console does not have, and does not answer the console's unsigned frames.
    Signed(SystemId),
    /// The vehicle signs with a key that the console does not have, but accepts unsigned frames.
    SignedButAnswers(SystemId),
    /// Unsigned frames arrive in the name of a vehicle that should sign.
    Unsigned(SystemId),
    /// Frames that are not signed with a vehicle's key arrive in its name.
    WrongKey(SystemId),
    /// Frames of a vehicle have old timestamps, this many seconds behind: they may be replayed.
    OldStamps(SystemId, u64),
    /// The vehicle is heard but does not answer.
    OneWay(SystemId),
    /// This many vehicles are heard but do not answer.
    OneWayVehicles(usize),
    /// This share of the bytes belongs to no frame, in percent.
    Noise(u8),
    /// The vehicle supports only MAVLink 1.
    Version1(SystemId),
    /// Another ground station, with these ids, is heard in addition to a vehicle.
    OtherStation(SystemId, ComponentId),
    /// This share of the frames arrives damaged, in percent.
    Damaged(u8),
    /// This share of the frames does not arrive, in percent.
    Lossy(u8),
    /// A recording is played, so there are no answers.
    Recording,
    /// The observation is too short for a finding.
    Listening,
    /// This many vehicles are heard, and it is too early to expect an answer.
    Unanswered(usize),
    /// This many vehicles are heard and answer.
    Well(usize),
}

impl Cause {
    /// The weight of the cause.
    pub fn weight(&self) -> Weight {
        match self {
            Self::NotOpen
            | Self::Nothing
            | Self::Text
            | Self::NoFrame
            | Self::WrongBaud
            | Self::UnknownDialect
            | Self::OnlyGroundStations
            | Self::OwnEcho
            | Self::NoAutopilot => Weight::Fatal,
            Self::DuplicateSystem(_)
            | Self::Signed(_)
            | Self::Unsigned(_)
            | Self::WrongKey(_)
            | Self::OldStamps(..)
            | Self::OneWay(_)
            | Self::OneWayVehicles(_)
            | Self::Noise(_)
            | Self::Damaged(_)
            | Self::Lossy(_) => Weight::Fault,
            Self::ForeignMessages(_)
            | Self::SignedButAnswers(_)
            | Self::Version1(_)
            | Self::OtherStation(..)
            | Self::Recording => Weight::Remark,
            Self::Listening | Self::Unanswered(_) | Self::Well(_) => Weight::Fine,
        }
    }
}

/// The findings of each link, worst first; every link has at least one.
pub fn diagnose(charts: &[Chart]) -> Vec<LinkFinding> {
    let duplicates = duplicates(charts);
    let mut findings = Vec::new();
    for (link, chart) in charts.iter().enumerate() {
        let shared = duplicates.iter().filter(|(_, links)| links.contains(&link));
        let mut causes: Vec<Cause> = shared
            .map(|(&system, _)| Cause::DuplicateSystem(system))
            .collect();
        causes.extend(examine(chart));
        if causes.is_empty() {
            causes = fine(chart);
        }
        findings.extend(causes.into_iter().map(|cause| LinkFinding {
            link,
            way: chart.way(),
            boards: boards(charts, &cause),
            cause,
        }));
    }
    findings.sort_by_key(|finding| finding.cause.weight());
    findings
}

/// The vehicles that share the system id of a finding.
fn boards(charts: &[Chart], cause: &Cause) -> Vec<HeardBoard> {
    let Cause::DuplicateSystem(system) = cause else {
        return Vec::new();
    };
    let heard = charts.iter().enumerate().flat_map(|(link, chart)| {
        let mine = autopilots(chart).filter(|sender| sender.source.system == *system);
        mine.map(move |sender| HeardBoard {
            board: sender.board,
            link,
            address: chart.peer_name(sender.source.peer),
        })
    });
    heard.collect()
}

/// The findings of a link without a fault.
fn fine(chart: &Chart) -> Vec<Cause> {
    let (answering, silent): (Vec<&Sender>, Vec<&Sender>) =
        autopilots(chart).partition(|sender| sender.answered_ago.is_some());
    let unanswered = (!silent.is_empty()).then_some(Cause::Unanswered(silent.len()));
    let well = (!answering.is_empty()).then_some(Cause::Well(answering.len()));
    unanswered.into_iter().chain(well).collect()
}

/// The faults of one link, examined on its own.
fn examine(chart: &Chart) -> Vec<Cause> {
    let Some(last) = chart.last() else {
        return vec![Cause::Listening];
    };
    if !last.up {
        return vec![Cause::NotOpen];
    }
    if autopilots(chart).next().is_none() {
        return vec![nobody(chart)];
    }
    let change = chart.change();
    let lost = lost_share(chart);
    let queries = queries_without_doubt(lost);
    let mut causes: Vec<Cause> = autopilots(chart)
        .filter_map(|sender| answering(chart, sender, queries))
        .chain(autopilots(chart).flat_map(|sender| signing(chart, sender)))
        .collect();
    let is_one_way = |cause: &Cause| matches!(cause, Cause::OneWay(_));
    let one_way = causes.iter().filter(|cause| is_one_way(cause)).count();
    if one_way > MOST_NAMED {
        causes.retain(|cause| !is_one_way(cause));
        causes.push(Cause::OneWayVehicles(one_way));
    }
    let is_cut = |cause: &Cause| chart.way() == Way::File && matches!(cause, Cause::Lossy(_));
    let quality = quality(&change, lost);
    causes.extend(quality.into_iter().filter(|cause| !is_cut(cause)));
    causes.extend(other_stations(chart));
    causes.extend(
        autopilots(chart)
            .filter(|sender| sender.version1)
            .map(|sender| Cause::Version1(sender.source.system)),
    );
    if chart.way() == Way::File {
        causes.push(Cause::Recording);
    }
    causes
}

/// Why no vehicle is heard.
fn nobody(chart: &Chart) -> Cause {
    if chart.up_for() < PATIENCE {
        return Cause::Listening;
    }
    let change = chart.change();
    if change.frames > 0 || !chart.senders().is_empty() {
        return strangers(chart);
    }
    // Noise contains the beginning of a frame here and there, but most of its bytes belong to none.
    let has_frames = change.bytes > 2 * change.skipped;
    if change.bytes == 0 {
        Cause::Nothing
    } else if has_frames && change.crc_errors.max(change.unknown) >= FOREIGN_ENOUGH {
        if change.crc_errors > change.unknown {
            Cause::Damaged(100)
        } else {
            Cause::UnknownDialect
        }
    } else if change.bytes < NOISE_ENOUGH {
        Cause::Listening
    } else if chart.last().is_some_and(|last| is_text(&last.noise)) {
        Cause::Text
    } else if chart.way() == Way::Serial {
        Cause::WrongBaud
    } else {
        Cause::NoFrame
    }
}

/// The diagnosis if senders are heard, but no vehicle.
fn strangers(chart: &Chart) -> Cause {
    let senders = chart.senders();
    let is_us = |sender: &Sender| sender.ids() == (GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT);
    let others = senders
        .iter()
        .filter(|sender| sender.role == HeartbeatRole::Other);
    if senders.is_empty() || others.count() > 0 {
        return Cause::NoAutopilot;
    }
    let ground_stations = senders
        .iter()
        .filter(|sender| sender.role == HeartbeatRole::GroundStation);
    match ground_stations.clone().count() {
        0 => Cause::NoAutopilot,
        1 if ground_stations.clone().all(is_us)
            && matches!(chart.way(), Way::Serial | Way::Udp) =>
        {
            Cause::OwnEcho
        }
        _ => Cause::OnlyGroundStations,
    }
}

/// The number of consecutive unanswered queries that almost certainly show that a vehicle does not
/// answer, if the share `lost` of the frames is lost in each direction.
fn queries_without_doubt(lost: f64) -> u32 {
    let answered = (1.0 - lost) * (1.0 - lost);
    // The lower limit means no loss; the upper one keeps the logarithm below 0 at total loss.
    let missed = (1.0 - answered).clamp(0.0, 0.99);
    let queries = (maths::ln(MISTAKEN) / maths::ln(missed)).ceil();
    queries.min(f64::from(MOST_QUERIES)) as u32
}

/// The finding about whether a vehicle answers the console's messages: it does not if at least
/// `queries` messages are unanswered. `None` if there is nothing to report.
fn answering(chart: &Chart, sender: &Sender, queries: u32) -> Option<Cause> {
    let (way, system) = (chart.way(), sender.source.system);
    let is_foreign = sender.signed && !last_keyed(chart).contains(&system);
    let patience = QUERY_EVERY * queries;
    let answers = sender
        .answered_ago
        .is_some_and(|ago| ago < patience.max(ANSWERS_AGAIN_WITHIN));
    if answers || way == Way::File {
        return is_foreign.then_some(Cause::SignedButAnswers(system));
    }
    let asked_enough = ASKED_ENOUGH.max(queries.into());
    if sender.known_for < patience.max(ANSWER_WITHIN) || sender.asked < asked_enough {
        return is_foreign.then_some(Cause::Signed(system));
    }
    Some(if is_foreign {
        Cause::Signed(system)
    } else {
        Cause::OneWay(system)
    })
}

/// The share of the vehicles' frames that is missing. Other ground stations are not counted, since
/// vehicles forward only some of their frames.
fn lost_share(chart: &Chart) -> f64 {
    let vehicles: BTreeSet<SystemId> = autopilots(chart)
        .map(|sender| sender.source.system)
        .collect();
    let senders: BTreeMap<_, _> = chart
        .senders()
        .iter()
        .filter(|sender| vehicles.contains(&sender.source.system))
        .filter(|sender| sender.role != HeartbeatRole::GroundStation)
        .map(|sender| (sender.ids(), chart.numbered(sender)))
        .collect();
    let came: u64 = senders.values().map(|frames| frames.came).sum();
    let lost: u64 = senders.values().map(|frames| frames.lost).sum();
    share(lost, came + lost)
}

/// Ground stations that are heard in addition to a vehicle and can command it, too; none in a
/// recording. A component of this type within a vehicle's system belongs to the vehicle.
fn other_stations(chart: &Chart) -> impl Iterator<Item = Cause> {
    let vehicles: BTreeSet<SystemId> = autopilots(chart)
        .map(|sender| sender.source.system)
        .collect();
    let senders = chart.senders().iter();
    let stations = senders
        .filter(|_| chart.way() != Way::File)
        .filter(|sender| sender.role == HeartbeatRole::GroundStation)
        .filter(|sender| !vehicles.contains(&sender.source.system));
    let ids: BTreeSet<_> = stations.map(Sender::ids).collect();
    ids.into_iter()
        .map(|(system, component)| Cause::OtherStation(system, component))
}

fn share(part: u64, of: u64) -> f64 {
    part as f64 / of.max(1) as f64
}

/// The faults in the received data: damaged or missing frames, noise, and messages that the dialect
/// does not have.
fn quality(change: &ChartChange, lost: f64) -> Vec<Cause> {
    let percent = |share: f64| (share * 100.0).round().clamp(0.0, 100.0) as u8;
    let damaged = share(change.crc_errors, change.frames + change.crc_errors);
    let foreign = share(change.unknown, change.frames + change.unknown);
    let mut causes = Vec::new();
    if damaged > MOST_DAMAGED {
        causes.push(Cause::Damaged(percent(damaged)));
    } else if lost > MOST_LOST {
        causes.push(Cause::Lossy(percent(lost)));
    }
    let noise = share(change.skipped, change.bytes);
    if noise > MOST_NOISE && change.skipped > NOISE_THAT_MATTERS {
        causes.push(Cause::Noise(percent(noise)));
    }
    if change.unknown >= FOREIGN_ENOUGH && foreign > 0.01 {
        causes.push(Cause::ForeignMessages(percent(foreign).max(1)));
    }
    causes
}

/// System ids that two vehicles share, and the links on which they are heard. Two vehicles at one
/// end of a link show up as a doubled heartbeat rate and sequence numbers that jump back and forth.
fn duplicates(charts: &[Chart]) -> BTreeMap<SystemId, Vec<usize>> {
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
    doubled
}

fn autopilots(chart: &Chart) -> impl Iterator<Item = &Sender> {
    let senders = chart.senders().iter();
    senders.filter(|sender| sender.role == HeartbeatRole::Autopilot)
}

/// Whether bytes are readable text, such as that of a shell, a boot loader or a GPS receiver.
fn is_text(bytes: &[u8]) -> bool {
    let readable = |byte: &&u8| matches!(byte, b' '..=b'~' | b'\r' | b'\n' | b'\t');
    !bytes.is_empty() && bytes.iter().filter(readable).count() * 10 >= bytes.len() * 9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_more_frames_are_lost_the_more_queries_count() {
        let queries = |percent: u32| queries_without_doubt(f64::from(percent) / 100.0);
        assert_eq!(
            [0, 5, 30, 50, 100].map(queries),
            [0, 3, 11, 25, MOST_QUERIES]
        );
    }
}
