//! Plans that vehicles carry from the start of a mission.

use std::sync::Arc;

use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::scoring::{Medal, Report};
use crate::vehicle::VehicleId;

const DRILL: &str = include_str!("../../../missions/drills/d16-one-of-three.toml");

fn mission() -> Arc<Mission> {
    Arc::new(Mission::parse(DRILL).expect("no faults"))
}

/// The vehicles whose plan has a fault.
fn faulty(seed: u64) -> Vec<VehicleId> {
    let drawn = mission().board.drawn(seed);
    let numbered = (1..).zip(drawn);
    numbered
        .filter_map(|(vehicle, fault)| fault.map(|_| vehicle))
        .collect()
}

/// A flight with new plans for some of the vehicles.
fn flown(seed: u64, replaced: &[VehicleId]) -> Report {
    let mission = mission();
    let areas = mission.named_areas();
    let context = Context {
        areas: Some(&areas),
        vehicles: &[1, 2, 3],
        ..Context::default()
    };
    let plan = |it: &VehicleId| format!("{it} plan survey plot{it} spacing 12 up 10 course 0\n");
    let plans: String = replaced.iter().map(plan).collect();
    let source = format!(
        "wait all ready timeout 60s\nwait 6s\n{plans}wait 5s\nall plan rehearse\nwait 1s\nall guided\nall arm\n\
         wait all armed timeout 10s\nall plan start\nwait all airborne timeout 20s\nwait all disarmed timeout 3min\n"
    );
    let script = Script::parse(&source, &context).expect("no faults");
    let mut exercise = Exercise::new(mission, seed, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
        exercise.take_notices();
    }
    exercise.report()
}

#[test]
fn gold_needs_the_faulty_plan_found_and_the_sound_ones_left() {
    for seed in 1..=2 {
        let bad = faulty(seed);
        assert_eq!(bad.len(), 1);
        let found = flown(seed, &bad);
        assert_eq!(found.medal, Some(Medal::Gold), "{seed}: {}", found.score);
        let all_new = flown(seed, &[1, 2, 3]);
        assert!(
            all_new.passed && all_new.medal < Some(Medal::Gold),
            "{seed}"
        );
        let sound: Vec<VehicleId> = (1..=3).filter(|it| !bad.contains(it)).collect();
        let wrong = flown(seed, &sound[..1]);
        assert!(!wrong.passed && wrong.medal.is_none(), "{seed}");
    }
}
