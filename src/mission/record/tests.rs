use super::*;
use crate::mission::fake::Pilot;
use crate::mission::fake::{do_nothing, fly_the_cells};

/// A flight with a recorder.
fn recorded() -> Pilot {
    let mut pilot = Pilot::new(7);
    pilot.flight.set_attempt(3);
    pilot
        .flight
        .start_record("2026-11-20T14:03:22Z", "embedded");
    pilot
}

/// Flies a few cells, with a refusal, a deed and an alarm; gives up at the end.
fn eventful() -> (Report, String) {
    let mut pilot = recorded();
    pilot.command("1 arm", RowState::Refused);
    drop(
        pilot
            .flight
            .act(EntryId(0), &Deed::Predict { points: 640 }, &[1]),
    );
    pilot.take_off(20.0);
    pilot.hear("Battery 1 is low 10.70V used 341 mAh");
    pilot.survey();
    pilot.flight.abandon();
    pilot.command("1 rtl", RowState::TimedOut);
    let report = pilot.flight.close(&pilot.ledger);
    (report, pilot.flight.take_record())
}

#[test]
fn a_record_scores_again_as_it_was_scored() {
    let (report, text) = eventful();
    let stored = Stored::read(&text).expect("a good record");
    assert_eq!(stored.damage, None);
    let again = stored.rescore().expect("a good mission");
    // The fake vehicle is where it is to a fraction of what messages carry; the rest is equal.
    assert_eq!(again.report.score, report.score);
    assert_eq!(again.report.ledger, report.ledger);
    assert_eq!(again.report.prediction, report.prediction);
    assert_eq!(again.report.objectives, report.objectives);
    assert_eq!(again.report.attempt, 3);
    assert_eq!(again.before.map(|end| end.score), Some(report.score));
}

#[test]
fn a_record_that_was_cut_off_anywhere_is_scored_up_to_there() {
    let (_, text) = eventful();
    let head = text.find('\n').expect("a first line") + 1;
    for at in (head..text.len() - 1).step_by(text.len() / 23) {
        let stored = Stored::read(&text[..at]).expect("the head is whole");
        assert!(stored.damage.is_some(), "{at}");
        let again = stored.rescore().expect("a good mission");
        assert!(again.before.is_none(), "{at}");
        assert!(!again.report.passed);
    }
}

#[test]
fn a_damaged_line_is_named_and_ends_the_record() {
    let (_, text) = eventful();
    let mut lines: Vec<&str> = text.lines().collect();
    lines[5] = "{\"tick\":{\"t\":";
    let stored = Stored::read(&lines.join("\n")).expect("the head is whole");
    let damage = stored.damage.expect("a line is damaged").to_string();
    assert!(damage.contains("line 6"), "{damage}");
}

#[test]
fn what_is_no_record_is_refused_with_the_reason() {
    for (text, reason) in [
        ("", "no recorded run"),
        ("schema = 1\n", "no recorded run"),
        ("{\"sortie_run\":99}\n", "version 99"),
        ("{\"sortie_run\":1}\n", "first line"),
    ] {
        let error = Stored::read(text).expect_err("no record").to_string();
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn a_record_is_small() {
    let (_, text) = eventful();
    let minutes = 1.0 + fly_the_cells(7).now.as_secs_f64() / 60.0;
    let per_minute = text.len() as f64 / minutes;
    assert!(per_minute < 80_000.0, "{per_minute} bytes a minute");
    assert!(do_nothing().report().score < 300);
}
