//! Random messages: each request is answered once, and no line does harm.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;
use crate::api::Call;
use crate::text::Locale;

/// One of these values, or no field.
fn field(values: Vec<Value>) -> impl Strategy<Value = Option<Value>> {
    prop::option::weighted(0.9, prop::sample::select(values))
}

prop_compose! {
    /// A message that is nearly right, without its number.
    fn message()(
        jsonrpc in prop::sample::select(vec!["2.0", "2.0", "2.0", "1.0"]),
        method in field(vec![
            json!("tools/call"), json!("tools/call"), json!("tools/call"), json!("tools/list"), json!("initialize"),
            json!("ping"), json!("notifications/initialized"), json!("moon"), json!(7),
        ]),
        name in field(vec![json!("say"), json!("vehicles"), json!("plan"), json!("moon"), json!([])]),
        arguments in field(vec![
            json!({}), json!({"line": "all arm"}), json!({"vehicle": 1}), json!({"vehicle": 1e9}), json!(null),
        ]),
        meta in field(vec![json!({"progressToken": 1}), json!({"progressToken": {}}), json!(3)]),
        params in field(vec![json!({}), json!({}), json!([]), json!("x")]),
    ) -> Value {
        let mut message = json!({"jsonrpc": jsonrpc});
        let fields = [("name", name), ("arguments", arguments), ("_meta", meta)];
        let mut params = params;
        if let Some(Value::Object(params)) = &mut params {
            let given = fields.into_iter().filter_map(|(name, it)| Some((name.to_owned(), it?)));
            params.extend(given);
        }
        for (name, value) in [("method", method), ("params", params)] {
            if let Some(value) = value {
                message[name] = value;
            }
        }
        message
    }
}

#[derive(Debug, Clone, Copy)]
enum Reaction {
    State,
    Fault,
    Text,
    Command,
    Silence,
}

fn reaction() -> impl Strategy<Value = Reaction> {
    use Reaction::{Command, Fault, Silence, State, Text};
    prop::sample::select(vec![State, Fault, Text, Command, Silence])
}

/// Lets a console react to a request; returns the answers to the client.
fn react(bridge: &mut Bridge, number: u64, reaction: Reaction) -> Vec<Value> {
    let row = json!({"entry": number, "vehicle": 1, "state": "done", "is_final": true});
    let messages = match reaction {
        Reaction::State => vec![("vehicles", json!({"id": number, "list": []}))],
        Reaction::Fault => vec![("fault", json!({"id": number, "message": "no"}))],
        Reaction::Text => vec![("ok", json!({"id": number, "entry": null}))],
        Reaction::Command => vec![
            ("ok", json!({"id": number, "entry": number})),
            ("row", row),
            ("ended", json!({"entry": number, "done": true})),
        ],
        Reaction::Silence => Vec::new(),
    };
    let answers = messages
        .into_iter()
        .filter_map(|(kind, content)| bridge.hear_console(kind, content));
    answers.filter(|it| it.get("id").is_some()).collect()
}

proptest! {
    #[test]
    fn every_request_with_a_number_gets_exactly_one_answer(
        messages in prop::collection::vec((message(), reaction()), 1..40),
        allows_commands in any::<bool>(),
    ) {
        let mut bridge = Bridge::new(allows_commands);
        let mut answers = Vec::new();
        for (id, (mut message, reaction)) in messages.iter().cloned().enumerate() {
            message["id"] = id.into();
            match hear(&mut bridge, &message) {
                Some(BridgeMessage::ToClient(answer)) => answers.push(answer),
                Some(BridgeMessage::ToConsole(line)) => {
                    let call = Call::read(&line, &Locale::default()).expect("a request");
                    let number = call.id.expect("a number");
                    answers.extend(react(&mut bridge, number, reaction));
                }
                None => prop_assert!(false, "no answer: {message}"),
            }
        }
        answers.extend(bridge.lose_console("gone"));
        let mut counts = BTreeMap::new();
        for answer in &answers {
            prop_assert!(answer.get("result").is_some() != answer.get("error").is_some());
            *counts.entry(answer["id"].as_u64()).or_insert(0) += 1;
        }
        let once = (0..messages.len() as u64).map(|id| (Some(id), 1)).collect();
        prop_assert_eq!(counts, once);
    }

    #[test]
    fn hostile_lines_do_no_harm(
        bytes in prop::collection::vec(any::<u8>(), 0..80),
        text in r#"[\[\]{}":,0-9a-z\\]{0,60}"#,
        message in message(),
        cut in any::<prop::sample::Index>(),
        id in prop::sample::select(vec![json!(null), json!([]), json!(1.5), json!("\u{0}\n")]),
    ) {
        let mut bridge = Bridge::new(true);
        let mut whole = message;
        whole["id"] = id;
        let part = whole.to_string().into_bytes();
        let part = &part[..cut.index(part.len())];
        for line in [bytes.as_slice(), text.as_bytes(), part, whole.to_string().as_bytes()] {
            if let Some(BridgeMessage::ToClient(answer)) = bridge.hear_client(line) {
                prop_assert!(!answer.to_string().contains('\n'));
            }
        }
        for kind in ["ok", "row", "ended", "fault", "welcome", text.as_str()] {
            for content in [json!(null), json!([]), json!({"id": 1}), json!({"entry": 1, "id": 1}), whole.clone()] {
                bridge.hear_console(kind, content);
            }
        }
    }
}
