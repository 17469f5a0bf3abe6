//! Properties of the score of arbitrary flights.

use proptest::prelude::*;

use super::facts::any_facts;
use super::*;

/// Changes that must never gain a point.
fn worse(facts: &Facts) -> Vec<(&'static str, Facts)> {
    let with = |change: &dyn Fn(&mut Facts)| {
        let mut changed = facts.clone();
        change(&mut changed);
        changed
    };
    let mut all = vec![
        (
            "harm",
            with(&|f| f.safety.push(event(SafetyKind::Injury, 0))),
        ),
        ("unsafe", with(&|f| f.commands.dangerous += 1)),
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
            with(&|f| {
                for objective in &mut f.objectives {
                    if let Some(product) = &mut objective.product {
                        product.quality *= 0.9;
                    }
                }
            }),
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

/// The same objectives and broken rules, with everything else perfect.
fn nearly_perfect(facts: Facts) -> Facts {
    let mut safety = facts.safety;
    safety.truncate(1);
    let mut objectives = facts.objectives;
    for objective in objectives.iter_mut().skip(1) {
        objective.fraction = 1.0;
        objective.met = true;
        objective.product = None;
    }
    Facts {
        objectives,
        safety,
        ..perfect()
    }
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
    fn hints_only_lower(facts in any_facts()) {
        let without = Facts { hints: HintsUsed::default(), ..facts.clone() };
        prop_assert!(score(&rules(), &facts).points <= score(&rules(), &without).points);
        let free = Facts { hints: HintsUsed { free_level: 3, ..facts.hints }, ..facts };
        prop_assert_eq!(score(&rules(), &free).points, score(&rules(), &without).points);
    }

    #[test]
    fn harm_caps_any_score_and_takes_any_medal(facts in any_facts(), hit in any::<bool>()) {
        let kind = if hit { SafetyKind::AircraftHit } else { SafetyKind::Injury };
        let mut facts = facts;
        facts.safety.push(event(kind, 0));
        let score = score(&rules(), &facts);
        prop_assert!(score.points <= HARM_POINTS);
        prop_assert_eq!(score.medal, None);
    }

    #[test]
    fn no_points_open_a_gate_or_make_up_for_a_missed_mandatory_objective(
        facts in any_facts(),
        good in any::<bool>(),
    ) {
        // Random flights rarely earn a medal, so some are made nearly perfect.
        let facts = if good { nearly_perfect(facts) } else { facts };
        let gates = ["safety >= 0.85", "crashes == 0", "cells >= 0.95"].map(|gate| Gate::parse(gate).expect("well formed"));
        let rules = ScoreRules { gold_requires: gates.to_vec(), ..rules() };
        let score = score(&rules, &facts);
        let safety = score.value(Component::Safety).unwrap_or(1.0);
        if score.medal == Some(Medal::Gold) {
            prop_assert!(safety >= 0.85 && score.points >= 850);
            prop_assert!(facts.safety.iter().all(|event| !event.kind.is_loss()));
            prop_assert!(facts.objectives[0].measure >= 0.95);
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
        let rules = ScoreRules { weights: Weights(parts.map(|part| part / sum)), ..rules() };
        let weights: f64 = score(&rules, &facts).components.iter().map(|c| c.weight).sum();
        prop_assert!((weights - 1.0).abs() < 1e-9);
    }
}
