//! Outcomes in the ledger.

use std::sync::Arc;

use super::*;
use crate::geo::maths;
use crate::vehicle::GlobalPosition;

#[test]
fn who_does_not_fly_is_refused_with_the_reason() {
    let mut stage = Stage::new(2, 10.0);
    stage.run(20.0);
    stage.say("all survey lane");
    let rows = stage.rows("survey");
    assert!(
        rows.iter().all(|(_, state, _)| *state == RowState::Refused),
        "{rows:?}"
    );
    assert!(rows[0].2.contains("GUIDED"), "{rows:?}");
    assert!(!stage.conductor.has(1));
}

#[test]
fn a_formation_nearer_than_the_separation_is_refused_with_the_figure() {
    let mut stage = Stage::flying(2, 10.0);
    stage.say("all formation line spacing 4");
    let rows = stage.rows("formation");
    assert_eq!(rows[0].1, RowState::Refused);
    assert!(
        rows[0].2.contains("4.0 m") && rows[0].2.contains("6.0 m"),
        "{rows:?}"
    );
}

#[test]
fn another_movement_takes_a_vehicle_out_and_the_others_close_up() {
    let mut stage = Stage::flying(4, 10.0);
    stage.say("all formation column spacing 12");
    assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
    stage.say("2 goto by e 60");
    assert!(!stage.conductor.has(2));
    assert!(stage.conductor.has(1) && stage.conductor.has(4));
    stage.run(60.0);
    let tail = (3..=4).map(|id| stage.distance(1, id)).fold(0.0, f64::max);
    assert!((tail - 24.0).abs() < 2.5, "{tail}");
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
    stage.say("all formation off");
    let rows = stage.rows("formation off");
    assert_eq!(rows[0].1, RowState::Done);
    assert_eq!(rows[1].1, RowState::Refused, "2 is in none: {rows:?}");
    assert!(!stage.conductor.has(1));
}

/// A stop that waits for the next step must not end a movement of the same step.
#[test]
fn a_movement_right_after_the_end_of_a_formation_wins() {
    let mut stage = Stage::flying(2, 10.0);
    stage.say("all formation column spacing 12");
    assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
    stage.say("all formation off");
    stage.say("all altitude 25");
    assert!(stage.watch(60.0, |stage| stage.is_done("altitude")));
    let rows = stage.rows("altitude");
    assert!(rows.iter().all(|row| row.1 == RowState::Done), "{rows:?}");
}

#[test]
fn a_vehicle_without_a_line_of_a_survey_is_not_reported_as_having_flown_one() {
    let mut stage = Stage::flying(3, 8.0);
    stage.say("1-3 survey lane spacing 100 course 0");
    let rows = stage.rows("survey");
    let without = rows.iter().filter(|row| row.1 == RowState::NoEffect);
    let reasons: Vec<&str> = without.map(|row| row.2.as_str()).collect();
    assert!(!reasons.is_empty(), "{rows:?}");
    assert!(
        reasons
            .iter()
            .all(|it| it.starts_with("no line left for it")),
        "{reasons:?}"
    );
}

#[test]
fn a_hold_ends_a_survey_where_it_is() {
    let mut stage = Stage::flying(2, 10.0);
    stage.say("all survey lane spacing 12");
    stage.run(20.0);
    stage.say("all hold");
    let rows = stage.rows("survey");
    assert!(
        rows.iter()
            .all(|(_, state, why)| { *state == RowState::Superseded && why.contains("hold") }),
        "{rows:?}"
    );
    stage.run(6.0);
    let before = stage.place(1);
    stage.run(4.0);
    let after = stage.place(1);
    assert!(maths::hypot(before[0] - after[0], before[1] - after[1]) < 0.5);
    assert!(stage.conductor.paths().is_empty());
}

#[test]
fn somebody_in_the_way_is_waited_for() {
    let mut stage = Stage::flying(2, 20.0);
    // Measured from the vehicle's own origin, which is 20 m to the east.
    stage.say("2 goto n 60 e -20");
    stage.run(20.0);
    stage.say("1 survey n 0 e -2 to n 120 e 2 spacing 10 up 20 course 0");
    stage.run(30.0);
    // A line has no detour, so the vehicle in the way must leave.
    assert!(
        stage
            .notices
            .iter()
            .any(|said| said.contains("until 2 has cleared the way")),
        "{:?}",
        stage.notices
    );
    assert!(stage.nearest_m >= 5.0, "{}", stage.nearest_m);
    stage.say("2 goto n 60 e 40");
    assert!(
        stage.watch(90.0, |stage| stage.is_done("survey")),
        "{:?}",
        stage.rows("survey")
    );
}

#[test]
fn a_wait_for_arrival_waits_for_the_survey() {
    use crate::language::{Findings, Pilot, Script, Seen};
    let mut stage = Stage::flying(2, 10.0);
    stage.say("all survey n 20 e 0 to n 60 e 40 spacing 20");
    let context = Context {
        vehicles: &[1, 2],
        ..Context::default()
    };
    let script = Script::parse("wait all arrived timeout 5min", &context).expect("good");
    let mut pilot = Pilot::new(script);
    let over = stage.watch(200.0, |stage| {
        let seen = Seen {
            vehicles: &stage.vehicles,
            ledger: &stage.ledger,
            findings: &Findings::default(),
        };
        pilot.step(stage.now(), seen).len() == 1
    });
    assert!(
        over && stage.is_done("survey"),
        "{:?}",
        stage.rows("survey")
    );
}

#[test]
fn who_falls_out_where_the_others_find_no_safe_way_ends_it_for_all() {
    let mut stage = Stage::flying(3, 10.0);
    stage.say("all formation column spacing 12");
    assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
    let mut vehicles = stage.vehicles.clone();
    let above = vehicles[&1].global.expect("it flies");
    // Below its leader it can neither rise past it nor stay.
    let below = GlobalPosition {
        altitude_m: above.altitude_m - 8.0,
        ..above
    };
    Arc::make_mut(vehicles.get_mut(&2).expect("it flies")).global = Some(below);
    let third = Arc::make_mut(vehicles.get_mut(&3).expect("it flies"));
    let heartbeat = &mut third.heartbeat;
    heartbeat.as_mut().expect("it is heard").mode.number = 5;
    let turn = stage.conductor.step(ConductorScene {
        now: stage.now(),
        vehicles: &vehicles,
        pilots: &stage.pilots,
    });
    let why = |id: VehicleId| {
        let row = turn.rows.iter().find(|row| row.vehicle == id);
        row.and_then(|row| row.explanation.as_ref().map(ToString::to_string))
    };
    assert!(why(3).is_some_and(|why| why.contains("LOITER")));
    for id in 1..=2 {
        assert_eq!(why(id), Some(text!("swarm-no-way").to_string()));
        assert!(!stage.conductor.has(id));
    }
}

#[test]
fn vehicles_sent_to_one_place_at_one_height_are_warned_of() {
    let mut stage = Stage::flying(3, 10.0);
    let goal = HOME.moved(60.0, 0.0);
    let there = format!("goto {:.6} {:.6}", goal.lat_deg, goal.lon_deg);
    let warned = |stage: &mut Stage, line: &str| {
        stage.notices.clear();
        stage.say(line);
        stage.run(0.5);
        stage.notices.join("\n")
    };
    let said = warned(&mut stage, &format!("all {there} up 20"));
    assert!(said.contains("1-3 fly to one place"), "{said}");
    // Each has an origin of its own, and one that flies higher passes above.
    for apart in ["all goto n 30 e 0 up 20", "all goto by n 10 e 0 up 0"] {
        assert_eq!(warned(&mut stage, apart), "", "{apart}");
    }
    stage.say("2 altitude 30");
    stage.run(20.0);
    let said = warned(&mut stage, &format!("all {there}"));
    assert!(said.contains("1,3 fly to one place"), "{said}");
    assert_eq!(warned(&mut stage, &format!("1-2 {there}")), "");
    // A formation moves as one.
    stage.say("all formation line spacing 12");
    assert!(stage.watch(90.0, |stage| stage.is_done("formation")));
    assert_eq!(warned(&mut stage, &format!("all {there}")), "");
}
