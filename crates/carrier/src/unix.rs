//! The carrier on one host: a Unix socket. The kernel says which user is at the other end.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use nix::unistd::geteuid;
use serde::de::DeserializeOwned;
use tokio::net::{UnixListener, UnixStream};
use tokio::sync::mpsc;

use super::exchange::exchange;
use super::fault::ClassFault;
use super::host::{HostPlace, user_name};
use super::ports::{
    ARRIVALS, CarrierPeer, DeskArrival, DeskPort, Outbox, RETRY, SeatArrival, SeatPort,
};
use super::socket;
use sortie_class::{ConnectionId, SEATS};

/// The permissions of the socket: every user of the host may connect.
const SOCKET_MODE: u32 = 0o666;
/// The maximum number of connections of one user, except for the instructor's own.
const OF_ONE_USER: usize = 16;

/// A kind of message that one side receives.
pub trait Message: DeserializeOwned + Send + 'static {}

impl<M: DeserializeOwned + Send + 'static> Message for M {}

/// Opens the desk of a class.
///
/// # Errors
/// Its folder or its socket cannot be used.
pub fn open<M: Message>(place: &HostPlace) -> Result<DeskPort<M>, ClassFault> {
    place.prepare()?;
    let listener =
        socket::open(&place.socket, SOCKET_MODE).map_err(|fault| ClassFault::Socket {
            socket: place.socket.clone(),
            fault,
        })?;
    let (arrived, arrivals) = mpsc::channel(ARRIVALS);
    let removed = Removed(place.clone());
    let task = tokio::spawn(async move {
        tokio::select! {
            () = arrived.closed() => {}
            () = accept(listener, &arrived) => {}
        }
        drop(removed);
    });
    Ok(DeskPort { arrivals, task })
}

/// Removes the socket when the desk closes.
struct Removed(HostPlace);

impl Drop for Removed {
    fn drop(&mut self) {
        self.0.remove();
    }
}

/// How many connections each user has.
#[derive(Clone, Default)]
struct Places(Arc<Mutex<BTreeMap<u32, usize>>>);

/// A place that is free again when it is dropped.
struct TakenPlace {
    places: Places,
    uid: u32,
}

impl Places {
    fn take(&self, uid: u32) -> Option<TakenPlace> {
        let mut taken = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_own = uid == geteuid().as_raw();
        let all: usize = taken.values().sum();
        let count = taken.entry(uid).or_default();
        if all >= SEATS || (!is_own && *count >= OF_ONE_USER) {
            return None;
        }
        *count += 1;
        let places = self.clone();
        Some(TakenPlace { places, uid })
    }
}

impl Drop for TakenPlace {
    fn drop(&mut self) {
        let mut taken = self.places.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = taken.get_mut(&self.uid) {
            *count -= 1;
        }
    }
}

async fn accept<M: Message>(listener: UnixListener, arrived: &mpsc::Sender<DeskArrival<M>>) {
    let places = Places::default();
    // Dropping the set ends the connections.
    let mut connections = tokio::task::JoinSet::new();
    for number in 1.. {
        let Ok((stream, _)) = listener.accept().await else {
            // No file descriptors are left until a connection ends.
            tokio::task::yield_now().await;
            continue;
        };
        while connections.try_join_next().is_some() {}
        let Some((uid, place)) = stream
            .peer_cred()
            .ok()
            .and_then(|cred| Some((cred.uid(), places.take(cred.uid())?)))
        else {
            continue;
        };
        let arrived = arrived.clone();
        connections.spawn(async move {
            serve(stream, ConnectionId(number), uid, &arrived).await;
            drop(place);
        });
    }
}

async fn serve<M: Message>(
    stream: UnixStream,
    connection: ConnectionId,
    uid: u32,
    arrived: &mpsc::Sender<DeskArrival<M>>,
) {
    let (outbox, lines) = Outbox::new();
    let user = user_name(uid);
    let opened = DeskArrival::Opened {
        connection,
        peer: CarrierPeer { user },
        outbox,
    };
    if arrived.send(opened).await.is_err() {
        return;
    }
    let (read, write) = stream.into_split();
    let line = |line| DeskArrival::Line {
        from: connection,
        line,
    };
    exchange(read, write, lines, arrived, line).await;
    drop(arrived.send(DeskArrival::Closed(connection)).await);
}

/// Connects to the desk of a class, and again whenever the connection ends.
pub fn join<M: Message>(place: HostPlace) -> SeatPort<M> {
    let (arrived, arrivals) = mpsc::channel(ARRIVALS);
    let task = tokio::spawn(async move {
        tokio::select! {
            () = arrived.closed() => {}
            () = keep_connected(place, &arrived) => {}
        }
    });
    SeatPort { arrivals, task }
}

async fn keep_connected<M: Message>(mut place: HostPlace, arrived: &mpsc::Sender<SeatArrival<M>>) {
    let mut wait = *RETRY.start();
    let mut stranger = None;
    loop {
        match connect(&place.socket, &place).await {
            Ok(Some((stream, desk))) => {
                if place.is_passing {
                    // Anybody could open a place of this name once its folder is gone.
                    place = place.of_user(&desk.user);
                }
                wait = *RETRY.start();
                stranger = None;
                if converse(stream, desk, arrived).await.is_none() {
                    return;
                }
            }
            // There is no desk, which is no fault: it may open later.
            Ok(None) => {}
            Err(fault) => {
                let found = Arc::new(fault);
                if stranger.as_ref() != Some(&found) {
                    stranger = Some(Arc::clone(&found));
                    if arrived.send(SeatArrival::Refused(found)).await.is_err() {
                        return;
                    }
                }
            }
        }
        tokio::time::sleep(wait).await;
        wait = (wait * 2).min(*RETRY.end());
    }
}

/// Connects; `None` if no desk answers.
async fn connect(
    socket: &Path,
    place: &HostPlace,
) -> Result<Option<(UnixStream, CarrierPeer)>, ClassFault> {
    let Ok(stream) = UnixStream::connect(socket).await else {
        return Ok(None);
    };
    let Ok(cred) = stream.peer_cred() else {
        return Ok(None);
    };
    place.check(cred.uid())?;
    let user = user_name(cred.uid());
    Ok(Some((stream, CarrierPeer { user })))
}

/// Passes lines until the connection ends; `None` if the console has ended.
async fn converse<M: Message>(
    stream: UnixStream,
    desk: CarrierPeer,
    arrived: &mpsc::Sender<SeatArrival<M>>,
) -> Option<()> {
    let (outbox, lines) = Outbox::new();
    arrived
        .send(SeatArrival::Found { desk, outbox })
        .await
        .ok()?;
    let (read, write) = stream.into_split();
    exchange(read, write, lines, arrived, SeatArrival::Line).await;
    arrived.send(SeatArrival::Lost).await.ok()
}
