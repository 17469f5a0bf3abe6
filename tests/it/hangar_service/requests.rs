//! The requests of the service, and their answers.

use futures_util::future::join_all;
use serde_json::{Value, json};

use super::{PATIENCE, Served};
use crate::stand_in::Behaviour;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_vehicle_is_started_told_of_and_ended() {
    let served = Served::start(4).await;
    let started = served.post(r#"{"system": 7, "idle_s": 600}"#).await;
    assert_eq!(started.status, 201, "{started:?}");
    assert!(started.head.contains("location: /vehicles/1"));
    assert_eq!(started.json()["system"], 7);
    let ready = served.ask("GET", "/vehicles/1/ready?timeout_s=90").await;
    assert_eq!(ready.status, 200, "{ready:?}");
    assert_eq!(ready.json()["stage"], "ready");
    let list = served.ask("GET", "/vehicles").await.json();
    assert_eq!(list.as_array().map(Vec::len), Some(1));
    assert_eq!(list[0]["id"], 1);
    let status = served.ask("GET", "/status").await.json();
    assert_eq!(status["capacity"], json!({ "running": 1, "free": 3 }));
    assert_eq!(status["programs"][0]["identity"], "a stand-in");
    let pid = list[0]["pid"].as_u64().expect("it runs");
    let again = served.ask("POST", "/vehicles/1/restart").await;
    assert_eq!(again.status, 202, "{again:?}");
    let ready = served.ask("GET", "/vehicles/1/ready?timeout_s=90").await;
    assert_eq!(ready.status, 200, "{ready:?}");
    let gone = served.ask("DELETE", "/vehicles/1").await;
    assert_eq!((gone.status, gone.body.as_str()), (204, ""));
    assert_eq!(served.ask("GET", "/vehicles/1").await.status, 404);
    assert!(!std::path::Path::new(&format!("/proc/{pid}")).exists());
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_papers_plain_requests_do_the_same() {
    let served = Served::start(4).await;
    let started = served.ask("GET", "/start/3").await;
    assert_eq!(
        (started.status, started.body.as_str()),
        (201, "3 started\n")
    );
    let twice = served.ask("GET", "/start/3").await;
    assert_eq!(twice.status, 409, "{twice:?}");
    let early = served.ask("GET", "/ready/3").await;
    assert!([200, 202].contains(&early.status), "{early:?}");
    served.ask("GET", "/vehicles/3/ready?timeout_s=90").await;
    let ready = served.ask("GET", "/ready/3").await;
    assert_eq!((ready.status, ready.body.as_str()), (200, "3 ready\n"));
    let list = served.ask("GET", "/list").await;
    assert_eq!((list.status, list.body.as_str()), (200, "3 ready\n"));
    let accept = ["Accept: application/json"];
    let json = served.send("GET", "/list", &accept, "").await.json();
    assert_eq!(json[0]["stage"], "ready");
    let stopped = served.ask("GET", "/stop/3").await;
    assert_eq!(
        (stopped.status, stopped.body.as_str()),
        (200, "3 stopped\n")
    );
    assert_eq!(served.ask("GET", "/stop/3").await.status, 404);
    assert_eq!(served.ask("GET", "/list").await.body, "");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn readiness_tells_what_is_not_ready_and_what_has_ended() {
    let served = Served::with(2, Some(Behaviour::NeverReady), |_| ()).await;
    served.post("{}").await;
    let waiting = served.ask("GET", "/vehicles/1/ready?timeout_s=0").await;
    assert_eq!(waiting.status, 202, "{waiting:?}");
    assert_ne!(waiting.json()["stage"], "ready");
    let long = served.ask("GET", "/vehicles/1/ready?timeout_s=301").await;
    assert_eq!(long.status, 400);
    assert!(long.problem().contains("300"), "{}", long.problem());
    served.end().await;

    let served = Served::with(2, Some(Behaviour::ExitsBeforeConnecting), |_| ()).await;
    served.post("{}").await;
    let ended = served.ask("GET", "/vehicles/1/ready?timeout_s=90").await;
    assert_eq!(ended.status, 410, "{ended:?}");
    assert!(ended.problem().contains("has ended"), "{ended:?}");
    let output = served.ask("GET", "/vehicles/1/output?lines=1").await.json();
    assert_eq!(
        output["lines"].as_array().map(Vec::len),
        Some(1),
        "{output}"
    );
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn fifty_clients_at_once_get_what_there_is_and_no_more() {
    let served = Served::start(3).await;
    let starts = join_all((0..25).map(|_| served.post("{}")));
    let lists = join_all((0..25).map(|_| served.ask("GET", "/vehicles")));
    let both = async { tokio::join!(starts, lists) };
    let (starts, lists) = tokio::time::timeout(PATIENCE, both).await.expect("in time");
    assert!(lists.iter().all(|answer| answer.status == 200));
    let mut ids: Vec<u64> = starts
        .iter()
        .filter(|answer| answer.status == 201)
        .filter_map(|answer| answer.json()["id"].as_u64())
        .collect();
    ids.sort_unstable();
    assert_eq!(ids, [1, 2, 3]);
    let full: Vec<_> = starts.iter().filter(|one| one.status == 503).collect();
    assert_eq!(full.len(), 22);
    assert!(full[0].head.contains("retry-after"), "{:?}", full[0]);
    assert!(full[0].problem().contains('3'), "{:?}", full[0]);
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_makes_no_sense_is_refused_with_what_is_wrong_and_where() {
    let served = Served::start(1).await;
    for (body, expected) in [
        ("", "EOF while parsing a value at line 1 column 0"),
        ("{", "EOF while parsing an object at line 1 column 1"),
        ("[]", "a list; expected an object at line 1 column 1"),
        (
            "{\"id\": \"one\"}",
            "invalid type: string \"one\", expected u16 at line 1 column 12",
        ),
        ("{\"id\": 70000}", "line 1 column 12"),
        (
            "{\n \"hoem\": {}}",
            "unknown field `hoem`, expected one of `id`",
        ),
        (
            "{\"home\": {\"lat_deg\": 1}}",
            "missing field `lon_deg` at line 1 column 23",
        ),
        (
            "{\"kind\": \"boat\"}",
            "unknown variant `boat`, expected one of `copter`",
        ),
        ("{} {}", "trailing characters at line 1 column 4"),
        ("\u{0}", "expected value at line 1 column 1"),
    ] {
        let answer = served.post(body).await;
        assert_eq!(answer.status, 400, "{body}: {answer:?}");
        assert!(
            answer.problem().contains(expected),
            "{body}: {}",
            answer.problem()
        );
    }
    let json = "Content-Type: application/json";
    let form = "Content-Type: application/x-www-form-urlencoded";
    for (method, path, headers, status, expected) in [
        ("POST", "/vehicles", &[form][..], 415, "application/json"),
        ("POST", "/vehicles", &[], 415, "application/json"),
        ("GET", "/vehicles/one", &[], 400, "`one` is not an instance"),
        (
            "GET",
            "/vehicles/70000",
            &[],
            400,
            "`70000` is not an instance",
        ),
        ("GET", "/vehicles/%ff", &[], 400, "UTF-8"),
        ("GET", "/vehicles/9", &[], 404, "no instance 9"),
        ("DELETE", "/vehicles/9", &[], 404, "no instance 9"),
        ("POST", "/vehicles/9/restart", &[json], 404, "no instance 9"),
        ("GET", "/vehicles/9/ready", &[], 404, "no instance 9"),
        ("GET", "/vehicles/9/output", &[], 404, "no instance 9"),
        (
            "GET",
            "/vehicles/9/ready?timeout=1",
            &[],
            400,
            "unknown field `timeout`, expected `timeout_s`",
        ),
        (
            "GET",
            "/vehicles/9/ready?timeout_s=-1",
            &[],
            400,
            "timeout_s: invalid digit",
        ),
        ("GET", "/vehicle", &[], 404, "unknown path /vehicle"),
        (
            "PATCH",
            "/vehicles",
            &[],
            405,
            "PATCH is not supported by /vehicles",
        ),
        (
            "POST",
            "/start/1",
            &[],
            405,
            "POST is not supported by /start/1",
        ),
    ] {
        let body = if method == "POST" { "{}" } else { "" };
        let answer = served.send(method, path, headers, body).await;
        assert_eq!(answer.status, status, "{method} {path}: {answer:?}");
        assert!(answer.problem().contains(expected), "{}", answer.problem());
    }
    let nothing = served.ask("GET", "/vehicles").await;
    assert_eq!(nothing.body, "[]", "nothing of that has started anything");
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn head_does_nothing_where_get_does_something() {
    let served = Served::start(2).await;
    served.post("{}").await;
    let upgrade = ["Connection: upgrade", "Upgrade: mavlink"];
    for (path, headers) in [
        ("/start/2", &[][..]),
        ("/stop/1", &[]),
        ("/vehicles/1/mavlink", &upgrade),
    ] {
        let answer = served.send("HEAD", path, headers, "").await;
        assert_eq!(answer.status, 405, "{path}: {answer:?}");
        assert!(answer.head.contains("allow: get\r\n"), "{answer:?}");
        assert_eq!(answer.body, "");
    }
    let list = served.ask("GET", "/vehicles").await.json();
    assert_eq!(list.as_array().map(Vec::len), Some(1), "{list}");
    assert_eq!(list[0]["id"], 1);
    assert_eq!(list[0]["attached"], false);
    let read = served.send("HEAD", "/vehicles/1", &[], "").await;
    assert_eq!((read.status, read.body.as_str()), (200, ""));
    served.end().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_description_has_every_request_and_only_those() {
    let served = Served::start(1).await;
    let document = served.ask("GET", "/openapi.json").await.json();
    assert!(
        document["openapi"]
            .as_str()
            .is_some_and(|version| version.starts_with("3.1"))
    );
    let paths = document["paths"].as_object().expect("paths");
    assert_eq!(paths.len(), 13);
    let mut names = std::collections::BTreeSet::new();
    for (path, operations) in paths {
        for operation in operations.as_object().expect("operations").values() {
            let name = operation["operationId"].as_str().expect("a name");
            assert!(names.insert(name), "{name} names two operations");
        }
        // An instance number that does not exist, so that nothing happens.
        let place = path.replace("{id}", "9999");
        for method in ["GET", "POST", "PUT", "DELETE", "PATCH"] {
            let described = operations.get(method.to_ascii_lowercase());
            if place == "/start/9999" && method == "GET" || place == "/events" {
                continue;
            }
            let answer = served.ask(method, &place).await;
            assert_eq!(
                answer.status == 405,
                described.is_none(),
                "{method} {path}: {answer:?}"
            );
            if let Some(described) = described {
                let codes = described["responses"].as_object().expect("responses");
                // Any request may be unauthorised, so the document states it once.
                assert!(
                    codes.contains_key(&answer.status.to_string()),
                    "{method} {path}: {answer:?}"
                );
            }
        }
    }
    for name in [
        "Launch", "Home", "Instance", "Stage", "Kind", "Problem", "Status", "Printed",
    ] {
        assert!(
            document["components"]["schemas"][name].is_object(),
            "{name}"
        );
    }
    every_reference_leads_somewhere(&document, &document);
    served.end().await;
}

fn every_reference_leads_somewhere(document: &Value, part: &Value) {
    match part {
        Value::Object(fields) => {
            if let Some(Value::String(place)) = fields.get("$ref") {
                let pointer = place.trim_start_matches('#');
                assert!(document.pointer(pointer).is_some(), "{place}");
            }
            let parts = fields.values();
            parts.for_each(|part| every_reference_leads_somewhere(document, part));
        }
        Value::Array(parts) => {
            let parts = parts.iter();
            parts.for_each(|part| every_reference_leads_somewhere(document, part));
        }
        _ => {}
    }
}
