//! The routing of frames between ports.
//!
//! The rules are those of MAVLink routing (<https://mavlink.io/en/guide/routing.html>): a message
//! without a receiver goes everywhere, one with a receiver only where that receiver was heard, and
//! none goes back to where it came from. Frames of vehicles go to stations, frames of stations to
//! vehicles and to other stations; vehicles are not connected with each other.

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::hash::{DefaultHasher, Hash, Hasher as _};
use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavMessage;
use mavlink::{MavlinkVersion, Message as _};

use crate::wire::{Anatomy, Content, Frame, MavAddress, Outgoing};

/// A frame with the same content from another port within this time is the same frame on a second path.
const SAME_WITHIN: Duration = Duration::from_secs(1);
/// The same frame, sequence number included, within this time has gone round a loop, whichever port it comes from. A
/// sender that repeats a message numbers it anew; its numbers start again after 256 frames.
const ROUND_WITHIN: Duration = Duration::from_secs(2);
/// The maximum number of frames remembered to recognise repetitions.
const MOST_REMEMBERED: usize = 16_384;
/// A sender that was silent for this long is forgotten.
const STALE: Duration = Duration::from_secs(60);
/// The maximum number of senders, and of ports per sender: their ids can be forged.
const MOST_SENDERS: usize = 1024;
const MOST_PORTS: usize = 8;

/// An endpoint that frames come from and go to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Port {
    /// A peer of a link to vehicles.
    Vehicle {
        /// The number of the link.
        link: u16,
        /// The number of the peer.
        peer: u32,
    },
    /// A peer of a forward: another ground station.
    Station {
        /// The number of the forward.
        forward: u16,
        /// The number of the peer.
        peer: u32,
    },
}

/// The properties of a frame that decide its route.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameFacts {
    pub sender: MavAddress,
    /// The message's number in MAVLink.
    pub id: u32,
    /// The receiver; `None` for everyone.
    pub receiver: Option<MavAddress>,
    /// A hash of sender, message and payload. The sequence number is left out, because a program that passes on its own
    /// messages numbers them separately on each link.
    pub content: u64,
    /// The sender's sequence number.
    pub sequence: u8,
    /// Whether the sender can be trusted: the checksum was verified.
    pub is_verified: bool,
}

impl FrameFacts {
    /// The facts about a frame and its bytes; `None` if the bytes are not a frame.
    pub fn of(frame: &Frame, bytes: &[u8]) -> Option<Self> {
        let anatomy = Anatomy::of(bytes)?;
        let receiver = match &frame.content {
            Content::Message(message) => addressed_by(message),
            Content::Undecoded { id, payload } => receiver_in(*id, &payload[..]),
            Content::Unknown { .. } => None,
        };
        Some(Self {
            sender: MavAddress {
                system: frame.system,
                component: frame.component,
            },
            id: anatomy.id,
            receiver: receiver.filter(|receiver| receiver.system != 0),
            content: content_of(&anatomy),
            sequence: anatomy.sequence,
            is_verified: frame.is_verified(),
        })
    }
}

/// The receiver of a message that the console sends; `None` for everyone.
pub fn receiver_of(outgoing: &Outgoing) -> Option<MavAddress> {
    let receiver = match outgoing {
        Outgoing::Message(message) => addressed_by(message),
        Outgoing::Raw { id, payload } => receiver_in(*id, payload),
    };
    receiver.filter(|receiver| receiver.system != 0)
}

fn addressed_by(message: &MavMessage) -> Option<MavAddress> {
    Some(MavAddress {
        system: message.target_system_id()?,
        component: message.target_component_id().unwrap_or(0),
    })
}

fn content_of(anatomy: &Anatomy<'_>) -> u64 {
    let mut hasher = DefaultHasher::new();
    let sender = (anatomy.system, anatomy.component, anatomy.id);
    (sender, anatomy.payload).hash(&mut hasher);
    hasher.finish()
}

/// The receiver in a payload that could not be decoded. The dialect does not give the positions of
/// fields, so each is found by writing a marker into the field of an empty message.
fn receiver_in(id: u32, payload: &[u8]) -> Option<MavAddress> {
    const MARK: u8 = 0xA5;
    let place = |mark: fn(&mut MavMessage) -> Option<&mut u8>| {
        let mut message = MavMessage::default_message_from_id(id)?;
        let (mut before, mut after) = ([0; 255], [0; 255]);
        message.ser(MavlinkVersion::V2, &mut before);
        *mark(&mut message)? = MARK;
        message.ser(MavlinkVersion::V2, &mut after);
        (0..after.len()).find(|&at| after[at] == MARK && before[at] != MARK)
    };
    let value = |mark| payload.get(place(mark)?).copied();
    Some(MavAddress {
        system: value(mavlink::Message::target_system_id_mut)?,
        component: value(mavlink::Message::target_component_id_mut).unwrap_or(0),
    })
}

/// The ports of one kind that a frame goes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reach {
    Nobody,
    /// All ports except the one that it came from.
    Everyone,
    These(Vec<Port>),
}

/// The route of a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Route {
    /// It has already been passed on, having arrived on another port or gone round a loop.
    Repeated,
    /// The console's own frame has come back: it has gone round a loop.
    Returned,
    /// Its receiver was never heard.
    Unknown,
    To {
        vehicles: Reach,
        stations: Reach,
    },
}

impl Route {
    /// The route of a message that the stations already have.
    fn without_stations(self) -> Self {
        match self {
            Self::To { vehicles, .. } => Self::To {
                vehicles,
                stations: Reach::Nobody,
            },
            Self::Repeated | Self::Returned | Self::Unknown => self,
        }
    }
}

/// The first source of a content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FrameOrigin {
    /// A message of the console itself.
    Console,
    Port(Port),
}

/// Records where senders are heard, and finds the route of each frame.
#[derive(Debug)]
pub struct Router {
    own: MavAddress,
    ports: BTreeMap<MavAddress, BTreeMap<Port, Duration>>,
    /// Where each content came from.
    contents: Recent<u64, FrameOrigin>,
    /// Each frame by its content and its sequence number.
    frames: Recent<(u64, u8), ()>,
}

impl Router {
    /// A router that has seen no frames yet; `own` is the console's own address.
    pub fn new(own: MavAddress) -> Self {
        Self {
            own,
            ports: BTreeMap::new(),
            contents: Recent::within(SAME_WITHIN),
            frames: Recent::within(ROUND_WITHIN),
        }
    }

    /// Records a message that the console itself sends to a station, so its echo is not passed on.
    pub fn note_own(&mut self, bytes: &[u8], now: Duration) {
        if let Some(anatomy) = Anatomy::of(bytes) {
            let content = content_of(&anatomy);
            self.contents.note(content, FrameOrigin::Console, now);
            self.frames.note((content, anatomy.sequence), (), now);
        }
    }

    /// The route of a frame from a port.
    pub fn route(&mut self, from: Port, facts: &FrameFacts, now: Duration) -> Route {
        let origin = self.contents.get(&facts.content, now);
        let has_gone_round = self.frames.get(&(facts.content, facts.sequence), now);
        let is_second = origin.is_some_and(|origin| origin != FrameOrigin::Port(from));
        if let Some(receiver) = facts.receiver
            && self.has_not_reached_its_vehicle(from, facts, origin)
        {
            self.note(from, facts, now);
            return self.to(from, receiver, now).without_stations();
        }
        if has_gone_round.is_some() || is_second {
            // Another ground station may use the console's own address: answers must reach it.
            if origin == Some(FrameOrigin::Console) {
                self.learn(from, facts, now);
            }
            // Another station with this address numbers its frames by itself.
            let is_own = has_gone_round.is_some() && facts.sender == self.own;
            return if is_own {
                Route::Returned
            } else {
                Route::Repeated
            };
        }
        self.note(from, facts, now);
        let Some(receiver) = facts.receiver else {
            return Route::To {
                vehicles: match from {
                    Port::Vehicle { .. } => Reach::Nobody,
                    Port::Station { .. } => Reach::Everyone,
                },
                stations: Reach::Everyone,
            };
        };
        self.to(from, receiver, now)
    }

    /// Whether a station's message to a receiver came first over a link to vehicles, from where it goes to no vehicle: if
    /// consoles forward to each other, a command takes both ways, and either may be the faster one.
    fn has_not_reached_its_vehicle(
        &self,
        from: Port,
        facts: &FrameFacts,
        origin: Option<FrameOrigin>,
    ) -> bool {
        let is_of_station = matches!(from, Port::Station { .. }) && facts.sender != self.own;
        let came_over_link = matches!(origin, Some(FrameOrigin::Port(Port::Vehicle { .. })));
        is_of_station && came_over_link
    }

    fn note(&mut self, from: Port, facts: &FrameFacts, now: Duration) {
        self.contents
            .note(facts.content, FrameOrigin::Port(from), now);
        self.frames.note((facts.content, facts.sequence), (), now);
        self.learn(from, facts, now);
    }

    fn to(&self, from: Port, receiver: MavAddress, now: Duration) -> Route {
        let ports = self.ports_of(receiver, now);
        if ports.is_empty() && receiver.system != self.own.system {
            return Route::Unknown;
        }
        let others = ports.into_iter().filter(|&port| port != from);
        let (vehicles, stations): (Vec<Port>, Vec<Port>) =
            others.partition(|port| matches!(port, Port::Vehicle { .. }));
        let reach = |ports: Vec<Port>| {
            if ports.is_empty() {
                Reach::Nobody
            } else {
                Reach::These(ports)
            }
        };
        Route::To {
            vehicles: match from {
                Port::Vehicle { .. } => Reach::Nobody,
                Port::Station { .. } => reach(vehicles),
            },
            stations: reach(stations),
        }
    }

    /// The ports of a component, or of its whole system if that component was not heard.
    fn ports_of(&self, receiver: MavAddress, now: Duration) -> Vec<Port> {
        let is_fresh = |at: Duration| now.saturating_sub(at) < STALE;
        let fresh = |ports: &BTreeMap<Port, Duration>| {
            let ports = ports.iter().filter(|&(_, &at)| is_fresh(at));
            ports.map(|(&port, _)| port).collect::<Vec<_>>()
        };
        let exact = self.ports.get(&receiver).map(fresh).unwrap_or_default();
        if !exact.is_empty() || receiver == self.own {
            return exact;
        }
        let system = self.ports.iter();
        let mut ports: Vec<Port> = system
            .filter(|(sender, _)| sender.system == receiver.system)
            .flat_map(|(_, ports)| fresh(ports))
            .collect();
        ports.sort_unstable();
        ports.dedup();
        ports
    }

    fn learn(&mut self, from: Port, facts: &FrameFacts, now: Duration) {
        if !facts.is_verified || facts.sender.system == 0 {
            return;
        }
        if self.ports.len() >= MOST_SENDERS && !self.ports.contains_key(&facts.sender) {
            let fresh = |ports: &BTreeMap<Port, Duration>| {
                ports.values().any(|&at| now.saturating_sub(at) < STALE)
            };
            self.ports.retain(|_, ports| fresh(ports));
            if self.ports.len() >= MOST_SENDERS {
                return;
            }
        }
        let ports = self.ports.entry(facts.sender).or_default();
        ports.insert(from, now);
        if ports.len() > MOST_PORTS {
            let oldest = ports.iter().min_by_key(|&(_, &at)| at).map(|(&it, _)| it);
            oldest.map(|oldest| ports.remove(&oldest));
        }
    }
}

/// What was passed on lately.
#[derive(Debug)]
struct Recent<K, V> {
    within: Duration,
    last: HashMap<K, (V, Duration)>,
    /// The keys in the order in which they were noted.
    order: VecDeque<(K, Duration)>,
}

impl<K: Copy + Eq + Hash, V: Copy> Recent<K, V> {
    fn within(within: Duration) -> Self {
        Self {
            within,
            last: HashMap::new(),
            order: VecDeque::new(),
        }
    }

    fn get(&self, key: &K, now: Duration) -> Option<V> {
        let (value, at) = *self.last.get(key)?;
        (now.saturating_sub(at) < self.within).then_some(value)
    }

    fn note(&mut self, key: K, value: V, now: Duration) {
        while let Some(&(oldest, at)) = self.order.front()
            && (now.saturating_sub(at) >= self.within || self.order.len() >= MOST_REMEMBERED)
        {
            self.order.pop_front();
            // The same key may have been noted again since.
            let last = self.last.get(&oldest);
            if last.is_some_and(|&(_, last)| last <= at) {
                self.last.remove(&oldest);
            }
        }
        self.last.insert(key, (value, now));
        self.order.push_back((key, now));
    }
}
