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
        usage: Vec::new(),
        hints: HintsUsed::default(),
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
        accepted: 3,
        empty: 1,
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

#[test]
fn commands_that_change_nothing_dilute_no_fault() {
    let done = RowState::Done;
    let (ledger, log, _) = logged(
        1,
        &[
            (1000, "1 goto n 9 e 0", done),
            (5000, "1 speed 3", done),
            (9000, "1 goto n 9 e 0", done),
            (13_000, "1 speed 3", done),
            (17_000, "1 rtl", done),
            (21_000, "1 goto n 9 e 0", done),
            (25_000, "1 speed 4", done),
        ],
    );
    let tally = log.tally(&ledger);
    assert_eq!((tally.accepted, tally.empty), (5, 2), "{tally:?}");
}

#[test]
fn harm_to_people_caps_the_score_and_takes_the_medal() {
    for kind in [SafetyKind::Injury, SafetyKind::AircraftHit] {
        let mut facts = perfect();
        facts.safety = vec![event(kind, 0)];
        let score = score(&rules(), &facts);
        assert_eq!((score.points, score.medal), (300, None));
    }
}

#[test]
fn hints_take_their_share_of_the_sum_from_the_second_try_on() {
    for (free, expected) in [(true, 1000), (false, 930)] {
        let mut facts = perfect();
        facts.hints = HintsUsed {
            levels: [1, 1, 0],
            free,
        };
        let score = score(&rules(), &facts);
        assert_eq!(score.points, expected);
        assert_eq!(score.subtotal_tenths, 10_000);
        let gain: Vec<u16> = improvements(&rules(), &facts)
            .iter()
            .map(|improvement| improvement.points)
            .collect();
        assert_eq!(gain, if free { vec![] } else { vec![70] });
    }
}

#[test]
fn a_flight_that_never_takes_off_earns_nothing_for_keeping_still() {
    let mut facts = perfect();
    facts.vehicles = 4;
    facts.usage = vec![VehicleUse::default(); 4];
    let value = score(&rules(), &facts).value(Component::Utilisation);
    assert_eq!(value, Some(0.0));
}

prop_compose! {
    fn any_alert()(level in 0..3usize, limit_s in 1u64..60, after_s in proptest::option::of(0u64..200)) -> AlertFact {
        AlertFact {
            text: "alert".into(),
            level: [AlertLevel::Caution, AlertLevel::Warning, AlertLevel::Critical][level],
            at: Duration::ZERO,
            limit: Duration::from_secs(limit_s),
            answered_after: after_s.map(Duration::from_secs),
        }
    }
}

prop_compose! {
    fn any_use()(airborne_s in 0u64..500, productive in 0.0..=1.0f64, idle in 0.0..=1.0f64) -> VehicleUse {
        let airborne = Duration::from_secs(airborne_s);
        VehicleUse {
            vehicle: 1,
            airborne,
            productive: airborne.mul_f64(productive),
            idle: airborne.mul_f64((1.0 - productive) * idle),
        }
    }
}

prop_compose! {
    fn any_facts()(
        fractions in proptest::collection::vec((0.0..=1.0f64, any::<bool>()), 1..5),
        quality in proptest::option::of(0.0..=1.0f64),
        elapsed_s in 0u64..1000,
        energy in proptest::option::of(0.0..100.0f64),
        breaches in proptest::collection::vec(0u64..100, 0..6),
        (accepted, empty, rejected, dangerous, duplicates) in (0u32..100, 0u32..9, 0u32..100, 0u32..9, 0u32..9),
        alerts in proptest::collection::vec(any_alert(), 0..4),
        usage in proptest::collection::vec(any_use(), 1..9),
        (levels, free) in (proptest::array::uniform3(0u32..5), any::<bool>()),
    ) -> Facts {
        Facts {
            objectives: fractions.iter().map(|&(fraction, mandatory)| objective(fraction, mandatory)).collect(),
            quality: quality.map(|quality| (quality, "map".into())),
            quality_advice: Text::default(),
            elapsed: Duration::from_secs(elapsed_s),
            energy_wh: energy,
            safety: breaches.iter().map(|&s| event(SafetyKind::Geofence, s)).collect(),
            commands: CommandTally { accepted, empty, rejected, dangerous, duplicates },
            alerts,
            vehicles: usage.len(),
            usage,
            hints: HintsUsed { levels, free },
        }
    }
}

/// What must never bring a point.
fn worse(facts: &Facts) -> Vec<(&'static str, Facts)> {
    let with = |change: &dyn Fn(&mut Facts)| {
        let mut changed = facts.clone();
        change(&mut changed);
        changed
    };
    let mut all = vec![
        ("time", with(&|f| f.elapsed += Duration::from_secs(30))),
        (
            "energy",
            with(&|f| f.energy_wh = f.energy_wh.map(|wh| wh + 3.0)),
        ),
        (
            "safety",
            with(&|f| f.safety.push(event(SafetyKind::OffPad, 0))),
        ),
        ("refused", with(&|f| f.commands.rejected += 1)),
        ("duplicate", with(&|f| f.commands.duplicates += 1)),
        ("padding", with(&|f| f.commands.empty += 50)),
        (
            "quality",
            with(&|f| f.quality = f.quality.clone().map(|(q, words)| (q * 0.9, words))),
        ),
        (
            "hover",
            with(&|f| {
                for one in &mut f.usage {
                    one.productive = one.productive.mul_f64(0.5);
                }
            }),
        ),
        (
            "idle",
            with(&|f| {
                for one in &mut f.usage {
                    one.idle = one.airborne.saturating_sub(one.productive);
                }
            }),
        ),
        (
            "alert",
            with(&|f| {
                for alert in &mut f.alerts {
                    alert.answered_after = alert
                        .answered_after
                        .map(|after| after + Duration::from_secs(5));
                }
            }),
        ),
        (
            "unanswered",
            with(&|f| {
                if let Some(alert) = f.alerts.first_mut() {
                    alert.answered_after = None;
                }
            }),
        ),
    ];
    for level in 0..3 {
        all.push(("hint", with(&|f| f.hints.levels[level] += 1)));
    }
    for index in 0..facts.objectives.len() {
        let missed = with(&|f| {
            let objective = &mut f.objectives[index];
            objective.fraction *= 0.9;
            objective.met = false;
        });
        all.push(("objective", missed));
    }
    all
}

proptest! {
    #[test]
    fn scores_stay_within_bounds_and_add_up(facts in any_facts()) {
        let score = score(&rules(), &facts);
        prop_assert!(score.points <= 1000);
        let sum: u32 = score.components.iter().map(|c| c.points_tenths).sum();
        prop_assert_eq!(sum, score.subtotal_tenths);
        let hinted = f64::from(sum) / 10.0 * score.hint_factor;
        prop_assert!((f64::from(score.points) - hinted).abs() <= 0.6);
        let weights: f64 = score.components.iter().map(|c| c.weight).sum();
        prop_assert!((weights - 1.0).abs() < 1e-9);
        for component in &score.components {
            prop_assert!((0.0..=1.0).contains(&component.value));
        }
        for improvement in improvements(&rules(), &facts) {
            prop_assert!(improvement.points >= 1 && u32::from(improvement.points) + u32::from(score.points) <= 1000);
        }
    }

    #[test]
    fn nothing_that_is_worse_brings_a_point(facts in any_facts()) {
        let before = score(&rules(), &facts).points;
        for (what, worse) in worse(&facts) {
            let after = score(&rules(), &worse).points;
            prop_assert!(after <= before, "{} brings {} points", what, after - before);
        }
    }

    #[test]
    fn no_points_open_a_gate_or_make_up_for_a_missed_mandatory_objective(facts in any_facts()) {
        let score = score(&rules(), &facts);
        let safety = score.value(Component::Safety).unwrap_or(1.0);
        if score.medal == Some(Medal::Gold) {
            prop_assert!(safety >= 0.85 && score.points >= 850);
        }
        if facts.objectives.iter().any(|objective| objective.mandatory && !objective.met) {
            prop_assert_eq!(score.medal, None);
            let objective = score.value(Component::Objective).unwrap_or(0.0);
            prop_assert!(objective <= 0.5);
        }
    }

    #[test]
    fn weights_shared_out_sum_to_one(parts in proptest::array::uniform8(0.0..1.0f64), facts in any_facts()) {
        let sum: f64 = parts.iter().sum();
        prop_assume!(sum > 0.1 && parts[0] > 0.0);
        let rules = Rules { weights: Weights(parts.map(|part| part / sum)), ..rules() };
        let weights: f64 = score(&rules, &facts).components.iter().map(|c| c.weight).sum();
        prop_assert!((weights - 1.0).abs() < 1e-9);
    }
}
