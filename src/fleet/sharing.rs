//! The forwards of a fleet: other ground stations that use its links, and their commands.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use crate::forward::{ForwardSpec, StationWatch};
use crate::ledger::ForeignCommand;
use crate::link::{
    self, Address, ForwardCounts, Inbound, LinkId, LinkPeer, LinkStatus, Relay, StationNews,
};
use crate::vehicle::Vehicle;
use crate::wire::{Content, MavAddress};

/// The maximum number of commands of other stations that wait for the hub; further ones pass without a row.
const NEWS_KEPT: usize = 256;
/// The maximum number of batches from forwards that wait for the hub. The hub ignores them, since
/// the relay has already passed them on.
const INBOUND_KEPT: usize = 16;

/// A forward that can be watched.
#[derive(Debug, Clone)]
pub struct ForwardFeed {
    pub spec: ForwardSpec,
    pub status: watch::Receiver<LinkStatus>,
    relay: Relay,
    id: LinkId,
}

impl ForwardFeed {
    /// The relay's counters so far.
    pub fn counts(&self) -> ForwardCounts {
        self.relay.counts(self.id)
    }
}

/// The forwards of a hub.
pub(super) struct Sharing {
    pub relay: Relay,
    forwards: BTreeMap<LinkId, (String, CancellationToken)>,
    opened: u16,
    inbound: mpsc::Sender<Inbound>,
    stations: StationWatch,
    /// The senders that have been reported as parts of a loop.
    pub loops_named: BTreeSet<(LinkId, LinkPeer)>,
    /// Whether a station with the console's own address has been reported; shared with the tasks of the vehicles.
    pub is_twin_said: Arc<AtomicBool>,
}

/// The messages from forwards to the hub.
pub(super) struct Overheard {
    pub news: mpsc::Receiver<StationNews>,
    pub frames: mpsc::Receiver<Inbound>,
}

impl Sharing {
    pub fn new(own: MavAddress) -> (Self, Overheard) {
        let (news, news_out) = mpsc::channel(NEWS_KEPT);
        let (inbound, frames) = mpsc::channel(INBOUND_KEPT);
        let sharing = Self {
            relay: Relay::new(own, news),
            forwards: BTreeMap::new(),
            opened: 0,
            inbound,
            stations: StationWatch::new(own),
            loops_named: BTreeSet::new(),
            is_twin_said: Arc::default(),
        };
        let overheard = Overheard {
            news: news_out,
            frames,
        };
        (sharing, overheard)
    }

    /// Opens a forward on an address.
    pub fn open(
        &mut self,
        spec: ForwardSpec,
        address: Address,
        cancel: &CancellationToken,
    ) -> ForwardFeed {
        let id = LinkId(self.opened);
        self.opened += 1;
        let cancel = cancel.child_token();
        let link = link::open_forward(
            id,
            address,
            spec.clone(),
            &self.relay,
            self.inbound.clone(),
            cancel.clone(),
        );
        self.forwards.insert(id, (spec.address.clone(), cancel));
        ForwardFeed {
            spec,
            status: link.status(),
            relay: self.relay.clone(),
            id,
        }
    }

    /// Closes the forwards at an address.
    pub fn close(&mut self, address: &str) {
        let relay = &self.relay;
        self.forwards.retain(|&id, (open, cancel)| {
            let stays = open != address;
            if !stays {
                relay.remove_forward(id);
                cancel.cancel();
            }
            stays
        });
    }

    /// The row of a station's command to a vehicle, if it is to be reported now.
    pub fn commanded(
        &mut self,
        news: &StationNews,
        to: &Vehicle,
        now: Duration,
    ) -> Option<ForeignCommand> {
        self.stations.commanded(news.station, &news.deed, to, now)
    }

    /// The row that a vehicle's frame changes, if it is to be reported now.
    pub fn heard(
        &mut self,
        content: &Content,
        from: &Vehicle,
        now: Duration,
    ) -> Option<ForeignCommand> {
        self.stations.answered(content, from, now)
    }

    /// The rows that were held back and are due now.
    pub fn due(&mut self, now: Duration) -> Vec<ForeignCommand> {
        self.stations.due(now)
    }
}
