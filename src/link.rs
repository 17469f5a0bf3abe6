//! Links: input and output of MAVLink frames.
//!
//! One task per link owns the socket, finds frames, counts dropped ones, sends a ground station's heartbeat every
//! second, and keeps reconnecting. Received frames go to one bounded channel shared by all links; messages to send
//! come through its [`LinkHandle`]; its state is published as [`LinkStatus`].
//!
//! # How the parts fit
//! - The life of a link: `address` reads where a link leads, `connect` opens it and names the reason if it
//!   cannot, `task` tries again (after 250 ms, later every 5 s) until the link ends. `stream` (TCP, serial, pipe),
//!   `datagram` (UDP) and `server` (`tcpin`) carry the data; `playback` plays a recording.
//! - What all transports share: `core` (queues, heartbeat, when reading stops), `beat` (when periodic work is due),
//!   `peer` (decoder, numbering and protocol version of one sender), `parcel` (what a queue holds), `meter` (traffic,
//!   losses), `status` (what is published of them).
//! - Where else frames go: `tap` counts them for the doctor and the inspector, `sink` collects them for the
//!   record (`tlog` is its format), `relay` shares them with other ground stations, `signer` signs and checks them.
//! - `simulator` serves the embedded simulator; `rehearsal_tape` records a rehearsal as if links had received it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tokio::io::DuplexStream;
use tokio::sync::{mpsc, watch};
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use crate::forward::ForwardSpec;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::{
    ComponentId, Frame, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, Outgoing, SystemId,
};

mod address;
mod beat;
mod connect;
mod core;
mod datagram;
mod meter;
mod parcel;
mod peer;
mod playback;
mod rehearsal_tape;
mod relay;
mod server;
mod signer;
mod simulator;
mod sink;
mod status;
mod stream;
mod tap;
mod task;
#[cfg(test)]
mod tests;
mod tlog;

use parcel::{Outlet, Parcel};

pub use address::{Address, AddressError};
pub use rehearsal_tape::RehearsalTape;
pub use relay::{ForwardCounts, Relay, StationNews};
pub use signer::{SignedLink, Signer, signing_clock};
pub use simulator::{
    Endpoint, InputSink, Simulator, SimulatorError, SimulatorPace, StartedSimulator, TruePlace,
    TruePlaces, WorldHandle, step_on_threads,
};
pub use sink::{FrameSink, WaitingFrames};
pub use status::{LinkState, LinkStatus, Rates};
pub use tap::Tap;
pub use tlog::{TlogDamage, TlogError, TlogPiece, TlogReader, TlogRecord, TlogSalvage, TlogWriter};

/// The maximum number of messages that wait for a link; more are dropped.
const OUTBOX_LEN: usize = 256;
/// The maximum number of frames that wait for a forward, which carries the traffic of all vehicles. All clients of
/// the forward share this queue; while it is full, newer frames are dropped for all of them.
const FORWARD_OUTBOX_LEN: usize = 2048;

/// The number of a link within this program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkId(pub u16);

/// A sender on a link. TCP, serial, pipe and file have one peer (0), a UDP socket has one per remote address, and
/// `tcpin` has one per client. Numbers are not reused while the link is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkPeer(pub u32);

#[derive(Debug, Clone, PartialEq)]
pub struct Inbound {
    pub link: LinkId,
    pub peer: LinkPeer,
    /// The frames, at least one.
    pub frames: Vec<Frame>,
    /// When their bytes were read.
    pub at: Instant,
}

/// The receiver of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum To {
    /// Every peer of the link; on a link that sends to one UDP address, that address.
    Everyone,
    Peer(LinkPeer),
    /// Every peer but this one.
    EveryoneBut(LinkPeer),
}

/// The transport of a link.
#[derive(Debug)]
pub enum Transport {
    /// A socket, a serial port or a recording.
    Address(Address),
    /// A byte pipe within this program, such as the embedded simulator's.
    Pipe(DuplexStream),
    /// The byte pipe to the process that simulates this vehicle.
    Sitl(VehicleId, DuplexStream),
}

/// The options of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkConfig {
    /// The system id to send as.
    pub system: SystemId,
    /// The component id to send as.
    pub component: ComponentId,
    /// The speed at which a recording is played.
    pub playback: Playback,
}

impl Default for LinkConfig {
    /// A ground station; recordings at their original speed.
    fn default() -> Self {
        Self {
            system: GROUND_STATION_SYSTEM,
            component: GROUND_STATION_COMPONENT,
            playback: Playback::Speed(1.0),
        }
    }
}

/// The speed at which a recording is played.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Playback {
    /// By its timestamps, at this multiple of the recorded speed.
    Speed(f64),
    /// As fast as its frames are accepted.
    AsFastAsPossible,
}

/// The handle of a link's task. The task does not end when the handle is dropped.
#[derive(Debug, Clone)]
pub struct LinkHandle {
    id: LinkId,
    outlet: Outlet,
    tap: Tap,
    hushed: Arc<AtomicBool>,
}

impl LinkHandle {
    /// Suppresses or resumes the link's heartbeats; other messages are not affected.
    pub fn hush(&self, hushed: bool) {
        self.hushed.store(hushed, Ordering::Relaxed);
    }

    /// The link's number within this program.
    pub fn id(&self) -> LinkId {
        self.id
    }

    /// Queues a message; returns whether it was accepted. It is not accepted while the link is down, since a command
    /// after a reconnection would come too late, nor when the queue is full; both cases count as dropped. A recording
    /// accepts no messages.
    ///
    /// Stations that share the link see the message too.
    pub fn send(&self, to: To, outgoing: Outgoing) -> bool {
        self.tap.share(&outgoing);
        self.outlet.queue(to, Parcel::from(outgoing))
    }

    /// The signing on the link; `None` if its frames need no signatures.
    pub fn signing(&self) -> Option<SignedLink> {
        self.tap.signing().cloned()
    }

    /// The tap for watching the link's frames.
    pub fn tap(&self) -> Tap {
        self.tap.clone()
    }

    /// A receiver of the link's status, which is published about four times a second and at every change of state.
    pub fn status(&self) -> watch::Receiver<LinkStatus> {
        self.outlet.status.clone()
    }
}

/// Opens a link as a ground station would. Opening never fails: errors are shown in the status, and attempts continue.
/// Ends with `cancel`, or when the receiver of `inbound` is gone. A full `inbound` slows a fast sender down; with UDP,
/// the kernel drops datagrams then.
///
/// Needs a tokio runtime.
pub fn open(
    id: LinkId,
    transport: Transport,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    open_with(id, transport, LinkConfig::default(), inbound, cancel)
}

/// Opens a link as [`open`] does, and records its frames.
pub fn open_recorded(
    id: LinkId,
    transport: Transport,
    sink: Option<FrameSink>,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    let (config, tap) = (LinkConfig::default(), Tap::new(sink));
    open_tapped(id, transport, config, tap, inbound, cancel)
}

/// The services that links to vehicles share.
#[derive(Debug, Clone, Copy)]
pub struct LinkServices<'a> {
    /// The recording of their frames.
    pub sink: Option<&'a FrameSink>,
    /// Shares their frames with other ground stations.
    pub relay: &'a Relay,
    /// Signs their frames, and checks signatures.
    pub signer: Option<&'a Signer>,
    /// The system id to send as.
    pub system: SystemId,
}

/// Opens a link to vehicles as [`open_recorded`] does, with these services. Frames from within this
/// program and from recordings are not checked: they cannot be forged.
pub fn open_shared(
    id: LinkId,
    transport: Transport,
    services: LinkServices<'_>,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    let LinkServices {
        sink,
        relay,
        signer,
        system,
    } = services;
    let signed = match (&transport, signer) {
        (
            Transport::Address(Address::File { .. }) | Transport::Pipe(_) | Transport::Sitl(..),
            _,
        )
        | (_, None) => None,
        (Transport::Address(address), Some(signer)) => Some(signer.on(&address.to_string(), id)),
    };
    let tap = Tap::relayed(sink.cloned(), relay.port_of_link(id)).signed_by(signed);
    let config = LinkConfig {
        system,
        ..LinkConfig::default()
    };
    let link = open_tapped(id, transport, config, tap, inbound, cancel);
    relay.add_link(id, link.outlet.clone());
    link
}

/// Opens a forward: a link to other ground stations, which share the links of a relay. Their frames
/// go through the relay; `inbound` must be drained.
pub fn open_forward(
    id: LinkId,
    address: Address,
    spec: ForwardSpec,
    relay: &Relay,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    let tap = Tap::relayed(None, relay.port_of_forward(id));
    let transport = Transport::Address(address);
    let own = relay.address();
    let config = LinkConfig {
        system: own.system,
        component: own.component,
        ..LinkConfig::default()
    };
    let link = open_tapped(id, transport, config, tap, inbound, cancel);
    relay.add_forward(id, spec, link.outlet.clone());
    link
}

/// Opens a link with an identity or a playback speed different from those of [`open`].
pub fn open_with(
    id: LinkId,
    transport: Transport,
    config: LinkConfig,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    open_tapped(id, transport, config, Tap::new(None), inbound, cancel)
}

fn open_tapped(
    id: LinkId,
    transport: Transport,
    config: LinkConfig,
    tap: Tap,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
) -> LinkHandle {
    let (name, state) = match &transport {
        Transport::Address(address) => {
            let name = Text::verbatim(address.to_string());
            (name, LinkState::Connecting)
        }
        Transport::Pipe(_) => (text!("link-simulator"), LinkState::Up),
        Transport::Sitl(vehicle, _) => (text!("link-sitl", vehicle = *vehicle), LinkState::Up),
    };
    let can_send = !matches!(transport, Transport::Address(Address::File { .. }));
    let outbox_len = if tap.is_forward() {
        FORWARD_OUTBOX_LEN
    } else {
        OUTBOX_LEN
    };
    let (outbox, to_send) = mpsc::channel(outbox_len);
    let (published, status) = watch::channel(LinkStatus::new(id, name, state));
    let refused = Arc::default();
    let meter = meter::LinkMeter::new(published, Arc::clone(&refused), tap.clone());
    let link = core::LinkCore::new(id, config, meter, inbound, to_send, cancel);
    let hushed = link.hushed();
    tokio::spawn(task::run(link, transport));
    LinkHandle {
        id,
        outlet: Outlet {
            outbox,
            status,
            refused,
            can_send,
        },
        tap,
        hushed,
    }
}
