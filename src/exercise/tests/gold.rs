//! Gold requires skill: plain solutions of a few commands earn silver at most, the reference flights earn gold.

use std::sync::Arc;

use super::{Exercise, Mission, read_script};
use crate::scoring::{Medal, Report};

/// Flies a script in a mission with seed 1.
fn flown(mission: &str, lines: &str) -> Report {
    let mission = Arc::new(Mission::parse(mission).expect("no faults"));
    let script = read_script(lines, &mission).expect("no faults");
    let mut exercise = Exercise::new(mission, 1, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
    }
    exercise.report()
}

/// The takeoff to a height in metres, some lines, and the return of all vehicles.
fn there_and_back(up_m: u32, lines: &str) -> String {
    format!(
        "wait all ready timeout 60s\nall guided\nall arm\nall takeoff {up_m}\nwait all altitude > {low} timeout 40s\n\
         {lines}all rtl\nwait all disarmed timeout 120s\n",
        low = up_m - 1
    )
}

/// Whether an objective was met.
fn is_met(report: &Report, id: &str) -> bool {
    let mut objectives = report.objectives.iter();
    objectives.any(|objective| objective.id == id && objective.met)
}

/// A survey at the right speed is one command. Gold requires more: a second look from another
/// height.
#[test]
fn a_slow_survey_alone_earns_less_than_gold() {
    let mission = include_str!("../../../missions/01-air-sample.toml");
    let survey = "all speed 3.5\nall survey yard up 20\nwait 100s\n";
    let plain = flown(mission, &there_and_back(20, survey));
    assert!(is_met(&plain, "cells"), "{:?}", plain.objectives);
    assert_eq!(plain.medal, Some(Medal::Silver), "{}", plain.score);
    let above = "all goto middle up 36\nwait all arrived timeout 60s\nwait 8s\n";
    let whole = flown(mission, &there_and_back(20, &format!("{survey}{above}")));
    assert_eq!(whole.medal, Some(Medal::Gold), "{}", whole.score);
}

/// The ways home cross, so gold requires a different height for each vehicle.
#[test]
fn a_return_of_the_formation_at_one_height_earns_less_than_gold() {
    let mission = include_str!("../../../missions/02-formation.toml");
    let led = ["gate1", "gate2", "gate3"]
        .map(|gate| format!("1 goto {gate}\nwait all arrived timeout 60s\n"));
    let lines = format!(
        "all formation wedge spacing 12\nwait all arrived timeout 60s\n{}",
        led.concat()
    );
    let plain = flown(mission, &there_and_back(25, &lines));
    assert!(is_met(&plain, "form"), "{:?}", plain.objectives);
    assert!(plain.medal < Some(Medal::Gold), "{}", plain.score);
    let reference = include_str!("../../../missions/pilots/02-formation.pilot");
    let reference = flown(mission, reference);
    assert_eq!(reference.medal, Some(Medal::Gold), "{}", reference.score);
}

/// The lines of a survey find the vent roughly; gold requires slow crossings close to it.
#[test]
fn a_survey_for_the_vent_earns_less_than_gold() {
    let mission = include_str!("../../../missions/03-plume-source.toml");
    let survey = "all survey plant spacing 12 up 12 course 0\nwait all arrived timeout 400s\n\
                  all mark peak as leak\n";
    let plain = flown(mission, &there_and_back(12, survey));
    assert!(is_met(&plain, "vent"), "{:?}", plain.objectives);
    assert_eq!(plain.medal, Some(Medal::Silver), "{}", plain.score);
    let reference = include_str!("../../../missions/pilots/03-plume-source.pilot");
    let reference = flown(mission, reference);
    assert_eq!(reference.medal, Some(Medal::Gold), "{}", reference.score);
}

/// The lines of a survey find the sources roughly; gold requires slow crossings of each peak.
#[test]
fn a_survey_for_the_sources_earns_less_than_gold() {
    let mission = include_str!("../../../missions/10-radiation-source.toml");
    let survey = "1 survey west spacing 10 up 15\n2 survey east spacing 10 up 15\n\
                  wait all arrived timeout 400s\n\
                  1 mark peak1 as source\n2 mark peak2 as source\n";
    let plain = flown(mission, &there_and_back(15, survey));
    assert!(is_met(&plain, "sources"), "{:?}", plain.objectives);
    assert_eq!(plain.medal, Some(Medal::Silver), "{}", plain.score);
    let reference = include_str!("../../../missions/pilots/10-radiation-source.pilot");
    let reference = flown(mission, reference);
    assert_eq!(reference.medal, Some(Medal::Gold), "{}", reference.score);
}
