//! Vehicles flown through the service.

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio_util::sync::CancellationToken;

use super::Served;
use crate::fleet::Console;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_vehicle_is_flown_through_the_tunnel() {
    let served = Served::start(1).await;
    let started = served.post(r#"{"system": 9, "speedup": 10}"#).await;
    assert_eq!(started.status, 201, "{started:?}");
    let remote = served.remote();
    let cancel = CancellationToken::new();
    let mut console = Console::start();
    console.connect_to(remote.tunnel(1, cancel.clone()));
    console.until_ready(&[9]).await;
    console.give("guided", &[9]);
    console.give("arm", &[9]);
    let takeoff = console.give("takeoff 10", &[9]);
    console.until_done(takeoff, 9).await;
    let instance = served.ask("GET", "/vehicles/1").await.json();
    assert_eq!(instance["attached"], true);
    cancel.cancel();
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_tunnel_is_for_one_at_a_time_and_asks_for_an_upgrade() {
    let served = Served::start(1).await;
    served.post("{}").await;
    let plain = served.ask("GET", "/vehicles/1/mavlink").await;
    assert_eq!(plain.status, 426, "{plain:?}");
    assert!(plain.head.contains("upgrade: mavlink"), "{plain:?}");
    let request = format!(
        "GET /vehicles/1/mavlink HTTP/1.1\r\nHost: {}\r\nConnection: keep-alive, Upgrade\r\nUpgrade: mavlink\r\n\r\n",
        served.address
    );
    let mut first = served.connect().await;
    first
        .write_all(request.as_bytes())
        .await
        .expect("it is open");
    let mut bytes = Vec::new();
    while !bytes.contains(&0xFD) {
        let mut some = [0; 512];
        let len = first.read(&mut some).await.expect("it speaks");
        assert!(len > 0, "{}", String::from_utf8_lossy(&bytes));
        bytes.extend_from_slice(&some[..len]);
    }
    assert!(bytes.starts_with(b"HTTP/1.1 101 "));
    let closing = request.replace("keep-alive", "close");
    let second = served.raw(closing.as_bytes()).await;
    assert_eq!(second.status, 409, "{second:?}");
    assert!(second.problem().contains("attached to instance 1 already"));
    drop(first);
    let remote = served.remote();
    let mut pipe = remote.tunnel(1, CancellationToken::new());
    let mut some = [0; 1];
    pipe.read_exact(&mut some).await.expect("it is free again");
    served.end().await;
}

/// A service that exposes its vehicles.
async fn exposing() -> Served {
    let adjust = |setup: &mut sortie::hangar::service::ServiceSetup| setup.expose = true;
    Served::with(2, Some(crate::stand_in::Behaviour::Normal), adjust).await
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_exposed_vehicle_has_a_port_of_its_own() {
    let served = exposing().await;
    let started = served.post("{}").await.json();
    let port = started["port"].as_u64().expect("a port") as u16;
    let list = served.ask("GET", "/vehicles").await.json();
    assert_eq!(list[0]["port"], port);
    let mut stream = TcpStream::connect(("127.0.0.1", port))
        .await
        .expect("it listens");
    let mut some = [0; 1];
    stream.read_exact(&mut some).await.expect("it speaks");
    served.ask("DELETE", "/vehicles/1").await;
    let closed = async {
        while TcpStream::connect(("127.0.0.1", port)).await.is_ok() {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(super::PATIENCE, closed)
        .await
        .expect("the port is closed");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_list_names_the_ports_of_exposed_vehicles() {
    let served = exposing().await;
    let ports = [served.post("{}").await, served.post("{}").await]
        .map(|started| started.json()["port"].as_u64().expect("a port"));
    for id in 1..=2 {
        let path = format!("/vehicles/{id}/ready?timeout_s=90");
        assert_eq!(served.ask("GET", &path).await.status, 200);
    }
    let [first, second] = ports;
    let expected = format!("1 ready tcp:127.0.0.1:{first}\n2 ready tcp:127.0.0.1:{second}\n");
    assert_eq!(served.ask("GET", "/list").await.body, expected);
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_second_client_of_an_exposed_port_is_turned_away_and_counted() {
    let served = exposing().await;
    let port = served.post("{}").await.json()["port"].as_u64();
    let port = port.expect("a port") as u16;
    let connect = async || TcpStream::connect(("127.0.0.1", port)).await;
    let mut first = connect().await.expect("it listens");
    let mut some = [0; 1];
    first.read_exact(&mut some).await.expect("it speaks");
    let refused = async || served.ask("GET", "/vehicles/1").await.json()["refused"].as_u64();
    assert_eq!(refused().await, Some(0));
    for count in 1..=2 {
        let mut second = connect().await.expect("it listens");
        let heard = tokio::time::timeout(super::PATIENCE, second.read(&mut some)).await;
        let heard = heard.expect("it is closed");
        assert!(matches!(heard, Ok(0) | Err(_)), "{heard:?}");
        let counted = async {
            while refused().await != Some(count) {
                tokio::task::yield_now().await;
            }
        };
        let counted = tokio::time::timeout(super::PATIENCE, counted).await;
        counted.expect("it is counted once");
    }
    first.read_exact(&mut some).await.expect("it still speaks");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn nothing_is_exposed_unless_asked_for() {
    let served = Served::start(1).await;
    assert!(served.post("{}").await.json().get("port").is_none());
    served.end().await;
}
