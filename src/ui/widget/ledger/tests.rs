use std::time::Duration;

use super::*;
use crate::language::verb;
use crate::ledger::{Given, Ledger, Risk, RowUpdate};
use crate::vehicle_id::VehicleId;

fn texts(lines: &[Line<'_>]) -> Vec<String> {
    lines.iter().map(ToString::to_string).collect()
}

#[test]
fn sentences_that_differ_stand_below_each_other_and_values_on_one_line() {
    let look = Look::default();
    let told = |remarks: [&str; 2]| {
        let mut ledger = Ledger::new();
        let given = Given {
            line: "all drop",
            verb: verb("drop").expect("a verb"),
            risk: Risk::None,
            by: None,
        };
        let id = ledger.open(Duration::ZERO, given, &[1, 2]);
        for (vehicle, remark) in (1..).zip(remarks) {
            ledger.apply(&RowUpdate {
                entry: id,
                vehicle,
                state: RowState::Done,
                tries: 1,
                at: Duration::ZERO,
                explanation: Some(Text::verbatim(remark)),
            });
        }
        let entry = ledger.entries().next().expect("it was opened");
        outcome(entry, &look)
    };
    assert_eq!(told(["= 500", "= 700"]).as_deref(), Some("1: 500   2: 700"));
    let sentences = [
        "a person 2 m away has it; 1 left",
        "no one within 8 m; 1 left",
    ];
    assert_eq!(told(sentences), None);
}

/// A ledger with one command, done for both its vehicles; for the first `ended` of them, its
/// effect is over.
fn done_and_ended(line: &str, ended: VehicleId) -> Ledger {
    let mut ledger = Ledger::new();
    let given = Given {
        line,
        verb: verb("arm").expect("a verb"),
        risk: Risk::None,
        by: None,
    };
    let entry = ledger.open(Duration::ZERO, given, &[1, 2]);
    let mut report = |vehicle, state, explanation| {
        ledger.apply(&RowUpdate {
            entry,
            vehicle,
            state,
            tries: 1,
            at: Duration::ZERO,
            explanation,
        });
    };
    for vehicle in [1, 2] {
        report(vehicle, RowState::Done, None);
    }
    for vehicle in 1..=ended {
        let by = Some(Text::verbatim("disarming"));
        report(vehicle, RowState::Overtaken, by);
    }
    ledger
}

#[test]
fn an_effect_that_has_ended_is_no_longer_shown_as_one() {
    let look = Look::default();
    for (ended, said, role) in [
        (0, "2 effect seen", Role::Ok),
        (1, "1 effect seen, 1 effect ended", Role::Ok),
        (2, "2 effect ended", Role::Muted),
    ] {
        let ledger = done_and_ended("all arm", ended);
        let entry = ledger.entries().next().expect("it was opened");
        assert_eq!(summary(entry, &look, false), said);
        assert_eq!(entry_role(entry), role, "{said}");
    }
}

#[test]
fn an_effect_that_was_seen_keeps_its_colour_beside_another_outcome() {
    let look = Look::default();
    let mut ledger = Ledger::new();
    let given = Given {
        line: "all takeoff 15",
        verb: verb("takeoff").expect("a verb"),
        risk: Risk::None,
        by: None,
    };
    let entry = ledger.open(Duration::ZERO, given, &[1, 2]);
    for (vehicle, state) in [(1, RowState::Done), (2, RowState::Refused)] {
        ledger.apply(&RowUpdate {
            entry,
            vehicle,
            state,
            tries: 1,
            at: Duration::ZERO,
            explanation: None,
        });
    }
    let entry = ledger.entries().next().expect("it was opened");
    let spans = summary_spans(entry, &look, 40);
    let style = |text| {
        let mut all = spans.iter();
        all.find(|it| it.content == text).map(|it| it.style)
    };
    assert_eq!(style("1 effect seen"), Some(look.style(Role::Ok)));
    assert_eq!(style("1 refused"), Some(look.style(Role::Danger)));
    let cut: String = summary_spans(entry, &look, 18)
        .iter()
        .map(|it| it.content.as_ref())
        .collect();
    assert_eq!(cut, "1 effect seen, 1 …");
}

#[test]
fn on_a_single_row_the_state_of_a_command_is_not_cut() {
    let look = Look::default();
    let ledger = done_and_ended("all goto n 120.5 e -35.25 up 30 heading 270", 1);
    let entry = ledger.entries().next().expect("it was opened");
    let view = FlightView::default();
    let line = short_line(entry, &view, 50, &look).to_string();
    assert_eq!(line, "00:00 all goto n …  1 effect seen, 1 effect ended…");
}

#[test]
fn what_is_left_out_of_a_command_is_marked_in_the_last_line() {
    let all = || {
        vec![
            Line::raw("00:01 2 mark"),
            Line::raw("  refused, for it"),
            Line::raw("  is late"),
        ]
    };
    for (rows, width, last) in [
        (3, 20, "  is late"),
        (2, 20, "  refused, for it…"),
        (2, 17, "  refused, for i…"),
        (1, 20, "00:01 2 mark…"),
    ] {
        let mut lines = all();
        cut(&mut lines, rows, width);
        assert_eq!(lines.len(), rows);
        assert_eq!(texts(&lines).pop().as_deref(), Some(last), "{rows} {width}");
    }
}
