//! The two ends of a class's connections.

use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;
use tokio::sync::mpsc;
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::fault::ClassFault;
use sortie_class::ConnectionId;
use sortie_class::protocol::{self, DeskMessage, LineFault, SeatMessage};

/// The maximum number of lines that wait to be written on one connection.
const OUTBOX: usize = 64;
/// The maximum number of arrivals, from all connections together, that wait for the console.
pub(super) const ARRIVALS: usize = 64;

/// The time between two attempts of a seat to connect grows from the first of these to the second.
pub(super) const RETRY: std::ops::RangeInclusive<Duration> =
    Duration::from_secs(1)..=Duration::from_secs(4);

/// How long a port that is closed waits for its carrier to say goodbye.
const GOODBYE: Duration = Duration::from_secs(1);

/// Who is at the other end of a connection.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CarrierPeer {
    /// The name of the user, or the user's number if there is no name.
    pub user: String,
}

/// Where lines to one connection wait to be written.
#[derive(Debug, Clone)]
pub struct Outbox(mpsc::Sender<String>);

impl Outbox {
    pub(super) fn new() -> (Self, mpsc::Receiver<String>) {
        let (sender, lines) = mpsc::channel(OUTBOX);
        (Self(sender), lines)
    }

    /// Whether there is room for a message.
    pub fn has_room(&self) -> bool {
        self.0.capacity() > 0
    }

    /// The number of messages for which there is room.
    pub fn room(&self) -> usize {
        self.0.capacity()
    }

    /// Queues a message; without room, it is dropped. The end of the connection is reported by its port.
    pub fn send(&self, message: &impl Serialize) {
        self.offer(message);
    }

    /// Queues a message; returns whether there was room for it.
    pub fn offer(&self, message: &impl Serialize) -> bool {
        self.0.try_send(protocol::line(message)).is_ok()
    }

    /// Whether the connection has ended.
    pub fn is_closed(&self) -> bool {
        self.0.is_closed()
    }
}

/// What arrives at a desk; `M` are the messages of seats.
#[derive(Debug)]
pub enum DeskArrival<M = SeatMessage> {
    Opened {
        connection: ConnectionId,
        peer: CarrierPeer,
        outbox: Outbox,
    },
    Line {
        from: ConnectionId,
        line: Result<M, LineFault>,
    },
    Closed(ConnectionId),
}

/// The desk's end. Dropping it closes all connections.
#[derive(Debug)]
pub struct DeskPort<M = SeatMessage> {
    pub(super) arrivals: mpsc::Receiver<DeskArrival<M>>,
    pub(super) task: JoinHandle<()>,
}

impl<M> DeskPort<M> {
    /// Closes all connections, and waits a moment until the seats have been told.
    pub async fn close(self) {
        drop(self.arrivals);
        drop(timeout(GOODBYE, self.task).await);
    }

    /// Waits for the next arrival; `None` if the carrier has ended.
    pub async fn next(&mut self) -> Option<DeskArrival<M>> {
        self.arrivals.recv().await
    }
}

/// What arrives at a seat; `M` are the messages of the desk.
#[derive(Debug)]
pub enum SeatArrival<M = DeskMessage> {
    /// A desk has been found.
    Found {
        desk: CarrierPeer,
        outbox: Outbox,
    },
    Line(Result<M, LineFault>),
    /// The connection has ended; another one is tried.
    Lost,
    /// There is a desk to which the seat must not connect. Reported once for each reason.
    Refused(Arc<ClassFault>),
}

/// The seat's end. It connects again until it is dropped.
#[derive(Debug)]
pub struct SeatPort<M = DeskMessage> {
    pub(super) arrivals: mpsc::Receiver<SeatArrival<M>>,
    pub(super) task: JoinHandle<()>,
}

impl<M> SeatPort<M> {
    /// Ends the connection, and waits a moment until the desk has been told.
    pub async fn close(self) {
        drop(self.arrivals);
        drop(timeout(GOODBYE, self.task).await);
    }

    /// Waits for the next arrival; `None` if the carrier has ended.
    pub async fn next(&mut self) -> Option<SeatArrival<M>> {
        self.arrivals.recv().await
    }
}
