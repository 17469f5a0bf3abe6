use std::collections::BTreeMap;
use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::ledger::{Ledger, RowState, RowUpdate};
use crate::mission::fake::given;

fn rules() -> Rules {
    Rules {
        weights: Weights::default(),
        par_time: Duration::from_secs(210),
        par_energy_wh: 20.0,
        time_limit: Duration::from_secs(480),
        medals: Medals {
            gold: 850,
            silver: 700,
            bronze: 550,
        },
        gold_requires: vec![Gate::parse("safety >= 0.85").expect("well formed")],
    }
}

fn objective(fraction: f64, mandatory: bool) -> ObjectiveFact {
    ObjectiveFact {
        id: "cells".to_owned(),
        title: Text::default(),
        value: 50.0,
        fraction,
        measure: fraction,
        met: fraction >= 1.0,
        mandatory,
        result: Text::default(),
        target: Text::default(),
        advice: "Sample more.".into(),
    }
}

fn perfect() -> Facts {
    Facts {
        objectives: vec![objective(1.0, true)],
        quality: Some((1.0, "map".into())),
        quality_advice: Text::default(),
        elapsed: Duration::from_secs(200),
        energy_wh: Some(15.0),
        safety: Vec::new(),
        commands: CommandTally {
            accepted: 10,
            ..CommandTally::default()
        },
        alerts: Vec::new(),
        vehicles: 1,
    }
}

fn event(kind: SafetyKind, lasted_s: u64) -> SafetyEvent {
    SafetyEvent {
        kind,
        vehicle: 1,
        at: Duration::ZERO,
        lasted: Duration::from_secs(lasted_s),
        text: "broken".into(),
    }
}

#[test]
fn a_perfect_flight_gets_everything() {
    let score = score(&rules(), &perfect());
    assert_eq!((score.points, score.medal), (1000, Some(Medal::Gold)));
    assert_eq!(improvements(&rules(), &perfect()), Vec::new());
}

#[test]
fn a_single_vehicles_utilisation_goes_to_safety_and_attention_is_shared() {
    let score = score(&rules(), &perfect());
    let weight = |component| {
        score
            .components
            .iter()
            .find(|c| c.component == component)
            .map(|c| c.weight)
    };
    assert!((weight(Component::Safety).expect("applies") - 0.25 / 0.95).abs() < 1e-9);
    assert!((weight(Component::Time).expect("applies") - 0.10 / 0.95).abs() < 1e-9);
    assert_eq!(weight(Component::Utilisation), None);
}

/// Each row: what is changed, which component, its value by the formula.
#[test]
fn each_component_follows_its_formula() {
    type Change = fn(&mut Facts);
    let table: [(Change, Component, f64); 9] = [
        (
            |f| f.objectives[0] = objective(0.8, false),
            Component::Objective,
            0.8,
        ),
        (
            |f| f.objectives[0] = objective(0.8, true),
            Component::Objective,
            0.5,
        ),
        (
            |f| f.elapsed = Duration::from_secs(345),
            Component::Time,
            0.5,
        ),
        (
            |f| f.objectives[0] = objective(0.5, false),
            Component::Time,
            0.0,
        ),
        (|f| f.energy_wh = Some(26.0), Component::Energy, 0.5),
        (
            |f| f.objectives[0] = objective(0.7, false),
            Component::Energy,
            0.0,
        ),
        (
            |f| f.safety = vec![event(SafetyKind::Geofence, 10)],
            Component::Safety,
            0.70,
        ),
        (
            |f| f.safety = vec![event(SafetyKind::Crash, 0), event(SafetyKind::OffPad, 0)],
            Component::Safety,
            0.55 * 0.95,
        ),
        (
            |f| f.commands.rejected = 1,
            Component::Command,
            1.0 - 1.0 / 4.5,
        ),
    ];
    for (index, (change, component, expected)) in table.into_iter().enumerate() {
        let mut facts = perfect();
        change(&mut facts);
        let value = score(&rules(), &facts).value(component).expect("applies");
        assert!(
            (value - expected).abs() < 1e-9,
            "row {index}: {value} instead of {expected}"
        );
    }
}

#[test]
fn a_missed_mandatory_objective_means_no_medal() {
    let mut facts = perfect();
    facts.objectives.push(objective(0.99, true));
    let score = score(&rules(), &facts);
    assert!(score.points > 550, "{}", score.points);
    assert_eq!(score.medal, None);
}

#[test]
fn gold_needs_its_gates_and_says_which() {
    let mut facts = perfect();
    facts.safety = vec![event(SafetyKind::Geofence, 0)];
    let score = score(&rules(), &facts);
    assert!(score.points >= 850);
    assert_eq!(score.medal, Some(Medal::Silver));
    assert_eq!(score.gold_missing, ["safety >= 0.85"]);
}

#[test]
fn improvements_are_the_points_that_would_have_come() {
    let mut facts = perfect();
    facts.safety = vec![event(SafetyKind::Crash, 0)];
    facts.elapsed = Duration::from_secs(345);
    let before = score(&rules(), &facts).points;
    let found = improvements(&rules(), &facts);
    assert_eq!(found.len(), 2);
    assert!(found[0].points > found[1].points);
    facts.safety.clear();
    assert_eq!(before + found[0].points, score(&rules(), &facts).points);
}

/// Gives lines to vehicle 1, each at a mission time in ms, on a program clock that runs `slower` times as fast.
fn logged(slower: u64, lines: &[(u64, &str, RowState)]) -> (Ledger, CommandLog, Vec<CommandEvent>) {
    let (mut ledger, mut log) = (Ledger::new(), CommandLog::default());
    let mut events = Vec::new();
    for &(at_ms, line, state) in lines {
        let at = Duration::from_millis(7000 + at_ms / slower);
        let entry = ledger.open(at, given(line), &[1]);
        ledger.apply(&RowUpdate {
            entry,
            vehicle: 1,
            state,
            tries: 1,
            at,
            explanation: None,
        });
        events.extend(log.step(Duration::from_millis(at_ms), &BTreeMap::new(), &ledger));
    }
    (ledger, log, events)
}

#[test]
fn commands_are_counted_per_vehicle_and_repetitions_once() {
    let expected = CommandTally {
        accepted: 4,
        rejected: 1,
        dangerous: 1,
        duplicates: 1,
    };
    // What is given twice in mission time is so at any speed of the simulation.
    for slower in [1, 20] {
        let (ledger, log, events) = logged(
            slower,
            &[
                (1000, "1 arm", RowState::Refused),
                (2000, "1 arm", RowState::Done),
                (3000, "1 rtl", RowState::Done),
                (3500, "1 rtl", RowState::Done),
                (9000, "1 rtl", RowState::Done),
                (9900, "1 kill", RowState::Done),
            ],
        );
        assert_eq!(events.len(), 1, "{events:?}");
        assert_eq!(log.tally(&ledger), expected, "{slower}");
    }
}

#[test]
fn risk_is_in_what_a_command_does_and_not_in_how_it_reads() {
    for (line, dangerous, forced) in [
        ("1 goto n 21196 e 0 up 20", false, false),
        ("1 long NAV_TAKEOFF 0 0 0 0 0 0 21196", false, false),
        ("1 param set WPNAV_SPEED 21196", false, false),
        ("1 param set ARMING_CHECK 1", false, false),
        ("1 long 400 1", false, false),
        ("1 kill", true, false),
        ("1 long 400 0 21196", true, false),
        ("1 long COMPONENT_ARM_DISARM 1 2989", true, true),
        ("1 long 400 1.0 21196.0", true, true),
        ("1 int 400 0 1 21196 0 0 0 0 0", true, true),
        ("1 parameter set arming_check 0", true, true),
    ] {
        let (ledger, log, events) = logged(1, &[(0, line, RowState::Done)]);
        assert_eq!(log.tally(&ledger).dangerous, u32::from(dangerous), "{line}");
        let expected = [CommandEvent::Forced { vehicle: 1 }];
        assert_eq!(events, expected[..usize::from(forced)], "{line}");
    }
}

proptest! {
    #[test]
    fn scores_stay_within_bounds_and_add_up(
        fractions in proptest::collection::vec((0.0..=1.0f64, any::<bool>()), 1..5),
        quality in proptest::option::of(0.0..=1.0f64),
        elapsed_s in 0u64..1000,
        energy in proptest::option::of(0.0..100.0f64),
        breaches in proptest::collection::vec(0u64..100, 0..6),
        (accepted, rejected, dangerous, duplicates) in (0u32..100, 0u32..100, 0u32..9, 0u32..9),
        vehicles in 1usize..9,
    ) {
        let facts = Facts {
            objectives: fractions.iter().map(|&(fraction, mandatory)| objective(fraction, mandatory)).collect(),
            quality: quality.map(|quality| (quality, "map".into())),
            quality_advice: Text::default(),
            elapsed: Duration::from_secs(elapsed_s),
            energy_wh: energy,
            safety: breaches.iter().map(|&s| event(SafetyKind::Geofence, s)).collect(),
            commands: CommandTally { accepted, rejected, dangerous, duplicates },
            alerts: Vec::new(),
            vehicles,
        };
        let score = score(&rules(), &facts);
        prop_assert!(score.points <= 1000);
        let sum: u32 = score.components.iter().map(|c| c.points_tenths).sum();
        prop_assert!((f64::from(score.points) - f64::from(sum) / 10.0).abs() <= 0.5);
        let weights: f64 = score.components.iter().map(|c| c.weight).sum();
        prop_assert!((weights - 1.0).abs() < 1e-9);
        for improvement in improvements(&rules(), &facts) {
            prop_assert!(improvement.points >= 1 && u32::from(improvement.points) + u32::from(score.points) <= 1000);
        }
    }
}
