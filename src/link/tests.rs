//! Links against pipes under a paused clock, and helpers of all link tests.

use std::time::Duration;

use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::{
    ATTITUDE_DATA, HEARTBEAT_DATA, MavAutopilot, MavMessage, MavState, MavType,
};
use rand::{Rng as _, SeedableRng as _};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::sync::mpsc;
use tokio::time::{advance, sleep, timeout};
use tokio_util::sync::CancellationToken;

use super::*;
use crate::wire::{Content, Decoder, Encoder};

mod forward;
mod playback;
mod tap;
mod tcp;
mod udp;

/// A link under test, and what it has delivered.
pub(super) struct Rig {
    pub(super) link: LinkHandle,
    pub(super) inbound: mpsc::Receiver<Inbound>,
    pub(super) cancel: CancellationToken,
}

impl Rig {
    pub(super) fn open(address: &str) -> Self {
        Self::over(Transport::Address(address.parse().expect("an address")))
    }

    pub(super) fn over(transport: Transport) -> Self {
        let (sender, inbound) = mpsc::channel(8);
        let cancel = CancellationToken::new();
        let link = open(LinkId(1), transport, sender, cancel.clone());
        Self {
            link,
            inbound,
            cancel,
        }
    }

    fn pipe() -> (Self, DuplexStream) {
        let (ours, theirs) = tokio::io::duplex(4096);
        (Self::over(Transport::Pipe(ours)), theirs)
    }

    /// Waits for a published status; other input is discarded.
    pub(super) async fn until(&mut self, wanted: impl Fn(&LinkStatus) -> bool) -> LinkStatus {
        let mut status = self.link.status();
        let waiting = async {
            loop {
                tokio::select! {
                    found = status.wait_for(&wanted) => return found.expect("published").clone(),
                    Some(_) = self.inbound.recv() => {}
                }
            }
        };
        let found = timeout(Duration::from_secs(20), waiting).await;
        found.unwrap_or_else(|_| panic!("still {:?}", self.link.status().borrow()))
    }

    pub(super) async fn next(&mut self) -> Inbound {
        let next = timeout(Duration::from_secs(20), self.inbound.recv()).await;
        next.expect("in time").expect("the link is open")
    }
}

/// A meter without readers.
pub(super) fn meter() -> meter::LinkMeter {
    let (published, _) = watch::channel(LinkStatus::new(LinkId(1), "test".into(), LinkState::Up));
    meter::LinkMeter::new(published, Arc::default(), Tap::new(None))
}

pub(super) fn heartbeat(system: u8) -> Vec<u8> {
    encoded(system, MavlinkVersion::V2)
}

fn encoded(system: u8, version: MavlinkVersion) -> Vec<u8> {
    let mut encoder = Encoder::new(system, 1);
    encoder.set_version(version);
    let mut bytes = Vec::new();
    let message = MavMessage::HEARTBEAT(HEARTBEAT_DATA::default());
    encoder.encode(&message.into(), &mut bytes);
    bytes
}

pub(super) fn attitude() -> Outgoing {
    MavMessage::ATTITUDE(ATTITUDE_DATA::default()).into()
}

pub(super) fn is_heartbeat(frame: &Frame) -> bool {
    matches!(frame.content, Content::Message(MavMessage::HEARTBEAT(_)))
}

/// Reads from a stream until a wanted frame arrives.
pub(super) async fn read_frame<S: tokio::io::AsyncRead + Unpin>(
    stream: &mut S,
    decoder: &mut Decoder,
    wanted: impl Fn(&Frame) -> bool,
) -> Frame {
    let mut bytes = [0; 512];
    loop {
        while let Some(frame) = decoder.next_frame() {
            if wanted(&frame) {
                return frame;
            }
        }
        let read = timeout(Duration::from_secs(20), stream.read(&mut bytes)).await;
        let len = read.expect("in time").expect("readable");
        assert!(len > 0, "closed before the frame came");
        decoder.push(&bytes[..len]);
    }
}

#[tokio::test(start_paused = true)]
async fn a_ground_station_heartbeat_goes_out_once_a_second() {
    let (_rig, mut far) = Rig::pipe();
    let mut decoder = Decoder::new();
    let start = Instant::now();
    for second in 0..5 {
        let frame = read_frame(&mut far, &mut decoder, |_| true).await;
        assert_eq!((frame.system, frame.component), (255, 190));
        assert_eq!(frame.sequence, second);
        let Content::Message(MavMessage::HEARTBEAT(beat)) = frame.content else {
            panic!("{:?}", frame.content);
        };
        assert_eq!(beat.mavtype, MavType::MAV_TYPE_GCS);
        assert_eq!(beat.autopilot, MavAutopilot::MAV_AUTOPILOT_INVALID);
        assert_eq!(beat.system_status, MavState::MAV_STATE_ACTIVE);
        let late = start.elapsed().abs_diff(Duration::from_secs(second.into()));
        assert!(
            late < Duration::from_millis(5),
            "beat {second} off by {late:?}"
        );
    }
}

#[tokio::test(start_paused = true)]
async fn ten_megabytes_of_random_bytes_move_only_counters() {
    let (mut rig, mut far) = Rig::pipe();
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let noise = tokio::spawn(async move {
        let mut chunk = vec![0; 64 * 1024];
        for _ in 0..160 {
            random.fill_bytes(&mut chunk);
            far.write_all(&chunk).await.expect("the link reads");
        }
        far
    });
    let status = rig.until(|s| s.decoder.bytes == 160 * 64 * 1024).await;
    assert_eq!(status.state, LinkState::Up);
    assert_eq!(status.last_error, None);
    assert!(status.decoder.skipped_bytes > 1_000_000, "{status:?}");
    let mut far = noise.await.expect("written");
    far.write_all(&[0; 600]).await.expect("the link reads");
    sleep(Duration::from_secs(1)).await;
    far.write_all(&heartbeat(3)).await.expect("the link reads");
    while rig.next().await.frames[0].system != 3 {}
}

#[tokio::test(start_paused = true)]
async fn unknown_messages_and_lost_ones_are_counted_by_sender() {
    let (mut rig, mut far) = Rig::pipe();
    let mut bytes = vec![0xFD, 2, 0, 0, 0, 9, 1, 0xFF, 0xFF, 0xFE, 1, 2, 3, 4];
    let mut encoder = Encoder::new(4, 1);
    for count in 0..5 {
        let before = bytes.len();
        encoder.encode(&attitude(), &mut bytes);
        if count == 1 || count == 2 {
            bytes.truncate(before);
        }
        if count == 3 {
            // In MAVLink 2 the message id follows the sender; this change makes the message unknown.
            bytes[before + 9] = 0xFE;
        }
    }
    far.write_all(&bytes).await.expect("the link reads");
    let status = rig.until(|s| s.decoder.frames == 2).await;
    assert_eq!(status.decoder.unknown_messages, 2);
    assert_eq!(status.numbered[&(4, 1)].lost, 2);
    assert_eq!(status.lost(), 2);
}

#[tokio::test(start_paused = true)]
async fn a_peer_is_answered_in_the_version_that_it_understands() {
    let (mut rig, mut far) = Rig::pipe();
    let mut decoder = Decoder::new();
    for (sent, answered) in [
        (MavlinkVersion::V1, MavlinkVersion::V1),
        (MavlinkVersion::V2, MavlinkVersion::V2),
        (MavlinkVersion::V1, MavlinkVersion::V2),
    ] {
        far.write_all(&encoded(1, sent)).await.expect("writable");
        assert_eq!(rig.next().await.frames[0].version, sent);
        assert!(rig.link.send(To::Everyone, attitude()));
        let frame = read_frame(&mut far, &mut decoder, |f| !is_heartbeat(f)).await;
        assert_eq!(frame.version, answered);
    }
}

#[tokio::test(start_paused = true)]
async fn a_frame_behind_a_false_start_is_delivered_after_a_pause() {
    let (mut rig, mut far) = Rig::pipe();
    let start = Instant::now();
    far.write_all(&[0xFD, 0xFF, 0x00]).await.expect("writable");
    far.write_all(&heartbeat(5)).await.expect("writable");
    assert_eq!(rig.next().await.frames[0].system, 5);
    let waited = start.elapsed();
    assert!(
        waited.abs_diff(Duration::from_millis(200)) < Duration::from_millis(5),
        "{waited:?}"
    );
}

#[tokio::test(start_paused = true)]
async fn a_receiver_that_stalls_slows_the_sender_and_stops_no_heartbeat() {
    let (mut rig, far) = Rig::pipe();
    let (mut reading, mut writing) = tokio::io::split(far);
    let sent = tokio::spawn(async move {
        for _ in 0..10_000 {
            writing.write_all(&heartbeat(1)).await.expect("writable");
        }
    });
    let mut decoder = Decoder::new();
    for _ in 0..5 {
        read_frame(&mut reading, &mut decoder, is_heartbeat).await;
    }
    assert!(!sent.is_finished(), "10 000 frames were taken in by nobody");
    let mut received = 0;
    while received < 10_000 {
        received += rig.next().await.frames.len();
    }
}

#[tokio::test(start_paused = true)]
async fn what_a_deaf_peer_does_not_take_is_dropped_and_counted() {
    let (mut rig, _far) = Rig::pipe();
    let mut taken = 0u64;
    for _ in 0..2000 {
        taken += u64::from(rig.link.send(To::Everyone, attitude()));
        tokio::task::yield_now().await;
    }
    assert!(taken < 1000, "{taken} messages found room");
    let status = rig.until(|s| s.dropped_out == 2000 - taken).await;
    assert_eq!(status.state, LinkState::Up);
}

#[tokio::test(start_paused = true)]
async fn rates_are_those_of_the_last_two_seconds() {
    let (mut rig, mut far) = Rig::pipe();
    let frame = heartbeat(1);
    for _ in 0..60 {
        far.write_all(&frame).await.expect("writable");
        rig.next().await;
        sleep(Duration::from_millis(50)).await;
    }
    let rates = rig.link.status().borrow().rates;
    assert!((rates.messages_in_s - 20.0).abs() < 1.5, "{rates:?}");
    assert!(
        (rates.bytes_in_s - 20.0 * frame.len() as f32).abs() < 30.0,
        "{rates:?}"
    );
    assert!((rates.messages_out_s - 1.0).abs() < 0.6, "{rates:?}");
    let idle = |s: &LinkStatus| s.rates.bytes_in_s == 0.0;
    rig.until(idle).await;
}

#[tokio::test(start_paused = true)]
async fn a_pipe_ends_when_its_other_end_is_gone() {
    let (mut rig, far) = Rig::pipe();
    drop(far);
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    let reason = status.last_error.expect("a reason");
    assert!(reason.contains("other end is gone"), "{reason}");
    assert!(!rig.link.send(To::Everyone, attitude()), "nobody is there");
}

#[tokio::test(start_paused = true)]
async fn a_cancelled_link_ends_without_an_error() {
    let (mut rig, _far) = Rig::pipe();
    advance(Duration::from_secs(3)).await;
    rig.cancel.cancel();
    let status = rig.until(|s| s.state == LinkState::Ended).await;
    assert_eq!(status.last_error, None);
}
