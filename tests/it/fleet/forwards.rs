//! Other ground stations that use the fleet's links.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavAutopilot, MavCmd, MavMessage,
    MavModeFlag, MavResult, MavType,
};
use sortie::fleet::Keeping;
use sortie::forward::ForwardSpec;
use sortie::link::{Endpoint, Simulator};
use sortie::wire::{Content, Decoder, Encoder};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio_util::sync::CancellationToken;

use super::{Console, world};

fn encoded(encoder: &mut Encoder, message: MavMessage) -> Vec<u8> {
    let mut bytes = Vec::new();
    encoder.encode(&message.into(), &mut bytes);
    bytes
}

fn guided() -> MavMessage {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        target_system: 1,
        target_component: 1,
        command: MavCmd::MAV_CMD_DO_SET_MODE,
        param1: 1.0,
        param2: 4.0,
        ..COMMAND_LONG_DATA::default()
    })
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_station_commands_a_vehicle_over_a_forward_and_is_named() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(2), 10.0, &[Endpoint::Pipes], cancel.clone())
        .await
        .expect("pipes always open");
    let mut console = Console::start();
    for pipe in started.pipes {
        console.connect_to(pipe);
    }
    console.until_ready(&[1, 2]).await;
    let spec: ForwardSpec = "tcpin:127.0.0.1:0".parse().expect("a forward");
    let address = spec.address.parse().expect("an address");
    console
        .fleet
        .forward(spec, address)
        .expect("the fleet runs");
    console
        .until("the forward is opened", |console| {
            !console.forwards.is_empty()
        })
        .await;
    let mut status = console.forwards[0].status.clone();
    let open = status.wait_for(|status| status.local.is_some()).await;
    let at = open.expect("published").local.expect("a socket");
    let mut station = TcpStream::connect(at).await.expect("connected");
    let (mut encoder, mut decoder) = (Encoder::new(254, 1), Decoder::new());
    let mut bytes = [0; 4096];
    let mut answer = None;
    // Vehicle 1 has to be heard before a command can find it.
    let mut is_sent = false;
    while answer.is_none() {
        let read = tokio::time::timeout(Duration::from_secs(60), station.read(&mut bytes));
        let count = read.await.expect("in time").expect("readable");
        assert!(count > 0, "the forward stays open");
        decoder.push(&bytes[..count]);
        while let Some(frame) = decoder.next_frame() {
            if frame.system == 1 && !is_sent {
                is_sent = true;
                let command = encoded(&mut encoder, guided());
                station.write_all(&command).await.expect("writable");
            }
            if let (1, Content::Message(MavMessage::COMMAND_ACK(ack))) =
                (frame.system, frame.content)
            {
                answer = Some(ack);
            }
        }
    }
    let answer = answer.expect("it was awaited");
    assert_eq!(answer.result, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(answer.target_system, 254);
    console
        .until("its command is in the ledger, with the answer", |console| {
            let mut rows = console.foreign.values();
            rows.any(|it| it == "GCS 254/1: 1 mode GUIDED: accepted")
        })
        .await;
    assert_eq!(console.foreign.len(), 1, "its answer is no second command");
    console
        .fleet
        .unforward("tcpin:127.0.0.1:0")
        .expect("the fleet runs");
    let rest = async { while station.read(&mut bytes).await.is_ok_and(|count| count > 0) {} };
    let closed = tokio::time::timeout(Duration::from_secs(60), rest).await;
    closed.expect("a closed forward closes its connections");
    cancel.cancel();
}

/// Opens a socket for vehicles; returns its address.
async fn listen(console: &mut Console) -> String {
    console.connect("udpin:127.0.0.1:0");
    let index = console.links.len();
    let is_there = |console: &Console| console.links.len() > index;
    console.until("the link is opened", is_there).await;
    let mut status = console.links[index].clone();
    let open = status.wait_for(|status| status.local.is_some()).await;
    open.expect("published")
        .local
        .expect("a socket")
        .to_string()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn forwards_in_a_ring_are_a_loop_and_not_a_vehicle_that_is_heard_twice() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(1), 1.0, &[Endpoint::Pipes], cancel.clone())
        .await
        .expect("pipes always open");
    let mut one = Console::start();
    for pipe in started.pipes {
        one.connect_to(pipe);
    }
    one.until_ready(&[1]).await;
    let mut two = Console::start_kept(Keeping {
        station: Some(254),
        ..Keeping::default()
    });
    let (at_one, at_two) = (listen(&mut one).await, listen(&mut two).await);
    for (console, to) in [(&one, at_two), (&two, at_one)] {
        let spec: ForwardSpec = format!("udp:{to}").parse().expect("a forward");
        let address = spec.address.parse().expect("an address");
        console
            .fleet
            .forward(spec, address)
            .expect("the fleet runs");
    }
    one.until("the loop is named", |console| {
        let mut notices = console.notices.iter();
        notices.any(|it| it.contains("form a loop"))
    })
    .await;
    let mut notices = one.notices.iter();
    assert!(!notices.any(|it| it.contains("heard twice")));
    drop(two);
    cancel.cancel();
}

#[tokio::test]
async fn a_station_elsewhere_is_named_from_the_answers_to_it() {
    let mut console = Console::start();
    let (ours, mut vehicle) = tokio::io::duplex(64 * 1024);
    console.connect_to(ours);
    let mut encoder = Encoder::new(7, 1);
    let beat = MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode: MavModeFlag::empty(),
        ..HEARTBEAT_DATA::default()
    });
    let ack = |command, system| {
        MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command,
            target_system: system,
            target_component: 190,
            ..COMMAND_ACK_DATA::default()
        })
    };
    for message in [
        beat,
        ack(MavCmd::MAV_CMD_NAV_LAND, 255),
        ack(MavCmd::MAV_CMD_REQUEST_MESSAGE, 253),
        ack(MavCmd::MAV_CMD_NAV_TAKEOFF, 253),
    ] {
        let bytes = encoded(&mut encoder, message);
        vehicle.write_all(&bytes).await.expect("writable");
    }
    console
        .until("its command is in the ledger", |console| {
            let mut rows = console.foreign.values();
            rows.any(|it| it == "GCS 253/190: 7 NAV_TAKEOFF: accepted")
        })
        .await;
    assert_eq!(console.foreign.len(), 1, "{:?}", console.foreign);
    // The landing was answered to this console's own address, which has not sent it.
    let is_twin = |it: &&String| it.contains("another ground station uses the address");
    let twins = |console: &Console| console.notices.iter().filter(is_twin).count();
    console
        .until(
            "the other station with this address is noticed",
            |console| twins(console) == 1,
        )
        .await;
    for command in [MavCmd::MAV_CMD_NAV_LAND, MavCmd::MAV_CMD_DO_SET_MODE] {
        let bytes = encoded(&mut encoder, ack(command, 255));
        vehicle.write_all(&bytes).await.expect("writable");
    }
    let bytes = encoded(&mut encoder, ack(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, 252));
    vehicle.write_all(&bytes).await.expect("writable");
    console
        .until("a later message has arrived", |console| {
            console
                .foreign
                .values()
                .any(|it| it.contains("GCS 252/190"))
        })
        .await;
    assert_eq!(twins(&console), 1, "{:?}", console.notices);
}
