//! Links shared with other ground stations, over pipes to vehicles and real sockets to stations.

use std::net::SocketAddr;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, MavCmd, STATUSTEXT_DATA,
};
use tokio::net::{TcpSocket, TcpStream, UdpSocket};

use super::*;
use crate::forward::{Deed, ForwardSpec, NamedCommand};
use crate::ledger::StationId;
use crate::wire::{MavAddress, SigningKey, Stamp};

const OWN: MavAddress = MavAddress {
    system: 255,
    component: 190,
};

/// A console whose links are pipes, with forwards.
struct Shared {
    own: MavAddress,
    relay: Relay,
    news: mpsc::Receiver<StationNews>,
    /// The console's ends of its links, and the vehicles' ends.
    links: Vec<LinkHandle>,
    vehicles: Vec<Far<DuplexStream>>,
    inbound: mpsc::Sender<Inbound>,
    cancel: CancellationToken,
}

/// The other end of a connection.
struct Far<S> {
    stream: S,
    decoder: Decoder,
    encoder: Encoder,
}

impl<S: tokio::io::AsyncRead + tokio::io::AsyncWrite + Unpin> Far<S> {
    fn new(stream: S, system: u8) -> Self {
        Self {
            stream,
            decoder: Decoder::new(),
            encoder: Encoder::new(system, 1),
        }
    }

    async fn say(&mut self, outgoing: &Outgoing) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.encoder.encode(outgoing, &mut bytes);
        self.stream.write_all(&bytes).await.expect("writable");
        bytes
    }

    /// The next frame of a sender.
    async fn next(&mut self, system: u8) -> Frame {
        let wanted = |frame: &Frame| frame.system == system;
        read_frame(&mut self.stream, &mut self.decoder, wanted).await
    }

    /// The next frame of a sender with this message, and its bytes.
    async fn hear(&mut self, system: u8, id: u32) -> (Frame, Vec<u8>) {
        let wanted = |frame: &Frame| frame.system == system && frame.content.id() == id;
        let frame = read_frame(&mut self.stream, &mut self.decoder, wanted).await;
        let bytes = self.decoder.bytes_of(&frame).to_vec();
        (frame, bytes)
    }
}

impl Shared {
    fn new() -> Self {
        Self::with_address(OWN)
    }

    fn with_address(own: MavAddress) -> Self {
        let (news, news_out) = mpsc::channel(64);
        let (inbound, mut drained) = mpsc::channel(64);
        tokio::spawn(async move { while drained.recv().await.is_some() {} });
        Self {
            own,
            relay: Relay::new(own, news),
            news: news_out,
            links: Vec::new(),
            vehicles: Vec::new(),
            inbound,
            cancel: CancellationToken::new(),
        }
    }

    fn add_vehicle(&mut self) {
        let (ours, theirs) = tokio::io::duplex(256 * 1024);
        self.add_link(Transport::Pipe(ours));
        let system = self.vehicles.len() as u8 + 1;
        self.vehicles.push(Far::new(theirs, system));
    }

    fn add_link(&mut self, transport: Transport) {
        let id = LinkId(self.links.len() as u16);
        let (inbound, cancel) = (self.inbound.clone(), self.cancel.clone());
        let services = LinkServices {
            sink: None,
            relay: &self.relay,
            signer: None,
            system: self.own.system,
        };
        let link = open_shared(id, transport, services, inbound, cancel);
        self.links.push(link);
    }

    /// Opens a forward and waits until it is up.
    async fn forward(&self, number: u16, words: &str) -> (LinkHandle, SocketAddr) {
        let spec: ForwardSpec = words.parse().expect("a forward");
        let address = spec.address.parse().expect("an address");
        let (inbound, cancel) = (self.inbound.clone(), self.cancel.clone());
        let link = open_forward(LinkId(number), address, spec, &self.relay, inbound, cancel);
        let mut status = link.status();
        let up = status.wait_for(|status| status.state == LinkState::Up);
        let up = timeout(Duration::from_secs(20), up).await.expect("in time");
        let local = up.expect("published").local.expect("a socket");
        (link, local)
    }

    /// A station that has been heard, and hears the vehicles.
    async fn station(&mut self, at: SocketAddr, system: u8) -> Far<TcpStream> {
        let mut station = Far::new(TcpStream::connect(at).await.expect("connected"), system);
        station.say(&beat(system)).await;
        self.vehicles[0].hear(system, 0).await;
        for number in 1..=self.vehicles.len() as u8 {
            self.vehicles[usize::from(number) - 1]
                .say(&beat(number))
                .await;
            station.hear(number, 0).await;
        }
        station
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

/// A heartbeat whose content differs by number.
fn beat(number: u8) -> Outgoing {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        custom_mode: number.into(),
        ..HEARTBEAT_DATA::default()
    })
    .into()
}

fn takeoff(system: u8) -> Outgoing {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_NAV_TAKEOFF,
        target_system: system,
        target_component: 1,
        ..COMMAND_LONG_DATA::default()
    })
    .into()
}

fn answer(system: u8) -> Outgoing {
    MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command: MavCmd::MAV_CMD_NAV_TAKEOFF,
        target_system: system,
        target_component: 1,
        ..COMMAND_ACK_DATA::default()
    })
    .into()
}

fn text(number: u16) -> Outgoing {
    MavMessage::STATUSTEXT(STATUSTEXT_DATA {
        id: number,
        ..STATUSTEXT_DATA::default()
    })
    .into()
}

#[tokio::test]
async fn stations_use_the_links_both_ways_and_each_frame_stays_as_it_was() {
    let mut shared = Shared::new();
    shared.add_vehicle();
    shared.add_vehicle();
    let (_forward, at) = shared.forward(0, "tcpin:127.0.0.1:0").await;
    let mut one = shared.station(at, 254).await;
    let mut other = shared.station(at, 253).await;
    // The other station hears the first one, which does not hear itself.
    one.say(&beat(9)).await;
    other.hear(254, 0).await;
    // A signed frame of a vehicle stays signed.
    let key: SigningKey = [7; 32];
    shared.vehicles[1].encoder.sign_next(
        &key,
        Stamp {
            link: 0,
            timestamp: 5,
        },
    );
    let sent = shared.vehicles[1].say(&text(50)).await;
    for station in [&mut one, &mut other] {
        let (frame, heard) = station.hear(2, 253).await;
        assert!(frame.seal.is_signature());
        assert_eq!(heard, sent);
    }
    // A command goes to its vehicle alone, and the answer to its sender alone.
    let sent = one.say(&takeoff(2)).await;
    assert_eq!(shared.vehicles[1].hear(254, 76).await.1, sent);
    let news = shared.news.recv().await.expect("reported");
    assert_eq!(
        news.station,
        StationId(MavAddress {
            system: 254,
            component: 1
        })
    );
    assert_eq!(news.system, Some(2));
    let named = |name: &str| NamedCommand {
        number: MavCmd::MAV_CMD_NAV_TAKEOFF as u16,
        name: name.to_owned(),
    };
    assert_eq!(news.deed, Deed::Command(named("NAV_TAKEOFF")));
    shared.vehicles[1].say(&answer(254)).await;
    shared.vehicles[1].say(&text(1)).await;
    one.hear(2, 77).await;
    let next = read_frame(&mut other.stream, &mut other.decoder, |frame| {
        frame.system == 2
    });
    assert_eq!(
        next.await.content.id(),
        253,
        "the answer was for the first station"
    );
    one.say(&text(7)).await;
    let next = shared.vehicles[0].next(254);
    assert!(is_heartbeat(&next.await), "the second heartbeat");
    let next = shared.vehicles[0].next(254);
    assert_eq!(
        next.await.content.id(),
        253,
        "the command was for vehicle 2"
    );
    // Both stations see the console's own commands, and no vehicle is asked to carry them out twice.
    assert!(shared.links[0].send(To::Everyone, takeoff(1)));
    shared.vehicles[0].hear(255, 76).await;
    one.hear(255, 76).await;
    other.hear(255, 76).await;
}

#[tokio::test]
async fn commands_from_the_own_address_of_the_console_are_passed_on_without_a_report() {
    let mut shared = Shared::new();
    shared.add_vehicle();
    let (_forward, at) = shared.forward(0, "tcpin:127.0.0.1:0").await;
    let mut twin = Far::new(TcpStream::connect(at).await.expect("connected"), OWN.system);
    twin.encoder = Encoder::new(OWN.system, OWN.component);
    twin.say(&beat(OWN.system)).await;
    shared.vehicles[0].hear(OWN.system, 0).await;
    shared.vehicles[0].say(&beat(1)).await;
    twin.hear(1, 0).await;
    twin.say(&takeoff(1)).await;
    shared.vehicles[0].hear(OWN.system, 76).await;
    // The next report is that of another station.
    let mut other = shared.station(at, 254).await;
    other.say(&takeoff(1)).await;
    let news = shared.news.recv().await.expect("reported");
    assert_eq!(news.station.0.system, 254);
}

#[tokio::test]
async fn a_read_only_forward_carries_nothing_back_and_filters_leave_answers_alone() {
    let mut shared = Shared::new();
    shared.add_vehicle();
    let (_open, open_at) = shared.forward(0, "tcpin:127.0.0.1:0 only ATTITUDE").await;
    let (_closed, closed_at) = shared
        .forward(1, "tcpin:127.0.0.1:0 read-only except 0,30")
        .await;
    let mut commander = shared.station(open_at, 254).await;
    let mut watcher = Far::new(TcpStream::connect(closed_at).await.expect("connected"), 253);
    watcher.say(&takeoff(1)).await;
    while shared.relay.counts(LinkId(1)).held_back == 0 {
        tokio::task::yield_now().await;
    }
    commander.say(&takeoff(1)).await;
    let vehicle = &mut shared.vehicles[0];
    let heard = read_frame(&mut vehicle.stream, &mut vehicle.decoder, |it| {
        it.content.id() == 76
    });
    assert_eq!(
        heard.await.system,
        254,
        "the watcher's command was held back"
    );
    vehicle.say(&text(1)).await;
    vehicle.say(&answer(254)).await;
    let next = read_frame(&mut commander.stream, &mut commander.decoder, |it| {
        it.system == 1
    });
    assert_eq!(
        next.await.content.id(),
        77,
        "the text was filtered, the answer was not"
    );
    watcher.hear(1, 253).await;
    assert!(shared.relay.counts(LinkId(0)).filtered >= 1);
    shared.relay.remove_forward(LinkId(1));
    assert_eq!(shared.relay.counts(LinkId(1)), ForwardCounts::default());
}

#[tokio::test]
async fn a_station_that_never_reads_costs_the_others_nothing() {
    /// More than the buffers of the operating system hold: 6 MB.
    const FRAMES: u16 = 24_000;
    let mut shared = Shared::new();
    shared.add_vehicle();
    let (forward, at) = shared.forward(0, "tcpin:127.0.0.1:0").await;
    let small = TcpSocket::new_v4().expect("a socket");
    small.set_recv_buffer_size(4096).expect("a size");
    let _stopped = small.connect(at).await.expect("connected");
    let mut reader = shared.station(at, 254).await;
    let vehicle = &mut shared.vehicles[0];
    for number in 0..FRAMES {
        let [low, high] = number.to_le_bytes();
        let mut payload = vec![0xFF; 255];
        (payload[0], payload[1]) = (low, high);
        // ENCAPSULATED_DATA, the longest message.
        vehicle.say(&Outgoing::Raw { id: 131, payload }).await;
        if number % 64 == 0 {
            // The reader gets everything in time while the other station is stuck.
            vehicle.say(&answer(254)).await;
            reader.hear(1, 77).await;
        }
    }
    let mut status = forward.status();
    let dropped = status.wait_for(|status| status.dropped_out > 0);
    let dropped = timeout(Duration::from_secs(20), dropped).await;
    dropped.expect("counted").expect("published");
    let is_free = shared.links[0].send(To::Everyone, takeoff(1));
    assert!(is_free, "the vehicle's link has room");
    shared.vehicles[0].hear(255, 76).await;
}

#[tokio::test]
async fn a_forward_sends_as_the_console_does() {
    let mut shared = Shared::with_address(MavAddress { system: 250, ..OWN });
    shared.add_vehicle();
    let (_forward, at) = shared.forward(0, "tcpin:127.0.0.1:0").await;
    let mut station = Far::new(TcpStream::connect(at).await.expect("connected"), 254);
    let frame = station.hear(250, 0).await.0;
    assert_eq!(frame.component, OWN.component);
}

#[tokio::test]
async fn own_frames_that_come_back_over_a_link_show_a_loop() {
    let mut shared = Shared::new();
    shared.add_vehicle();
    let (_forward, at) = shared.forward(0, "tcpin:127.0.0.1:0").await;
    let mut station = Far::new(TcpStream::connect(at).await.expect("connected"), 254);
    let (link, peer) = (LinkId(0), LinkPeer(0));
    for number in 0..2 {
        assert!(!shared.relay.is_loop(link, peer), "{number} frames");
        let own = station.hear(255, 0).await.1;
        let vehicle = &mut shared.vehicles[0];
        vehicle.stream.write_all(&own).await.expect("writable");
        vehicle.say(&beat(number)).await;
        station.hear(1, 0).await;
    }
    assert!(shared.relay.is_loop(link, peer));
}

#[tokio::test]
async fn two_consoles_that_forward_to_each_other_make_no_storm() {
    let (mut one, mut two) = (Shared::new(), Shared::new());
    one.add_vehicle();
    // Console 2 has the vehicle of console 1 as its own, and forwards it back twice.
    let (first, at_one) = one.forward(0, "udpin:127.0.0.1:0").await;
    let (second, at_one_again) = one.forward(1, "udpin:127.0.0.1:0").await;
    two.add_link(Transport::Address(
        format!("udp:{at_one}").parse().expect("an address"),
    ));
    let (_back, _) = two.forward(0, &format!("udp:{at_one_again}")).await;
    let (_echo, _) = two.forward(1, &format!("udp:{at_one}")).await;
    let watcher = UdpSocket::bind("127.0.0.1:0").await.expect("bound");
    let watched = watcher.local_addr().expect("bound");
    let (_watch, _) = two.forward(2, &format!("udp:{watched}")).await;
    let peers = |count: usize| move |status: &LinkStatus| status.peers >= count;
    let (mut first_status, mut second_status) = (first.status(), second.status());
    for (status, count) in [(&mut first_status, 2), (&mut second_status, 1)] {
        let there = timeout(Duration::from_secs(20), status.wait_for(peers(count))).await;
        there.expect("in time").expect("published");
    }
    for number in 0..100 {
        one.vehicles[0].say(&text(number)).await;
    }
    one.vehicles[0].say(&text(100)).await;
    let mut seen = Vec::new();
    let mut decoder = Decoder::new();
    let mut datagram = [0; 2048];
    while !seen.contains(&100) {
        let read = timeout(Duration::from_secs(20), watcher.recv(&mut datagram)).await;
        decoder.push(&datagram[..read.expect("in time").expect("readable")]);
        while let Some(frame) = decoder.next_frame() {
            if let Content::Message(MavMessage::STATUSTEXT(data)) = frame.content {
                seen.push(data.id);
            }
        }
    }
    assert_eq!(seen, (0..=100).collect::<Vec<u16>>(), "each once");
    // Console 1 receives its own vehicle's frames again, and the command that console 2 echoes, but
    // passes neither on again.
    let arm = takeoff(1);
    assert!(two.links[0].send(To::Everyone, arm));
    one.vehicles[0].hear(255, 76).await;
    one.vehicles[0].say(&beat(3)).await;
    one.vehicles[0].say(&text(101)).await;
    let repeated = || one.relay.counts(LinkId(0)).repeated + one.relay.counts(LinkId(1)).repeated;
    let waiting = async {
        while repeated() < 101 {
            tokio::task::yield_now().await;
        }
    };
    timeout(Duration::from_secs(20), waiting)
        .await
        .expect("the echoes came back");
    let passed: u64 = [&first, &second]
        .map(|link| link.status().borrow().sent_messages)
        .iter()
        .sum();
    assert!(passed < 1000, "{passed} messages for 102 of the vehicle");
}
