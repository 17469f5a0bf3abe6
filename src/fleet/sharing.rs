//! The forwards of a fleet: other ground stations that use its links, and their commands.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use crate::forward::{Deed, ForwardSpec, StationId, station_of_ack};
use crate::link::{self, Address, ForwardCounts, Inbound, LinkId, LinkStatus, Relay, StationNews};
use crate::notice::Notice;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleClass, VehicleId};
use crate::wire::{Content, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, MavAddress};

/// The maximum number of commands of other stations that wait for the hub; further ones pass without a notice.
const NEWS_KEPT: usize = 256;
/// The maximum number of batches from forwards that wait for the hub, which ignores them: the relay has passed them on.
const INBOUND_KEPT: usize = 16;
/// The console's address on every link.
pub(super) const OWN: MavAddress = MavAddress {
    system: GROUND_STATION_SYSTEM,
    component: GROUND_STATION_COMPONENT,
};
/// Within this time, the same command of a station is a repetition, and an answer belongs to the
/// command.
const SAME_WITHIN: Duration = Duration::from_secs(5);
/// The number of remembered deeds above which old ones are forgotten.
const MOST_SAID: usize = 1024;
/// The longest pause between setpoints of one stream.
const STREAM_WITHIN: Duration = Duration::from_secs(30);

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
    /// The last deed of each station on each vehicle.
    said: BTreeMap<Exchange, (Deed, Duration)>,
    /// Whether a station with the console's own address has been reported; shared with the tasks of the vehicles.
    pub is_twin_said: Arc<AtomicBool>,
}

/// A vehicle that a station commands, with the class that names its modes.
#[derive(Clone, Copy)]
pub(super) struct Addressee {
    pub vehicle: VehicleId,
    pub class: VehicleClass,
}

/// A station and a vehicle that it has commanded.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Exchange {
    station: StationId,
    vehicle: VehicleId,
}

/// The messages from forwards to the hub.
pub(super) struct Overheard {
    pub news: mpsc::Receiver<StationNews>,
    pub frames: mpsc::Receiver<Inbound>,
}

impl Sharing {
    pub fn new() -> (Self, Overheard) {
        let (news, news_out) = mpsc::channel(NEWS_KEPT);
        let (inbound, frames) = mpsc::channel(INBOUND_KEPT);
        let sharing = Self {
            relay: Relay::new(OWN, news),
            forwards: BTreeMap::new(),
            opened: 0,
            inbound,
            said: BTreeMap::new(),
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

    /// The notice of a station's command to a vehicle; `None` if it repeats or continues an earlier one.
    pub fn commanded(
        &mut self,
        news: &StationNews,
        to: Addressee,
        now: Duration,
    ) -> Option<Notice> {
        let exchange = Exchange {
            station: news.station,
            vehicle: to.vehicle,
        };
        let last = self.said.get(&exchange);
        let within = match news.deed {
            Deed::Steering => STREAM_WITHIN,
            Deed::Mode(_)
            | Deed::Arm(_)
            | Deed::Command(_)
            | Deed::Parameter(..)
            | Deed::Plan(_) => SAME_WITHIN,
        };
        let is_same =
            last.is_some_and(|(deed, at)| *deed == news.deed && now.saturating_sub(*at) < within);
        self.note(exchange, news.deed.clone(), now);
        (!is_same).then(|| {
            let text = news.deed.text(news.station, to.vehicle, to.class);
            notice(to.vehicle, text, now)
        })
    }

    /// The notice of a vehicle's answer to a station whose command did not come through a forward;
    /// `None` for other messages and for a command that has been reported.
    pub fn answered(&mut self, content: &Content, to: Addressee, now: Duration) -> Option<Notice> {
        let (station, command) = station_of_ack(content, OWN)?;
        let exchange = Exchange {
            station,
            vehicle: to.vehicle,
        };
        let last = self.said.get(&exchange);
        if last.is_some_and(|(_, at)| now.saturating_sub(*at) < SAME_WITHIN) {
            return None;
        }
        let deed = Deed::Command(command);
        let text = deed.text(station, to.vehicle, to.class);
        self.note(exchange, deed, now);
        Some(notice(to.vehicle, text, now))
    }

    fn note(&mut self, exchange: Exchange, deed: Deed, now: Duration) {
        if self.said.len() >= MOST_SAID {
            self.said
                .retain(|_, (_, at)| now.saturating_sub(*at) < STREAM_WITHIN);
        }
        self.said.insert(exchange, (deed, now));
    }
}

fn notice(vehicle: VehicleId, text: Text, now: Duration) -> Notice {
    Notice::about(vehicle, now, Severity::Notice, text)
}
