//! The debrief of a flight with a crew.

use super::*;
use crate::scoring::{LedgerReport, RowReport};

/// A flight of two vehicles in which anna gave the only command.
fn flown_by_anna() -> Report {
    let mut report = fly_the_cells(1).report();
    let row = |vehicle, state| RowReport {
        vehicle,
        state,
        tries: 1,
        explanation: None,
    };
    let second = UseReport {
        vehicle: 2,
        ..report.usage[0]
    };
    report.usage.push(second);
    report.swarm.fan_out_waiting = Some(2.0);
    report.ledger = vec![LedgerReport {
        at_s: 21.0,
        line: "1-4 guided".to_owned(),
        by: Some(Person::named("anna")),
        rows: vec![
            row(1, RowState::Done),
            row(2, RowState::Barred),
            row(3, RowState::Done),
            row(4, RowState::Done),
        ],
    }];
    report.crew = vec!["anna".to_owned()];
    report
}

/// The page as one line, so that nothing depends on where lines end.
fn shown(report: &Report, language: Language) -> String {
    let page = text(report, &Locale::new(language));
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_command_that_not_all_vehicles_took_says_how_many_did() {
    let mut report = flown_by_anna();
    let page = shown(&report, Language::English);
    let expected = "> anna: 1-4 guided: 3 effect seen, 1 refused";
    assert!(page.contains(expected), "{page}");
    report.ledger[0].rows.remove(1);
    let page = shown(&report, Language::English);
    assert!(page.contains("anna: 1-4 guided: effect seen"), "{page}");
}

#[test]
fn figures_of_a_crew_are_not_those_of_the_reader() {
    let report = flown_by_anna();
    let page = shown(&report, Language::English);
    for words in [
        "the crew was busy for",
        "a command takes the crew",
        "the crew switched vehicles",
        "the crew keeps 2.0 vehicles busy",
    ] {
        assert!(page.contains(words), "{words}: {page}");
    }
    let page = shown(&report, Language::Ukrainian);
    assert!(page.contains("екіпаж був зайнятий"), "{page}");
    let mut alone = report;
    alone.crew.clear();
    let page = shown(&alone, Language::English);
    assert!(page.contains("you were busy for"), "{page}");
    assert!(!page.contains("crew"), "{page}");
}

#[test]
fn others_gave_commands_too_only_if_the_reader_gave_some() {
    let mut report = flown_by_anna();
    let page = shown(&report, Language::English);
    assert!(page.contains("commands by anna"), "{page}");
    let mut own = report.ledger[0].clone();
    own.by = None;
    report.ledger.push(own);
    let page = shown(&report, Language::English);
    assert!(page.contains("commands also by anna"), "{page}");
}
