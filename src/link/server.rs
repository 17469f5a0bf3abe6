//! `tcpin`: many clients on one listening port.

use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use futures_util::stream::{FuturesUnordered, StreamExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::time::timeout;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::core::{ConnectionEnd, LinkCore, LinkWork};
use super::peer::{PeerStream, StreamEnding};
use super::stream::{PAUSE, READ_LEN};
use super::{LinkPeer, Parcel, To};
use crate::text;

/// The maximum number of clients; others wait in the listener's queue.
const CLIENT_CAP: usize = 256;
/// The maximum number of bytes queued for a client that does not read.
const OUTPUT_CAP: usize = 64 * 1024;

#[derive(Debug)]
struct TcpClient {
    socket: Arc<TcpStream>,
    stream: PeerStream,
    output: Vec<u8>,
    /// Ends the wait for room to write when the client is dropped.
    gone: DropGuard,
    awaits_room: bool,
}

/// Carries data until the listener fails. The function is long because a `select!` cannot be
/// divided.
pub(super) async fn session(link: &mut LinkCore, listener: TcpListener) -> ConnectionEnd {
    let mut clients = BTreeMap::new();
    let mut next = 0;
    let mut input = vec![0; READ_LEN];
    let mut readable = FuturesUnordered::new();
    let mut writable = FuturesUnordered::new();
    loop {
        tokio::select! {
            biased;
            work = link.next_work(true) => match work {
                LinkWork::End => return ConnectionEnd::Cancelled,
                LinkWork::Nothing => {}
                LinkWork::Send(batch) => {
                    encode(link, &mut clients, &batch);
                    let flushed = clients.iter_mut().filter_map(|(&peer, c)| c.flush(peer));
                    writable.extend(flushed);
                }
            },
            Some(peer) = writable.next() => {
                if let Some(client) = clients.get_mut(&peer) {
                    client.awaits_room = false;
                    writable.extend(client.flush(peer));
                }
            }
            accepted = listener.accept(), if clients.len() < CLIENT_CAP => match accepted {
                Ok((socket, from)) => {
                    let peer = LinkPeer(next);
                    link.meter.tap.name_peer(peer, from);
                    next += 1;
                    let socket = Arc::new(socket);
                    readable.push(wait_for_data(peer, Arc::clone(&socket), None));
                    let stream = PeerStream::new(&link.config, peer);
                    clients.insert(peer, TcpClient::new(socket, stream));
                    link.meter.set_peers(clients.len());
                }
                Err(error) if error.kind() == io::ErrorKind::ConnectionAborted => {}
                Err(error) => return ConnectionEnd::Lost(text!("transport-no-clients", error = error.to_string())),
            },
            Some((peer, has_data)) = readable.next(), if link.may_read() => {
                let client = clients.get_mut(&peer);
                if let Some(wait) = client.and_then(|c| c.read(peer, has_data, &mut input, link)) {
                    readable.push(wait_for_data(peer, wait.0, wait.1));
                } else {
                    clients.remove(&peer);
                    link.meter.set_peers(clients.len());
                }
            }
        }
    }
}

fn encode(
    link: &mut LinkCore,
    clients: &mut BTreeMap<LinkPeer, TcpClient>,
    batch: &[(To, Parcel)],
) {
    for (to, parcel) in batch {
        match to {
            To::Everyone => {
                for client in clients.values_mut() {
                    client.encode(parcel, link);
                }
            }
            To::EveryoneBut(one) => {
                for (_, client) in clients.iter_mut().filter(|(peer, _)| *peer != one) {
                    client.encode(parcel, link);
                }
            }
            To::Peer(peer) => match clients.get_mut(peer) {
                Some(client) => client.encode(parcel, link),
                None => link.meter.dropped(1),
            },
        }
    }
}

impl TcpClient {
    fn new(socket: Arc<TcpStream>, stream: PeerStream) -> Self {
        // Without this option, messages are late, but not lost.
        let _ = socket.set_nodelay(true);
        Self {
            socket,
            stream,
            output: Vec::new(),
            gone: CancellationToken::new().drop_guard(),
            awaits_room: false,
        }
    }

    fn encode(&mut self, parcel: &Parcel, link: &mut LinkCore) {
        if self.output.len() >= OUTPUT_CAP {
            link.meter.dropped(1);
            return;
        }
        let before = self.output.len();
        self.stream.encode(parcel, &mut self.output, &link.meter);
        link.meter.sent(1, self.output.len() - before);
    }

    /// Writes as much as the socket accepts, and returns a wait for the rest, if any. A broken connection is detected
    /// on reading.
    fn flush(&mut self, peer: LinkPeer) -> Option<impl Future<Output = LinkPeer> + use<>> {
        while !self.output.is_empty() && !self.awaits_room {
            match self.socket.try_write(&self.output) {
                Ok(count) => drop(self.output.drain(..count)),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                    self.awaits_room = true;
                    let gone = self.gone.token().clone();
                    return Some(wait_for_room(peer, gone, Arc::clone(&self.socket)));
                }
                Err(_) => self.output.clear(),
            }
        }
        None
    }

    /// Reads available bytes, and returns the next wait: for the socket, with a time-out that marks a pause. `None`
    /// when the client has left.
    fn read(
        &mut self,
        peer: LinkPeer,
        has_data: bool,
        input: &mut [u8],
        link: &mut LinkCore,
    ) -> Option<(Arc<TcpStream>, Option<Duration>)> {
        let mut patience = Some(PAUSE);
        let frames = if has_data {
            match self.socket.try_read(input) {
                Ok(0) => return None,
                Ok(len) => self
                    .stream
                    .receive(&input[..len], StreamEnding::Open, &mut link.meter),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => Vec::new(),
                Err(_) => return None,
            }
        } else {
            patience = None;
            self.stream
                .receive(&[], StreamEnding::Closed, &mut link.meter)
        };
        link.deliver(peer, frames);
        Some((Arc::clone(&self.socket), patience))
    }
}

/// Waits for a client's data, or for a pause of `patience`.
async fn wait_for_data(
    peer: LinkPeer,
    socket: Arc<TcpStream>,
    patience: Option<Duration>,
) -> (LinkPeer, bool) {
    match patience {
        None => (peer, socket.readable().await.is_ok()),
        Some(patience) => (peer, timeout(patience, socket.readable()).await.is_ok()),
    }
}

/// Waits until a client accepts more, or is dropped.
async fn wait_for_room(
    peer: LinkPeer,
    gone: CancellationToken,
    socket: Arc<TcpStream>,
) -> LinkPeer {
    let _ = gone.run_until_cancelled(socket.writable()).await;
    peer
}
