//! A manned aircraft crosses the area of the mission: drones give way.

use std::sync::Arc;
use std::time::Duration;

use super::{Exercise, Mission, read_script};
use crate::mission::MoverKind;
use crate::scoring::{EventKind, Medal, Report};

const DRILL: &str = include_str!("../../../missions/drills/d17-give-way.toml");
const REFERENCE: &str = include_str!("../../../missions/pilots/d17-give-way.pilot");
const NAIVE: &str = include_str!("../../../missions/pilots/d17-naive.pilot");

fn exercise(mission: &str, lines: &str, seed: u64) -> Exercise {
    let mission = Arc::new(Mission::parse(mission).expect("no faults"));
    let script = read_script(lines, &mission).expect("no faults");
    Exercise::new(mission, seed, script, Vec::new())
}

fn flown(mission: &str, lines: &str, seed: u64) -> Report {
    let mut exercise = exercise(mission, lines, seed);
    while !exercise.is_over() {
        exercise.step();
    }
    exercise.report()
}

fn rules(report: &Report) -> Vec<String> {
    let broken = report.events.iter().filter(|it| it.kind == EventKind::Rule);
    broken.map(|it| it.text.to_string()).collect()
}

#[test]
fn the_flight_that_gives_way_earns_gold_and_the_other_one_fails() {
    for seed in 1..=6 {
        let report = flown(DRILL, REFERENCE, seed);
        assert!(report.passed, "{seed}: {:?}", report.objectives);
        assert_eq!(report.medal, Some(Medal::Gold), "{seed}: {}", report.score);
        assert_eq!(rules(&report), Vec::<String>::new(), "{seed}");
        let report = flown(DRILL, NAIVE, seed);
        assert!(
            !report.passed && report.medal.is_none(),
            "{seed}: {}",
            report.score
        );
    }
}

/// Without the event that ends the flight, the rule alone costs half of the safety, and the debrief names it.
#[test]
fn flying_close_to_an_aircraft_is_harm_that_the_debrief_names() {
    let start = DRILL
        .find("[[events]]\nid = \"evaded\"")
        .expect("the event");
    let end = DRILL.find("[[hints]]").expect("hints follow");
    let mission = [&DRILL[..start], &DRILL[end..]].concat();
    let report = flown(&mission, NAIVE, 1);
    let broken = rules(&report);
    assert!(!broken.is_empty(), "{:?}", report.events);
    let text = crate::debrief::text(&report, &crate::text::Locale::default());
    assert!(text.contains(&broken[0]), "{text}");
    let safe = flown(&mission, REFERENCE, 1);
    assert!(
        report.score + 40 < safe.score,
        "{} {}",
        report.score,
        safe.score
    );
}

#[test]
fn the_trainee_sees_the_aircraft_with_its_course() {
    let mut exercise = exercise(DRILL, REFERENCE, 1);
    while exercise.flight_mut().progress().elapsed < Duration::from_secs(20) {
        exercise.step();
    }
    let progress = exercise.flight_mut().progress();
    let aircraft = progress.movers.first().expect("it is under way");
    assert_eq!(aircraft.kind, MoverKind::Aircraft);
    assert_eq!(aircraft.callsign, "MEDEVAC1");
    assert!((aircraft.altitude_amsl_m - 115.0).abs() < 1e-9);
    let [north, east] = aircraft.velocity_m_s;
    assert!(north.abs() < 1e-9 && (east - 40.0).abs() < 1e-9);
}
