//! Tests of the command tally.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;
use crate::ledger::{Given, Ledger, RowState, RowUpdate};
use crate::mission::fake::given;
use crate::pilot_in_command::Person;

/// Gives lines to vehicle 1, each at a mission time in ms, with the program's clock slowed down by `slower`.
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
        given: 6,
        accepted: 3,
        empty: 1,
        rejected: 1,
        forgiven: 0,
        dangerous: 1,
        duplicates: 1,
    };
    // Duplicates by mission time are duplicates at any speed-up.
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
fn refusals_that_a_lesson_asks_for_cost_nothing_and_further_ones_do() {
    let refused = |rejected| CommandTally {
        given: 9,
        accepted: 4,
        rejected,
        ..CommandTally::default()
    };
    let value = |tally: CommandTally| tally.forgiving(1).value();
    assert!((value(refused(1)) - 1.0).abs() < 1e-9);
    assert!(value(refused(2)) < 1.0);
    assert_eq!(refused(1).forgiving(0), refused(1));
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
fn commands_of_the_crew_count_and_those_of_an_instructor_do_not() {
    let people = [Person::named("anna"), Person::instructor("petro")];
    for (person, counted) in people.iter().zip([1, 0]) {
        let (mut ledger, mut log) = (Ledger::new(), CommandLog::default());
        let given = Given {
            by: Some(person),
            ..given("1 rtl")
        };
        let entry = ledger.open(Duration::ZERO, given, &[1]);
        ledger.apply(&RowUpdate {
            entry,
            vehicle: 1,
            state: RowState::Refused,
            tries: 1,
            at: Duration::ZERO,
            explanation: None,
        });
        log.step(Duration::ZERO, &BTreeMap::new(), &ledger);
        let tally = log.tally(&ledger);
        assert_eq!(
            (tally.given, tally.rejected),
            (counted, counted),
            "{person}"
        );
    }
}

#[test]
fn a_command_to_several_counts_for_each_vehicle_that_refuses_it() {
    let (mut ledger, mut log) = (Ledger::new(), CommandLog::default());
    let rows = [
        (1, RowState::Refused, 0),
        (2, RowState::Refused, 1),
        (3, RowState::Done, 1),
    ];
    let entry = ledger.open(Duration::ZERO, given("1-3 rtl"), &[1, 2, 3]);
    for (vehicle, state, tries) in rows {
        ledger.apply(&RowUpdate {
            entry,
            vehicle,
            state,
            tries,
            at: Duration::ZERO,
            explanation: None,
        });
    }
    log.step(Duration::ZERO, &BTreeMap::new(), &ledger);
    let tally = log.tally(&ledger);
    assert_eq!((tally.given, tally.rejected, tally.accepted), (3, 2, 1));
    let words = |vehicles| tally.value_and_words(vehicles).1.to_string();
    assert_eq!(words(3), "2 refused; 3 commands, counted per vehicle");
    assert_eq!(words(1), "2 refused; 3 commands");
}

proptest! {
    #[test]
    fn no_count_is_larger_than_that_of_all(
        orders in proptest::collection::vec((0..4usize, 0..5usize, 0u64..5000), 0..30),
    ) {
        let lines = ["1 arm", "1 rtl", "1 kill", "1 long 400 1 2989"];
        let states = [RowState::Done, RowState::Refused, RowState::TimedOut, RowState::NoEffect, RowState::Superseded];
        let mut at_ms = 0;
        let orders: Vec<(u64, &str, RowState)> = orders
            .into_iter()
            .map(|(line, state, after_ms)| {
                at_ms += after_ms;
                (at_ms, lines[line], states[state])
            })
            .collect();
        let (ledger, log, _) = logged(1, &orders);
        let tally = log.tally(&ledger);
        prop_assert_eq!(tally.given as usize, orders.len());
        let parts = tally.accepted + tally.empty + tally.rejected + tally.duplicates;
        prop_assert!(parts <= tally.given && tally.dangerous <= tally.given, "{:?}", tally);
        prop_assert!((0.0..=1.0).contains(&tally.value()));
    }
}
