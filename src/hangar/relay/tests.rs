use futures_util::FutureExt as _;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpListener;

use super::*;

/// A relay with an instance at the other end of a socket.
async fn relay() -> (Relay, TcpStream) {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
    let address = listener.local_addr().expect("it has one");
    let instance = TcpStream::connect(address).await.expect("it listens");
    let mut relay = Relay::default();
    relay.connect(listener.accept().await.expect("it connects").0);
    (relay, instance)
}

#[tokio::test]
async fn bytes_go_both_ways() {
    let (mut relay, mut instance) = relay().await;
    let mut console = relay.attach().expect("nobody is attached");
    assert!(relay.attach().is_none());
    instance.write_all(b"heartbeat").await.expect("it reads");
    assert_eq!(relay.pass().await, Passed::Instance);
    assert_eq!(relay.said(), b"heartbeat");
    let mut heard = [0; 9];
    console
        .read_exact(&mut heard)
        .await
        .expect("it is passed on");
    assert_eq!(&heard, b"heartbeat");
    console.write_all(b"arm").await.expect("it reads");
    assert_eq!(relay.pass().await, Passed::Attached);
    let mut heard = [0; 3];
    instance.read_exact(&mut heard).await.expect("passed on");
    assert_eq!(&heard, b"arm");
}

#[tokio::test]
async fn a_client_that_leaves_is_noticed_and_may_come_again() {
    let (mut relay, instance) = relay().await;
    drop(relay.attach());
    assert_eq!(relay.pass().await, Passed::AttachedGone);
    assert!(!relay.is_attached());
    drop(instance);
    assert_eq!(relay.pass().await, Passed::InstanceGone);
    assert!(relay.attach().is_some());
}

#[tokio::test]
async fn one_who_does_not_read_loses_whole_pieces_and_keeps_nobody_waiting() {
    const PIECE: [u8; 1000] = [7; 1000];
    let (mut relay, mut instance) = relay().await;
    let mut console = relay.attach().expect("nobody is attached");
    let mut passed = 0;
    while passed < 4 * PIPE_LEN {
        instance.write_all(&PIECE).await.expect("it is read");
        let mut piece = 0;
        while piece < PIECE.len() {
            assert_eq!(relay.pass().await, Passed::Instance);
            piece += relay.said().len();
        }
        passed += piece;
    }
    // The piece at the end of the full pipe follows when there is room again, so that nothing is cut.
    let mut heard = vec![0; 2 * PIPE_LEN];
    let mut len = console.read(&mut heard).await.expect("it is full");
    assert_eq!(len, PIPE_LEN);
    console.write_all(b"x").await.expect("it is read");
    assert_eq!(relay.pass().await, Passed::Attached);
    assert!(relay.pass().now_or_never().is_none());
    len += console.read(&mut heard).await.expect("the rest");
    assert_eq!(len % PIECE.len(), 0);
}

#[tokio::test]
async fn an_instance_that_does_not_read_keeps_nobody_waiting_and_gets_whole_pieces() {
    const PIECE: [u8; 1000] = [7; 1000];
    let (mut relay, mut instance) = relay().await;
    let mut console = relay.attach().expect("nobody is attached");
    // This is more than a socket's buffers hold.
    for _ in 0..20_000 {
        console.write_all(&PIECE).await.expect("it is read");
        assert_eq!(relay.pass().await, Passed::Attached);
    }
    drop(console);
    let mut heard = 0;
    let mut space = vec![0; PIPE_LEN];
    while relay
        .instance
        .as_ref()
        .is_some_and(|end| !end.waiting.is_empty())
    {
        tokio::select! {
            len = instance.read(&mut space) => heard += len.expect("it is there"),
            _ = relay.pass() => {}
        }
    }
    relay.disconnect();
    while let Ok(len @ 1..) = instance.read(&mut space).await {
        heard += len;
    }
    assert!(heard > BACKLOG_LEN && heard < 20_000_000, "{heard}");
    assert_eq!(heard % PIECE.len(), 0);
}
