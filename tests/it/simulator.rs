//! The simulator's server over real sockets, with ground stations that misbehave.

use std::io::ErrorKind;
use std::net::SocketAddr;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MavCmd, MavMessage, PARAM_REQUEST_LIST_DATA, SETUP_SIGNING_DATA,
};
use rand::{Rng as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use sortie::geo::LatLon;
use sortie::link::{Endpoint, Simulator, StartedSimulator};
use sortie::sim::{Start, World, WorldConfig};
use sortie::wire::{Content, Decoder, Encoder, Frame, Outgoing, Stamp};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_util::sync::{CancellationToken, DropGuard};

/// A limit far beyond the duration of any step here.
const PATIENCE: Duration = Duration::from_secs(60);

/// A simulator on free ports of this machine; it ends with the test.
struct Server {
    started: StartedSimulator,
    _end: DropGuard,
}

impl Server {
    async fn start(vehicles: usize) -> Self {
        let first = Start {
            at: LatLon::new(50.0, 30.0),
            altitude_amsl_m: 100.0,
            heading_deg: 0.0,
        };
        let endpoint = Endpoint::Tcp {
            host: "127.0.0.1".into(),
            port: 0,
        };
        let world = World::new(&WorldConfig::row(vehicles, first));
        let cancel = CancellationToken::new();
        let started = Simulator::start(world, 5.0, &[endpoint], cancel.clone()).await;
        Self {
            started: started.expect("the simulator starts"),
            _end: cancel.drop_guard(),
        }
    }

    fn address(&self, vehicle: usize) -> SocketAddr {
        self.started.addresses[vehicle]
    }

    async fn connections(&mut self, wanted: usize) {
        let waiting = self.started.connections.wait_for(|count| *count == wanted);
        let found = timeout(PATIENCE, waiting).await;
        found
            .unwrap_or_else(|_| panic!("never {wanted} connections"))
            .expect("the simulator runs");
    }
}

/// A ground station that follows the protocol.
struct Station {
    stream: TcpStream,
    encoder: Encoder,
    decoder: Decoder,
}

impl Station {
    async fn connect(address: SocketAddr) -> Self {
        let stream = TcpStream::connect(address).await.expect("it listens");
        Self {
            stream,
            encoder: Encoder::new(255, 190),
            decoder: Decoder::new(),
        }
    }

    async fn say(&mut self, message: MavMessage) {
        let mut bytes = Vec::new();
        self.encoder.encode_message(&message, &mut bytes);
        self.stream.write_all(&bytes).await.expect("it reads");
    }

    async fn order(&mut self, command: MavCmd, p: [f32; 2]) {
        self.say(MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            command,
            param1: p[0],
            param2: p[1],
            target_system: 0,
            target_component: 1,
            ..Default::default()
        }))
        .await;
    }

    /// The next frame; `None` when the vehicle has closed the connection.
    async fn next(&mut self) -> Option<Frame> {
        let mut bytes = [0; 4096];
        loop {
            if let Some(frame) = self.decoder.next_frame() {
                return Some(frame);
            }
            let read = timeout(PATIENCE, self.stream.read(&mut bytes)).await;
            match read.expect("in time") {
                Ok(0) => return None,
                Ok(len) => self.decoder.push(&bytes[..len]),
                Err(error) if error.kind() == ErrorKind::ConnectionReset => return None,
                Err(error) => panic!("{error}"),
            }
        }
    }

    async fn until(&mut self, wanted: impl Fn(&MavMessage) -> bool) -> Frame {
        loop {
            let frame = self.next().await.expect("still connected");
            if matches!(&frame.content, Content::Message(message) if wanted(message)) {
                return frame;
            }
        }
    }

    /// Checks that the vehicle serves this ground station: it acknowledges a command and sends a heartbeat.
    async fn is_served(&mut self) {
        self.order(MavCmd::MAV_CMD_REQUEST_MESSAGE, [148.0, 0.0])
            .await;
        self.until(|m| matches!(m, MavMessage::AUTOPILOT_VERSION(_)))
            .await;
        self.until(|m| matches!(m, MavMessage::HEARTBEAT(_))).await;
    }
}

/// Valid frames of every request, with random fields (NaN among them).
fn random_requests(random: &mut ChaCha8Rng, count: usize) -> Vec<u8> {
    const IDS: [u32; 26] = [
        0, 4, 11, 20, 21, 23, 39, 40, 43, 44, 45, 47, 51, 66, 69, 70, 73, 75, 76, 82, 84, 86, 110,
        111, 117, 119,
    ];
    let mut encoder = Encoder::new(255, 190);
    let mut bytes = Vec::new();
    for round in 0..count {
        let id = IDS[round % IDS.len()];
        let mut payload = vec![0; 60];
        random.fill_bytes(&mut payload);
        if round % 3 == 0 {
            payload[..28].copy_from_slice(&f32::NAN.to_le_bytes().repeat(7));
        }
        if round % 2 == 0 {
            // The offset of the target system in the longest requests.
            payload[30] = 1;
            payload[50] = 1;
        }
        encoder.encode(&Outgoing::Raw { id, payload }, &mut bytes);
    }
    bytes
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn noise_and_random_requests_disturb_no_other_ground_station() {
    let mut server = Server::start(2).await;
    let mut own = Station::connect(server.address(0)).await;
    let mut other = Station::connect(server.address(1)).await;
    own.is_served().await;
    let mut random = ChaCha8Rng::seed_from_u64(4);
    for _ in 0..4 {
        let mut bad = TcpStream::connect(server.address(0))
            .await
            .expect("it listens");
        let mut noise = vec![0; 100_000];
        random.fill_bytes(&mut noise);
        noise.extend(random_requests(&mut random, 500));
        // A reboot may end the connection; the rest is then not accepted.
        let _ = bad.write_all(&noise).await;
        other.is_served().await;
    }
    server.connections(2).await;
    let mut again = Station::connect(server.address(0)).await;
    again.until(|m| matches!(m, MavMessage::HEARTBEAT(_))).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn floods_of_requests_are_answered_without_end_and_others_are_served() {
    let server = Server::start(1).await;
    let mut other = Station::connect(server.address(0)).await;
    let mut flood = Station::connect(server.address(0)).await;
    let mut encoder = Encoder::new(255, 190);
    let mut bytes = Vec::new();
    for _ in 0..1000 {
        let list = PARAM_REQUEST_LIST_DATA {
            target_system: 1,
            target_component: 1,
        };
        encoder.encode_message(&MavMessage::PARAM_REQUEST_LIST(list), &mut bytes);
        let request = COMMAND_LONG_DATA {
            command: MavCmd::MAV_CMD_REQUEST_MESSAGE,
            param1: 148.0,
            target_system: 1,
            ..Default::default()
        };
        encoder.encode_message(&MavMessage::COMMAND_LONG(request), &mut bytes);
    }
    flood.stream.write_all(&bytes).await.expect("it reads");
    other.is_served().await;
    // The last request starts the list again, and it is sent to its end.
    let last = |m: &MavMessage| matches!(m, MavMessage::PARAM_VALUE(v) if v.param_index + 1 == v.param_count);
    flood.until(last).await;
    flood.is_served().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn clients_that_never_read_hold_nobody_up_and_leave_nothing_behind() {
    let mut server = Server::start(1).await;
    let mut deaf = Vec::new();
    for _ in 0..8 {
        let mut station = Station::connect(server.address(0)).await;
        let all = Outgoing::Raw {
            id: 66,
            payload: vec![50, 0, 1, 1, 0, 1],
        };
        let mut bytes = Vec::new();
        station.encoder.encode(&all, &mut bytes);
        station.stream.write_all(&bytes).await.expect("it reads");
        deaf.push(station);
    }
    server.connections(8).await;
    let mut other = Station::connect(server.address(0)).await;
    for _ in 0..5 {
        other.is_served().await;
    }
    drop(deaf);
    server.connections(1).await;
    other.is_served().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn hundreds_of_connections_leave_nothing_behind() {
    let mut server = Server::start(1).await;
    let mut other = Station::connect(server.address(0)).await;
    other.is_served().await;
    for round in 0..300 {
        let stream = TcpStream::connect(server.address(0))
            .await
            .expect("it listens");
        if round % 3 == 0 {
            stream.set_zero_linger().expect("a socket");
        }
    }
    other.is_served().await;
    server.connections(1).await;
    // More stations than a port has room for: the surplus ones are turned away, and there is room
    // again when the others leave.
    let mut crowd = Vec::new();
    for _ in 0..100 {
        crowd.push(
            TcpStream::connect(server.address(0))
                .await
                .expect("it listens"),
        );
    }
    server.connections(16).await;
    other.is_served().await;
    drop(crowd);
    server.connections(1).await;
    Station::connect(server.address(0)).await.is_served().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_reboot_drops_everybody_and_the_port_serves_again() {
    let mut server = Server::start(1).await;
    let mut stations = Vec::new();
    for _ in 0..3 {
        stations.push(Station::connect(server.address(0)).await);
    }
    for _ in 0..5 {
        stations[0].is_served().await;
        stations[0]
            .order(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0, 0.0])
            .await;
        for station in &mut stations {
            while station.next().await.is_some() {}
            *station = Station::connect(server.address(0)).await;
        }
        server.connections(3).await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn signing_closes_serial_1_to_those_without_the_key() {
    let server = Server::start(1).await;
    let key = [3; 32];
    let mut cable = Station::connect(server.address(0)).await;
    cable
        .say(MavMessage::SETUP_SIGNING(SETUP_SIGNING_DATA {
            initial_timestamp: 1_000_000,
            target_system: 1,
            target_component: 1,
            secret_key: key,
        }))
        .await;
    cable.is_served().await;
    let radio = server.started.further_addresses[0][0];
    let mut stranger = Station::connect(radio).await;
    let mut friend = Station::connect(radio).await;
    let request = MavCmd::MAV_CMD_REQUEST_MESSAGE;
    stranger.order(request, [148.0, 0.0]).await;
    let timestamp = 10_000_000;
    friend.encoder.sign_next(&key, Stamp { link: 4, timestamp });
    friend.order(request, [148.0, 0.0]).await;
    let is_version = |m: &MavMessage| matches!(m, MavMessage::AUTOPILOT_VERSION(_));
    assert!(friend.until(is_version).await.seal.is_signature());
    for _ in 0..10 {
        let frame = stranger.next().await.expect("connected");
        let is_answer = matches!(&frame.content, Content::Message(m) if is_version(m));
        assert!(frame.seal.is_signature() && !is_answer, "{frame:?}");
    }
}
