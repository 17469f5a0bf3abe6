//! What the trainee asks and says: hints, a prediction, a goal.

use std::sync::Arc;

use super::*;
use crate::commands::{Deed, Goal};
use crate::ledger::RowState;
use crate::mission::fake::{Pilot, fly_the_cells};

/// The second mission with two hints of ours to be asked for instead of its own.
fn with_clues() -> Arc<Mission> {
    let clues = "[[hints]]\nlevel = 2\nobjective = \"cells\"\ntext = \"Fly {next_cell} next.\"\n\
                 [[hints]]\nlevel = 1\nphase = \"ground\"\ntext = \"Look at the wind.\"\n";
    let source = include_str!("../../../missions/01-air-sample.toml");
    let (before, own) = source
        .split_once("[[hints]]\nlevel")
        .expect("it has hints to be asked for");
    let (_, scoring) = own.split_once("[scoring]").expect("it is scored");
    let source = format!("{before}{clues}[scoring]{scoring}");
    Arc::new(Mission::parse(&source).expect("it is good"))
}

fn ask(flight: &mut Flight) -> (RowState, String) {
    let row = flight.act(EntryId(0), &Deed::Hint, &[1, 2]).remove(0);
    let words = row.explanation.map(|text| text.to_string());
    (row.state, words.unwrap_or_default())
}

#[test]
fn hints_come_one_by_one_and_cost_from_the_second_try_on() {
    for (attempt, factor) in [(1, 1.0), (2, 0.93)] {
        let mut flight = Flight::new(with_clues(), 1);
        flight.set_attempt(attempt);
        assert!(ask(&mut flight).1.contains("Look at the wind."));
        assert!(ask(&mut flight).1.contains("Fly A1 next."));
        assert_eq!(ask(&mut flight).0, RowState::Refused);
        assert_eq!(flight.progress().clues.next, None);
        let report = flight.report(&Ledger::new());
        assert_eq!(
            report.hints.len(),
            2,
            "two vehicles asked, one hint each time"
        );
        assert!((report.hint_factor - factor).abs() < 1e-9);
        assert_eq!(flight.progress().clues.given.len(), 2);
    }
}

#[test]
fn a_prediction_is_compared_with_what_came() {
    let mut pilot = Pilot::new(1);
    let deed = Deed::Predict { points: 400 };
    drop(pilot.flight.act(EntryId(0), &deed, &[1]));
    let prediction = pilot.report().prediction.expect("it was given");
    let score = i32::from(pilot.report().score);
    assert_eq!((prediction.predicted, prediction.error), (400, score - 400));
}

#[test]
fn a_goal_is_reached_by_a_flight_that_passes_only() {
    let seconds = Duration::from_secs;
    for (goal, reached) in [
        (Goal::Time(seconds(470)), true),
        (Goal::Time(seconds(20)), false),
        (Goal::Battery(25.0), true),
        (Goal::Battery(99.0), false),
        (Goal::Safety, true),
        (Goal::Commands, true),
        (Goal::Attention, true),
        (Goal::Score(500), true),
        (Goal::Score(1000), false),
    ] {
        let mut pilot = fly_the_cells(1);
        pilot.flight.pledge.goal = Some(goal);
        let report = pilot.report().goal.expect("it was set");
        assert_eq!(report.reached, reached, "{goal:?}: {}", report.result);
        let mut idle = Pilot::new(1);
        idle.flight.pledge.goal = Some(goal);
        idle.flight.abandon();
        assert!(!idle.report().goal.expect("it was set").reached);
    }
}

#[test]
fn a_hint_that_is_not_there_is_no_refused_command() {
    let mut pilot = Pilot::new(1);
    for (line, rejected) in [("1 hint", (0, 0)), ("1 arm", (1, 1))] {
        pilot.command(line, RowState::Refused);
        pilot.tick();
        let events = pilot.report().events;
        let told = events.iter().filter(|event| event.kind == "rejected");
        let found = (pilot.flight.tally.rejected, told.count());
        assert_eq!(found, rejected, "{line}");
    }
}
