//! Passes frames between the links to vehicles and the forwards to other ground stations.
//!
//! The links' tasks call the relay with every frame; the relay only queues copies and never waits.
//!
//! Each link and each forward has one queue. While it is full, newer frames are dropped and
//! counted, and so are all frames while the link is down. All clients of a forward share its queue:
//! a frame dropped there reaches none of them. A `tcpin` forward never waits for a client; a
//! client that does not read loses frames of its own, beyond `OUTPUT_CAP` bytes (`server`). A `tcp`
//! station that does not read lets the queue of its forward fill.

use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::time::Instant;

use super::{LinkId, LinkPeer, Outlet, Parcel, To};
use crate::forward::{Deed, ForwardSpec, FrameFacts, Port, Reach, Route, Router, deed_of};
use crate::ledger::StationId;
use crate::wire::{Frame, MavAddress, Outgoing, SystemId, is_secret};

/// The maximum number of streams whose rate one forward limits; others pass without a limit.
const MOST_STREAMS: usize = 4096;

/// The number of own frames that must come back over a link to show a loop: a single one may come back when a station
/// is restarted.
const RETURNS_ENOUGH: u64 = 2;

/// A command of another ground station to vehicles, over a forward.
#[derive(Debug, Clone, PartialEq)]
pub struct StationNews {
    pub station: StationId,
    /// The vehicle; `None` for all.
    pub system: Option<SystemId>,
    pub deed: Deed,
}

/// The counters of one forward for frames that were not simply passed on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ForwardCounts {
    /// Frames to the stations that its filters left out.
    pub filtered: u64,
    /// Frames of the stations that did not reach the vehicles because the forward is read-only.
    pub held_back: u64,
    /// Frames of the stations whose receiver was never heard.
    pub unknown: u64,
    /// Frames of the stations that arrived a second time, by another path.
    pub repeated: u64,
    /// The console's own frames among those: they have gone round a loop.
    pub returned: u64,
}

/// Shares links with other ground stations. All clones are one relay.
#[derive(Debug, Clone)]
pub struct Relay(Arc<RelayShared>);

#[derive(Debug)]
struct RelayShared {
    opened: Instant,
    /// Whether there is any forward; without one, frames are not examined.
    is_used: AtomicBool,
    core: Mutex<RelayCore>,
}

#[derive(Debug)]
struct RelayCore {
    own: MavAddress,
    router: Router,
    links: BTreeMap<LinkId, Outlet>,
    forwards: BTreeMap<LinkId, RelayedForward>,
    news: mpsc::Sender<StationNews>,
    /// How many of the console's own frames have come back over each peer of a link.
    returned: BTreeMap<(LinkId, LinkPeer), u64>,
}

#[derive(Debug)]
struct RelayedForward {
    spec: ForwardSpec,
    outlet: Outlet,
    counts: ForwardCounts,
    /// When each stream was passed on last, by sender and message.
    streams: HashMap<(MavAddress, u32), Duration>,
}

/// The end of a relay that one link holds.
#[derive(Debug, Clone)]
pub(super) struct RelayPort {
    relay: Relay,
    id: LinkId,
    is_forward: bool,
}

impl Relay {
    /// A relay for a console with this address. Commands of other stations are reported through
    /// `news`; while that channel is full, commands are passed on without a report.
    pub fn new(own: MavAddress, news: mpsc::Sender<StationNews>) -> Self {
        Self(Arc::new(RelayShared {
            opened: Instant::now(),
            is_used: AtomicBool::new(false),
            core: Mutex::new(RelayCore {
                own,
                router: Router::new(own),
                links: BTreeMap::new(),
                forwards: BTreeMap::new(),
                news,
                returned: BTreeMap::new(),
            }),
        }))
    }

    /// The console's own address.
    pub(super) fn address(&self) -> MavAddress {
        self.core().own
    }

    /// Whether a peer of a link sends back what the console sends to its forwards: another console forwards the link to
    /// which this one forwards.
    pub fn is_loop(&self, link: LinkId, peer: LinkPeer) -> bool {
        let returned = self.core().returned.get(&(link, peer)).copied();
        returned.is_some_and(|returned| returned >= RETURNS_ENOUGH)
    }

    /// Ends the passing of frames to and from a forward.
    pub fn remove_forward(&self, id: LinkId) {
        let mut core = self.core();
        core.forwards.remove(&id);
        self.0
            .is_used
            .store(!core.forwards.is_empty(), Ordering::Relaxed);
    }

    /// The counts of a forward; zeros if it is unknown.
    pub fn counts(&self, id: LinkId) -> ForwardCounts {
        let core = self.core();
        core.forwards
            .get(&id)
            .map(|forward| forward.counts)
            .unwrap_or_default()
    }

    pub(super) fn port_of_link(&self, id: LinkId) -> RelayPort {
        self.port(id, false)
    }

    pub(super) fn port_of_forward(&self, id: LinkId) -> RelayPort {
        self.port(id, true)
    }

    fn port(&self, id: LinkId, is_forward: bool) -> RelayPort {
        RelayPort {
            relay: self.clone(),
            id,
            is_forward,
        }
    }

    pub(super) fn add_link(&self, id: LinkId, outlet: Outlet) {
        self.core().links.insert(id, outlet);
    }

    pub(super) fn add_forward(&self, id: LinkId, spec: ForwardSpec, outlet: Outlet) {
        let forward = RelayedForward {
            spec,
            outlet,
            counts: ForwardCounts::default(),
            streams: HashMap::new(),
        };
        self.core().forwards.insert(id, forward);
        self.0.is_used.store(true, Ordering::Relaxed);
    }

    /// Whether there is any forward.
    pub fn is_used(&self) -> bool {
        self.0.is_used.load(Ordering::Relaxed)
    }

    fn core(&self) -> MutexGuard<'_, RelayCore> {
        // A panic while passing a frame on loses only that frame.
        self.0.core.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl RelayPort {
    pub fn is_forward(&self) -> bool {
        self.is_forward
    }

    /// Passes on a received frame.
    pub fn pass(&self, peer: LinkPeer, bytes: &[u8], frame: &Frame) {
        if !self.relay.is_used() {
            return;
        }
        let Some(facts) = FrameFacts::of(frame, bytes) else {
            return;
        };
        let passing = Passing {
            facts,
            bytes: bytes.into(),
            now: self.relay.0.opened.elapsed(),
        };
        let mut core = self.relay.core();
        if self.is_forward {
            core.pass_from_station(self.id, peer, frame, &passing);
        } else {
            core.pass_from_vehicle(self.id, peer, &passing);
        }
    }

    /// Sends the stations a copy of a message that the console sends to a vehicle, unless it
    /// contains a secret.
    pub fn share(&self, outgoing: &Outgoing) {
        let id = outgoing.id();
        if self.is_forward || !self.relay.is_used() || is_secret(id) {
            return;
        }
        for forward in self.relay.core().forwards.values_mut() {
            if forward.spec.passes(id) {
                let parcel = Parcel::from(outgoing.clone());
                forward.outlet.queue(To::Everyone, parcel);
            } else {
                forward.counts.filtered += 1;
            }
        }
    }

    /// Records a frame that the console sends to stations, so its echo is recognised.
    pub fn note_own(&self, bytes: &[u8]) {
        if self.is_forward {
            let now = self.relay.0.opened.elapsed();
            self.relay.core().router.note_own(bytes, now);
        }
    }
}

/// A received frame on its way to other ports.
struct Passing {
    facts: FrameFacts,
    bytes: Arc<[u8]>,
    /// When the frame arrived, since the relay was opened.
    now: Duration,
}

impl RelayCore {
    fn pass_from_vehicle(&mut self, link: LinkId, peer: LinkPeer, passing: &Passing) {
        let from = Port::Vehicle {
            link: link.0,
            peer: peer.0,
        };
        match self.router.route(from, &passing.facts, passing.now) {
            Route::To { stations, .. } => self.pass_to_stations(None, &stations, passing),
            Route::Returned => *self.returned.entry((link, peer)).or_default() += 1,
            Route::Repeated | Route::Unknown => {}
        }
    }

    fn pass_from_station(&mut self, id: LinkId, peer: LinkPeer, frame: &Frame, passing: &Passing) {
        let from = Port::Station {
            forward: id.0,
            peer: peer.0,
        };
        let route = self.router.route(from, &passing.facts, passing.now);
        let Some(forward) = self.forwards.get_mut(&id) else {
            return;
        };
        match route {
            Route::Repeated => forward.counts.repeated += 1,
            Route::Returned => {
                forward.counts.repeated += 1;
                forward.counts.returned += 1;
            }
            _ if forward.spec.read_only => forward.counts.held_back += 1,
            Route::Unknown => forward.counts.unknown += 1,
            Route::To { vehicles, stations } => {
                self.pass_to_vehicles(&vehicles, &passing.bytes);
                self.pass_to_stations(Some((id, peer)), &stations, passing);
                if vehicles != Reach::Nobody {
                    self.report(&passing.facts, frame);
                }
            }
        }
    }

    /// Reports a station's command, unless it comes from the console's own address: answers to such
    /// a command cannot be distinguished from answers to the console.
    fn report(&self, facts: &FrameFacts, frame: &Frame) {
        if facts.sender == self.own {
            return;
        }
        if let Some(deed) = deed_of(&frame.content) {
            // If the queue is full, the report is dropped: there are many others.
            drop(self.news.try_send(StationNews {
                station: StationId(facts.sender),
                system: facts.receiver.map(|receiver| receiver.system),
                deed,
            }));
        }
    }

    fn pass_to_vehicles(&self, reach: &Reach, bytes: &Arc<[u8]>) {
        match reach {
            Reach::Nobody => {}
            Reach::Everyone => {
                for outlet in self.links.values() {
                    outlet.queue(To::Everyone, Parcel::Frame(Arc::clone(bytes)));
                }
            }
            Reach::These(ports) => {
                for port in ports {
                    if let Port::Vehicle { link, peer } = *port
                        && let Some(outlet) = self.links.get(&LinkId(link))
                    {
                        let frame = Parcel::Frame(Arc::clone(bytes));
                        outlet.queue(To::Peer(LinkPeer(peer)), frame);
                    }
                }
            }
        }
    }

    fn pass_to_stations(
        &mut self,
        from: Option<(LinkId, LinkPeer)>,
        reach: &Reach,
        passing: &Passing,
    ) {
        match reach {
            Reach::Nobody => {}
            Reach::Everyone => {
                for (&id, forward) in &mut self.forwards {
                    let to = match from {
                        Some((origin, peer)) if origin == id => To::EveryoneBut(peer),
                        Some(_) | None => To::Everyone,
                    };
                    forward.pass(to, passing);
                }
            }
            Reach::These(ports) => {
                for port in ports {
                    if let Port::Station { forward, peer } = *port
                        && let Some(forward) = self.forwards.get_mut(&LinkId(forward))
                    {
                        let frame = Parcel::Frame(Arc::clone(&passing.bytes));
                        forward.outlet.queue(To::Peer(LinkPeer(peer)), frame);
                    }
                }
            }
        }
    }
}

impl RelayedForward {
    /// Passes on a message for everyone, unless the filters or the rate limit leave it out.
    fn pass(&mut self, to: To, passing: &Passing) {
        if self.spec.passes(passing.facts.id) && self.is_due(&passing.facts, passing.now) {
            self.outlet
                .queue(to, Parcel::Frame(Arc::clone(&passing.bytes)));
        } else {
            self.counts.filtered += 1;
        }
    }

    fn is_due(&mut self, facts: &FrameFacts, now: Duration) -> bool {
        let Some(rate_hz) = self.spec.rate_hz else {
            return true;
        };
        let stream = (facts.sender, facts.id);
        let last = self.streams.get(&stream).copied();
        let is_counted = last.is_some() || self.streams.len() < MOST_STREAMS;
        if !self.spec.is_paced(facts.id) || !is_counted {
            return true;
        }
        // A tenth less, so that a stream at exactly this rate passes completely despite its jitter.
        let pause = Duration::from_secs_f64(0.9 / rate_hz);
        let is_due = last.is_none_or(|last| now.saturating_sub(last) >= pause);
        if is_due {
            self.streams.insert(stream, now);
        }
        is_due
    }
}
