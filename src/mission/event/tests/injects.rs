//! What an instructor triggers, at once or by a condition.

use super::{demanded, pilot, said};
use crate::mission::fake::Pilot;
use crate::mission::{InjectFault, Injected, check_condition};
use crate::scoring::FlightOutcome;

#[test]
fn instructors_may_do_what_the_mission_allows() {
    let allowed = "
        [instructor]\nmay_inject = ['gust', 'person']
        [[events]]\nid = 'own'\nby = 'instructor'\ndo = [{ fail = 'called off' }]";
    let mut pilot = pilot(allowed, 1);
    let names: Vec<String> = pilot
        .flight
        .injects()
        .into_iter()
        .map(|inject| inject.name)
        .collect();
    assert_eq!(names, ["own", "gust", "person"]);
    assert!(pilot.flight.inject("motor_fail").is_err());
    pilot.flight.inject("gust").expect("it is allowed");
    pilot.flight.inject("person").expect("it is allowed");
    pilot.wait(10.0);
    let speeds = demanded(&mut pilot, "SIM_WIND_SPD");
    assert!(
        (speeds.last().expect("it blows") - 10.0).abs() < 0.11,
        "{speeds:?}"
    );
    assert_eq!(pilot.flight.progress().movers.len(), 1);
    pilot.flight.inject("own").expect("it is allowed");
    pilot.wait(1.0);
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    assert!(pilot.flight.inject("gust").is_err());
}

#[test]
fn a_second_gust_within_the_first_leaves_no_wind_behind() {
    let mut pilot = pilot("[instructor]\nmay_inject = ['gust']", 1);
    for _ in 0..2 {
        pilot.flight.inject("gust").expect("it is allowed");
        pilot.wait(10.0);
    }
    pilot.wait(60.0);
    let speeds = demanded(&mut pilot, "SIM_WIND_SPD");
    let most = speeds.iter().copied().fold(0.0, f64::max);
    let last = speeds.last().expect("it blows");
    assert!(
        (most - 17.0).abs() < 0.11 && (last - 3.0).abs() < 0.11,
        "{speeds:?}"
    );
}

#[test]
fn what_an_instructor_injects_is_not_left_to_chance() {
    let event = "[[events]]\nid = 'own'\nby = 'instructor'\np = 0.001\ndo = [{ say = 'now' }]";
    for seed in 0..5 {
        let mut pilot = pilot(event, seed);
        pilot.flight.inject("own").expect("it is the mission's own");
        pilot.wait(1.0);
        assert_eq!(said(&pilot.report(), "now").len(), 1, "seed {seed}");
    }
}

fn injected(pilot: &Pilot) -> Vec<(String, Option<String>)> {
    let injected = pilot.flight.progress().injected.into_iter();
    injected
        .map(|Injected { name, when, .. }| (name, when))
        .collect()
}

#[test]
fn an_inject_is_told_when_it_has_been_carried_out() {
    let mut pilot = pilot("[instructor]\nmay_inject = ['gust']", 1);
    pilot.flight.inject("gust").expect("it is allowed");
    assert_eq!(injected(&pilot), []);
    pilot.wait(0.1);
    assert_eq!(injected(&pilot), [("gust".to_owned(), None)]);
}

#[test]
fn an_inject_names_the_vehicles_that_its_faults_have_hit() {
    let mut pilot = pilot("[instructor]\nmay_inject = ['motor_fail', 'gust']", 1);
    pilot.take_off(20.0);
    for name in ["motor_fail", "gust"] {
        pilot.flight.inject(name).expect("it is allowed");
    }
    pilot.wait(0.1);
    let injected = pilot.flight.progress().injected;
    let hit: Vec<&[u16]> = injected.iter().map(|it| &it.vehicles[..]).collect();
    assert!(matches!(hit[..], [[_], []]), "{hit:?}");
}

#[test]
fn an_armed_inject_comes_once_as_soon_as_its_condition_holds() {
    let allowed = "[instructor]\nmay_inject = ['gust']";
    let mut pilot = pilot(allowed, 1);
    let when = "vehicle(1).z > 10 and not active('nowhere')";
    let fault = pilot.flight.arm("gust", when);
    assert!(matches!(fault, Err(InjectFault::Condition(_))), "{fault:?}");
    let when = "vehicle(1).z > 10";
    pilot.flight.arm("gust", when).expect("it can be armed");
    pilot
        .flight
        .arm("gust", "t > 100000")
        .expect("it can be armed");
    pilot.wait(5.0);
    assert_eq!(injected(&pilot), []);
    pilot.take_off(20.0);
    pilot.land();
    pilot.take_off(20.0);
    let expected = ("gust".to_owned(), Some(when.to_owned()));
    assert_eq!(injected(&pilot), [expected]);
}

#[test]
fn a_disarmed_inject_never_comes() {
    let mut pilot = pilot("[instructor]\nmay_inject = ['gust', 'person']", 1);
    for name in ["gust", "person"] {
        pilot.flight.arm(name, "t > 5").expect("it can be armed");
    }
    pilot.flight.disarm(Some("gust"));
    pilot.wait(10.0);
    let expected = ("person".to_owned(), Some("t > 5".to_owned()));
    assert_eq!(injected(&pilot), [expected]);
    pilot.flight.arm("gust", "t > 15").expect("it can be armed");
    pilot.flight.disarm(None);
    pilot.wait(10.0);
    assert_eq!(injected(&pilot).len(), 1);
}

#[test]
fn a_condition_may_name_everything_that_the_mission_has() {
    let more = "[instructor]\nmay_inject = ['gust']
        [[events]]\nid = 'own'\nby = 'instructor'\ndo = [{ say = 'x' }]";
    let mut pilot = pilot(more, 1);
    let mission = pilot.flight.mission();
    let (objective, hazard) = (&mission.objectives[0].id, &mission.site.hazard_ids[0]);
    let when = format!(
        "met('{objective}') or found('{hazard}') > 0 or fired('own') or clearance('aircraft') < 50"
    );
    pilot.flight.arm("gust", &when).expect(&when);
}

#[test]
fn without_a_mission_a_condition_is_checked_for_all_but_names() {
    for good in [
        "t > 60 and vehicle(9).z > 20",
        "inside('anywhere') > 0 or met(some)",
        "alert_open('critical')",
        "clearance('walker') < 10",
    ] {
        check_condition(good).expect(good);
    }
    let long = "t > 1 and ".repeat(500);
    for bad in [
        "",
        "t >",
        "alt > 20",
        "t",
        "alert_open('loud')",
        "speed(1) > 2",
        &long,
    ] {
        assert!(check_condition(bad).is_err(), "{bad}");
    }
}
