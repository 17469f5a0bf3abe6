use super::*;
use crate::language::Channel;
use crate::language::tests::{context, groups, places};

fn completions(line: &str) -> Vec<Completion> {
    let (groups, places) = (groups(), places());
    complete(line, line.len(), &context(&groups, &places))
}

fn on_screen() -> Context<'static> {
    Context {
        channel: Channel::Screen,
        ..Context::default()
    }
}

fn first_completion(line: &str) -> Option<String> {
    let first = completions(line).into_iter().next();
    first.map(|completion| completion.text)
}

#[test]
fn words_that_begin_as_written_come_first_and_everyday_ones_before_the_rest() {
    for (line, expected) in [
        ("go", vec!["goto"]),
        ("al", vec!["altitude", "all", "alt_hold"]),
        ("all al", vec!["altitude", "alt_hold"]),
        ("l", vec!["land", "long", "logs", "loiter"]),
        ("hold", vec!["hold", "alt_hold"]),
        ("mode a", vec!["AUTO", "ALT_HOLD", "ACRO"]),
        ("a", vec!["arm", "altitude", "all", "auto", "alt_hold"]),
        ("request att", vec!["ATTITUDE"]),
        (
            "mode ",
            vec![
                "GUIDED",
                "LOITER",
                "RTL",
                "LAND",
                "BRAKE",
                "AUTO",
                "ALT_HOLD",
                "STABILIZE",
            ],
        ),
        ("wait ", vec!["all"]),
    ] {
        let found = completions(line);
        let found: Vec<&str> = found.iter().map(|c| c.text.as_str()).collect();
        assert!(found.starts_with(&expected), "{line}: {found:?}");
    }
    assert_eq!(completions("got").len(), 1, "nothing to cycle through");
    let scattered = completions("al").into_iter().map(|c| c.text);
    assert!(!scattered.into_iter().any(|text| text == "interval"));
}

#[test]
fn modes_that_listen_to_the_sticks_say_that_they_sink() {
    let hint = |line: &str| completions(line)[0].hint.clone();
    for line in ["loit", "all alt_h", "mode posh"] {
        assert!(
            hint(line).contains("the vehicle sinks while the throttle stick is down"),
            "{line}"
        );
    }
    assert!(hint("stabil").contains("falls"));
    assert!(!hint("guided").contains("stick"));
}

#[test]
fn the_best_completion_comes_first() {
    for (line, best) in [
        ("tko", "takeoff"),
        ("all gui", "guided"),
        ("@r", "@red"),
        ("mode poshol", "POSHOLD"),
        ("goto tow", "tower"),
        ("orbit 20 at tow", "tower"),
        ("goto tower ke", "keep"),
        ("speed cl", "climb"),
        ("request autopilotv", "AUTOPILOT_VERSION"),
        ("long takeoff", "NAV_TAKEOFF"),
        ("wait all arriv", "arrived"),
        ("wait all altitude ", ">"),
        ("wait all arrived ", "timeout"),
        ("param ", "get"),
    ] {
        assert_eq!(first_completion(line).as_deref(), Some(best), "{line}");
    }
    assert_eq!(first_completion("takeoff "), None);
    assert_eq!(first_completion("all arm # ta"), None);
}

/// A list comes before the items, so after them only their parameters are possible.
#[test]
fn an_optional_word_is_not_offered_after_the_words_that_follow_it() {
    let offered = |line: &str| {
        let found = complete(line, line.len(), &on_screen()).into_iter();
        found.map(|it| it.text).collect::<Vec<String>>()
    };
    assert_eq!(offered("draft set ")[..3], ["plan", "fence", "rally"]);
    let fields = offered("draft set 3 ");
    assert!(fields.contains(&"hold".to_owned()), "{fields:?}");
    assert!(!fields.contains(&"plan".to_owned()), "{fields:?}");
}

#[test]
fn a_completion_replaces_the_whole_word_under_the_cursor() {
    let found = complete("all tak 20", 6, &Context::default());
    assert_eq!(
        (found[0].text.as_str(), found[0].replaces.clone()),
        ("takeoff", 4..7)
    );
}

#[test]
fn the_hint_marks_what_comes_next() {
    let hint = |line| hint(line, &Context::default()).unwrap_or_default();
    assert_eq!(
        hint("takeoff "),
        "takeoff ‹ALTITUDE›: height above home, 0.5 to 1000 m"
    );
    assert!(
        hint("goto n 1 ")
            .to_string()
            .starts_with("goto n NORTH ‹e EAST› [up UP]"),
        "{}",
        hint("goto n 1 ")
    );
    assert_eq!(hint("goto "), "goto ‹n NORTH | by | LAT LON|PLACE›");
    assert_eq!(hint("all arm now"), "");
    assert_eq!(hint("arm"), "arm: start the motors");
    assert_eq!(hint("nonsense"), "");
    let own = |line| super::hint(line, &on_screen()).unwrap_or_default();
    assert_eq!(
        own("draft split 4"),
        "draft split ITEM: put a waypoint in the middle of the leg to an item"
    );
    let set = own("draft set 3 hold 5s");
    assert!(
        set.to_string()
            .starts_with("draft set [plan|fence|rally] ITEMS"),
        "{set}"
    );
}

#[test]
fn messages_fields_and_the_names_of_values_are_completed() {
    for (line, expected) in [
        ("send HEARTB", vec!["HEARTBEAT"]),
        (
            "3 send HEARTBEAT ",
            vec!["custom_mode=", "type=", "autopilot=", "base_mode="],
        ),
        ("3 send HEARTBEAT type=2 ty", vec![]),
        ("3 send HEARTBEAT custom_mode=1 ty", vec!["type="]),
        ("send HEARTBEAT type=QUAD", vec!["QUADROTOR"]),
        (
            "send HEARTBEAT base_mode=SAFETY_ARMED|AUTO",
            vec!["SAFETY_ARMED|AUTO_ENABLED"],
        ),
        ("send ATTITUDE roll=", vec![]),
    ] {
        let found = completions(line);
        let found: Vec<&str> = found.iter().map(|c| c.text.as_str()).collect();
        assert!(found.starts_with(&expected), "{line}: {found:?}");
        assert!(
            !expected.is_empty() || found.is_empty(),
            "{line}: {found:?}"
        );
    }
    let whole = completions("send HEARTBEAT base_mode=SAFETY_ARMED|AUTO")[0].clone();
    assert_eq!(whole.replaces, 25..42);
}

#[test]
fn the_hint_of_a_field_is_its_type_and_range() {
    let hint = |line| hint(line, &Context::default()).unwrap_or_default();
    assert_eq!(
        hint("send HEARTBEAT custom_mode="),
        "custom_mode: u32, 0 to 4294967295"
    );
    assert_eq!(hint("send HEARTBEAT type=QU"), "type: u8, MAV_TYPE");
    assert_eq!(hint("send SET_ATTITUDE_TARGET q=[1"), "q: f32[4]");
}
