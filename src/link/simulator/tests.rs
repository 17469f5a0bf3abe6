//! The simulator's server, over pipes under a paused clock and over real sockets.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd, MavMessage};
use tokio::net::TcpListener;
use tokio::time::{Instant, advance};

use super::*;
use crate::geo::LatLon;
use crate::link::tests::{Rig, is_heartbeat};
use crate::link::{LinkState, To, Transport};
use crate::mission::record::refly;
use crate::record::StoredInputs;
use crate::sim::{Airframe, Start, WorldConfig};
use crate::wire::{Content, Outgoing};

fn config(vehicles: usize) -> WorldConfig {
    let first = Start {
        at: LatLon {
            lat_deg: 50.0,
            lon_deg: 30.0,
        },
        altitude_amsl_m: 100.0,
        heading_deg: 0.0,
    };
    WorldConfig::row(vehicles, first)
}

fn world(vehicles: usize) -> World {
    World::new(&config(vehicles))
}

async fn start(vehicles: usize, speedup: f64, endpoint: Endpoint) -> StartedSimulator {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(vehicles), speedup, &[endpoint], cancel).await;
    started.expect("the simulator starts")
}

fn tcp(port: u16) -> Endpoint {
    Endpoint::Tcp {
        host: "127.0.0.1".into(),
        port,
    }
}

fn udp(port: u16) -> Endpoint {
    Endpoint::Udp {
        host: "127.0.0.1".into(),
        port,
    }
}

fn reboot(system: u8) -> Outgoing {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        param1: 1.0,
        command: MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
        target_system: system,
        target_component: 1,
        ..Default::default()
    })
    .into()
}

/// `REQUEST_DATA_STREAM` for everything at 50 Hz: deprecated, but still used by ground stations.
fn all_streams(system: u8) -> Outgoing {
    Outgoing::Raw {
        id: 66,
        payload: vec![50, 0, system, 1, 0, 1],
    }
}

async fn heartbeats(rig: &mut Rig, time: Duration) -> usize {
    let until = Instant::now() + time;
    let mut count = 0;
    while let Ok(Some(inbound)) = tokio::time::timeout_at(until, rig.inbound.recv()).await {
        count += inbound.frames.iter().filter(|f| is_heartbeat(f)).count();
    }
    count
}

async fn acknowledged(rig: &mut Rig) {
    loop {
        let inbound = rig.next().await;
        let is_ack = |c: &Content| matches!(c, Content::Message(MavMessage::COMMAND_ACK(_)));
        if inbound.frames.iter().any(|f| is_ack(&f.content)) {
            return;
        }
    }
}

#[tokio::test(start_paused = true)]
async fn the_world_keeps_the_pace_that_was_asked_for() {
    for (speedup, expected) in [(1.0, 20), (5.0, 100), (0.5, 10), (100.0, 2000)] {
        let mut started = start(1, speedup, Endpoint::Pipes).await;
        let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
        rig.next().await; // booted
        let count = heartbeats(&mut rig, Duration::from_secs(20)).await;
        assert!(
            count.abs_diff(expected) <= 1 + expected / 100,
            "{count} at speedup {speedup}"
        );
    }
}

#[tokio::test(start_paused = true)]
async fn a_stalled_machine_slows_the_simulation_down() {
    let mut started = start(1, 1.0, Endpoint::Pipes).await;
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    rig.next().await;
    for _ in 0..5 {
        advance(Duration::from_secs(3600)).await;
    }
    let count = heartbeats(&mut rig, Duration::from_secs(10)).await;
    assert!(
        (9..=12).contains(&count),
        "{count} heartbeats in 10 s after hours of standstill"
    );
}

#[tokio::test(start_paused = true)]
async fn a_reader_that_has_stopped_holds_up_no_other_vehicle() {
    let mut started = start(2, 1.0, Endpoint::Pipes).await;
    let mut rigs: Vec<_> = started
        .pipes
        .drain(..)
        .map(|pipe| Rig::over(Transport::Pipe(pipe)))
        .collect();
    let mut other = rigs.remove(1);
    rigs[0].next().await;
    assert!(rigs[0].link.send(To::Everyone, all_streams(1)));
    other.next().await;
    let count = heartbeats(&mut other, Duration::from_secs(60)).await;
    assert!((59..=61).contains(&count), "{count} heartbeats in a minute");
    let held = rigs[0].link.status().borrow().decoder.bytes;
    assert!(held < 1_000_000, "{held} bytes were taken in by nobody");
    let mut waiting = 0;
    while let Ok(inbound) = rigs[0].inbound.try_recv() {
        waiting += inbound.frames.len();
        tokio::task::yield_now().await;
    }
    assert!(
        waiting > 1000,
        "only {waiting} frames: the vehicle did not send much"
    );
}

#[tokio::test(start_paused = true)]
async fn a_pipe_outlasts_a_reboot() {
    let mut started = start(1, 1.0, Endpoint::Pipes).await;
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    rig.next().await;
    assert!(rig.link.send(To::Everyone, reboot(1)));
    acknowledged(&mut rig).await;
    let count = heartbeats(&mut rig, Duration::from_secs(30)).await;
    assert!(
        (25..=32).contains(&count),
        "{count} heartbeats around a reboot"
    );
    assert_eq!(rig.link.status().borrow().state, LinkState::Up);
}

#[tokio::test]
async fn a_reboot_closes_the_tcp_connection_and_the_link_comes_back() {
    let started = start(2, 1.0, tcp(0)).await;
    let mut rig = Rig::open(&format!("tcp:{}", started.addresses[1]));
    assert_eq!(rig.next().await.frames[0].system, 2);
    assert!(rig.link.send(To::Everyone, reboot(2)));
    acknowledged(&mut rig).await;
    let lost = rig
        .until(|s| matches!(s.state, LinkState::Waiting { .. }))
        .await;
    let reason = lost.last_error.expect("a reason");
    assert!(reason.contains("closed by the other end"), "{reason}");
    rig.until(|s| s.reconnects == 1 && s.state == LinkState::Up)
        .await;
    assert_eq!(rig.next().await.frames[0].system, 2);
}

#[tokio::test]
async fn a_vehicle_serves_many_tcp_clients() {
    let started = start(1, 10.0, tcp(0)).await;
    let address = format!("tcp:{}", started.addresses[0]);
    let mut rigs: Vec<_> = (0..3).map(|_| Rig::open(&address)).collect();
    for rig in &mut rigs {
        assert_eq!(rig.next().await.frames[0].system, 1);
        assert!(rig.link.send(To::Everyone, reboot(99)));
    }
    for rig in &mut rigs {
        rig.until(|s| s.decoder.frames > 5).await;
    }
}

#[tokio::test]
async fn all_vehicles_reach_one_udp_port_and_hear_its_answers() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let port = up.local.expect("a socket").port();
    let host = "127.0.0.1".to_owned();
    start(3, 5.0, Endpoint::Udp { host, port }).await;
    let mut systems = BTreeSet::new();
    while systems.len() < 3 {
        systems.extend(rig.next().await.frames.iter().map(|f| f.system));
    }
    assert_eq!(systems, BTreeSet::from([1, 2, 3]));
    assert!(rig.link.send(To::Everyone, reboot(2)));
    acknowledged(&mut rig).await;
}

#[tokio::test]
async fn what_cannot_be_started_is_explained() {
    let taken = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let port = taken.local_addr().expect("bound").port();
    let in_use = format!("port {port} on 127.0.0.1 is in use: choose another with --tcp");
    let nowhere = Endpoint::Tcp {
        host: "192.0.2.1".into(),
        port: 0,
    };
    let table = [
        (1.0, tcp(port), in_use.as_str()),
        (1.0, tcp(65530), "2 vehicle(s) from port 65530"),
        (1.0, udp(0), "port 0 cannot be reached"),
        (1.0, nowhere, "cannot listen on port 0 of 192.0.2.1"),
        (0.0, Endpoint::Pipes, "a speed-up of 0"),
        (f64::NAN, Endpoint::Pipes, "a speed-up of NaN"),
    ];
    for (speedup, endpoint, expected) in table {
        let cancel = CancellationToken::new();
        let result = Simulator::start(world(2), speedup, &[endpoint], cancel).await;
        let error = result.expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[tokio::test(start_paused = true)]
async fn a_cancelled_simulator_ends_its_pipes() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(1), 1.0, &[Endpoint::Pipes], cancel.clone()).await;
    let mut started = started.expect("the simulator starts");
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    rig.next().await;
    cancel.cancel();
    rig.until(|s| s.state == LinkState::Ended).await;
    started.task.await.expect("no panic");
}

#[tokio::test(start_paused = true)]
async fn while_it_is_held_no_vehicle_moves_or_says_anything() {
    let moving = SimulatorPace {
        speedup: 1.0,
        held: false,
    };
    let (hold, pace) = watch::channel(moving);
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(1), pace, &[Endpoint::Pipes], cancel).await;
    let mut started = started.expect("the simulator starts");
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    assert!(heartbeats(&mut rig, Duration::from_secs(5)).await >= 4);
    hold.send_replace(SimulatorPace {
        held: true,
        ..moving
    });
    // Earlier messages may still be in transit.
    heartbeats(&mut rig, Duration::from_millis(100)).await;
    assert_eq!(heartbeats(&mut rig, Duration::from_secs(60)).await, 0);
    hold.send_replace(moving);
    let count = heartbeats(&mut rig, Duration::from_secs(5)).await;
    assert!((4..=6).contains(&count), "{count}: time was made up for");
}

#[tokio::test(start_paused = true)]
async fn another_pace_holds_from_then_on() {
    let slow = SimulatorPace {
        speedup: 1.0,
        held: false,
    };
    let (pace, feed) = watch::channel(slow);
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(1), feed, &[Endpoint::Pipes], cancel).await;
    let mut started = started.expect("the simulator starts");
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    heartbeats(&mut rig, Duration::from_secs(10)).await;
    pace.send_replace(SimulatorPace {
        speedup: 4.0,
        ..slow
    });
    let count = heartbeats(&mut rig, Duration::from_secs(10)).await;
    assert!((38..=42).contains(&count), "{count}");
}

/// A vehicle that reboots drops its connection, and another is made.
#[tokio::test(start_paused = true)]
async fn what_has_entered_a_simulator_flies_it_again() {
    let head = InputsHead::of(&config(2), &[] as &[Arc<Airframe>]);
    let (sink, cancel) = (InputSink::default(), CancellationToken::new());
    let record = Some((head, sink.clone()));
    let pipes = [Endpoint::Pipes];
    let started = Simulator::start_recorded(world(2), 3.0, &pipes, record, cancel.clone()).await;
    let mut started = started.expect("the simulator starts");
    let mut rig = Rig::over(Transport::Pipe(started.pipes.remove(0)));
    heartbeats(&mut rig, Duration::from_secs(3)).await;
    assert!(rig.link.send(To::Everyone, all_streams(1)));
    heartbeats(&mut rig, Duration::from_secs(3)).await;
    assert!(rig.link.send(To::Everyone, reboot(1)));
    heartbeats(&mut rig, Duration::from_secs(4)).await;
    cancel.cancel();
    started.task.await.expect("no panic");
    let written = sink.take();
    let inputs = StoredInputs::read(&written).expect("a log");
    assert!(
        inputs.is_whole() && inputs.lasts() > Duration::from_secs(25),
        "{written}"
    );
    assert_eq!(written.matches("\"on\"").count(), 3, "{written}");
    assert_eq!(refly(&mut config(2), &inputs), None);
    let line = written
        .lines()
        .find(|line| line.contains("420000"))
        .expect("the request");
    let lacking = StoredInputs::read(&written.replace(&format!("{line}\n"), "")).expect("a log");
    let difference = refly(&mut config(2), &lacking).expect("it lacks the request");
    assert_eq!(difference.vehicle, Some(1));
}
