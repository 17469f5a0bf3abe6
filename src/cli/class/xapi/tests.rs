//! A statement with everything that a learning record store requires.

use super::*;
use crate::campaign::CareerFlight;
use crate::mission::{Mission, Stake};
use crate::record::InstructorPart;
use crate::scoring::FlownBy;
use crate::store;

/// A flight of the first mission by hand, whose record was scored again.
fn trainee(stake: Stake, passed: bool) -> ClassTrainee {
    let mission: Mission = store::mission("00").expect("it is embedded");
    let flight = ClassFlight {
        instructor: InstructorPart::default(),
        seal: None,
        record: "2026-11-20T14-03-22Z_00-first-flight_1-00".to_owned(),
        when: "2026-11-20T14:03:22Z".to_owned(),
        profile: Some("Anna".to_owned()),
        title: mission.title.clone(),
        revision: mission.rev,
        mission_file: None,
        seed: u64::MAX,
        sim_time_s: 83.5,
        has_own_fleet: false,
        has_pause: false,
        has_end: true,
        objectives: Vec::new(),
        flight: CareerFlight {
            mission: mission.id.clone(),
            drill_of: None,
            tier: 0,
            reward: 0,
            vehicles: 1,
            stake,
            flown_by: Some(FlownBy::Hand),
            day: 20_000,
            score: 812,
            passed,
            medal: None,
            evidence: Vec::new(),
            wear: 0,
            imported: false,
        },
    };
    ClassTrainee {
        user: "anna".to_owned(),
        flights: vec![flight],
    }
}

fn statement(stake: Stake, passed: bool) -> Value {
    let statements = Statements {
        class: "9 A",
        home_page: "https://lab.example.org",
    };
    let lines = statements.lines(&[trainee(stake, passed)]);
    assert_eq!(lines.lines().count(), 1);
    serde_json::from_str(lines.trim_end()).expect("JSON")
}

#[test]
fn a_flight_is_a_statement() {
    let said = statement(Stake::Graded, true);
    let account = json!({ "homePage": "https://lab.example.org", "name": "anna" });
    assert_eq!(said["actor"]["account"], account);
    assert_eq!(said["verb"]["id"], "http://adlnet.gov/expapi/verbs/passed");
    assert_eq!(said["object"]["id"], "urn:sortie:mission:00-first-flight");
    let score = json!({ "scaled": 0.812, "raw": 812, "min": 0, "max": 1000 });
    assert_eq!(said["result"]["score"], score);
    assert_eq!(said["result"]["success"], true);
    assert_eq!(said["result"]["duration"], "PT83.5S");
    assert_eq!(said["timestamp"], "2026-11-20T14:03:22Z");
    let class = &said["context"]["contextActivities"]["grouping"][0]["id"];
    assert_eq!(class, "urn:sortie:class:9%20A");
}

#[test]
fn the_verb_says_whether_a_flight_counts_and_was_passed() {
    for (stake, passed, verb) in [
        (Stake::Graded, false, "failed"),
        (Stake::Exam, true, "passed"),
        (Stake::Practice, true, "completed"),
    ] {
        let said = statement(stake, passed);
        assert_eq!(said["verb"]["display"]["en"], verb);
    }
}

#[test]
fn a_flight_has_the_same_uuid_whenever_it_is_exported() {
    let id = |said: Value| said["id"].as_str().unwrap_or_default().to_owned();
    let first = id(statement(Stake::Graded, true));
    assert_eq!(first, id(statement(Stake::Graded, true)));
    let parts: Vec<usize> = first.split('-').map(str::len).collect();
    assert_eq!(parts, [8, 4, 4, 4, 12]);
    assert!(
        first
            .split('-')
            .nth(3)
            .is_some_and(|it| it.starts_with(['8', '9', 'a', 'b']))
    );
}
