//! The advice, and its promised points.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::facts::any_facts;
use super::*;

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

#[test]
fn where_the_product_is_what_is_asked_for_one_advice_is_about_both() {
    let mut facts = perfect();
    facts.objectives[0] = with_map(0.4, objective(0.5, false));
    if let Some(product) = &mut facts.objectives[0].product {
        product.advice = "Sample more.".into();
        product.is_measured = true;
    }
    let found = improvements(&rules(), &facts);
    let first = found[0].text.to_string();
    assert!(
        first.contains("from 0.40 to 0.90") && first.contains("Sample more."),
        "{first}"
    );
    assert_eq!(found.len(), 1, "{found:?}");
    facts.objectives[0] = with_map(0.9, objective(1.0, false));
    let (after, before) = (score(&rules(), &facts).points, {
        facts.objectives[0] = with_map(0.4, objective(0.5, false));
        score(&rules(), &facts).points
    });
    assert_eq!(before + found[0].points, after);
}

#[test]
fn rules_with_one_advice_are_advised_once_for_all() {
    let mut facts = perfect();
    facts.safety = vec![
        event(SafetyKind::Separation, 0),
        event(SafetyKind::Collision, 0),
    ];
    let found = improvements(&rules(), &facts);
    assert_eq!(found.len(), 1, "{found:?}");
    let lost = 1000 - score(&rules(), &facts).points;
    assert_eq!(found[0].points, lost);
}

#[test]
fn what_must_be_reached_together_is_advised_together() {
    let mut facts = perfect();
    facts.objectives = vec![
        objective(1.0, false),
        objective(0.9, true),
        objective(0.9, true),
    ];
    facts.elapsed = Duration::from_secs(100);
    let found = improvements(&rules(), &facts);
    assert_eq!(found.len(), 1, "{found:?}");
    let lost = 1000 - score(&rules(), &facts).points;
    assert_eq!(found[0].points, lost);
}

#[test]
fn the_advice_on_commands_names_the_fault_that_cost_most() {
    let advised = |rejected, dangerous, duplicates| {
        let mut facts = perfect();
        facts.commands = CommandTally {
            rejected,
            dangerous,
            duplicates,
            ..facts.commands
        };
        let found = improvements(&rules(), &facts).remove(0);
        found.text.to_string()
    };
    let [refused, is_unsafe, twice] = [advised(1, 1, 1), advised(0, 1, 1), advised(0, 0, 1)];
    assert!(refused.starts_with("Avoid refused commands"), "{refused}");
    assert!(
        is_unsafe.starts_with("Avoid unsafe commands"),
        "{is_unsafe}"
    );
    assert!(twice.starts_with("Give each command once"), "{twice}");
    let many = advised(1, 3, 0);
    assert!(many.starts_with("Avoid unsafe commands"), "{many}");
}

proptest! {
    #[test]
    fn no_advice_is_given_twice_and_all_gains_are_no_more_than_what_was_lost(facts in any_facts()) {
        let points = score(&rules(), &facts).points;
        let found = improvements(&rules(), &facts);
        let texts: BTreeSet<String> = found.iter().map(|one| one.text.to_string()).collect();
        prop_assert_eq!(texts.len(), found.len());
        let gains: u16 = found.iter().map(|one| one.points).sum();
        prop_assert!(points + gains <= 1000, "{} and {:?}", points, found);
        prop_assert!(found.iter().all(|one| one.points > 0));
        prop_assert!(found.is_sorted_by(|a, b| a.points >= b.points));
    }
}
