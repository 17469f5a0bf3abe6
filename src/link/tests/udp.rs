//! UDP, over real sockets.

use tokio::net::UdpSocket;

use super::*;

async fn socket() -> UdpSocket {
    UdpSocket::bind("127.0.0.1:0").await.expect("a free port")
}

async fn receive(socket: &UdpSocket, wanted: impl Fn(&Frame) -> bool) -> Frame {
    let mut bytes = [0; 2048];
    loop {
        let received = timeout(Duration::from_secs(20), socket.recv(&mut bytes)).await;
        let len = received.expect("in time").expect("readable");
        let mut decoder = Decoder::new();
        decoder.push(&bytes[..len]);
        while let Some(frame) = decoder.next_frame() {
            if wanted(&frame) {
                return frame;
            }
        }
    }
}

#[tokio::test]
async fn vehicles_on_one_port_are_answered_each_at_its_own_address() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let mut vehicles = Vec::new();
    for system in 1..=4 {
        let vehicle = socket().await;
        vehicle
            .send_to(&heartbeat(system), address)
            .await
            .expect("sent");
        let inbound = rig.next().await;
        assert_eq!(inbound.frames[0].system, system);
        vehicles.push((vehicle, inbound.peer));
    }
    rig.until(|s| s.peers == 4).await;
    for (number, (_, peer)) in vehicles.iter().enumerate() {
        let payload = vec![number as u8 + 1; 28];
        assert!(
            rig.link
                .send(To::Peer(*peer), Outgoing::Raw { id: 30, payload })
        );
    }
    for (number, (vehicle, _)) in vehicles.iter().enumerate() {
        let expected = u32::from_le_bytes([number as u8 + 1; 4]);
        let frame = receive(vehicle, |f| !is_heartbeat(f)).await;
        let Content::Message(MavMessage::ATTITUDE(attitude)) = frame.content else {
            panic!("{:?}", frame.content);
        };
        assert_eq!(
            attitude.time_boot_ms, expected,
            "a message for another vehicle"
        );
        receive(vehicle, is_heartbeat).await;
    }
}

#[tokio::test]
async fn a_datagram_with_a_false_start_delays_nothing() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let vehicle = socket().await;
    for datagram in [&[0xFD, 0xFF, 0x00][..], &[], &heartbeat(9)] {
        vehicle.send_to(datagram, address).await.expect("sent");
    }
    assert_eq!(rig.next().await.frames[0].system, 9);
    let status = rig.until(|s| s.decoder.frames == 1).await;
    assert_eq!((status.peers, status.decoder.skipped_bytes), (1, 3));
}

#[tokio::test]
async fn frames_that_a_bridge_has_cut_are_put_together() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let bridge = socket().await;
    let bytes: Vec<u8> = (1..=9).flat_map(heartbeat).collect();
    for piece in bytes.chunks(8) {
        bridge.send_to(piece, address).await.expect("sent");
    }
    let mut heard = Vec::new();
    while heard.len() < 9 {
        heard.extend(rig.next().await.frames.iter().map(|frame| frame.system));
    }
    assert_eq!(heard, (1..=9).collect::<Vec<_>>());
    let status = rig.until(|s| s.decoder.frames == 9).await;
    assert_eq!((status.peers, status.decoder.skipped_bytes), (1, 0));
}

#[tokio::test]
async fn a_frame_behind_a_false_start_in_a_datagram_comes_after_a_pause() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let vehicle = socket().await;
    let datagram = [&[0xFD, 0xFF, 0x00][..], &heartbeat(9)].concat();
    for _ in 0..2 {
        vehicle.send_to(&datagram, address).await.expect("sent");
        assert_eq!(rig.next().await.frames[0].system, 9);
    }
    let status = rig.until(|s| s.decoder.frames == 2).await;
    assert_eq!((status.peers, status.decoder.skipped_bytes), (1, 6));
}

#[tokio::test]
async fn the_target_hears_from_a_sending_link_before_it_has_spoken() {
    let vehicle = socket().await;
    let address = vehicle.local_addr().expect("bound");
    let mut rig = Rig::open(&format!("udp:{address}"));
    let mut bytes = [0; 2048];
    let (_, from) = vehicle.recv_from(&mut bytes).await.expect("a heartbeat");
    vehicle.send_to(&heartbeat(2), from).await.expect("sent");
    let inbound = rig.next().await;
    assert_eq!((inbound.peer, inbound.frames[0].system), (LinkPeer(0), 2));
    assert!(rig.link.send(To::Everyone, attitude()));
    receive(&vehicle, |f| !is_heartbeat(f)).await;
}

#[tokio::test]
async fn nobody_at_the_target_is_no_error() {
    let gone = socket().await;
    let address = gone.local_addr().expect("bound");
    drop(gone);
    let mut rig = Rig::open(&format!("udp:{address}"));
    let status = rig.until(|s| s.sent_messages >= 2).await;
    assert_eq!((status.state, status.last_error), (LinkState::Up, None));
    let vehicle = UdpSocket::bind(address).await.expect("still free");
    receive(&vehicle, is_heartbeat).await;
}

#[tokio::test]
async fn a_udp_port_in_use_is_named() {
    let taken = socket().await;
    let address = taken.local_addr().expect("bound");
    let mut rig = Rig::open(&format!("udpin:{address}"));
    let status = rig.until(|s| s.last_error.is_some()).await;
    let reason = status.last_error.expect("a reason");
    assert!(
        reason.contains(&format!("port {} on 127.0.0.1 is in use", address.port())),
        "{reason}"
    );
}

#[cfg(feature = "serial")]
#[tokio::test(start_paused = true)]
async fn an_absent_serial_port_is_named_and_tried_again() {
    let mut rig = Rig::open("serial:/dev/absent:57600");
    let status = rig.until(|s| s.last_error.is_some()).await;
    let reason = status.last_error.expect("a reason");
    assert!(reason.contains("/dev/absent at 57600 baud"), "{reason}");
    let longest = Duration::from_secs(5);
    rig.until(|s| s.state == LinkState::Waiting { retry_in: longest })
        .await;
}
