//! The service's checks of its clients.

use std::net::SocketAddr;

use super::{Served, ours};
use sortie::hangar::service::{Owner, ServiceSetup};

#[expect(clippy::unnecessary_wraps, reason = "one of several of its type")]
fn stranger(_: SocketAddr, _: SocketAddr) -> Option<u32> {
    Some(nix::unistd::geteuid().as_raw() + 4242)
}

#[expect(clippy::unnecessary_wraps, reason = "one of several of its type")]
fn root(_: SocketAddr, _: SocketAddr) -> Option<u32> {
    Some(0)
}

fn unknown(_: SocketAddr, _: SocketAddr) -> Option<u32> {
    None
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_same_user_needs_no_token_and_everybody_else_does() {
    for (owner, require_token, status) in [
        (ours as Owner, false, 200),
        (root, false, 200),
        (stranger, false, 401),
        (unknown, false, 401),
        (ours, true, 401),
    ] {
        let adjust = |setup: &mut ServiceSetup| {
            setup.owner = owner;
            setup.require_token = require_token;
        };
        let served = Served::with(1, None, adjust).await;
        let plain = served.ask("GET", "/list").await;
        assert_eq!(plain.status, status, "{plain:?}");
        if status == 401 {
            assert!(plain.head.contains("www-authenticate: bearer"), "{plain:?}");
            assert!(plain.problem().contains("Authorization: Bearer TOKEN"));
        }
        let right = format!("Authorization: {}", served.token.authorization());
        let answer = served.send("GET", "/list", &[&right], "").await;
        assert_eq!(answer.status, 200, "{answer:?}");
        served.end().await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_wrong_token_is_refused_even_of_the_same_user_and_on_every_path() {
    let served = Served::start(1).await;
    let right = served.token.authorization();
    let short = &right[..right.len() - 1];
    for wrong in [
        "Bearer",
        "Bearer ",
        "Bearer 0",
        short,
        &format!("{right}0"),
        &right.replace("Bearer", "Basic"),
        &right.replace("Bearer ", ""),
    ] {
        let header = format!("Authorization: {wrong}");
        for (method, path) in [
            ("GET", "/list"),
            ("GET", "/start/1"),
            ("GET", "/openapi.json"),
            ("DELETE", "/vehicles/1"),
            ("GET", "/vehicles/1/mavlink"),
            ("GET", "/events"),
            ("GET", "/nothing"),
        ] {
            let answer = served.send(method, path, &[&header], "").await;
            assert_eq!(answer.status, 401, "{wrong} {path}: {answer:?}");
        }
    }
    assert_eq!(served.ask("GET", "/list").await.body, "");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn pages_of_other_sites_are_refused() {
    let served = Served::start(1).await;
    let port = served.address.port();
    let own_origin = format!("Origin: http://{}", served.address);
    for (headers, status) in [
        (vec!["Host: evil.example".to_owned()], 403),
        (vec![format!("Host: evil.example:{port}")], 403),
        (vec!["Host: 192.0.2.1".to_owned()], 403),
        (vec!["Host: localhost".to_owned()], 200),
        (vec![format!("Host: localhost:{port}")], 200),
        (vec!["Host: 127.0.0.1:6000".to_owned()], 200),
        (
            vec![
                "Host: localhost".to_owned(),
                "Host: evil.example".to_owned(),
            ],
            400,
        ),
        (vec!["Origin: http://evil.example".to_owned()], 403),
        (vec!["Origin: null".to_owned()], 403),
        (vec![own_origin], 200),
        (vec!["Sec-Fetch-Site: cross-site".to_owned()], 403),
        (vec!["Sec-Fetch-Site: same-site".to_owned()], 403),
        (vec!["Sec-Fetch-Site: none".to_owned()], 200),
    ] {
        let words: Vec<&str> = headers.iter().map(String::as_str).collect();
        let answer = served.send("GET", "/list", &words, "").await;
        assert_eq!(answer.status, status, "{headers:?}: {answer:?}");
    }
    // An address in the request line takes precedence over the header.
    for (address, status) in [("http://evil.example", 403), ("http://localhost", 200)] {
        let request =
            format!("GET {address}/list HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
        let answer = served.raw(request.as_bytes()).await;
        assert_eq!(answer.status, status, "{address}: {answer:?}");
    }
    for (whole, status) in [("evil.example", 403), ("localhost", 200)] {
        let path = format!("http://{whole}/list");
        let answer = served.send("GET", &path, &["Host: localhost"], "").await;
        assert_eq!(answer.status, status, "{whole}: {answer:?}");
    }
    let start = ["Sec-Fetch-Site: cross-site"];
    served.send("GET", "/start/1", &start, "").await;
    assert_eq!(served.ask("GET", "/list").await.body, "");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn who_means_an_earlier_run_of_the_service_is_told_so() {
    let served = Served::start(1).await;
    let life = served.ask("GET", "/status").await.json();
    let life = life["life"].as_str().expect("it has one").to_owned();
    for (life, status) in [(life.as_str(), 200), ("0123456789abcdef", 412)] {
        let header = format!("If-Match: \"{life}\"");
        let answer = served.send("GET", "/list", &[&header], "").await;
        assert_eq!(answer.status, status, "{answer:?}");
    }
    served.end().await;
}
