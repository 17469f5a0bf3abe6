//! Objectives of the basic lessons, flown in the simulator.

use std::sync::Arc;

use sortie::exercise::Exercise;
use sortie::language::{Context, Script};
use sortie::mission::{Mission, Report};

use super::folder;

fn basics() -> String {
    std::fs::read_to_string(folder("tests/data/basics_mission.toml")).expect("it is there")
}

fn flown(source: &str, script: &str, seed: u64) -> Report {
    let mission = Mission::parse(source).expect("a good mission");
    let places = mission.places_to_name();
    let vehicles: Vec<u16> = (1..=mission.seats.count as u16).collect();
    let context = Context {
        places: Some(&places),
        vehicles: &vehicles,
        ..Context::default()
    };
    let script = Script::parse(script, &context).expect("a good script");
    let mut exercise = Exercise::new(Arc::new(mission), seed, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
    }
    exercise.report()
}

fn unmet(report: &Report) -> Vec<(&str, String)> {
    let unmet = report.objectives.iter().filter(|objective| !objective.met);
    unmet
        .map(|objective| (objective.id.as_str(), objective.result.to_string()))
        .collect()
}

const START: &str = "wait all ready timeout 60s\nall guided\nall arm\nall takeoff 20\n\
    wait all altitude > 19 timeout 40s\n";

#[test]
fn a_script_flies_through_the_gates_wherever_the_seed_puts_them() {
    let script = format!(
        "{START}wait 8s\nall goto gate1 up 20\nwait all arrived timeout 40s\n\
         all goto next up 20\nwait all arrived timeout 40s\n\
         all goto mast up 20\nwait all arrived timeout 40s\nwait 4s\n\
         all rtl\nwait all disarmed timeout 120s\n"
    );
    for seed in 1..=3 {
        let report = flown(&basics(), &script, seed);
        assert_eq!(unmet(&report), [], "seed {seed}");
    }
}

#[test]
fn gates_in_the_wrong_order_and_a_short_hover_do_not_count() {
    let script = format!(
        "{START}all goto gate2 up 20\nwait all arrived timeout 40s\n\
         all rtl\nwait all disarmed timeout 120s\n"
    );
    let report = flown(&basics(), &script, 1);
    let unmet = unmet(&report);
    assert!(!report.passed);
    assert!(
        unmet.contains(&("gates", "0/2 gates".to_owned())),
        "{unmet:?}"
    );
    assert!(unmet.iter().any(|(id, _)| *id == "mast-seen"), "{unmet:?}");
    assert!(unmet.iter().all(|(id, _)| *id != "landed"), "{unmet:?}");
}

/// Two vehicles fly side by side, first 10 m apart, and then 30 m.
#[test]
fn a_formation_is_kept_or_it_is_not() {
    let objectives = basics().find("[[objectives]]").expect("there are some");
    let scoring = basics().find("[scoring]").expect("there is one");
    let formation = "[[objectives]]\nid = \"keep\"\ntitle = \"Keep\"\nkind = \"formation\"\n\
        gates = [[0, 20, 20], [0, 60, 20]]\nradius = 4\nspacing = [7, 13]\ntarget = 0.9\n\
        partial_from = 0.3\nvalue = 10\nmandatory = true\n";
    let source = [&basics()[..objectives], formation, &basics()[scoring..]].concat();
    let source = source
        .replace("max_vehicles = 1", "max_vehicles = 2")
        .replace("pads = [[0, 0]]", "pads = [[-5, 0], [5, 0]]");
    // From its own pad, to the west or to the east.
    let flight = |aside: i32| {
        let to = |north: u32| {
            format!(
                "1 goto n {north} e {} up 20\n2 goto n {north} e {aside} up 20\n\
                 wait all arrived timeout 60s\n",
                -aside
            )
        };
        let home = "all rtl\nwait all disarmed timeout 120s\n";
        format!("{START}{}{}{home}", to(20), to(60))
    };
    let close = flown(&source, &flight(0), 1);
    assert_eq!(unmet(&close), []);
    let apart = flown(&source, &flight(10), 1);
    assert_eq!(unmet(&apart), [("keep", "2/2 gates, 0 %".to_owned())]);
}

#[test]
fn the_truth_of_a_line_inspection_shows_the_line() {
    let source = std::fs::read_to_string(folder("missions/04-line-inspection.toml"));
    let report = flown(&source.expect("it is there"), "wait 1s\n", 1);
    assert_eq!(report.truth.wires.len(), 1);
    assert!(report.truth.wires[0].len() > 2, "{:?}", report.truth.wires);
}
