//! The census: the rate of each message by sender, and the last one of each kind.

mod statistics;
mod tally;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{COMMAND_ACK_DATA, HEARTBEAT_DATA, TIMESYNC_DATA};

pub use self::statistics::MessageStatistics;
pub use self::tally::{MessageTally, Rate};
use crate::wire::{Anatomy, ComponentId, SenderLoss, SystemId};

/// The maximum number of kinds of messages that one link keeps; further ones are only counted. 250 vehicles send about
/// 10 000.
const MOST_KINDS: usize = 20_000;
/// The maximum number of kinds with a checksum that cannot be verified, since noise may look like any of them.
const MOST_UNVERIFIED: usize = 256;
/// The number of messages of one kind from one sender that count as more than noise: noise seldom
/// repeats itself this often.
const KEEPS_COMING: u64 = 3;
/// Entries silent for this long may be replaced if there is no room.
const STALE: Duration = Duration::from_secs(60);
/// The minimum interval between two searches for room.
const SWEEP_EVERY: Duration = Duration::from_secs(1);
/// The maximum number of frames of one kind that are kept for a graph between two reads.
const MOST_WATCHED: usize = 512;
/// A source that has been silent for this long has paused, or was stopped.
const PAUSE: Duration = Duration::from_secs(5);

/// Whether frames were received or sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    In,
    /// Sent by this program.
    Out,
}

/// One sender at one end of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FrameSource {
    /// Whether the frame was received from the sender, or sent by this program.
    pub direction: Direction,
    /// The link's peer that sent or received the frames.
    pub peer: u32,
    /// The sender's system id.
    pub system: SystemId,
    /// The sender's component id.
    pub component: ComponentId,
}

/// One kind of message from one source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TallyKey {
    pub source: FrameSource,
    pub message: u32,
}

/// The frames of one watched kind since the last read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WatchedMessage {
    pub key: TallyKey,
    /// The time and the bytes of each frame, oldest first.
    pub frames: VecDeque<(Duration, Vec<u8>)>,
    /// The number of frames that were not kept.
    pub dropped: u64,
}

/// The direction of a frame, and the peer of its link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameWay {
    pub direction: Direction,
    /// The number of the peer.
    pub peer: u32,
}

impl FrameWay {
    /// Received from a peer.
    pub const fn received(peer: u32) -> Self {
        let direction = Direction::In;
        Self { direction, peer }
    }

    /// Sent to a peer.
    pub const fn sent(peer: u32) -> Self {
        let direction = Direction::Out;
        Self { direction, peer }
    }
}

/// Counts the messages of one link.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Census {
    tallies: BTreeMap<TallyKey, MessageTally>,
    sources: BTreeMap<FrameSource, SourceFacts>,
    peers: BTreeMap<u32, String>,
    unverified: usize,
    uncounted: u64,
    next_sweep: Duration,
    watched: BTreeMap<TallyKey, WatchedMessage>,
    noise: Vec<u8>,
    /// The number of resets of the statistics so far, as counted by the caller.
    resets: u32,
}

/// Facts about a source that depend on every one of its frames.
#[derive(Debug, Clone, PartialEq, Eq)]
struct SourceFacts {
    answered_at: Option<Duration>,
    heard_at: Duration,
    /// The time since which frames have been received without a pause.
    steady_since: Duration,
    /// The losses since the last reset, by the sequence numbers.
    loss: SenderLoss,
}

impl Census {
    /// Counts one frame. `is_verified` states whether the dialect has verified its checksum.
    pub fn note(&mut self, way: FrameWay, bytes: &[u8], is_verified: bool, now: Duration) {
        let Some(frame) = Anatomy::of(bytes) else {
            return;
        };
        let source = FrameSource {
            direction: way.direction,
            peer: way.peer,
            system: frame.system,
            component: frame.component,
        };
        let key = TallyKey {
            source,
            message: frame.id,
        };
        if !self.tallies.contains_key(&key) && !self.admit(is_verified, now) {
            self.uncounted += 1;
            return;
        }
        let tallies = &mut self.tallies;
        let tally = tallies
            .entry(key)
            .or_insert_with(|| MessageTally::new(is_verified, now));
        tally.note(bytes, is_verified, now);
        if is_verified {
            let witness = self.sources.entry(source).or_insert(SourceFacts {
                answered_at: None,
                heard_at: now,
                steady_since: now,
                loss: SenderLoss::default(),
            });
            if now.saturating_sub(witness.heard_at) > PAUSE {
                witness.steady_since = now;
            }
            witness.heard_at = now;
            witness.loss.note(frame.sequence);
            if way.direction == Direction::In && answers(&frame) {
                witness.answered_at = Some(now);
            }
        }
        if let Some(watched) = self.watched.get_mut(&key) {
            watched.frames.push_back((now, bytes.to_vec()));
            if watched.frames.len() > MOST_WATCHED {
                watched.frames.pop_front();
                watched.dropped += 1;
            }
        }
    }

    /// Whether there is room for one more kind.
    fn admit(&mut self, is_verified: bool, now: Duration) -> bool {
        if !self.has_room(is_verified) && now >= self.next_sweep {
            self.next_sweep = now + SWEEP_EVERY;
            self.sweep(now);
        }
        let has_room = self.has_room(is_verified);
        self.unverified += usize::from(has_room && !is_verified);
        has_room
    }

    fn has_room(&self, is_verified: bool) -> bool {
        self.tallies.len() < MOST_KINDS && (is_verified || self.unverified < MOST_UNVERIFIED)
    }

    /// Drops entries that have been silent for long, since peers reconnect under new numbers.
    fn sweep(&mut self, now: Duration) {
        self.tallies
            .retain(|_, tally| now.saturating_sub(tally.last_at) < STALE);
        let sources: BTreeSet<FrameSource> = self.tallies.keys().map(|key| key.source).collect();
        let peers: BTreeSet<u32> = sources.iter().map(|source| source.peer).collect();
        self.sources.retain(|source, _| sources.contains(source));
        self.peers.retain(|peer, _| peers.contains(peer));
        let tallies = self.tallies.values();
        self.unverified = tallies.filter(|tally| !tally.was_admitted_verified).count();
    }

    /// Keeps the beginning of bytes that contain no frame.
    pub fn note_noise(&mut self, bytes: &[u8]) {
        const KEPT: usize = 256;
        self.noise.clear();
        self.noise
            .extend_from_slice(&bytes[..bytes.len().min(KEPT)]);
    }

    /// Sets a peer's name: its network address.
    pub fn name_peer(&mut self, peer: u32, name: String) {
        self.peers.insert(peer, name);
    }

    /// A peer's name, if it has one.
    pub fn peer_name(&self, peer: u32) -> Option<&str> {
        self.peers.get(&peer).map(String::as_str)
    }

    /// The names of all peers that have one.
    pub fn peer_names(&self) -> &BTreeMap<u32, String> {
        &self.peers
    }

    /// Every kind of message, ordered by source and id.
    pub fn tallies(&self) -> impl Iterator<Item = (TallyKey, &MessageTally)> {
        self.tallies.iter().map(|(&key, tally)| (key, tally))
    }

    /// One kind of message; `None` if it was never counted.
    pub fn tally(&self, key: TallyKey) -> Option<&MessageTally> {
        self.tallies.get(&key)
    }

    /// Whether a kind is more than noise: its checksum was right, its sender has other messages, or it has
    /// arrived several times.
    pub fn is_credible(&self, key: TallyKey, tally: &MessageTally) -> bool {
        tally.is_verified || tally.count >= KEEPS_COMING || self.sources.contains_key(&key.source)
    }

    /// All sources with verified frames, received and sent.
    pub fn sources(&self) -> impl Iterator<Item = FrameSource> {
        self.sources.keys().copied()
    }

    /// When a source last sent an answer to the console's frames; `None` if it never did.
    pub fn answered_at(&self, source: FrameSource) -> Option<Duration> {
        self.sources.get(&source)?.answered_at
    }

    /// The time since which a source has been received without a pause; `None` if it is unknown.
    pub fn steady_since(&self, source: FrameSource) -> Option<Duration> {
        Some(self.sources.get(&source)?.steady_since)
    }

    /// The losses of a source since the last reset; `None` if it is unknown.
    pub fn loss_of(&self, source: FrameSource) -> Option<&SenderLoss> {
        Some(&self.sources.get(&source)?.loss)
    }

    /// Begins new statistics if `resets`, the number of resets requested so far, has changed.
    pub fn reset_statistics(&mut self, resets: u32, now: Duration) {
        if std::mem::replace(&mut self.resets, resets) == resets {
            return;
        }
        for tally in self.tallies.values_mut() {
            tally.statistics = MessageStatistics::new(now);
        }
        for source in self.sources.values_mut() {
            source.loss.reset();
        }
    }

    /// The number of resets of the statistics so far.
    pub fn resets(&self) -> u32 {
        self.resets
    }

    /// The number of frames of kinds for which there was no room.
    pub fn uncounted(&self) -> u64 {
        self.uncounted
    }

    /// The last bytes that contain no frame.
    pub fn noise(&self) -> &[u8] {
        &self.noise
    }

    /// Keeps every frame of these kinds from now on, and of no other kinds.
    pub fn watch(&mut self, keys: &BTreeSet<TallyKey>) {
        self.watched.retain(|key, _| keys.contains(key));
        for &key in keys {
            self.watched.entry(key).or_insert_with(|| WatchedMessage {
                key,
                frames: VecDeque::new(),
                dropped: 0,
            });
        }
    }

    /// The frames of watched kinds since the last call.
    pub fn take_watched(&mut self) -> Vec<WatchedMessage> {
        let take = |watched: &mut WatchedMessage| WatchedMessage {
            key: watched.key,
            frames: std::mem::take(&mut watched.frames),
            dropped: std::mem::take(&mut watched.dropped),
        };
        let taken = self.watched.values_mut().map(take);
        taken.filter(|taken| !taken.frames.is_empty()).collect()
    }

    /// A copy without the watched frames.
    #[must_use]
    pub fn snapshot(&self) -> Self {
        Self {
            tallies: self.tallies.clone(),
            sources: self.sources.clone(),
            peers: self.peers.clone(),
            unverified: self.unverified,
            uncounted: self.uncounted,
            next_sweep: self.next_sweep,
            watched: BTreeMap::new(),
            noise: self.noise.clone(),
            resets: self.resets,
        }
    }
}

/// Whether a message is an answer to a request: `COMMAND_ACK`, or a TIMESYNC that is not a request itself.
/// Parameters and similar messages are broadcast at any program's request.
fn answers(frame: &Anatomy<'_>) -> bool {
    const COMMAND_ACK: u32 = COMMAND_ACK_DATA::ID;
    /// TIMESYNC; its first field, eight bytes of `tc1`, is zero in a request.
    const TIMESYNC: u32 = TIMESYNC_DATA::ID;
    match frame.id {
        COMMAND_ACK => true,
        TIMESYNC => frame.payload.iter().take(8).any(|&byte| byte != 0),
        _ => false,
    }
}

impl Census {
    /// How many messages other than heartbeats were sent to a peer.
    pub fn asked(&self, peer: u32) -> u64 {
        let ours = self.tallies.iter().filter(|(key, _)| {
            key.source.direction == Direction::Out
                && key.source.peer == peer
                && key.message != HEARTBEAT_DATA::ID
        });
        ours.map(|(_, tally)| tally.count).sum()
    }

    /// The tallies of one source.
    pub fn of(&self, source: FrameSource) -> impl Iterator<Item = (u32, &MessageTally)> {
        let first = TallyKey { source, message: 0 };
        let last = TallyKey {
            source,
            message: u32::MAX,
        };
        let found = self.tallies.range(first..=last);
        found.map(|(key, tally)| (key.message, tally))
    }
}

#[cfg(test)]
mod tests;
