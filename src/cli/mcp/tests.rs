use serde_json::{Value, json};

use super::*;

mod hostile;

/// The bridge's response to a message from the client.
fn hear(bridge: &mut Bridge, message: &Value) -> Option<BridgeMessage> {
    bridge.hear_client(message.to_string().as_bytes())
}

/// The answer to a message that needs no console.
fn answer(bridge: &mut Bridge, message: &Value) -> Value {
    match hear(bridge, message) {
        Some(BridgeMessage::ToClient(answer)) => answer,
        other => panic!("{message}: {other:?}"),
    }
}

/// The console request that a call makes.
fn asked(bridge: &mut Bridge, message: &Value) -> Value {
    match hear(bridge, message) {
        Some(BridgeMessage::ToConsole(line)) => serde_json::from_str(&line).expect("JSON"),
        other => panic!("{message}: {other:?}"),
    }
}

fn request(method: &str, params: &Value) -> Value {
    json!({"jsonrpc": "2.0", "id": 1, "method": method, "params": params})
}

fn call(id: impl Into<Value>, name: &str, arguments: &Value) -> Value {
    let params = json!({"name": name, "arguments": arguments});
    let id: Value = id.into();
    json!({"jsonrpc": "2.0", "id": id, "method": "tools/call", "params": params})
}

/// Whether the result of a tool is an error, and its text.
fn outcome(answer: &Value) -> (bool, &str) {
    let result = &answer["result"];
    assert_eq!(result["content"].as_array().map(Vec::len), Some(1));
    assert_eq!(result["content"][0]["type"], "text");
    let text = result["content"][0]["text"].as_str().expect("text");
    (result["isError"].as_bool().expect("a flag"), text)
}

fn names(bridge: &mut Bridge) -> Vec<String> {
    let listed = answer(bridge, &request("tools/list", &json!({})));
    let tools = listed["result"]["tools"].as_array().expect("tools");
    let name = |tool: &Value| tool["name"].as_str().expect("a name").to_owned();
    tools.iter().map(name).collect()
}

#[test]
fn client_and_server_agree_on_a_version() {
    for (asked, agreed) in [
        ("2024-11-05", "2024-11-05"),
        ("2025-03-26", "2024-11-05"),
        ("2025-06-18", "2025-06-18"),
        ("2025-11-25", "2025-11-25"),
        ("2026-07-28", "2025-11-25"),
        ("1.0", "2025-11-25"),
    ] {
        let params =
            json!({"protocolVersion": asked, "capabilities": {}, "clientInfo": {"name": "c"}});
        let answer = answer(&mut Bridge::new(false), &request("initialize", &params));
        assert_eq!(answer["result"]["protocolVersion"], agreed, "{asked}");
        assert_eq!(answer["result"]["capabilities"], json!({"tools": {}}));
        assert_eq!(answer["result"]["serverInfo"]["name"], "sortie");
    }
}

#[test]
fn notifications_and_answers_are_not_answered() {
    let mut bridge = Bridge::new(false);
    for message in [
        json!({"jsonrpc": "2.0", "method": "notifications/initialized"}),
        json!({"jsonrpc": "2.0", "method": "tools/call", "params": {"name": "vehicles"}}),
        json!({"jsonrpc": "2.0", "method": "unknown", "params": []}),
        json!({"jsonrpc": "2.0", "id": 3, "result": {}}),
        json!({"jsonrpc": "2.0", "id": null, "error": {"code": -32700, "message": "not JSON"}}),
    ] {
        assert_eq!(hear(&mut bridge, &message), None, "{message}");
    }
    assert_eq!(bridge.hear_client(b" \r\n"), None);
    let pong = answer(
        &mut bridge,
        &json!({"jsonrpc": "2.0", "id": "p", "method": "ping"}),
    );
    assert_eq!(pong, json!({"jsonrpc": "2.0", "id": "p", "result": {}}));
}

#[test]
fn a_message_that_cannot_be_carried_out_gets_an_error() {
    let mut bridge = Bridge::new(false);
    for (line, id, code) in [
        ("fly", Value::Null, -32700),
        ("{\"jsonrpc\": \"2.0\", \"id\": 1", Value::Null, -32700),
        ("[]", Value::Null, -32600),
        (
            r#"[{"jsonrpc": "2.0", "id": 1, "method": "ping"}]"#,
            Value::Null,
            -32600,
        ),
        (r#"{"id": 1, "method": "ping"}"#, json!(1), -32600),
        (
            r#"{"jsonrpc": "2.0", "id": null, "method": "ping"}"#,
            Value::Null,
            -32600,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": [1], "method": "ping"}"#,
            Value::Null,
            -32600,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": 1, "method": 7}"#,
            json!(1),
            -32600,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": "a", "method": "server/discover"}"#,
            json!("a"),
            -32601,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": 1, "method": "ping", "params": [1]}"#,
            json!(1),
            -32602,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": 1, "method": "initialize"}"#,
            json!(1),
            -32602,
        ),
        (
            r#"{"jsonrpc": "2.0", "id": 1, "method": "tools/call"}"#,
            json!(1),
            -32602,
        ),
    ] {
        let Some(BridgeMessage::ToClient(answer)) = bridge.hear_client(line.as_bytes()) else {
            panic!("no answer: {line}");
        };
        assert_eq!(answer["jsonrpc"], "2.0", "{line}");
        assert_eq!(answer["id"], id, "{line}");
        assert_eq!(answer["error"]["code"], code, "{line}");
        assert!(answer.get("result").is_none(), "{line}");
    }
    for name in ["", "moon", "watch"] {
        let answer = answer(&mut bridge, &call(1, name, &json!({})));
        assert_eq!(answer["error"]["code"], -32602, "{name}");
    }
}

#[test]
fn a_tool_that_reads_answers_with_a_state_of_the_console() {
    let mut bridge = Bridge::new(false);
    let sent = asked(&mut bridge, &call("a", "vehicles", &json!({})));
    assert_eq!(sent, json!({"do": "get", "what": "vehicles", "id": 1}));
    let sent = asked(&mut bridge, &call("b", "plan", &json!({"vehicle": 3})));
    assert_eq!(
        sent,
        json!({"do": "get", "what": "plan", "vehicle": 3, "id": 2})
    );
    let plan = bridge.hear_console("plan", json!({"id": 2, "vehicle": 3, "items": []}));
    let plan = plan.expect("an answer");
    assert_eq!(plan["id"], "b");
    assert_eq!(outcome(&plan), (false, r#"{"items":[],"vehicle":3}"#));
    let fault = json!({"id": 1, "message": "too early", "help": "wait", "asks": false});
    let fault = bridge.hear_console("fault", fault).expect("an answer");
    assert_eq!(fault["id"], "a");
    assert_eq!(outcome(&fault), (true, "too early; wait"));
    assert_eq!(bridge.hear_console("vehicles", json!({"list": []})), None);
}

#[test]
fn arguments_that_do_not_fit_are_explained_to_the_model() {
    let mut bridge = Bridge::new(true);
    for (name, arguments) in [
        ("plan", json!({})),
        ("plan", json!({"vehicle": "1"})),
        ("plan", json!({"vehicle": -1})),
        (
            "vehicles",
            json!({"do": "say", "line": "all kill", "confirm": true}),
        ),
        ("say", json!({"line": 7})),
        ("say", json!({"line": "all arm", "do": "get"})),
        ("say", json!({"line": "x".repeat(70_000)})),
    ] {
        let answer = answer(&mut bridge, &call(1, name, &arguments));
        assert!(outcome(&answer).0, "{name} {answer}");
    }
}

#[test]
fn commands_are_a_tool_only_if_they_are_allowed() {
    let mut reading = Bridge::new(false);
    assert!(!names(&mut reading).contains(&"say".to_owned()));
    let refused = answer(&mut reading, &call(1, "say", &json!({"line": "all arm"})));
    assert_eq!(refused["error"]["code"], -32602);
    let message = refused["error"]["message"].as_str().expect("a message");
    assert!(message.contains("--allow-commands"), "{message}");
    let mut commanding = Bridge::new(true);
    assert!(names(&mut commanding).contains(&"say".to_owned()));
    let sent = asked(
        &mut commanding,
        &call(1, "say", &json!({"line": "all arm"})),
    );
    assert_eq!(
        sent,
        json!({"do": "say", "line": "all arm", "confirm": false, "id": 1})
    );
}

#[test]
fn a_line_answers_with_its_rows_when_it_has_ended() {
    let mut bridge = Bridge::new(true);
    let mut message = call(5, "say", &json!({"line": "1-2 land"}));
    message["params"]["_meta"] = json!({"progressToken": "t"});
    asked(&mut bridge, &message);
    let mut hear = |kind: &str, content: Value| bridge.hear_console(kind, content);
    assert_eq!(hear("ok", json!({"id": 1, "entry": 17})), None);
    let row = |vehicle, state, is_final| json!({"entry": 17, "line": "1-2 land", "vehicle": vehicle, "state": state, "is_final": is_final, "remark": null});
    assert_eq!(hear("row", row(1, "accepted", false)), None);
    let progress = hear("row", row(2, "timed_out", true)).expect("progress");
    assert_eq!(progress["method"], "notifications/progress");
    let expected = json!({"progressToken": "t", "progress": 1, "message": "vehicle 2: timed out"});
    assert_eq!(progress["params"], expected);
    assert_eq!(hear("row", row(2, "timed_out", true)), None, "the same row");
    assert_eq!(
        hear("row", row(1, "done", true)).expect("progress")["params"]["progress"],
        2
    );
    assert_eq!(hear("ended", json!({"entry": 16, "done": true})), None);
    let ended = hear("ended", json!({"entry": 17, "done": false})).expect("an answer");
    assert_eq!(ended["id"], 5);
    let (is_error, text) = outcome(&ended);
    assert!(is_error);
    let text: Value = serde_json::from_str(text).expect("JSON");
    let rows = json!([
        {"vehicle": 1, "state": "done", "remark": null},
        {"vehicle": 2, "state": "timed_out", "remark": null},
    ]);
    assert_eq!(
        text,
        json!({"entry": 17, "done": false, "text": null, "rows": rows})
    );
}

#[test]
fn a_line_to_the_console_itself_answers_with_its_text_and_a_fault_with_the_way_out() {
    let mut bridge = Bridge::new(true);
    asked(
        &mut bridge,
        &call(1, "say", &json!({"line": "all plan status"})),
    );
    let ok = bridge.hear_console("ok", json!({"id": 1, "entry": null, "text": "1: no plan"}));
    let ok = ok.expect("an answer");
    assert_eq!(
        outcome(&ok),
        (false, r#"{"done":true,"text":"1: no plan"}"#)
    );
    asked(&mut bridge, &call(2, "say", &json!({"line": "all kill"})));
    let fault = json!({"id": 2, "message": "needs a confirmation", "asks": true});
    let fault = bridge.hear_console("fault", fault).expect("an answer");
    let expected = "needs a confirmation; with `confirm`, it is carried out";
    assert_eq!(outcome(&fault), (true, expected));
}

#[test]
fn a_cancelled_call_is_not_answered() {
    let mut bridge = Bridge::new(true);
    asked(&mut bridge, &call(1, "say", &json!({"line": "all land"})));
    asked(&mut bridge, &call(2, "say", &json!({"line": "all arm"})));
    bridge.hear_console("ok", json!({"id": 2, "entry": 4}));
    for id in [1, 2, 3] {
        let params = json!({"requestId": id});
        let message =
            json!({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": params});
        assert_eq!(hear(&mut bridge, &message), None);
    }
    assert_eq!(
        bridge.hear_console("ok", json!({"id": 1, "entry": 3})),
        None
    );
    for entry in [3, 4] {
        assert_eq!(
            bridge.hear_console("ended", json!({"entry": entry, "done": true})),
            None
        );
    }
    assert!(bridge.lose_console("gone").is_empty());
}

#[test]
fn calls_are_limited_and_fail_with_the_console() {
    let mut bridge = Bridge::new(false);
    for id in 0..MOST_CALLS {
        asked(&mut bridge, &call(id, "mission", &json!({})));
    }
    let refused = answer(&mut bridge, &call("more", "mission", &json!({})));
    assert!(outcome(&refused).0);
    let answers = bridge.lose_console("gone");
    let ids: Vec<_> = answers.iter().map(|it| it["id"].as_u64()).collect();
    assert_eq!(ids, (0..MOST_CALLS as u64).map(Some).collect::<Vec<_>>());
    assert!(answers.iter().all(|it| outcome(it) == (true, "gone")));
    asked(&mut bridge, &call("more", "mission", &json!({})));
}

#[test]
fn a_line_that_is_too_long_is_cut_off_and_the_next_one_is_read() {
    let most = usize::try_from(LONGEST_CLIENT_LINE).expect("it fits");
    let mut input = vec![b'a'; 3 * most];
    input.extend_from_slice(b"\nnext\nlast");
    let mut input = input.as_slice();
    let mut lengths = Vec::new();
    while let Some(line) = next_line(&mut input).expect("memory") {
        lengths.push(line.len());
    }
    assert_eq!(lengths, [most, 5, 4]);
}
