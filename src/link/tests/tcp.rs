//! TCP in both directions, over real sockets.

use mavlink::dialects::ardupilotmega::FILE_TRANSFER_PROTOCOL_DATA;
use tokio::net::{TcpListener, TcpStream};

use super::*;

async fn listener() -> (TcpListener, String) {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let address = format!("tcp:{}", listener.local_addr().expect("bound"));
    (listener, address)
}

#[tokio::test]
async fn a_link_resumes_after_the_server_has_closed_it() {
    let (listener, address) = listener().await;
    let mut rig = Rig::open(&address);
    let mut decoder = Decoder::new();
    let (mut server, _) = listener.accept().await.expect("the link connects");
    read_frame(&mut server, &mut decoder, is_heartbeat).await;
    server.write_all(&heartbeat(7)).await.expect("writable");
    assert_eq!(rig.next().await.frames[0].system, 7);
    drop(server);
    let lost = rig
        .until(|s| matches!(s.state, LinkState::Waiting { .. }))
        .await;
    let reason = lost.last_error.expect("a reason");
    assert!(
        reason.contains("closed") || reason.contains("reset"),
        "{reason}"
    );
    assert!(
        !rig.link.send(To::Everyone, attitude()),
        "a command must not arrive late"
    );
    let (mut server, _) = listener.accept().await.expect("the link comes back");
    server.write_all(&heartbeat(7)).await.expect("writable");
    assert_eq!(rig.next().await.frames[0].system, 7);
    let status = rig.until(|s| s.decoder.frames == 2).await;
    assert_eq!(status.reconnects, 1);
    assert_eq!(status.last_error, None);
    assert_eq!(status.lost(), 0, "a new connection numbers anew");
}

#[tokio::test]
async fn a_server_that_is_not_there_is_told_at_once_and_found_later() {
    let (gone, address) = listener().await;
    let socket = gone.local_addr().expect("bound");
    drop(gone);
    let mut rig = Rig::open(&address);
    let status = rig.until(|s| s.last_error.is_some()).await;
    assert!(
        matches!(status.state, LinkState::Waiting { retry_in } if retry_in < Duration::from_secs(1))
    );
    let reason = status.last_error.expect("a reason");
    assert!(reason.contains("connection refused"), "{reason}");
    let listener = TcpListener::bind(socket).await.expect("still free");
    listener.accept().await.expect("the link tries again");
    let status = rig.until(|s| s.state == LinkState::Up).await;
    assert_eq!(status.reconnects, 0, "it was never up before");
    assert_eq!(status.name.to_string(), address);
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_falls_silent_on_tcp_is_connected_to_anew() {
    let (listener, address) = listener().await;
    let mut rig = Rig::open(&address);
    let (mut server, _) = listener.accept().await.expect("the link connects");
    server.write_all(&heartbeat(7)).await.expect("writable");
    let status = rig
        .until(|s| matches!(s.state, LinkState::Waiting { .. }))
        .await;
    let reason = status.last_error.expect("a reason");
    assert!(reason.contains("nothing was received for 10 s"), "{reason}");
    listener.accept().await.expect("the link comes back");
}

#[tokio::test]
async fn every_client_of_a_listening_link_is_a_peer() {
    let mut rig = Rig::open("tcpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let mut clients = Vec::new();
    for system in 1..=3 {
        let mut client = TcpStream::connect(address).await.expect("it listens");
        client
            .write_all(&heartbeat(system))
            .await
            .expect("writable");
        let inbound = rig.next().await;
        assert_eq!(inbound.frames[0].system, system);
        clients.push((client, inbound.peer, Decoder::new()));
    }
    rig.until(|s| s.peers == 3).await;
    assert!(rig.link.send(To::Peer(clients[1].1), attitude()));
    let (client, _, decoder) = &mut clients[1];
    read_frame(client, decoder, |f| !is_heartbeat(f)).await;
    for (client, _, decoder) in &mut clients {
        read_frame(client, decoder, is_heartbeat).await;
    }
    clients.remove(0);
    rig.until(|s| s.peers == 2).await;
    assert!(rig.link.send(To::Everyone, attitude()));
    for (client, _, decoder) in &mut clients {
        read_frame(client, decoder, |f| !is_heartbeat(f)).await;
    }
}

#[tokio::test]
async fn a_client_that_does_not_read_holds_up_nobody() {
    let mut rig = Rig::open("tcpin:127.0.0.1:0");
    let up = rig.until(|s| s.state == LinkState::Up).await;
    let address = up.local.expect("a socket");
    let _deaf = TcpStream::connect(address).await.expect("it listens");
    let mut other = TcpStream::connect(address).await.expect("it listens");
    rig.until(|s| s.peers == 2).await;
    let long = Outgoing::from(MavMessage::FILE_TRANSFER_PROTOCOL(
        FILE_TRANSFER_PROTOCOL_DATA {
            payload: [0x55; 251],
            ..Default::default()
        },
    ));
    let mut decoder = Decoder::new();
    while rig.link.status().borrow().dropped_out == 0 {
        for _ in 0..100 {
            assert!(
                rig.link.send(To::Everyone, long.clone()),
                "the queue is full"
            );
        }
        for _ in 0..100 {
            read_frame(&mut other, &mut decoder, |f| !is_heartbeat(f)).await;
        }
    }
    let other_is_served = read_frame(&mut other, &mut decoder, is_heartbeat).await;
    assert_eq!(other_is_served.system, 255);
}

#[tokio::test]
async fn a_port_in_use_is_named_and_taken_once_it_is_free() {
    let (taken, address) = listener().await;
    let port = taken.local_addr().expect("bound").port();
    let mut rig = Rig::open(&address.replace("tcp:", "tcpin:"));
    let status = rig.until(|s| s.last_error.is_some()).await;
    let reason = status.last_error.expect("a reason");
    assert!(
        reason.contains(&format!("port {port} on 127.0.0.1 is in use")),
        "{reason}"
    );
    drop(taken);
    rig.until(|s| s.state == LinkState::Up).await;
}
