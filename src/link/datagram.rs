//! Links over UDP, where every remote address is a separate peer.

use std::collections::BTreeMap;
use std::io;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::net::UdpSocket;
use tokio::time::{Instant, sleep_until};

use super::core::{ConnectionEnd, LinkCore, LinkWork};
use super::meter::LinkMeter;
use super::peer::{PeerStream, StreamEnding};
use super::stream::PAUSE;
use super::{LinkConfig, LinkPeer, Parcel, To};
use crate::text;
use crate::text::Text;
use crate::wire::Frame;

/// The longest possible datagram, in bytes.
const DATAGRAM_LEN: usize = 65_536;
/// The maximum number of peers, since sender addresses can be forged.
const PEER_CAP: usize = 1024;
/// The maximum number of unknown senders for which half a frame is kept, since a bridge may cut
/// every frame; and the silence after which a peer may be replaced.
const STRANGER_CAP: usize = 16;
const STALE: Duration = Duration::from_secs(10);

/// Carries data until the socket fails. Messages for everyone go to `target` if there is one, otherwise to all known
/// peers.
pub(super) async fn session(
    link: &mut LinkCore,
    socket: UdpSocket,
    target: Option<SocketAddr>,
) -> ConnectionEnd {
    let mut peers = Peers::new(link.config, target);
    let mut input = vec![0; DATAGRAM_LEN];
    loop {
        let pause = peers.next_pause();
        tokio::select! {
            biased;
            work = link.next_work(true) => match work {
                LinkWork::End => return ConnectionEnd::Cancelled,
                LinkWork::Nothing => {}
                LinkWork::Send(batch) => {
                    for (to, parcel) in &batch {
                        peers.send(&socket, *to, parcel, &mut link.meter).await;
                    }
                }
            },
            received = socket.recv_from(&mut input), if link.may_read() => match received {
                Ok((len, from)) => {
                    let found = peers.receive(from, &input[..len], StreamEnding::Datagram, &mut link.meter);
                    if let Some((peer, frames)) = found {
                        link.deliver(peer, frames);
                    }
                }
                Err(error) if is_icmp(&error) => {}
                Err(error) => return ConnectionEnd::Lost(text!("transport-udp-failed", error = error.to_string())),
            },
            from = paused(pause), if link.may_read() => {
                if let Some((peer, frames)) = peers.receive(from, &[], StreamEnding::Closed, &mut link.meter) {
                    link.deliver(peer, frames);
                }
            }
        }
    }
}

/// Waits until a sender has paused and returns it; forever if no half frame is waiting.
async fn paused(pause: Option<(Instant, SocketAddr)>) -> SocketAddr {
    match pause {
        Some((at, from)) => {
            sleep_until(at).await;
            from
        }
        None => std::future::pending().await,
    }
}

/// Whether the error only means that a peer's port is currently closed.
fn is_icmp(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::ConnectionRefused | io::ErrorKind::ConnectionReset
    )
}

#[derive(Debug)]
struct Peers {
    config: LinkConfig,
    by_address: BTreeMap<SocketAddr, LinkPeer>,
    all: BTreeMap<LinkPeer, DatagramPeer>,
    /// Senders of half a frame that have not sent an intact one yet.
    strangers: BTreeMap<SocketAddr, PeerStream>,
    /// Senders whose last datagram ended inside a frame, with its time.
    tails: BTreeMap<SocketAddr, Instant>,
    next: u32,
    target: Option<LinkPeer>,
    sending_fails: bool,
}

#[derive(Debug)]
struct DatagramPeer {
    address: SocketAddr,
    stream: PeerStream,
    heard_at: Option<Instant>,
}

impl Peers {
    fn new(config: LinkConfig, target: Option<SocketAddr>) -> Self {
        let mut peers = Self {
            config,
            by_address: BTreeMap::new(),
            all: BTreeMap::new(),
            strangers: BTreeMap::new(),
            tails: BTreeMap::new(),
            next: 0,
            target: None,
            sending_fails: false,
        };
        peers.target = target.map(|address| {
            peers.admit(DatagramPeer {
                address,
                stream: PeerStream::new(&config, LinkPeer(0)),
                heard_at: None,
            })
        });
        peers
    }

    /// The time at which the next sender counts as paused, and its address; `None` if no half frame
    /// is waiting.
    fn next_pause(&self) -> Option<(Instant, SocketAddr)> {
        let pause = |(&from, &at): (&SocketAddr, &Instant)| (at + PAUSE, from);
        self.tails.iter().map(pause).min()
    }

    /// Handles a datagram, or a pause after one. An unknown sender becomes a peer with its first
    /// intact frame.
    fn receive(
        &mut self,
        from: SocketAddr,
        bytes: &[u8],
        ending: StreamEnding,
        meter: &mut LinkMeter,
    ) -> Option<(LinkPeer, Vec<Frame>)> {
        let now = Instant::now();
        self.tails.remove(&from);
        let known = self.by_address.get(&from).copied();
        if let Some(peer) = known
            && let Some(remote) = self.all.get_mut(&peer)
        {
            let frames = remote.stream.receive(bytes, ending, meter);
            if remote.stream.has_tail() {
                self.tails.insert(from, now);
            }
            if frames.iter().any(Frame::is_verified) && remote.heard_at.replace(now).is_none() {
                meter.set_peers(self.heard());
            }
            return Some((peer, frames));
        }
        self.receive_from_stranger(from, bytes, ending, meter)
    }

    fn receive_from_stranger(
        &mut self,
        from: SocketAddr,
        bytes: &[u8],
        ending: StreamEnding,
        meter: &mut LinkMeter,
    ) -> Option<(LinkPeer, Vec<Frame>)> {
        let now = Instant::now();
        let known = self.strangers.remove(&from);
        // If the sender becomes a peer, it will have this number.
        let mut stream =
            known.unwrap_or_else(|| PeerStream::new(&self.config, LinkPeer(self.next)));
        stream.belongs_to(LinkPeer(self.next));
        let ending = match self.strangers.len() {
            STRANGER_CAP.. => StreamEnding::Closed,
            _ => ending,
        };
        let frames = stream.receive(bytes, ending, meter);
        let is_peer = frames.iter().any(Frame::is_verified) && self.has_room(now);
        if stream.has_tail() {
            self.tails.insert(from, now);
        }
        if !is_peer {
            if stream.has_tail() {
                self.strangers.insert(from, stream);
            }
            return None;
        }
        let peer = self.admit(DatagramPeer {
            address: from,
            stream,
            heard_at: Some(now),
        });
        meter.tap.name_peer(peer, from);
        meter.set_peers(self.heard());
        Some((peer, frames))
    }

    fn heard(&self) -> usize {
        let heard = |remote: &&DatagramPeer| remote.heard_at.is_some();
        self.all.values().filter(heard).count()
    }

    fn admit(&mut self, remote: DatagramPeer) -> LinkPeer {
        let peer = LinkPeer(self.next);
        self.next = self.next.wrapping_add(1);
        self.by_address.insert(remote.address, peer);
        self.all.insert(peer, remote);
        peer
    }

    /// Makes room for one more peer, unless all are active.
    fn has_room(&mut self, now: Instant) -> bool {
        if self.all.len() < PEER_CAP {
            return true;
        }
        let quietest = self
            .all
            .iter()
            .filter_map(|(&peer, remote)| Some((remote.heard_at?, peer)))
            .filter(|&(_, peer)| Some(peer) != self.target)
            .min();
        match quietest {
            Some((heard_at, peer)) if now - heard_at > STALE => {
                if let Some(gone) = self.all.remove(&peer) {
                    self.by_address.remove(&gone.address);
                    self.tails.remove(&gone.address);
                }
                true
            }
            _ => false,
        }
    }

    async fn send(&mut self, socket: &UdpSocket, to: To, parcel: &Parcel, meter: &mut LinkMeter) {
        let (one, without) = match to {
            To::Peer(peer) => (Some(peer), None),
            To::Everyone => (self.target, None),
            To::EveryoneBut(peer) => (self.target, Some(peer)),
        };
        let Some(peer) = one else {
            for (_, remote) in self
                .all
                .iter_mut()
                .filter(|(peer, _)| Some(**peer) != without)
            {
                let sent = remote.send(socket, parcel, meter).await;
                note(sent, &mut self.sending_fails, meter);
            }
            return;
        };
        if Some(peer) == without {
            return;
        }
        match self.all.get_mut(&peer) {
            Some(remote) => {
                let sent = remote.send(socket, parcel, meter).await;
                note(sent, &mut self.sending_fails, meter);
            }
            None => meter.dropped(1),
        }
    }
}

impl DatagramPeer {
    async fn send(
        &mut self,
        socket: &UdpSocket,
        parcel: &Parcel,
        meter: &mut LinkMeter,
    ) -> Result<(), Text> {
        let mut datagram = Vec::new();
        self.stream.encode(parcel, &mut datagram, meter);
        match socket.send_to(&datagram, self.address).await {
            Ok(len) => meter.sent(1, len),
            Err(error) if is_icmp(&error) => meter.sent(1, datagram.len()),
            Err(error) => {
                meter.dropped(1);
                return Err(text!(
                    "transport-cannot-send",
                    address = self.address.to_string(),
                    error = error.to_string()
                ));
            }
        }
        Ok(())
    }
}

/// Publishes a failure to send while it lasts.
fn note(sent: Result<(), Text>, sending_fails: &mut bool, meter: &mut LinkMeter) {
    let failed = sent.is_err();
    if failed || *sending_fails {
        meter.complain(sent.err());
    }
    *sending_fails = failed;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::tests::{heartbeat, meter};
    use tokio::time::advance;

    fn stranger(number: usize) -> SocketAddr {
        let [high, low] = (number as u16).to_be_bytes();
        ([10, 0, high, low], 14550).into()
    }

    #[tokio::test(start_paused = true)]
    async fn forged_senders_fill_no_memory_and_displace_only_the_silent() {
        let mut meter = meter();
        let target = stranger(60_000);
        let mut peers = Peers::new(LinkConfig::default(), Some(target));
        let mut receive = |number, bytes: &[u8]| {
            let found = peers.receive(stranger(number), bytes, StreamEnding::Datagram, &mut meter);
            (found.map(|(peer, _)| peer), peers.all.len())
        };
        assert_eq!(receive(0, b"noise"), (None, 1), "noise makes no peer");
        for number in 1..PEER_CAP {
            let peer = LinkPeer(number as u32);
            assert_eq!(receive(number, &heartbeat(1)), (Some(peer), number + 1));
        }
        assert_eq!(
            receive(5000, &heartbeat(1)),
            (None, PEER_CAP),
            "everybody is in use"
        );
        advance(Duration::from_secs(8)).await;
        receive(1, &heartbeat(1));
        advance(Duration::from_secs(3)).await;
        let newcomer = LinkPeer(PEER_CAP as u32);
        assert_eq!(receive(5000, &heartbeat(1)), (Some(newcomer), PEER_CAP));
        assert_eq!(
            receive(1, &heartbeat(1)).0,
            Some(LinkPeer(1)),
            "1 has been heard lately"
        );
        assert_eq!(
            receive(60_000, &heartbeat(1)).0,
            Some(LinkPeer(0)),
            "the target stays"
        );
        assert_ne!(
            receive(2, &heartbeat(1)).0,
            Some(LinkPeer(2)),
            "2 was silent for longest"
        );
        assert_eq!(peers.by_address.len(), PEER_CAP);
    }

    #[tokio::test(start_paused = true)]
    async fn half_frames_of_forged_senders_fill_no_memory() {
        let mut meter = meter();
        let mut peers = Peers::new(LinkConfig::default(), None);
        for number in 0..1000 {
            let from = stranger(number);
            assert_eq!(
                peers.receive(from, &[0xFD, 9], StreamEnding::Datagram, &mut meter),
                None
            );
        }
        assert_eq!(
            (peers.strangers.len(), peers.tails.len()),
            (STRANGER_CAP, STRANGER_CAP)
        );
        advance(PAUSE).await;
        while let Some((at, from)) = peers.next_pause() {
            assert!(at <= Instant::now());
            assert_eq!(
                peers.receive(from, &[], StreamEnding::Closed, &mut meter),
                None
            );
        }
        assert_eq!(peers.strangers.len(), 0);
    }
}
