//! The carrier on one host: a Unix socket. The kernel says which user is at the other end.

use std::collections::BTreeMap;
use std::os::unix::fs::FileTypeExt as _;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, io};

use nix::unistd::geteuid;
use serde::de::DeserializeOwned;
use tokio::net::{UnixListener, UnixStream};
use tokio::sync::mpsc;

use super::calling::{self, WayToDesk};
use super::exchange::exchange;
use super::fault::ClassFault;
use super::host::{HostPlace, user_name};
use super::ports::{ARRIVALS, CarrierPeer, DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort};
use super::socket::{self, SocketFault};
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
    calling::join(place)
}

impl<M: Message> WayToDesk<M> for HostPlace {
    type Call = UnixStream;

    async fn call(&self) -> Result<Option<(UnixStream, CarrierPeer)>, ClassFault> {
        let stream = match UnixStream::connect(&self.socket).await {
            Ok(stream) => stream,
            Err(error) => return not_connected(&self.socket, error).map_or(Ok(None), Err),
        };
        let Ok(cred) = stream.peer_cred() else {
            return Ok(None);
        };
        self.check(cred.uid())?;
        let user = user_name(cred.uid());
        Ok(Some((stream, CarrierPeer { user })))
    }

    fn keep_to(&mut self, desk: &CarrierPeer) {
        if self.is_passing {
            // Anybody could open a place of this name once its folder is gone.
            self.instructor = Some(desk.user.clone());
        }
    }

    async fn pass(
        &self,
        call: UnixStream,
        lines: mpsc::Receiver<String>,
        arrived: &mpsc::Sender<SeatArrival<M>>,
    ) {
        let (read, write) = call.into_split();
        tokio::select! {
            biased;
            // What was said last, such as a farewell, is written before the connection closes.
            () = exchange(read, write, lines, arrived, SeatArrival::Line) => {}
            () = arrived.closed() => {}
        }
    }
}

/// Why no desk can ever answer there; `None` if one may open later.
fn not_connected(socket: &Path, error: io::Error) -> Option<ClassFault> {
    let is_other = fs::metadata(socket).is_ok_and(|found| !found.file_type().is_socket());
    let fault = if is_other {
        SocketFault::NoSocket
    } else if error.kind() == io::ErrorKind::PermissionDenied {
        SocketFault::Io(error)
    } else {
        return None;
    };
    let socket = socket.to_owned();
    Some(ClassFault::Socket { socket, fault })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_user_takes_only_so_many_places_and_nobody_more_than_there_are() {
        let places = Places::default();
        let own = geteuid().as_raw();
        let of_other: Vec<_> = (0..=OF_ONE_USER).map(|_| places.take(own + 1)).collect();
        let taken = of_other.iter().filter(|it| it.is_some()).count();
        assert_eq!(taken, OF_ONE_USER);
        let of_own: Vec<_> = (0..=SEATS).map(|_| places.take(own)).collect();
        let taken = of_own.iter().filter(|it| it.is_some()).count();
        assert_eq!(taken, SEATS - OF_ONE_USER);
        drop(of_other);
        assert!(places.take(own + 1).is_some());
    }
}
