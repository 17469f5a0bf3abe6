//! Access to a link's frames: a [`Census`] that the link fills and any part of the program may
//! read.

use std::borrow::Cow;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::time::Instant;

use super::relay::RelayPort;
use super::{FrameSink, LinkPeer, LinkState, LinkStatus, SignedLink};
use crate::doctor::{self, Observation};
use crate::inspector::{Census, FrameWay};
use crate::wire::{Anatomy, Frame, Outgoing, is_secret, without_payload};

/// The frames of one link. Every frame is counted and the last of each kind kept, which costs a look-up and a short
/// copy; nothing is queued, so readers cannot slow the link down.
#[derive(Debug, Clone)]
pub struct Tap {
    opened: Instant,
    census: Arc<Mutex<Census>>,
    /// The sink for every frame, if the link is recorded.
    sink: Option<FrameSink>,
    relay: Option<RelayPort>,
    signing: Option<SignedLink>,
}

impl Tap {
    pub(super) fn new(sink: Option<FrameSink>) -> Self {
        Self {
            opened: Instant::now(),
            census: Arc::default(),
            sink,
            relay: None,
            signing: None,
        }
    }

    pub(super) fn relayed(sink: Option<FrameSink>, port: RelayPort) -> Self {
        Self {
            relay: Some(port),
            ..Self::new(sink)
        }
    }

    /// The tap of a link whose frames are signed and checked.
    pub(super) fn signed_by(self, signing: Option<SignedLink>) -> Self {
        Self { signing, ..self }
    }

    /// The signing on the link, if there is any.
    pub(super) fn signing(&self) -> Option<&SignedLink> {
        self.signing.as_ref()
    }

    /// Whether the link leads to other ground stations.
    pub(super) fn is_forward(&self) -> bool {
        self.relay.as_ref().is_some_and(RelayPort::is_forward)
    }

    /// Sends the stations that share the link a copy of a message that the console sends on it.
    pub(super) fn share(&self, outgoing: &Outgoing) {
        if let Some(port) = &self.relay {
            port.share(outgoing);
        }
    }

    /// Records a frame that the console itself sends.
    pub(super) fn sent_own(&self, bytes: &[u8]) {
        if let Some(port) = &self.relay {
            port.note_own(bytes);
        }
    }

    /// Calls `look` with the census and the current time, which counts from the link's opening, as
    /// do all times in the census. `look` must be quick, because the link waits in the meantime.
    pub fn look<T>(&self, look: impl FnOnce(&mut Census, Duration) -> T) -> T {
        let now = self.opened.elapsed();
        look(&mut self.census(), now)
    }

    /// The link doctor's view of the link.
    pub fn observe(&self, status: &LinkStatus) -> Observation {
        let (senders, noise, peers) = self.look(|census, now| {
            let senders = doctor::observe(census, now);
            (
                senders,
                census.noise().to_vec(),
                census.peer_names().clone(),
            )
        });
        let signing = self.signing.as_ref();
        Observation {
            up: status.state == LinkState::Up,
            keyed: signing.map(SignedLink::keyed).unwrap_or_default(),
            is_signing_required: signing.is_some_and(SignedLink::is_required),
            counters: status.decoder,
            numbered: status.numbered.clone(),
            senders,
            noise,
            peers,
        }
    }

    pub(super) fn received(&self, peer: LinkPeer, bytes: &[u8], frame: &Frame) {
        self.take_down(bytes);
        let now = self.opened.elapsed();
        let way = FrameWay::received(peer.0);
        let shown = without_secrets(bytes);
        self.census().note(way, &shown, frame.is_verified(), now);
        if let Some(port) = &self.relay {
            port.pass(peer, bytes, frame);
        }
    }

    pub(super) fn sent(&self, peer: LinkPeer, bytes: &[u8]) {
        self.take_down(bytes);
        let now = self.opened.elapsed();
        let way = FrameWay::sent(peer.0);
        self.census().note(way, &without_secrets(bytes), true, now);
    }

    fn take_down(&self, frame: &[u8]) {
        if let Some(sink) = &self.sink {
            sink.note(frame);
        }
    }

    /// Notes bytes in which no frame was found.
    pub(super) fn noise(&self, bytes: &[u8]) {
        self.census().note_noise(bytes);
    }

    pub(super) fn name_peer(&self, peer: LinkPeer, address: SocketAddr) {
        self.census().name_peer(peer.0, address.to_string());
    }

    fn census(&self) -> MutexGuard<'_, Census> {
        // A panic while counting leaves counters off by one, not a broken census.
        self.census.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The bytes of a frame for display: the payload of a message with a secret is zeros.
fn without_secrets(bytes: &[u8]) -> Cow<'_, [u8]> {
    if Anatomy::of(bytes).is_some_and(|frame| is_secret(frame.id)) {
        without_payload(bytes).into()
    } else {
        bytes.into()
    }
}
