//! Messages and frames on their way to a link's task.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use tokio::sync::{mpsc, watch};

use super::{LinkState, LinkStatus, To};
use crate::wire::Outgoing;

/// A frame or bytes to send over a link.
#[derive(Debug, Clone)]
pub(super) enum Parcel {
    /// A message of the console, numbered by the link.
    Message(Box<Outgoing>),
    /// A whole frame of another sender, passed on byte for byte.
    Frame(Arc<[u8]>),
}

impl From<Outgoing> for Parcel {
    fn from(outgoing: Outgoing) -> Self {
        Self::Message(Box::new(outgoing))
    }
}

/// The sending end of a link's queue.
#[derive(Debug, Clone)]
pub(super) struct Outlet {
    pub outbox: mpsc::Sender<(To, Parcel)>,
    pub status: watch::Receiver<LinkStatus>,
    /// Parcels that were not accepted.
    pub refused: Arc<AtomicU64>,
    /// Whether the transport can send at all.
    pub can_send: bool,
}

impl Outlet {
    /// Queues a parcel without waiting; returns whether it was accepted.
    pub fn queue(&self, to: To, parcel: Parcel) -> bool {
        let taken = self.can_send
            && self.status.borrow().state == LinkState::Up
            && self.outbox.try_send((to, parcel)).is_ok();
        if !taken {
            self.refused.fetch_add(1, Ordering::Relaxed);
        }
        taken
    }
}
