//! What a mission shows while it is flown: its progress, its score so far, and its hints.

use std::sync::Arc;

use super::AIR_SAMPLE;
use crate::mission::fake::{Pilot, do_nothing};
use crate::mission::{Flight, Mission};
use crate::scoring::FlightOutcome;

#[test]
fn in_flight_the_way_home_and_the_battery_are_named() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.goto(12.0, 0.0, 5.0);
    let home = |pilot: &Pilot| pilot.flight.progress().objectives[3].detail.clone();
    assert_eq!(home(&pilot), "12 m from the pad");
    pilot.goto(0.0, 0.0, 5.0);
    assert_eq!(home(&pilot), "not landed yet");
    pilot.wait(270.0);
    pilot.goto(50.0, 0.0, 5.0);
    assert!(home(&pilot).contains(" % left, 25 % needed"));
}

#[test]
fn the_score_begins_with_the_first_takeoff() {
    let mut pilot = Pilot::new(1);
    pilot.wait(5.0);
    assert_eq!(pilot.flight.progress().score_so_far, None);
    pilot.take_off(20.0);
    assert!(pilot.flight.progress().score_so_far.is_some());
    assert!(do_nothing().flight.progress().score_so_far.is_some());
}

#[test]
fn the_score_in_flight_counts_what_is_earned_before_the_landing() {
    let mut pilot = Pilot::new(1);
    let so_far = |pilot: &Pilot| pilot.flight.progress().score_so_far.expect("it has flown");
    pilot.take_off(20.0);
    pilot.survey();
    let surveyed = so_far(&pilot);
    pilot.look_above();
    let hovered = so_far(&pilot);
    assert!(hovered > surveyed, "{surveyed} {hovered}");
    pilot.goto(0.0, 0.0, 10.0);
    pilot.wait(5.0);
    let in_flight = so_far(&pilot);
    pilot.land();
    let landed = pilot.report().score;
    let with_the_landing = landed - in_flight;
    assert!((1..150).contains(&with_the_landing), "{in_flight} {landed}");
    assert_eq!(so_far(&pilot), landed);
}

#[test]
fn a_hint_names_only_what_can_be_filled_in() {
    let with = |text: &str| AIR_SAMPLE.replace("{next_cell}", text);
    let faults = Mission::parse(&with("{nextcell}")).expect_err("an unknown placeholder");
    assert!(faults[0].message.contains("`{next_cell}`"), "{faults:?}");
    assert!(Mission::parse(&with("A1")).is_ok());
}

#[test]
fn hints_follow_the_flight() {
    let mut pilot = Pilot::new(1);
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.unwrap_or_default();
    pilot.tick();
    assert!(hint(&pilot).contains("Arm the drone"));
    pilot.take_off(20.0);
    let said = hint(&pilot);
    assert!(
        said.contains("A1") && !said.contains("faster than"),
        "it is not over the cells: {said}"
    );
    pilot.cross(40.0, 0.0, 9.0);
    assert!(hint(&pilot).contains("faster than"), "{}", hint(&pilot));
    pilot.goto(40.0, -20.0, 5.0);
    pilot.wait(6.0);
    let said = hint(&pilot);
    assert!(
        said.contains("B1") && !said.contains("faster than"),
        "{said}"
    );
    pilot.survey();
    assert!(
        hint(&pilot).contains("above the middle"),
        "{}",
        hint(&pilot)
    );
    pilot.look_above();
    assert!(hint(&pilot).contains("send the drone home"));
}

#[test]
fn before_its_vehicles_are_there_a_mission_counts_none_of_them() {
    for source in [
        include_str!("../../../missions/01-air-sample.toml"),
        include_str!("../../../missions/02-formation.toml"),
    ] {
        let mission = Mission::parse(source).expect("it is good");
        let progress = Flight::new(Arc::new(mission), 1).progress();
        let details = progress.objectives.iter().map(|it| it.detail.to_string());
        let odd: Vec<String> = details.filter(|it| it.contains("0/0")).collect();
        assert!(odd.is_empty(), "{odd:?}");
    }
}

#[test]
fn after_a_failsafe_the_hint_says_what_happened_and_what_is_possible() {
    let mut pilot = Pilot::new(1);
    let hint = |pilot: &Pilot| pilot.flight.progress().hint.unwrap_or_default();
    pilot.take_off(20.0);
    pilot.hear("Battery 1 is low 10.50V used 2900 mAh");
    pilot.tick();
    assert!(hint(&pilot).contains("next one is A1"), "it still flies");
    pilot.land();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Flying);
    let said = hint(&pilot).to_string();
    let expected = "a failsafe has landed vehicle 1 (battery low): take off again";
    assert!(said.starts_with(expected), "{said}");
    pilot.set_armed(true);
    pilot.tick();
    assert!(!hint(&pilot).contains("failsafe"));
}
