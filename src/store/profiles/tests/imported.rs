//! The effect of importing a hand-written file.

use std::sync::Arc;
use std::time::{Duration, UNIX_EPOCH};

use serde_json::{Value, json};

use super::{WHEN, anna, open};
use crate::campaign::{CareerStanding, Stake};
use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::scoring::{FlownBy, Report};
use crate::store::{Landing, ProfileFile, RunEntry, course};

const FIRST: &str = include_str!("../../../../missions/00-first-flight.toml");
const PILOT: &str = include_str!("../../../../missions/pilots/00-first-flight.pilot");

fn flown() -> (Arc<Mission>, Report) {
    let mission = Arc::new(Mission::parse(FIRST).expect("no faults"));
    let places = mission.places_to_name();
    let context = Context {
        places: Some(&places),
        vehicles: &[1],
        ..Context::default()
    };
    let script = Script::parse(PILOT, &context).expect("no faults");
    let mut exercise = Exercise::new(Arc::clone(&mission), 1, script, Vec::new());
    exercise.flight_mut().set_flown_by(Some(FlownBy::Hand));
    while !exercise.is_over() {
        exercise.step();
        exercise.take_notices();
    }
    let report = exercise.report();
    assert!(report.passed && report.medal.is_some());
    (mission, report)
}

/// Anna's profile with a graded flight and a part that she bought, as a document.
fn document() -> Value {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    let (mission, report) = flown();
    let landing = Landing {
        id: "a".to_owned(),
        is_recorded: true,
        when: UNIX_EPOCH + Duration::from_secs(1_790_000_000),
        stake: Stake::Graded,
    };
    let run = RunEntry::of(&mission, &report, landing);
    profiles.store(&anna, &run).expect("stored");
    let bought = profiles.buy(&anna, "r_rfd900", &course(), WHEN);
    bought.expect("paid");
    let exported = profiles.export(&anna).expect("readable").write();
    serde_json::from_str(&exported).expect("just written")
}

/// The result of importing a document into a new profile: the standing, its flights and the remarks.
fn brought(document: &Value) -> (CareerStanding, Value, Vec<String>) {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let file = ProfileFile::read(&document.to_string()).expect("nothing impossible");
    let (file, told) = file.borne_out();
    let profile = profiles.import(&file, "Copy").expect("free");
    let history = profiles.history(&profile).expect("readable");
    let again = profiles.export(&profile).expect("readable").write();
    let again: Value = serde_json::from_str(&again).expect("just written");
    let told = told.iter().map(ToString::to_string).collect();
    (CareerStanding::of(&history), again["entries"].clone(), told)
}

#[test]
fn an_honest_profile_comes_back_as_it_was_and_marked() {
    let document = document();
    let (standing, entries, told) = brought(&document);
    assert!(told.is_empty(), "{told:?}");
    assert!(standing.has_passed("00-first-flight") && standing.credits() > 500);
    let mut expected = document["entries"].clone();
    expected[0]["entry"]["imported"] = json!(true);
    assert_eq!(entries, expected);
}

#[test]
fn what_a_flight_brings_follows_from_its_report_and_the_mission() {
    let honest = document();
    let (expected, ..) = brought(&honest);
    let mut edited = honest;
    let flight = edited.pointer_mut("/entries/0/entry").expect("a flight");
    flight["reward"] = json!(100_000);
    flight["tier"] = json!(3);
    flight["score"] = json!(1000);
    flight["vehicles"] = json!(32);
    let (standing, ..) = brought(&edited);
    assert_eq!(standing, expected);
}

#[test]
fn a_report_that_does_not_fit_together_is_left_out() {
    for (place, value) in [
        ("/runs/0/report/score", json!(1000)),
        ("/runs/0/report/subtotal", json!(1234.5)),
        ("/runs/0/report/components/0/points", json!(990.0)),
        ("/runs/0/report/objectives/2/met", json!(false)),
        ("/runs/0/report/objectives/1/id", json!("other")),
        ("/runs/0/report/mission", json!("14-combined-final")),
    ] {
        let mut edited = document();
        *edited.pointer_mut(place).expect("it has one") = value;
        if place.ends_with("score") {
            edited["runs"][0]["report"]["hint_factor"] = json!(0.7);
        }
        let (standing, entries, told) = brought(&edited);
        assert!(!standing.has_passed("00-first-flight"), "{place}");
        assert_eq!(
            entries.as_array().map(Vec::len),
            Some(1),
            "{place}: the part stays"
        );
        assert_eq!(told.len(), 1, "{place}: {told:?}");
    }
}

#[test]
fn nothing_without_a_report_and_nothing_twice() {
    let mut without = document();
    without["runs"] = json!([]);
    let (standing, _, told) = brought(&without);
    assert!(
        !standing.has_passed("00-first-flight") && told.len() == 1,
        "{told:?}"
    );
    let honest = document();
    let mut twice = honest.clone();
    let copy = |row: &Value| {
        let mut copy = row.clone();
        copy["id"] = json!("b");
        copy
    };
    for list in ["entries", "runs"] {
        let second = copy(&honest[list][0]);
        twice[list].as_array_mut().expect("a list").push(second);
    }
    let (expected, ..) = brought(&honest);
    let (standing, _, told) = brought(&twice);
    assert_eq!((standing, told.len()), (expected, 1), "{told:?}");
}

#[test]
fn what_was_locked_or_scripted_or_another_exam_is_practice() {
    let (expected, ..) = {
        let mut practice = document();
        practice["entries"][0]["entry"]["stake"] = json!("practice");
        brought(&practice)
    };
    let edits: [(&str, Value); 3] = [
        ("/entries/0/entry/stake", json!("exam")),
        ("/runs/0/report/flown_by", json!("script")),
        ("/runs/0/report/mission_file", json!("altered")),
    ];
    for (place, value) in edits {
        let mut edited = document();
        if let Some(found) = edited.pointer_mut(place) {
            *found = value;
        } else {
            edited["runs"][0]["report"]["mission_file"] = value;
        }
        let (standing, _, told) = brought(&edited);
        assert_eq!(standing, expected, "{place}: {told:?}");
        assert_eq!(told.len(), 1, "{place}: {told:?}");
    }
}
