//! Vehicles that are told apart, or taken for each other, by the senders of their frames.

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, MavCmd, MavModeFlag, MavResult, VFR_HUD_DATA,
};

use super::*;

/// The id of vehicle 1's board, once it is known.
fn board(console: &Console) -> Option<String> {
    let version = console.vehicle(1)?.version?;
    version.board.map(|board| board.to_string())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_vehicle_on_two_links_is_no_conflict_of_ids() {
    let (addresses, cancel) = serve(world(1), 1.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console
        .until("the board is known", |console| board(console).is_some())
        .await;
    console.connect(&addresses[0]);
    console
        .until("it is told as one vehicle", |console| {
            let mut notices = console.notices.iter();
            notices.any(|text| text.contains("vehicle 1 is heard twice"))
        })
        .await;
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn two_vehicles_with_one_system_id_are_named() {
    let (first, cancel_first) = serve(world(1), 1.0).await;
    let mut other = world(1);
    other.mark_boards(7);
    let (second, cancel_second) = serve(other, 1.0).await;
    let mut console = Console::start();
    console.connect(&first[0]);
    console
        .until("the first board is known", |console| {
            board(console).is_some()
        })
        .await;
    let known = board(&console).expect("known");
    console.connect(&second[0]);
    console
        .until("the conflict is named", |console| {
            console.notices.iter().any(|text| {
                let names_both = text.matches(", board ").count() == 2 && text.contains(&known);
                names_both && text.contains("two senders use system id 1")
            })
        })
        .await;
    assert_eq!(console.vehicles.len(), 1);
    console
        .until("the vehicle is marked", |console| {
            console.vehicle(1).is_some_and(|it| it.twin.is_some())
        })
        .await;
    cancel_first.cancel();
    cancel_second.cancel();
}

/// Frames of vehicle 5.
fn frames(messages: impl IntoIterator<Item = MavMessage>) -> Vec<u8> {
    let (mut encoder, mut bytes) = (Encoder::new(5, 1), Vec::new());
    for message in messages {
        encoder.encode(&message.into(), &mut bytes);
    }
    bytes
}

fn beat(base_mode: MavModeFlag) -> MavMessage {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode,
        ..HEARTBEAT_DATA::default()
    })
}

/// The heartbeat of vehicle 5, which is disarmed.
fn heartbeat() -> Vec<u8> {
    frames([beat(MavModeFlag::empty())])
}

/// A console that has heard vehicle 5 over UDP, the vehicle's socket, and the console's address.
async fn hearing_by_udp() -> (Console, UdpSocket, SocketAddr) {
    let mut console = Console::start();
    console.connect("udpin:127.0.0.1:0");
    console
        .until("it listens", |console| {
            let mut links = console.links.iter();
            links.any(|link| link.borrow().local.is_some())
        })
        .await;
    let port = console.links[0].borrow().local.expect("bound");
    let vehicle = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    vehicle.send_to(&heartbeat(), port).await.expect("sent");
    console
        .until("it is heard", |console| console.vehicle(5).is_some())
        .await;
    (console, vehicle, port)
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_another_sender_takes_over_is_named_with_both_addresses() {
    let (mut console, first, port) = hearing_by_udp().await;
    let second = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    let [before, now] = [&first, &second].map(|socket| socket.local_addr().expect("bound"));
    let names = format!("(from {now}), no longer over ");
    let is_told = |console: &Console| {
        let mut notices = console.notices.iter();
        notices.any(|text| text.contains(&names) && text.contains(&format!("(from {before})")))
    };
    let forging = async {
        loop {
            second.send_to(&heartbeat(), port).await.expect("sent");
            tokio::time::sleep(Duration::from_millis(200)).await;
        }
    };
    tokio::select! {
        () = console.until("the takeover is told", is_told) => {}
        () = forging => {}
    }
}

fn speed(groundspeed: f32) -> MavMessage {
    MavMessage::VFR_HUD(VFR_HUD_DATA {
        groundspeed,
        ..VFR_HUD_DATA::default()
    })
}

/// The answer to a command to arm, and telemetry of an armed vehicle that moves.
fn forgery() -> [Vec<u8>; 2] {
    let accepted = MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command: MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
        result: MavResult::MAV_RESULT_ACCEPTED,
        target_system: 255,
        target_component: 190,
        ..COMMAND_ACK_DATA::default()
    });
    let armed = beat(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED);
    [vec![accepted], vec![armed, speed(99.0)]].map(frames)
}

#[tokio::test(start_paused = true)]
async fn a_second_sender_changes_no_value_and_ends_no_command_while_the_first_speaks() {
    let (mut console, vehicle, port) = hearing_by_udp().await;
    let forger = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    let arm = console.give("arm", &[5]);
    console
        .until("it is sent", |console| {
            console.state(arm, 5) == Some(RowState::Sent)
        })
        .await;
    let [ack, telemetry] = forgery();
    let has_speed = |console: &Console, wanted: f32| {
        let hud = console.vehicle(5).and_then(|one| one.hud);
        hud.is_some_and(|hud| hud.ground_speed_m_s.to_bits() == wanted.to_bits())
    };
    // Datagrams to one socket are read in their order: once the last one is heard, all were.
    for (socket, bytes) in [
        (&vehicle, &heartbeat()),
        (&forger, &ack),
        (&forger, &telemetry),
        (&vehicle, &frames([speed(1.0)])),
    ] {
        socket.send_to(bytes, port).await.expect("sent");
    }
    console
        .until("the vehicle is heard", |console| has_speed(console, 1.0))
        .await;
    while let Ok(event) = console.events.try_recv() {
        console.hear(event);
    }
    assert_eq!(console.state(arm, 5), Some(RowState::Sent));
    let heard = console.vehicle(5).expect("it is heard");
    assert!(!heard.armed() && heard.twin.is_some());
    // The same bytes of the vehicle itself count.
    vehicle.send_to(&ack, port).await.expect("sent");
    vehicle.send_to(&telemetry, port).await.expect("sent");
    console.until_done(arm, 5).await;
    assert!(has_speed(&console, 99.0) && console.vehicle(5).expect("it is heard").armed());
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_was_forgotten_appears_anew_wherever_it_is_heard() {
    let (mut console, _, port) = hearing_by_udp().await;
    console.fleet.forget(5).expect("the fleet runs");
    console.vehicles.clear();
    let other = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    other.send_to(&heartbeat(), port).await.expect("sent");
    console
        .until("it is heard again", |console| console.vehicle(5).is_some())
        .await;
    assert!(
        console
            .notices
            .iter()
            .all(|text| !text.contains("no longer by")),
        "{:?}",
        console.notices
    );
}
