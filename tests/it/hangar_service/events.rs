//! The stream of events.

use serde_json::Value;
use tokio::io::{AsyncBufReadExt as _, AsyncWriteExt as _, BufReader, Lines};
use tokio::net::TcpStream;

use super::{PATIENCE, Served};

struct Events(Lines<BufReader<TcpStream>>);

impl Events {
    async fn follow(served: &Served) -> Self {
        let mut stream = served.connect().await;
        // Without chunked encoding the lines are easy to find.
        let request = format!("GET /events HTTP/1.0\r\nHost: {}\r\n\r\n", served.address);
        stream
            .write_all(request.as_bytes())
            .await
            .expect("it is open");
        let mut events = Self(BufReader::new(stream).lines());
        let head = events.line().await.expect("a status line");
        assert!(head.contains(" 200 "), "{head}");
        while let Some(line) = events.line().await.filter(|line| !line.is_empty()) {
            if line.starts_with("content-type") {
                assert_eq!(line, "content-type: text/event-stream");
            }
        }
        events
    }

    async fn line(&mut self) -> Option<String> {
        let line = tokio::time::timeout(PATIENCE, self.0.next_line()).await;
        line.expect("in time").ok().flatten()
    }

    async fn next(&mut self) -> Option<(String, Value)> {
        let mut name = String::new();
        loop {
            let line = self.line().await?;
            if let Some(word) = line.strip_prefix("event: ") {
                word.clone_into(&mut name);
            }
            if let Some(data) = line.strip_prefix("data: ") {
                return Some((name, serde_json::from_str(data).expect("JSON")));
            }
        }
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn events_come_in_order_after_a_snapshot() {
    let served = Served::start(2).await;
    served.post("{}").await;
    let mut events = Events::follow(&served).await;
    let (name, snapshot) = events.next().await.expect("a snapshot");
    assert_eq!(name, "snapshot");
    assert_eq!(snapshot["vehicles"][0]["id"], 1);
    assert_eq!(snapshot["life"].as_str().map(str::len), Some(16));
    let stages = [
        "queued",
        "process",
        "heartbeat",
        "parameters",
        "position",
        "ready",
    ];
    let place = |stage: &Value| {
        stages
            .iter()
            .position(|word| *word == stage.as_str().unwrap_or(""))
    };
    let mut last = place(&snapshot["vehicles"][0]["stage"]);
    while last != Some(5) {
        let (name, instance) = events.next().await.expect("it goes on");
        assert_eq!(
            (name.as_str(), &instance["id"]),
            ("vehicle", &Value::from(1))
        );
        let stage = place(&instance["stage"]);
        assert!(stage >= last, "{instance}");
        last = stage;
    }
    served.ask("DELETE", "/vehicles/1").await;
    served.post("{}").await;
    let mut seen = Vec::new();
    while !seen.contains(&"ready".to_owned()) {
        let (name, data) = events.next().await.expect("it goes on");
        seen.push(if name == "gone" {
            name
        } else {
            data["stage"].as_str().unwrap_or("").to_owned()
        });
        if seen.last().is_some_and(|word| word == "ready") && !seen.contains(&"gone".to_owned()) {
            // Events of the first instance, before it is ended.
            seen.clear();
        }
    }
    let gone = seen
        .iter()
        .position(|word| word == "gone")
        .expect("the first has gone");
    let new = seen
        .iter()
        .rposition(|word| word == "queued" || word == "process");
    assert!(new.is_some_and(|new| new > gone), "{seen:?}");
    served.cancel.cancel();
    // The stream ends with the service.
    while events.next().await.is_some() {}
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn who_follows_hears_that_the_service_is_there() {
    let adjust = |setup: &mut sortie::hangar::service::ServiceSetup| {
        setup.bounds.keep_alive = std::time::Duration::from_millis(50);
    };
    let served = Served::with(1, None, adjust).await;
    let mut events = Events::follow(&served).await;
    events.next().await.expect("a snapshot");
    let mut lines = Vec::new();
    while !lines.contains(&":".to_owned()) {
        lines.push(events.line().await.expect("it goes on").trim().to_owned());
    }
    served.end().await;
}
