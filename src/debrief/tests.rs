use super::*;
use crate::ledger::RowState;
use crate::mission::fake::{Pilot, do_nothing, fly_the_cells};

fn bad_flight() -> Report {
    let mut pilot = Pilot::new(1);
    pilot.tick();
    pilot.command("1 arm", RowState::Refused);
    pilot.tick();
    pilot.command(
        &format!("1 takeoff 20.{}", "0".repeat(280)),
        RowState::Refused,
    );
    pilot.take_off(80.0);
    pilot.goto(-45.0, 0.0, 5.0);
    pilot.set_armed(false);
    pilot.tick();
    pilot.report()
}

#[test]
fn no_line_is_wider_than_the_page() {
    for report in [
        fly_the_cells(1).report(),
        do_nothing().report(),
        bad_flight(),
    ] {
        let text = text(&report);
        for line in text.lines() {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
    }
}

#[test]
fn the_components_add_up_to_the_score() {
    for report in [
        fly_the_cells(1).report(),
        do_nothing().report(),
        bad_flight(),
    ] {
        let sum: f64 = report
            .components
            .iter()
            .map(|component| component.points)
            .sum();
        assert!(
            (sum - f64::from(report.score)).abs() <= 0.5 + 1e-6,
            "{sum} {}",
            report.score
        );
    }
}

#[test]
fn every_rule_broken_and_every_rejection_stands_in_the_timeline() {
    let text = text(&bad_flight());
    for words in [
        "r 1 arm: refused",
        "x drone 1: above 60 m",
        "x drone 1: outside geofence fence",
        "x drone 1: motors stopped",
    ] {
        assert!(text.contains(words), "{words} is missing:\n{text}");
    }
}

#[test]
fn improvements_stand_by_their_gain() {
    let report = bad_flight();
    assert!(!report.improvements.is_empty());
    assert!(
        report
            .improvements
            .is_sorted_by(|a, b| a.points >= b.points)
    );
}

#[test]
fn foreign_text_cannot_break_the_page() {
    let mut report = do_nothing().report();
    report.events[0].text = "a\u{1b}[2Jb\nc".to_owned();
    assert!(!text(&report).contains('\u{1b}'));
}

#[test]
fn a_whole_debrief_reads_like_this() {
    insta::assert_snapshot!(text(&fly_the_cells(1).report()));
}
