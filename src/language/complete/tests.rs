use super::*;
use crate::language::tests::{context, groups, places};

fn first_completion(line: &str) -> Option<String> {
    let (groups, places) = (groups(), places());
    complete(line, line.len(), &context(&groups, &places))
        .into_iter()
        .next()
        .map(|completion| completion.text)
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
        hint("goto n 1 ").starts_with("goto n NORTH ‹e EAST› [up UP]"),
        "{}",
        hint("goto n 1 ")
    );
    assert_eq!(hint("goto "), "goto ‹n NORTH | by | LAT LON|PLACE›");
    assert_eq!(hint("all arm now"), "");
    assert_eq!(hint("arm"), "arm: start the motors");
    assert_eq!(hint("nonsense"), "");
}
