//! The part of a link's task that does not depend on the transport.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::sync::mpsc::error::TrySendError;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use super::beat::{BeatPace, LinkBeat};
use super::meter::LinkMeter;
use super::{Inbound, LinkConfig, LinkId, LinkPeer, Parcel, To};
use crate::text::Text;
use crate::wire::{Frame, ground_station_heartbeat};

const HEARTBEAT: BeatPace = BeatPace {
    handy: Duration::from_millis(900),
    latest: Duration::from_secs(1),
};
const PUBLISH: BeatPace = BeatPace {
    handy: Duration::from_millis(200),
    latest: Duration::from_millis(300),
};
/// The maximum number of queued messages in one write.
const BATCH_LEN: usize = 64;

/// A link without its socket: pending input and output, heartbeats and publication.
#[derive(Debug)]
pub(super) struct LinkCore {
    id: LinkId,
    pub(super) config: LinkConfig,
    pub(super) meter: LinkMeter,
    inbound: mpsc::Sender<Inbound>,
    to_send: mpsc::Receiver<(To, Parcel)>,
    cancel: CancellationToken,
    /// Received frames waiting for room in the channel. Nothing more is read until they are
    /// delivered.
    undelivered: Option<Inbound>,
    /// Whether frames have arrived since the last request for work, so the task is awake anyway.
    has_heard: bool,
    heartbeat: LinkBeat,
    /// Whether heartbeats are suppressed, as by a radio out of range.
    hushed: Arc<AtomicBool>,
    publish: LinkBeat,
}

/// The transport's next action.
#[derive(Debug)]
pub(super) enum LinkWork {
    /// Send these parcels; at least one.
    Send(Vec<(To, Parcel)>),
    /// Do nothing, but check again whether reading is allowed.
    Nothing,
    End,
}

/// How a connection ended.
#[derive(Debug)]
pub(super) enum ConnectionEnd {
    /// The link was cancelled, or the receiver of its frames is gone.
    Cancelled,
    /// The connection failed for this reason; another attempt follows.
    Lost(Text),
    /// The connection must not be reopened; the reason is given unless this is the regular end.
    Final(Option<Text>),
}

impl LinkCore {
    pub(super) fn new(
        id: LinkId,
        config: LinkConfig,
        meter: LinkMeter,
        inbound: mpsc::Sender<Inbound>,
        to_send: mpsc::Receiver<(To, Parcel)>,
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
            heartbeat: LinkBeat::new(HEARTBEAT),
            hushed: Arc::new(AtomicBool::new(false)),
            publish: LinkBeat::new(PUBLISH),
        }
    }

    /// The switch that suppresses heartbeats.
    pub(super) fn hushed(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.hushed)
    }

    /// The heartbeat, unless suppressed.
    fn beat(&self) -> LinkWork {
        if self.hushed.load(Ordering::Relaxed) {
            return LinkWork::Nothing;
        }
        LinkWork::Send(vec![(To::Everyone, ground_station_heartbeat().into())])
    }

    /// Publishes that the link is up, and sends a heartbeat at once.
    pub(super) fn up(&mut self, local: Option<std::net::SocketAddr>) {
        self.heartbeat.hasten();
        self.meter.up(local);
    }

    /// Whether more may be read from the transport.
    pub(super) fn may_read(&self) -> bool {
        self.undelivered.is_none()
    }

    /// Delivers a peer's frames, at once or as soon as there is room. Call it only if [`Self::may_read`] allowed the
    /// reading.
    pub(super) fn deliver(&mut self, peer: LinkPeer, frames: Vec<Frame>) {
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

    /// Waits until received frames are delivered. `None` if the link must close.
    pub(super) async fn delivered(&mut self) -> Option<()> {
        while self.undelivered.is_some() {
            if let LinkWork::End = self.next_work(false).await {
                return None;
            }
        }
        Some(())
    }

    /// Waits for the next action. Cancel-safe. Queued messages stay queued unless the transport `may_send`.
    pub(super) async fn next_work(&mut self, may_send: bool) -> LinkWork {
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
            () = self.cancel.cancelled() => LinkWork::End,
            () = self.inbound.closed() => LinkWork::End,
            Ok(permit) = self.inbound.reserve(), if self.undelivered.is_some() => {
                if let Some(batch) = self.undelivered.take() {
                    permit.send(batch);
                }
                LinkWork::Nothing
            }
            () = self.publish.due() => {
                self.meter.publish();
                LinkWork::Nothing
            }
            () = self.heartbeat.due(), if may_send => self.beat(),
            Some(first) = self.to_send.recv(), if may_send => {
                let mut batch = vec![first];
                while batch.len() < BATCH_LEN
                    && let Ok(next) = self.to_send.try_recv()
                {
                    batch.push(next);
                }
                LinkWork::Send(batch)
            }
        }
    }

    /// Waits for a future while the link is down; messages to send are dropped. `None` if the link must close.
    pub(super) async fn meanwhile<F: Future>(&mut self, future: F) -> Option<F::Output> {
        tokio::pin!(future);
        loop {
            tokio::select! {
                output = &mut future => return Some(output),
                work = self.next_work(false) => if let LinkWork::End = work {
                    return None;
                },
            }
            self.drop_queued();
        }
    }

    /// Accepts no more messages, and drops queued ones.
    pub(super) fn close(&mut self) {
        self.to_send.close();
        self.drop_queued();
    }

    /// Drops messages queued just before the link went down.
    pub(super) fn drop_queued(&mut self) {
        while self.to_send.try_recv().is_ok() {
            self.meter.dropped(1);
        }
    }
}
