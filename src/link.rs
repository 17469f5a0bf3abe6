//! Links: how MAVLink frames reach this program and leave it.
//!
//! One task per link owns the socket, finds frames, counts what it drops, says once a second that a ground
//! station is here, and reconnects for ever. What it reads goes to one bounded channel that all links share;
//! what it is to send comes through its [`LinkHandle`]; how it is doing is in its [`LinkStatus`].

use std::fmt;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use tokio::io::DuplexStream;
use tokio::sync::{mpsc, watch};
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use crate::doctor::NumberedSenders;
use crate::text;
use crate::text::Text;
use crate::wire::{
    ComponentId, Counters, Frame, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, Outgoing,
    SystemId,
};

mod address;
mod beat;
mod connect;
mod core;
mod datagram;
mod meter;
mod peer;
mod playback;
mod server;
mod simulator;
mod sink;
mod stream;
mod tap;
mod task;
#[cfg(test)]
mod tests;
mod tlog;

pub use address::{Address, AddressError};
pub use simulator::{
    Endpoint, InputSink, Simulator, SimulatorError, SimulatorPace, StartedSimulator,
    step_on_threads,
};
pub use sink::{FrameSink, WaitingFrames};
pub use tap::Tap;
pub use tlog::{TlogError, TlogPiece, TlogReader, TlogRecord, TlogSalvage, TlogWriter};

/// How many messages wait for a link before more are dropped.
const OUTBOX_LEN: usize = 256;

/// Names a link within this program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkId(pub u16);

/// Who speaks on a link: TCP, serial, pipe and file have one peer (0), a UDP socket has one per remote
/// address, `tcpin` one per client. Numbers are not used again while the link is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkPeer(pub u32);

/// Frames that came in together.
#[derive(Debug, Clone, PartialEq)]
pub struct Inbound {
    /// The link they came by.
    pub link: LinkId,
    pub peer: LinkPeer,
    /// The frames, never none.
    pub frames: Vec<Frame>,
    /// When their bytes were read.
    pub at: Instant,
}

/// For whom a message is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum To {
    /// Every peer of the link; on a link that sends to one UDP address, that address.
    Everyone,
    Peer(LinkPeer),
}

/// What a link is made of.
#[derive(Debug)]
pub enum Transport {
    /// A socket, a serial port or a recording.
    Address(Address),
    /// A byte pipe within this program, such as the embedded simulator's.
    Pipe(DuplexStream),
}

/// How a link presents itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkConfig {
    /// The system id to send as.
    pub system: SystemId,
    /// The component id to send as.
    pub component: ComponentId,
    /// How fast a recording is played.
    pub playback: Playback,
}

impl Default for LinkConfig {
    /// A ground station; recordings at the speed at which they were made.
    fn default() -> Self {
        Self {
            system: GROUND_STATION_SYSTEM,
            component: GROUND_STATION_COMPONENT,
            playback: Playback::Speed(1.0),
        }
    }
}

/// How fast a recording is played.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Playback {
    /// By its time stamps, this many times as fast as it was recorded.
    Speed(f64),
    /// As fast as its frames are taken.
    AsFastAsPossible,
}

/// Whether a link carries data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkState {
    Connecting,
    Up,
    /// Failed or lost; it is tried again.
    Waiting {
        /// How long after this state was published.
        retry_in: Duration,
    },
    /// Closed for good: cancelled, a recording's end, or a pipe whose other end is gone.
    Ended,
}

impl LinkState {
    /// In a few words.
    pub fn text(self) -> Text {
        match self {
            Self::Connecting => text!("transport-connecting"),
            Self::Up => text!("transport-up"),
            Self::Waiting { retry_in } => {
                let seconds = format!("{:.1}", retry_in.as_secs_f32());
                text!("transport-waiting", seconds = seconds)
            }
            Self::Ended => text!("transport-ended"),
        }
    }
}

impl fmt::Display for LinkState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().fmt(f)
    }
}

/// Traffic per second, over the last two seconds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rates {
    /// Bytes received, good or bad.
    pub bytes_in_s: f32,
    pub messages_in_s: f32,
    pub bytes_out_s: f32,
    pub messages_out_s: f32,
}

/// How a link is doing. Counters run from the link's opening, over all reconnections.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkStatus {
    pub id: LinkId,
    /// Its address as text, or `pipe`.
    pub name: String,
    /// Whether it carries data.
    pub state: LinkState,
    /// The socket's own address while there is one: which port a listener got.
    pub local: Option<SocketAddr>,
    /// How many peers it has: always 1 for an open stream.
    pub peers: usize,
    /// What its decoders have seen.
    pub decoder: Counters,
    /// Bytes sent, or about to be: a peer that does not read may never get the last of them.
    pub sent_bytes: u64,
    /// Messages sent, or about to be, heartbeats included; one to three peers counts three times.
    pub sent_messages: u64,
    /// Messages that were not sent: the queue was full, the link down, the peer gone or not reading.
    pub dropped_out: u64,
    pub rates: Rates,
    /// What each sender's numbering shows.
    pub numbered: NumberedSenders,
    /// How often the link has come up again.
    pub reconnects: u32,
    /// What went wrong last; cleared when the link comes up.
    pub last_error: Option<Text>,
}

impl LinkStatus {
    fn new(id: LinkId, name: String, state: LinkState) -> Self {
        Self {
            id,
            name,
            state,
            local: None,
            peers: 0,
            decoder: Counters::default(),
            sent_bytes: 0,
            sent_messages: 0,
            dropped_out: 0,
            rates: Rates::default(),
            numbered: NumberedSenders::new(),
            reconnects: 0,
            last_error: None,
        }
    }

    /// Frames that never came, by the gaps in their senders' numbering.
    pub fn lost(&self) -> u64 {
        self.numbered.values().map(|frames| frames.lost).sum()
    }
}

/// The way to a link's task. The task lives on without it.
#[derive(Debug, Clone)]
pub struct LinkHandle {
    id: LinkId,
    outbox: mpsc::Sender<(To, Outgoing)>,
    status: watch::Receiver<LinkStatus>,
    refused: Arc<AtomicU64>,
    tap: Tap,
    can_send: bool,
    hushed: Arc<AtomicBool>,
}

impl LinkHandle {
    /// Withholds the link's heartbeats, or lets them go out again; everything else goes out all the same.
    pub fn hush(&self, hushed: bool) {
        self.hushed.store(hushed, Ordering::Relaxed);
    }

    /// The link's name within this program.
    pub fn id(&self) -> LinkId {
        self.id
    }

    /// Gives the link a message to send and returns whether it took it. It does not while it is down, since
    /// a command that arrives after a reconnection would come too late, nor when its queue is full; both count
    /// as dropped. A recording takes nothing.
    pub fn send(&self, to: To, outgoing: Outgoing) -> bool {
        let taken = self.can_send
            && self.status.borrow().state == LinkState::Up
            && self.outbox.try_send((to, outgoing)).is_ok();
        if !taken {
            self.refused.fetch_add(1, Ordering::Relaxed);
        }
        taken
    }

    /// Where the link's frames can be watched.
    pub fn tap(&self) -> Tap {
        self.tap.clone()
    }

    /// Follows the link's status, which is published about four times a second and at every change of state.
    pub fn status(&self) -> watch::Receiver<LinkStatus> {
        self.status.clone()
    }
}

/// Opens a link as a ground station would. Nothing fails here: what cannot be opened is tried for ever and says
/// so in the status. Ends with `cancel`, or when the receiver of `inbound` is gone. Awaiting room in `inbound`
/// is what slows a fast sender down; what UDP drops meanwhile, the kernel drops.
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

/// Opens a link as [`open`] does, and has its frames taken down.
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

/// Opens a link under another identity or at another playback speed than [`open`].
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
        Transport::Address(address) => (address.to_string(), LinkState::Connecting),
        Transport::Pipe(_) => ("pipe".to_owned(), LinkState::Up),
    };
    let can_send = !matches!(transport, Transport::Address(Address::File { .. }));
    let (outbox, to_send) = mpsc::channel(OUTBOX_LEN);
    let (published, status) = watch::channel(LinkStatus::new(id, name, state));
    let refused = Arc::new(AtomicU64::new(0));
    let meter = meter::LinkMeter::new(published, Arc::clone(&refused), tap.clone());
    let link = core::LinkCore::new(id, config, meter, inbound, to_send, cancel);
    let hushed = link.hushed();
    tokio::spawn(task::run(link, transport));
    LinkHandle {
        id,
        outbox,
        status,
        refused,
        tap,
        can_send,
        hushed,
    }
}
