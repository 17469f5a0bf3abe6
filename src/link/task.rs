//! The part of a link's task that does not depend on the transport.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::sync::mpsc::error::TrySendError;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use super::beat::{Beat, Pace};
use super::meter::Meter;
use super::{
    Address, Inbound, LinkConfig, LinkId, LinkState, Peer, To, Transport, connect, playback, stream,
};
use crate::text;
use crate::text::Text;
use crate::wire::{Frame, Outgoing, ground_station_heartbeat};

const HEARTBEAT: Pace = Pace {
    handy: Duration::from_millis(900),
    latest: Duration::from_secs(1),
};
const PUBLISH: Pace = Pace {
    handy: Duration::from_millis(200),
    latest: Duration::from_millis(300),
};
const FIRST_RETRY: Duration = Duration::from_millis(250);
const LONGEST_RETRY: Duration = Duration::from_secs(5);
/// How many queued messages go into one write.
const BATCH_LEN: usize = 64;

/// A link without its socket.
#[derive(Debug)]
pub(super) struct Link {
    id: LinkId,
    pub(super) config: LinkConfig,
    pub(super) meter: Meter,
    inbound: mpsc::Sender<Inbound>,
    to_send: mpsc::Receiver<(To, Outgoing)>,
    cancel: CancellationToken,
    /// Read, but the receiver has no room for it yet. Nothing more is read meanwhile.
    undelivered: Option<Inbound>,
    /// Frames have come since the last chore: the task is awake anyway.
    has_heard: bool,
    heartbeat: Beat,
    /// Whether heartbeats are withheld, as a radio would that does not reach.
    hushed: Arc<AtomicBool>,
    publish: Beat,
}

/// What the transport has to do next.
#[derive(Debug)]
pub(super) enum Chore {
    /// Send these; never none.
    Send(Vec<(To, Outgoing)>),
    /// Nothing, but look again whether reading is allowed.
    Nothing,
    /// Close.
    End,
}

/// How a connection came to its end.
#[derive(Debug)]
pub(super) enum Outcome {
    /// Nobody wants it any more.
    Unwanted,
    /// It failed for this reason and is worth another try.
    Lost(Text),
    /// It is over, for this reason if it is not the ordinary end.
    Over(Option<Text>),
}

impl Link {
    pub(super) fn new(
        id: LinkId,
        config: LinkConfig,
        meter: Meter,
        inbound: mpsc::Sender<Inbound>,
        to_send: mpsc::Receiver<(To, Outgoing)>,
        cancel: CancellationToken,
    ) -> Self {
        Self {
            id,
            config,
            meter,
            inbound,
            to_send,
            cancel,
            undelivered: None,
            has_heard: false,
            heartbeat: Beat::new(HEARTBEAT),
            hushed: Arc::new(AtomicBool::new(false)),
            publish: Beat::new(PUBLISH),
        }
    }

    /// What withholds heartbeats.
    pub(super) fn hushed(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.hushed)
    }

    /// The heartbeat, unless it is withheld.
    fn beat(&self) -> Chore {
        if self.hushed.load(Ordering::Relaxed) {
            return Chore::Nothing;
        }
        Chore::Send(vec![(To::Everyone, ground_station_heartbeat())])
    }

    /// Says that the link carries data from now on, to the peers first of all.
    pub(super) fn up(&mut self, local: Option<std::net::SocketAddr>) {
        self.heartbeat.hasten();
        self.meter.up(local);
    }

    /// Whether there is room for more from the transport.
    pub(super) fn may_read(&self) -> bool {
        self.undelivered.is_none()
    }

    /// Hands on what a peer sent, at once or as soon as there is room. Only when [`Self::may_read`] allowed the
    /// reading.
    pub(super) fn deliver(&mut self, peer: Peer, frames: Vec<Frame>) {
        if frames.is_empty() {
            return;
        }
        self.has_heard = true;
        let batch = Inbound {
            link: self.id,
            peer,
            frames,
            at: Instant::now(),
        };
        if let Err(TrySendError::Full(batch)) = self.inbound.try_send(batch) {
            self.undelivered = Some(batch);
        }
    }

    /// Waits until what was read is taken. `None` if nobody wants the link any more.
    pub(super) async fn delivered(&mut self) -> Option<()> {
        while self.undelivered.is_some() {
            if let Chore::End = self.chore(false).await {
                return None;
            }
        }
        Some(())
    }

    /// Waits for the next thing to do. Safe to drop at any time. Queued messages are left where they are
    /// unless the transport `may_send`.
    pub(super) async fn chore(&mut self, may_send: bool) -> Chore {
        if std::mem::take(&mut self.has_heard) {
            let now = Instant::now();
            if self.publish.is_handy(now) {
                self.meter.publish();
            }
            if may_send && self.heartbeat.is_handy(now) {
                return self.beat();
            }
        }
        tokio::select! {
            biased;
            () = self.cancel.cancelled() => Chore::End,
            () = self.inbound.closed() => Chore::End,
            Ok(permit) = self.inbound.reserve(), if self.undelivered.is_some() => {
                if let Some(batch) = self.undelivered.take() {
                    permit.send(batch);
                }
                Chore::Nothing
            }
            () = self.publish.due() => {
                self.meter.publish();
                Chore::Nothing
            }
            () = self.heartbeat.due(), if may_send => self.beat(),
            Some(first) = self.to_send.recv(), if may_send => {
                let mut batch = vec![first];
                while batch.len() < BATCH_LEN
                    && let Ok(next) = self.to_send.try_recv()
                {
                    batch.push(next);
                }
                Chore::Send(batch)
            }
        }
    }

    /// Waits for a future while the link is down: what is to be sent is dropped. `None` if nobody wants the
    /// link any more.
    pub(super) async fn meanwhile<F: Future>(&mut self, future: F) -> Option<F::Output> {
        tokio::pin!(future);
        loop {
            tokio::select! {
                output = &mut future => return Some(output),
                chore = self.chore(false) => if let Chore::End = chore {
                    return None;
                },
            }
            self.drop_queued();
        }
    }

    /// Drops what was queued just before the link went down.
    fn drop_queued(&mut self) {
        while self.to_send.try_recv().is_ok() {
            self.meter.dropped(1);
        }
    }
}

/// Runs a link until its end.
pub(super) async fn run(mut link: Link, transport: Transport) {
    let reason = match transport {
        Transport::Pipe(pipe) => {
            link.up(None);
            match stream::session(&mut link, pipe, None).await {
                Outcome::Unwanted => None,
                Outcome::Over(reason) => reason,
                Outcome::Lost(reason) => Some(text!("transport-pipe-gone", reason = reason)),
            }
        }
        Transport::Address(Address::File { path }) => playback::play(&mut link, &path).await,
        Transport::Address(address) => reconnect_for_ever(&mut link, &address).await,
    };
    link.to_send.close();
    link.drop_queued();
    link.meter.down(LinkState::Ended, reason);
}

/// Opens an address again and again; returns why it gave up, if it did.
async fn reconnect_for_ever(link: &mut Link, address: &Address) -> Option<Text> {
    let mut retry_in = FIRST_RETRY;
    loop {
        link.meter.down(LinkState::Connecting, None);
        let reason = match connect::attempt(link, address).await {
            Outcome::Unwanted => return None,
            Outcome::Over(reason) => return reason,
            Outcome::Lost(reason) => reason,
        };
        // A server that accepts and closes at once is no success.
        if link.meter.take_heard() {
            retry_in = FIRST_RETRY;
        }
        let state = LinkState::Waiting { retry_in };
        link.meter.down(state, Some(reason));
        link.drop_queued();
        link.meanwhile(tokio::time::sleep(retry_in)).await?;
        retry_in = (2 * retry_in).min(LONGEST_RETRY);
    }
}
