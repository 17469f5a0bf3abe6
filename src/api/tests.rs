use std::time::Duration;

use proptest::prelude::*;
use serde_json::{Value, json};

use super::*;
use crate::app::effect::Effect;
use crate::app::event::{Event, ProgramLine, SessionEvent, Started, VehicleEvent};
use crate::app::state::Activity;
use crate::app::{App, Setup, State};
use crate::ledger::{EntryId, ForeignCommand, ForeignId, RowState, RowUpdate, StationId};
use crate::mission::Stake;
use crate::notice::Notice;
use crate::parameters::{ListedParameter, ParameterDocuments, ParameterType};
use crate::vehicle::{Severity, Vehicle};
use crate::wire::MavAddress;

fn read(line: &str) -> Result<Call, Fault> {
    Call::read(line, &Locale::default())
}

/// A console in free flight with vehicles 1 and 2.
fn console() -> App {
    console_in(Activity::Free)
}

fn console_in(activity: Activity) -> App {
    let mut app = App::new(Setup::default());
    let started = Started {
        activity,
        mission: None,
        places: std::collections::BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    };
    hear(&mut app, SessionEvent::Started(Box::new(started)));
    for system in [1, 2] {
        hear(
            &mut app,
            VehicleEvent::Telemetry(Vehicle::new(system, 1).into()),
        );
    }
    app
}

fn hear(app: &mut App, event: impl Into<Event>) {
    drop(app.update(event));
}

/// The outcome of a program's line: the entry, or the fault.
fn say(
    app: &mut App,
    line: &str,
    confirmed: bool,
) -> (Result<Option<EntryId>, String>, Vec<Effect>) {
    let line = line.to_owned();
    let mut effects = app.update(Event::Program(ProgramLine { line, confirmed }));
    let Some(Effect::AnswerProgram(answer)) = effects.pop() else {
        panic!("no answer: {effects:?}");
    };
    let answer = answer
        .map(|answer| answer.entry)
        .map_err(|refusal| refusal.fault.message.to_string());
    (answer, effects)
}

fn lines(messages: &[Message]) -> Vec<Value> {
    let read = |message: &Message| serde_json::from_str(&message.line()).expect("JSON");
    messages.iter().map(read).collect()
}

fn row(app: &mut App, entry: EntryId, vehicle: u16, state: RowState) {
    hear(
        app,
        VehicleEvent::Row(RowUpdate {
            entry,
            vehicle,
            state,
            tries: 1,
            at: Duration::ZERO,
            explanation: None,
        }),
    );
}

#[test]
fn a_request_is_one_object_with_a_number_of_its_own() {
    let call = read(r#"{"id": 7, "do": "say", "line": "all arm"}"#).expect("a request");
    let request = Request::Say {
        line: "all arm".to_owned(),
        confirm: false,
    };
    assert_eq!(
        call,
        Call {
            id: Some(7),
            request
        }
    );
    let call = read(r#"{"do": "get", "what": "plan", "vehicle": 3}"#).expect("a request");
    let request = Request::Get {
        what: Subject::Plan,
        vehicle: Some(3),
    };
    assert_eq!(call, Call { id: None, request });
}

#[test]
fn a_fault_of_a_request_repeats_its_number_and_says_what_is_wrong() {
    let faults = [
        ("all arm", None, "not JSON"),
        ("[1]", None, "not a JSON object"),
        (r#"{"id": -1, "do": "say", "line": "x"}"#, None, "`id`"),
        (r#"{"id": 5, "do": "fly"}"#, Some(5), "unknown value `fly`"),
        (
            r#"{"id": 6, "do": "say", "lin": "x"}"#,
            Some(6),
            "unknown field `lin`",
        ),
        (
            r#"{"id": 7, "do": "watch", "what": ["moon"]}"#,
            Some(7),
            "moon",
        ),
        (
            r#"{"id": 8, "do": "watch", "what": [], "every_s": 0}"#,
            Some(8),
            "between 0.05 and 3600",
        ),
    ];
    for (line, id, words) in faults {
        let fault = read(line).expect_err(line);
        assert_eq!(fault.id, id, "{line}");
        assert!(fault.message.contains(words), "{line}: {}", fault.message);
    }
}

#[test]
fn a_line_with_named_targets_goes_out_and_its_rows_are_followed_to_the_end() {
    let mut app = console();
    let mut client = Client::default();
    let (entry, effects) = say(&mut app, "1-2 mode guided", false);
    let entry = entry.expect("carried out").expect("an entry");
    assert!(matches!(effects[..], [Effect::Order { .. }]), "{effects:?}");
    client.follow(entry);
    let wall = Duration::ZERO;
    let first = lines(&client.news(app.state(), wall));
    assert_eq!(first.len(), 2, "{first:?}");
    assert_eq!(first[0]["row"]["state"], "queued");
    row(&mut app, entry, 1, RowState::InProgress(40));
    row(&mut app, entry, 2, RowState::Done);
    let second = lines(&client.news(app.state(), wall));
    assert_eq!(second[0]["row"]["percent"], 40);
    assert_eq!(second[1]["row"]["is_final"], true);
    assert_eq!(client.news(app.state(), wall), [], "nothing has changed");
    row(&mut app, entry, 1, RowState::Refused);
    let third = lines(&client.news(app.state(), wall));
    assert_eq!(
        third[1],
        json!({"ended": {"entry": entry.0, "done": false}})
    );
}

#[test]
fn a_line_without_targets_is_refused_whatever_the_user_has_selected() {
    let mut app = console();
    hear(
        &mut app,
        crate::app::event::TerminalEvent::Line("select 1".to_owned()),
    );
    let (outcome, _) = say(&mut app, "mode guided", false);
    assert!(outcome.is_err(), "{outcome:?}");
    assert_eq!(app.state().session().ledger().entries().len(), 0);
}

#[test]
fn a_dangerous_line_has_to_be_confirmed_and_asks_the_user_nothing() {
    let mut app = console();
    let (outcome, _) = say(&mut app, "all kill", false);
    assert!(outcome.is_err());
    assert!(app.state().overlay().is_none());
    let (outcome, _) = say(&mut app, "all kill", true);
    assert!(matches!(outcome, Ok(Some(_))), "{outcome:?}");
}

#[test]
fn a_question_to_the_user_stays_open_while_a_program_gives_a_line() {
    let mut app = console();
    hear(
        &mut app,
        crate::app::event::TerminalEvent::Line("all kill".to_owned()),
    );
    let asked = app.state().overlay().map(|it| format!("{it:?}"));
    assert!(asked.is_some());
    let (outcome, _) = say(&mut app, "1 mode guided", false);
    assert!(outcome.is_ok());
    let open = app.state().overlay().map(|it| format!("{it:?}"));
    assert_eq!(open, asked);
}

#[test]
fn lines_for_the_screen_and_macros_are_refused() {
    let mut app = console();
    for line in ["show map", "sort id", "status"] {
        let (outcome, effects) = say(&mut app, line, true);
        assert!(outcome.is_err(), "{line}");
        assert!(effects.is_empty(), "{line}");
    }
}

#[test]
fn in_an_exam_programs_can_read_and_give_no_line() {
    let mut app = console_in(Activity::Mission {
        id: "00-first-flight".to_owned(),
        title: "First flight".into(),
        stake: Stake::Exam,
    });
    for line in [
        "all arm",
        "1 mode guided",
        "all kill",
        "show map",
        "draft survey",
    ] {
        let (outcome, effects) = say(&mut app, line, true);
        let refusal = outcome.expect_err(line);
        assert!(refusal.contains("in an exam"), "{line}: {refusal}");
        assert!(effects.is_empty(), "{line}");
    }
    assert_eq!(app.state().session().ledger().entries().len(), 0);
    let vehicles = present(app.state(), Some(1), Subject::Vehicles, None, Vec::new);
    let vehicles = lines(&[vehicles.expect("a state")]).remove(0);
    assert_eq!(
        vehicles["vehicles"]["list"].as_array().map(Vec::len),
        Some(2)
    );
}

#[test]
fn vehicles_are_sent_when_they_change_and_not_more_often_than_wanted() {
    let mut app = console();
    let mut client = Client::default();
    client.watch([Topic::Vehicles], Some(2.0), app.state());
    let count = |client: &mut Client, app: &App, at_s| {
        let news = lines(&client.news(app.state(), Duration::from_secs(at_s)));
        news.iter()
            .map(|it| it["vehicles"]["list"].as_array().map_or(0, Vec::len))
            .sum::<usize>()
    };
    assert_eq!(count(&mut client, &app, 1), 2, "all at first");
    hear(&mut app, VehicleEvent::Telemetry(Vehicle::new(2, 1).into()));
    assert_eq!(count(&mut client, &app, 2), 0, "too early");
    assert_eq!(count(&mut client, &app, 3), 1, "only the changed one");
    assert_eq!(count(&mut client, &app, 9), 0, "nothing has changed");
}

#[test]
fn notices_and_commands_of_others_are_sent_from_the_request_on() {
    let mut app = console();
    let notice = |text: &str| Notice::about(1, Duration::ZERO, Severity::Warning, text.into());
    hear(&mut app, notice("before"));
    say(&mut app, "1 mode guided", false)
        .0
        .expect("carried out");
    let mut client = Client::default();
    client.watch([Topic::Notices, Topic::Ledger], None, app.state());
    assert_eq!(client.news(app.state(), Duration::ZERO), []);
    hear(&mut app, notice("after"));
    hear(
        &mut app,
        crate::app::event::TerminalEvent::Line("2 mode guided".to_owned()),
    );
    let news = lines(&client.news(app.state(), Duration::from_secs(1)));
    assert_eq!(news.len(), 2, "{news:?}");
    assert_eq!(news[0]["row"]["vehicle"], 2);
    assert_eq!(news[1]["notice"]["text"], "after");
    assert_eq!(news[1]["notice"]["severity"], 4);
}

#[test]
fn commands_of_other_stations_are_sent_with_each_change() {
    let mut app = console();
    let foreign = |id, count| ForeignCommand {
        id: ForeignId(id),
        station: StationId(MavAddress {
            system: 254,
            component: 230,
        }),
        vehicle: 1,
        at: Duration::ZERO,
        last_at: Duration::ZERO,
        what: "mode RTL".into(),
        count,
        state: RowState::Accepted,
        explanation: None,
    };
    hear(&mut app, VehicleEvent::Foreign(foreign(0, 1)));
    let mut client = Client::default();
    client.watch([Topic::Ledger], None, app.state());
    assert_eq!(client.news(app.state(), Duration::ZERO), []);
    for command in [foreign(1, 1), foreign(1, 2)] {
        hear(&mut app, VehicleEvent::Foreign(command));
        let news = lines(&client.news(app.state(), Duration::from_secs(1)));
        assert_eq!(news.len(), 1, "{news:?}");
        assert_eq!(news[0]["foreign"]["foreign"], 1);
        assert_eq!(news[0]["foreign"]["station"], "254/230");
    }
    assert_eq!(client.news(app.state(), Duration::from_secs(2)), []);
    let all = present(app.state(), None, Subject::Ledger, None, Vec::new).expect("a state");
    let all = lines(&[all]).remove(0);
    assert_eq!(all["ledger"]["list"], json!([]));
    assert_eq!(all["ledger"]["foreign"][1]["count"], 2);
}

#[test]
fn what_belongs_to_one_vehicle_needs_its_number() {
    let app = console();
    let fault =
        present(app.state(), Some(1), Subject::Plan, None, Vec::new).expect_err("none named");
    assert_eq!(fault.id, Some(1));
    assert!(present(app.state(), None, Subject::Plan, Some(9), Vec::new).is_err());
    let plan = present(app.state(), Some(2), Subject::Plan, Some(1), Vec::new).expect("its plan");
    let expected = json!({"plan": {"id": 2, "vehicle": 1, "complete": false, "items": []}});
    assert_eq!(lines(&[plan]), [expected]);
}

#[test]
fn the_schema_has_every_type_that_it_names() {
    fn names<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
        match value {
            Value::Object(fields) => {
                if let Some(Value::String(name)) = fields.get("$ref") {
                    found.push(name.rsplit('/').next().unwrap_or(name));
                }
                fields.values().for_each(|value| names(value, found));
            }
            Value::Array(values) => values.iter().for_each(|value| names(value, found)),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
    }
    let schema = schema();
    let mut named = Vec::new();
    names(&schema, &mut named);
    assert!(named.len() > 10, "{named:?}");
    for name in named {
        assert!(
            schema["components"]["schemas"].get(name).is_some(),
            "{name} is not described"
        );
    }
}

#[test]
fn the_states_of_the_console_are_never_beyond_its_reach() {
    let app = console();
    let state: &State = app.state();
    for what in [
        Subject::Vehicles,
        Subject::Notices,
        Subject::Ledger,
        Subject::Mission,
        Subject::Links,
        Subject::Records,
    ] {
        let message =
            present(state, Some(4), what, None, Vec::new).expect("a state of the whole console");
        let line = lines(&[message]).remove(0);
        let content = line
            .as_object()
            .and_then(|it| it.values().next())
            .expect("one field");
        assert_eq!(content["id"], 4, "{line}");
    }
}

proptest! {
    #[test]
    fn hostile_lines_are_answered_with_a_fault_or_read(line in ".{0,200}", cut in 0usize..60) {
        drop(read(&line));
        let request = r#"{"id": 8, "do": "watch", "what": ["vehicles"], "every_s": 1}"#;
        let mut bytes = request.as_bytes().to_vec();
        bytes.truncate(cut);
        prop_assert!(read(&String::from_utf8_lossy(&bytes)).is_err());
    }
}

#[test]
fn a_parameter_has_its_default_unit_and_meaning_where_they_are_known() {
    let text = r#"{"": {"FENCE_ENABLE": {"DisplayName": "Fence", "Values": {"1": "Enabled"}},
        "RTL_ALT": {"DisplayName": "Height", "Units": "cm"}}}"#;
    let documents = ParameterDocuments::read(text).documents;
    let parameter = |value| ListedParameter {
        value,
        original: value,
        kind: ParameterType::Real32,
        index: None,
    };
    let view = |name: &str, value: f64, default| {
        let view = ParameterView::new(name, &parameter(value), default, documents.get(name));
        serde_json::to_value(view).expect("JSON")
    };
    assert_eq!(
        view("FENCE_ENABLE", 1.0, Some(0.0)),
        json!({"name": "FENCE_ENABLE", "value": 1.0, "default": 0.0, "unit": null, "meaning": "Enabled"})
    );
    assert_eq!(
        view("RTL_ALT", 1500.0, None),
        json!({"name": "RTL_ALT", "value": 1500.0, "default": null, "unit": "cm", "meaning": null})
    );
}

#[test]
fn forwards_are_among_the_links() {
    let mut app = console();
    let forward = crate::app::state::ForwardSummary {
        name: "udp:127.0.0.1:14550 read-only".to_owned(),
        up: true,
        peers: 1,
        sent_messages: 40,
        held_back: 3,
        ..Default::default()
    };
    hear(
        &mut app,
        crate::app::event::LinkEvent::Forwards(vec![forward]),
    );
    let links = present(app.state(), Some(4), Subject::Links, None, Vec::new).expect("a state");
    let links: Value = serde_json::from_str(&links.line()).expect("JSON");
    let forward = &links["links"]["forwards"][0];
    assert_eq!(forward["name"], "udp:127.0.0.1:14550 read-only");
    let figures = ["stations", "sent_messages", "held_back"].map(|name| &forward[name]);
    assert_eq!(figures, [1, 40, 3]);
}
