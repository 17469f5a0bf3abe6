//! The link doctor: from a link's traffic to the causes of faults, and advice.
//!
//! A [`Chart`] per link keeps the last seconds of its [`observe`]d traffic. [`diagnose`] examines all charts together,
//! because one system id on two links is a fault of neither. It returns causes, worst first; the caller turns each
//! [`LinkFinding`] into text.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, HEARTBEAT_DATA, MavAutopilot, MavMessage, MavType,
};
use mavlink::{MavlinkVersion, MessageData as _};

use crate::inspector::{Census, Direction, FrameSource, MessageTally};
use crate::wire::{
    Anatomy, BoardId, ComponentId, Content, Counters, Decoder, Frame, Seal, SequenceStep, SystemId,
};

mod diagnosis;
#[cfg(test)]
mod tests;
mod words;

pub use diagnosis::{Cause, HeardBoard, LinkFinding, Weight, diagnose};

/// The time span of a chart: the last seconds of a link.
pub const WINDOW: Duration = Duration::from_secs(10);
/// A sender that has been silent for this long is dropped.
const GONE_AFTER: Duration = Duration::from_secs(5);
const HEARTBEAT: u32 = HEARTBEAT_DATA::ID;

/// The kind of connection, on which the advice depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// A connection to a TCP server.
    Tcp,
    /// A TCP server that waits for clients.
    TcpIn,
    /// UDP to one address.
    Udp,
    UdpIn,
    Serial,
    /// A recording: no answers are possible.
    File,
    Pipe,
}

impl Way {
    /// The kind of connection of a link's address, such as `udpin:127.0.0.1:14550`.
    pub fn of(address: &str) -> Self {
        match address.split(':').next() {
            Some("tcp") => Self::Tcp,
            Some("tcpin") => Self::TcpIn,
            Some("udp" | "udpbcast") => Self::Udp,
            Some("udpin") => Self::UdpIn,
            Some("serial") => Self::Serial,
            Some("file") => Self::File,
            _ => Self::Pipe,
        }
    }
}

/// The role of a sender, by its heartbeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeartbeatRole {
    Autopilot,
    GroundStation,
    /// A camera, a gimbal, a companion computer.
    Other,
    /// No heartbeat was received from this sender.
    Silent,
}

/// A sender that is heard on a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sender {
    /// The ids of the sender, and its peer.
    pub source: FrameSource,
    pub role: HeartbeatRole,
    /// How long the sender has been heard without a pause; before that it may have been stopped and
    /// unable to answer.
    pub known_for: Duration,
    pub heartbeat_hz: f64,
    /// Whether its last heartbeat was signed.
    pub signed: bool,
    /// Whether it sends MAVLink 1.
    pub version1: bool,
    /// How long ago it last answered the console; `None` if it never did.
    pub answered_ago: Option<Duration>,
    /// The number of messages sent to its peer, except heartbeats.
    pub asked: u64,
    /// The id of its board, if it has sent it.
    pub board: Option<BoardId>,
}

/// The sequence counts of a link's senders, by their ids.
pub type NumberedSenders = BTreeMap<(SystemId, ComponentId), NumberedFrames>;

/// Sequence counts of one sender's frames.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NumberedFrames {
    pub came: u64,
    pub lost: u64,
    /// Frames with a lower number than one already received.
    pub late: u64,
    /// Frames by their signatures.
    pub seals: SealCounts,
    /// Whether the sender is a ground station. Vehicles forward only some of a station's frames, so its gaps are no
    /// losses.
    pub is_station: bool,
}

/// Frames of one sender, by their signatures.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SealCounts {
    /// Signed with the sender's key, with a new timestamp.
    pub right: u64,
    pub unsigned: u64,
    /// Signed, but not with a key that the console has.
    pub foreign: u64,
    /// Signed with the sender's key, but with an old timestamp.
    pub old: u64,
    /// How far the timestamp of the last old frame was behind, in units of 10 microseconds.
    pub behind: u64,
}

impl SealCounts {
    /// Counts one more frame.
    pub fn note(&mut self, seal: Seal) {
        match seal {
            Seal::Unsigned => self.unsigned += 1,
            Seal::Foreign => self.foreign += 1,
            Seal::Old(behind) => {
                self.old += 1;
                self.behind = behind;
            }
            Seal::Right | Seal::RightWithNext => self.right += 1,
        }
    }

    /// Whether any frame had a signature.
    pub fn has_signatures(self) -> bool {
        self.right + self.foreign + self.old > 0
    }

    /// The sum of two counts, with the greater lag.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            right: self.right + other.right,
            unsigned: self.unsigned + other.unsigned,
            foreign: self.foreign + other.foreign,
            old: self.old + other.old,
            behind: self.behind.max(other.behind),
        }
    }

    fn since(self, before: Self) -> Self {
        Self {
            right: self.right.saturating_sub(before.right),
            unsigned: self.unsigned.saturating_sub(before.unsigned),
            foreign: self.foreign.saturating_sub(before.foreign),
            old: self.old.saturating_sub(before.old),
            behind: self.behind,
        }
    }
}

impl NumberedFrames {
    /// Counts one more frame by its sequence number.
    pub fn note(&mut self, step: SequenceStep) {
        self.came += 1;
        self.lost = self.lost.saturating_add_signed(step.missing.into());
        self.late += u64::from(step.is_late);
    }

    fn since(self, before: Self) -> Self {
        Self {
            came: self.came.saturating_sub(before.came),
            lost: self.lost.saturating_sub(before.lost),
            late: self.late.saturating_sub(before.late),
            seals: self.seals.since(before.seals),
            is_station: self.is_station,
        }
    }
}

/// The state of a link at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Whether the link carries data.
    pub up: bool,
    /// The counters of its decoders.
    pub counters: Counters,
    pub numbered: NumberedSenders,
    pub senders: Vec<Sender>,
    /// The addresses of its peers, by number, where they have one.
    pub peers: BTreeMap<u32, String>,
    /// The last bytes in which no frame was found.
    pub noise: Vec<u8>,
    /// The vehicles for which the console has a key.
    pub keyed: Vec<SystemId>,
    /// Whether frames without a valid signature are ignored.
    pub is_signing_required: bool,
}

impl Sender {
    fn ids(&self) -> (SystemId, ComponentId) {
        (self.source.system, self.source.component)
    }
}

/// The senders heard on a link; `now` is on the census's clock.
pub fn observe(census: &Census, now: Duration) -> Vec<Sender> {
    census
        .sources()
        .filter(|source| source.direction == Direction::In)
        .filter_map(|source| sender(census, source, now))
        .collect()
}

fn sender(census: &Census, source: FrameSource, now: Duration) -> Option<Sender> {
    let tallies = || census.of(source).map(|(_, tally)| tally);
    let last_at = tallies().map(|tally| tally.last_at).max()?;
    if now.saturating_sub(last_at) > GONE_AFTER {
        return None;
    }
    let newest = tallies().max_by_key(|tally| tally.last_at)?;
    let (version, signed) = dress(newest)?;
    let heartbeat = census
        .of(source)
        .find(|(id, _)| *id == HEARTBEAT)
        .map(|(_, tally)| tally);
    Some(Sender {
        source,
        role: heartbeat.map_or(HeartbeatRole::Silent, role),
        known_for: now.saturating_sub(census.steady_since(source)?),
        heartbeat_hz: heartbeat.map_or(0.0, |tally| tally.rate(now).hz),
        signed,
        version1: version == MavlinkVersion::V1,
        answered_ago: census.answered_at(source).map(|at| now.saturating_sub(at)),
        asked: census.asked(source.peer),
        board: board(census, source),
    })
}

/// The id of a sender's board, from its last `AUTOPILOT_VERSION`.
fn board(census: &Census, source: FrameSource) -> Option<BoardId> {
    let mut tallies = census.of(source);
    let (_, tally) = tallies.find(|(id, _)| *id == AUTOPILOT_VERSION_DATA::ID)?;
    let mut decoder = Decoder::new();
    decoder.push(&tally.last);
    match decoder.next_frame()?.content {
        Content::Message(MavMessage::AUTOPILOT_VERSION(data)) => BoardId::of(data.uid, &data.uid2),
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

fn dress(tally: &MessageTally) -> Option<(MavlinkVersion, bool)> {
    Anatomy::of(&tally.last).map(|frame| (frame.version, frame.signed))
}

/// Whether a frame is the heartbeat of a ground station.
pub fn is_of_a_station(frame: &Frame) -> bool {
    let Content::Message(MavMessage::HEARTBEAT(beat)) = &frame.content else {
        return false;
    };
    beat.mavtype == MavType::MAV_TYPE_GCS
}

fn role(heartbeat: &MessageTally) -> HeartbeatRole {
    const GROUND_STATION: u8 = MavType::MAV_TYPE_GCS as u8;
    const NONE: u8 = MavAutopilot::MAV_AUTOPILOT_INVALID as u8;
    let byte = |at| {
        let frame = Anatomy::of(&heartbeat.last);
        frame.and_then(|frame| frame.payload.get(at).copied())
    };
    match (byte(4), byte(5)) {
        (Some(GROUND_STATION), _) => HeartbeatRole::GroundStation,
        (_, Some(NONE)) => HeartbeatRole::Other,
        _ => HeartbeatRole::Autopilot,
    }
}

/// The last seconds of one link.
#[derive(Debug, Clone)]
pub struct Chart {
    way: Way,
    seen: VecDeque<(Duration, Observation)>,
    up_since: Option<Duration>,
}

/// The changes to a link's counters within the window.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct ChartChange {
    bytes: u64,
    frames: u64,
    crc_errors: u64,
    skipped: u64,
    unknown: u64,
}

impl Chart {
    /// An empty chart for a newly opened link.
    pub fn new(way: Way) -> Self {
        Self {
            way,
            seen: VecDeque::new(),
            up_since: None,
        }
    }

    /// The kind of connection.
    pub fn way(&self) -> Way {
        self.way
    }

    /// Adds an observation; about one a second is enough.
    pub fn note(&mut self, observation: Observation, now: Duration) {
        if !observation.up {
            self.up_since = None;
            self.seen.clear();
        } else if self.up_since.is_none() {
            self.up_since = Some(now);
        }
        self.seen.push_back((now, observation));
        // One observation older than the window is kept, so that the window is complete.
        while self.seen.get(1).is_some_and(|(at, _)| *at + WINDOW <= now) {
            self.seen.pop_front();
        }
    }

    /// Whether the link was up at the last observation; `None` before the first.
    pub fn is_up(&self) -> Option<bool> {
        self.last().map(|last| last.up)
    }

    fn last(&self) -> Option<&Observation> {
        self.seen.back().map(|(_, observation)| observation)
    }

    /// How long the link had been up at the last observation.
    fn up_for(&self) -> Duration {
        let last_at = self.seen.back().map_or(Duration::ZERO, |(at, _)| *at);
        self.up_since
            .map_or(Duration::ZERO, |since| last_at.saturating_sub(since))
    }

    fn change(&self) -> ChartChange {
        let (Some((_, first)), Some((_, last))) = (self.seen.front(), self.seen.back()) else {
            return ChartChange::default();
        };
        let (from, to) = (first.counters, last.counters);
        ChartChange {
            bytes: to.bytes.saturating_sub(from.bytes),
            frames: to.frames.saturating_sub(from.frames),
            crc_errors: to.crc_errors.saturating_sub(from.crc_errors),
            skipped: to.skipped_bytes.saturating_sub(from.skipped_bytes),
            unknown: to.unknown_messages.saturating_sub(from.unknown_messages),
        }
    }

    /// The changes to a sender's sequence counts within the window.
    fn numbered(&self, sender: &Sender) -> NumberedFrames {
        let ids = sender.ids();
        let of = |seen: Option<&(Duration, Observation)>| {
            let numbered = seen.and_then(|(_, observation)| observation.numbered.get(&ids));
            numbered.copied().unwrap_or_default()
        };
        of(self.seen.back()).since(of(self.seen.front()))
    }

    /// Whether the console has had the key of a vehicle for the whole window.
    fn is_keyed(&self, system: SystemId) -> bool {
        let has = |seen: Option<&(Duration, Observation)>| {
            seen.is_some_and(|(_, observation)| observation.keyed.contains(&system))
        };
        has(self.seen.front()) && has(self.seen.back())
    }

    fn peer_name(&self, peer: u32) -> Option<String> {
        self.last().and_then(|last| last.peers.get(&peer).cloned())
    }

    fn senders(&self) -> &[Sender] {
        self.last().map_or(&[], |last| &last.senders)
    }
}
