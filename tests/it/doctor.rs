//! The link doctor on real links, each with exactly one fault that it should name.
//!
//! The clock is paused: a test advances it by a second once the link has read everything that was sent.

use std::collections::BTreeSet;
use std::time::Duration;

use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::{
    ATTITUDE_DATA, HEARTBEAT_DATA, MavAutopilot, MavMessage, MavType, TIMESYNC_DATA,
};
use sortie::doctor::{Cause, Chart, Way, Weight, diagnose};
use sortie::link::{self, Inbound, LinkHandle, LinkId, LinkState, LinkStatus, To, Transport};
use sortie::wire::{Encoder, Outgoing, ground_station_heartbeat};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::net::UdpSocket;
use tokio::sync::mpsc;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

mod faults;
mod uart;

/// A link under examination.
struct Patient {
    link: LinkHandle,
    inbound: mpsc::Receiver<Inbound>,
    chart: Chart,
    started: Instant,
    given: u64,
    _cancel: tokio_util::sync::DropGuard,
}

impl Patient {
    fn over(transport: Transport, way: Way) -> Self {
        let (sender, inbound) = mpsc::channel(64);
        let cancel = CancellationToken::new();
        Self {
            link: link::open(LinkId(0), transport, sender, cancel.clone()),
            inbound,
            chart: Chart::new(way),
            started: Instant::now(),
            given: 0,
            _cancel: cancel.drop_guard(),
        }
    }

    /// A link over a pipe with a simulated clock, and its other end.
    fn piped(way: Way) -> (Self, DuplexStream) {
        let (ours, theirs) = tokio::io::duplex(1 << 20);
        (Self::over(Transport::Pipe(ours), way), theirs)
    }

    /// A UDP listener, and a socket that sends to it.
    async fn listening() -> (Self, UdpSocket) {
        let address = "udpin:127.0.0.1:0".parse().expect("an address");
        let mut patient = Self::over(Transport::Address(address), Way::UdpIn);
        let status = patient.until(|status| status.local.is_some()).await;
        let remote = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
        let local = status.local.expect("bound");
        remote.connect(local).await.expect("connected");
        (patient, remote)
    }

    async fn until(&mut self, wanted: impl Fn(&LinkStatus) -> bool) -> LinkStatus {
        let mut status = self.link.status();
        loop {
            tokio::select! {
                found = status.wait_for(&wanted) => return found.expect("published").clone(),
                Some(_) = self.inbound.recv() => {}
            }
        }
    }

    /// Waits until the link has read everything, advances by a second, and notes the link's state.
    async fn second(&mut self) {
        let given = self.given;
        self.until(|status| status.decoder.bytes >= given).await;
        let to_pass = tokio::time::sleep(Duration::from_secs(1));
        tokio::pin!(to_pass);
        loop {
            tokio::select! {
                () = &mut to_pass => break,
                Some(_) = self.inbound.recv() => {}
            }
        }
        self.note();
    }

    fn note(&mut self) {
        let status = self.link.status().borrow().clone();
        let observation = self.link.tap().observe(&status);
        self.chart.note(observation, self.started.elapsed());
    }

    /// The doctor's findings, worst first.
    fn causes(&self) -> Vec<Cause> {
        let findings = diagnose(std::slice::from_ref(&self.chart), &BTreeSet::new());
        findings.into_iter().map(|finding| finding.cause).collect()
    }

    /// Sends a request, as the session with a vehicle does.
    fn ask(&self) {
        let question = MavMessage::TIMESYNC(TIMESYNC_DATA::default());
        self.link.send(To::Everyone, question.into());
    }

    /// Feeds bytes to the link, a share every second.
    async fn feed<W: tokio::io::AsyncWrite + Unpin>(
        &mut self,
        to: &mut W,
        bytes: &[u8],
        seconds: usize,
    ) {
        for part in bytes.chunks(bytes.len().div_ceil(seconds)) {
            to.write_all(part).await.expect("the link reads");
            self.given += part.len() as u64;
            self.second().await;
        }
    }
}

/// A sender of frames.
struct Voice(Encoder);

impl Voice {
    fn new(system: u8, component: u8) -> Self {
        Self(Encoder::new(system, component))
    }

    fn say(&mut self, message: impl Into<Outgoing>) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.0.encode(&message.into(), &mut bytes);
        bytes
    }

    /// The frames of one second: a heartbeat and ten attitudes.
    fn second(&mut self) -> Vec<u8> {
        let mut bytes = self.say(heartbeat());
        for _ in 0..10 {
            bytes.extend(self.say(MavMessage::ATTITUDE(ATTITUDE_DATA::default())));
        }
        bytes
    }

    fn answer(&mut self) -> Vec<u8> {
        self.say(MavMessage::TIMESYNC(TIMESYNC_DATA {
            tc1: 77,
            ..TIMESYNC_DATA::default()
        }))
    }
}

fn heartbeat() -> MavMessage {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        ..HEARTBEAT_DATA::default()
    })
}

/// The frames of a recording, without their times.
fn recording(name: &str) -> Vec<u8> {
    let path = format!(
        "{}/tests/data/recordings/{name}",
        env!("CARGO_MANIFEST_DIR")
    );
    let file = std::fs::File::open(path).expect("a recording");
    let records = link::TlogReader::new(std::io::BufReader::new(file));
    records
        .flat_map(|record| record.expect("intact").bytes)
        .collect()
}
