//! Clients that are too many, too slow, or send too much.

use std::collections::BTreeSet;
use std::net::SocketAddr;
use std::sync::Mutex;
use std::time::Duration;

use tokio::io::AsyncWriteExt as _;
use tokio::net::TcpSocket;

use super::{Answer, Served};
use sortie::hangar::service::ServiceSetup;

/// A short wait, so that a test ends soon; nothing is expected to finish within it.
const SOON: Duration = Duration::from_millis(300);

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_is_too_long_is_refused() {
    let served = Served::start(1).await;
    let long = format!("{{\"model\": \"{}\"}}", "x".repeat(70_000));
    let answer = served.post(&long).await;
    assert_eq!(answer.status, 413, "{answer:?}");
    assert!(answer.problem().contains("65536 bytes"));
    let head = format!(
        "POST /vehicles HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n",
        served.address
    );
    let chunk = format!("{:x}\r\n{}\r\n", 20_000, " ".repeat(20_000));
    let answer = served
        .raw(format!("{head}{}0\r\n\r\n", chunk.repeat(4)).as_bytes())
        .await;
    assert_eq!(answer.status, 413, "{answer:?}");
    let header = format!("X-Long: {}", "x".repeat(40_000));
    let answer = served.send("GET", "/list", &[&header], "").await;
    assert_eq!(answer.status, 431, "{answer:?}");
    let path = format!("/{}", "x".repeat(40_000));
    let answer = served.ask("GET", &path).await;
    assert!([414, 431].contains(&answer.status), "{answer:?}");
    let fits = format!(
        "{{\"model\": \"quad\", \"parameters\": {{}}{}}}",
        " ".repeat(60_000)
    );
    let answer = served.post(&fits).await;
    assert_eq!(answer.status, 201, "{answer:?}");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn slow_clients_are_hung_up_on_and_others_served_meanwhile() {
    let adjust = |setup: &mut ServiceSetup| {
        setup.bounds.head = SOON;
        setup.bounds.body = SOON;
    };
    let served = Served::with(1, None, adjust).await;
    let mut silent = served.connect().await;
    let mut half = served.connect().await;
    half.write_all(b"GET /list HTTP/1.1\r\nHost: local")
        .await
        .expect("it is open");
    let dripping = served.connect().await;
    let (mut drip_in, mut drip_out) = dripping.into_split();
    let drip = tokio::spawn(async move {
        loop {
            // Sends until the service disconnects.
            if drip_out.write_all(b"GET").await.is_err() {
                return;
            }
            tokio::time::sleep(SOON / 10).await;
        }
    });
    let mut body = served.connect().await;
    let head = format!(
        "POST /vehicles HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\nContent-Length: 10\r\n\r\n{{",
        served.address
    );
    body.write_all(head.as_bytes()).await.expect("it is open");
    for _ in 0..10 {
        assert_eq!(served.ask("GET", "/list").await.status, 200);
    }
    for stream in [&mut silent, &mut half] {
        let answer = Answer::read(stream).await;
        assert!([0, 408].contains(&answer.status), "{answer:?}");
    }
    let answer = Answer::read(&mut body).await;
    assert_eq!(answer.status, 408, "{answer:?}");
    let mut rest = Vec::new();
    // A connection has ended whether it was reset or closed.
    let _ = tokio::io::AsyncReadExt::read_to_end(&mut drip_in, &mut rest).await;
    drip.await.expect("no panic");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn who_holds_all_connections_does_not_hold_them_for_long() {
    let adjust = |setup: &mut ServiceSetup| {
        setup.bounds.connections = 3;
        setup.bounds.head = SOON * 10;
    };
    let served = Served::with(1, None, adjust).await;
    let mut held = Vec::new();
    for _ in 0..3 {
        held.push(served.connect().await);
    }
    // This request may come before all three have been noticed; none of them waits.
    let answer = served.ask("GET", "/list").await;
    assert_eq!(answer.status, 503, "{answer:?}");
    assert!(answer.problem().contains("too many connections"));
    for stream in &mut held {
        Answer::read(stream).await;
    }
    let served_again = async {
        while served.ask("GET", "/list").await.status != 200 {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(super::PATIENCE, served_again)
        .await
        .expect("there is room again");
    served.end().await;
}

/// Ports of programs of another user.
static STRANGERS: Mutex<BTreeSet<u16>> = Mutex::new(BTreeSet::new());

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn another_user_of_the_host_cannot_keep_the_owner_out() {
    #[expect(clippy::unnecessary_wraps, reason = "the type of an owner")]
    fn owner(peer: SocketAddr, _: SocketAddr) -> Option<u32> {
        let strangers = STRANGERS.lock().expect("no panic");
        // Root may do everything that the owner may.
        Some(if strangers.contains(&peer.port()) {
            4711
        } else {
            0
        })
    }
    let adjust = |setup: &mut ServiceSetup| {
        setup.bounds.connections = 8;
        setup.owner = owner;
    };
    let served = Served::with(1, None, adjust).await;
    let mut held = Vec::new();
    for _ in 0..30 {
        let socket = TcpSocket::new_v4().expect("a socket");
        socket
            .bind("127.0.0.1:0".parse().expect("an address"))
            .expect("a port");
        let port = socket.local_addr().expect("bound").port();
        STRANGERS.lock().expect("no panic").insert(port);
        held.push(socket.connect(served.address).await.expect("it listens"));
        assert_eq!(served.ask("GET", "/list").await.status, 200);
    }
    drop(held);
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn those_who_wait_leave_room_for_those_who_ask() {
    let adjust = |setup: &mut ServiceSetup| setup.bounds.waiting = 2;
    let served = Served::with(1, None, adjust).await;
    let mut waiting = Vec::new();
    for _ in 0..2 {
        let mut stream = served.connect().await;
        let request = format!("GET /events HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
        stream
            .write_all(request.as_bytes())
            .await
            .expect("it is open");
        // The service has accepted the connection when it sends a byte.
        let mut first = [0; 1];
        tokio::io::AsyncReadExt::read_exact(&mut stream, &mut first)
            .await
            .expect("it answers");
        waiting.push(stream);
    }
    let third = served.ask("GET", "/events").await;
    assert_eq!(third.status, 503, "{third:?}");
    assert_eq!(served.ask("GET", "/list").await.status, 200);
    drop(waiting);
    served.end().await;
}
