//! Objectives about continuous hazards, flown by the test vehicle.

use crate::commands::{Deed, FindKind, Spot, Subject};
use crate::ledger::RowState;
use crate::mission::fake::{Pilot, given};
use crate::mission::ground_truth::Quantity;
use crate::mission::world::World;
use crate::mission::{Mission, ObjectiveState, Point};
use crate::scoring::FlightOutcome;

const PLUME: &str = include_str!("../../../missions/03-plume-source.toml");
const WATCH: &str = include_str!("../../../missions/08-fire-watch.toml");
const ATTACK: &str = include_str!("../../../missions/09-fire-attack.toml");
const SEARCH: &str = include_str!("../../../missions/05-night-search.toml");
const RADIATION: &str = include_str!("../../../missions/drills/d10-cross-the-peak.toml");

fn mission(file: &str) -> Mission {
    Mission::parse(file).expect("the shipped mission is good")
}

/// The position of the first object of the first hazard.
fn truth(file: &str, seed: u64) -> Point {
    let world = World::new(&mission(file), seed);
    world.objects().next().expect("there is one").1.at
}

fn mark(pilot: &mut Pilot, at: Point) {
    mark_as(pilot, at, FindKind::Leak);
}

fn mark_as(pilot: &mut Pilot, [east_m, north_m]: Point, kind: FindKind) {
    let now = pilot.now;
    let entry = pilot.ledger.open(now, given("1 arm"), &[1]);
    let deed = Deed::Mark {
        subject: Subject::Spot(Spot::Offset { north_m, east_m }),
        kind: Some(kind),
    };
    pilot.flight.act(entry, &deed, &[1]);
}

/// A vehicle that has flown through the plume near its source, and the place of the source.
fn in_the_plume() -> (Pilot, Point) {
    let mut pilot = Pilot::flying(mission(PLUME), 4);
    let [east, north] = truth(PLUME, 4);
    pilot.take_off(12.0);
    pilot.goto(north, east + 10.0, 10.0);
    pilot.wait(3.0);
    (pilot, [east, north])
}

fn fly_home(pilot: &mut Pilot) {
    pilot.goto(0.0, 0.0, 10.0);
    pilot.land();
}

#[test]
fn how_near_a_report_is_comes_out_after_landing_only() {
    let (mut pilot, [east, north]) = in_the_plume();
    mark(&mut pilot, [east + 5.0, north]);
    pilot.wait(1.0);
    let first = pilot.flight.progress().objectives.remove(0);
    assert_eq!(first.state, ObjectiveState::Open);
    assert!(first.fraction.abs() < 1e-9);
    assert_eq!(first.detail, "judged later: 1");
    fly_home(&mut pilot);
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Passed);
    assert_eq!(pilot.report().objectives[0].result, "5.0 m off");
}

#[test]
fn reports_lose_worth_with_distance_and_by_those_that_are_wrong() {
    let score = |offsets_m: &[f64]| {
        let (mut pilot, [east, north]) = in_the_plume();
        for offset_m in offsets_m {
            mark(&mut pilot, [east, north + offset_m]);
        }
        fly_home(&mut pilot);
        let report = pilot.report();
        (report.objectives[0].points, report.passed)
    };
    let (near, middle, far) = (score(&[10.0]), score(&[30.0]), score(&[80.0]));
    assert!((near.0 - 60.0).abs() < 0.1 && (middle.0 - 25.7).abs() < 0.1 && far.0.abs() < 0.1);
    // A wrong report costs half an object; the mission is passed with one for each.
    let corrected = score(&[80.0, 10.0]);
    assert!(
        (corrected.0 - 30.0).abs() < 0.1 && corrected.1,
        "{corrected:?}"
    );
    let grid = score(&[10.0, 30.0, 50.0]);
    assert!(grid.0.abs() < 0.1 && !grid.1, "{grid:?}");
}

#[test]
fn a_wrong_report_that_is_withdrawn_costs_nothing() {
    let (mut pilot, [east, north]) = in_the_plume();
    mark(&mut pilot, [east, north + 40.0]);
    let entry = pilot.ledger.open(pilot.now, given("1 arm"), &[1]);
    let wrong = Spot::Offset {
        north_m: north + 40.0,
        east_m: east,
    };
    let rows = pilot.flight.act(entry, &Deed::Unmark { spot: wrong }, &[1]);
    assert_eq!(rows[0].state, RowState::Done);
    mark(&mut pilot, [east, north]);
    pilot.land();
    assert_eq!(pilot.report().objectives[0].result, "0.0 m off");
}

/// A lucky guess from the pad earns nothing.
#[test]
fn a_report_without_a_measurement_near_it_is_wrong_however_near_it_is() {
    let mut pilot = Pilot::flying(mission(PLUME), 4);
    pilot.take_off(12.0);
    pilot.wait(5.0);
    assert!(
        !pilot.flight.places().contains_key("peak"),
        "noise is no reading"
    );
    mark(&mut pilot, truth(PLUME, 4));
    pilot.land();
    let report = pilot.report();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    assert_eq!(
        report.objectives[0].result,
        "not found, 1 report without a measurement near it"
    );
    assert!(report.objectives[0].points.abs() < 1e-9);
}

/// One report is judged in the same words by both objectives, however far it has to be from the source to count.
#[test]
fn a_report_that_is_too_far_away_for_an_objective_is_shown_with_its_distance() {
    let (mut pilot, [east, north]) = in_the_plume();
    mark(&mut pilot, [east + 17.0, north]);
    fly_home(&mut pilot);
    let objectives = pilot.report().objectives;
    for objective in &objectives[..2] {
        assert_eq!(objective.result, "17.0 m off", "{}", objective.id);
    }
    assert!(objectives[1].points.abs() < 1e-9);
}

#[test]
fn an_objective_that_is_nearly_met_has_not_all_points() {
    let (mut pilot, [east, north]) = in_the_plume();
    mark(&mut pilot, [east, north + 3.03]);
    fly_home(&mut pilot);
    let close = pilot.report().objectives.remove(1);
    assert_eq!(
        (close.met, close.points, close.points_max),
        (false, 14.9, 15.0)
    );
}

/// Guesses earn nothing, even those that are right.
#[test]
fn a_report_of_a_place_where_no_detector_has_found_anything_is_wrong() {
    let mut pilot = Pilot::flying(mission(SEARCH), 4);
    pilot.take_off(30.0);
    mark_as(&mut pilot, truth(SEARCH, 4), FindKind::Person);
    pilot.land();
    pilot.flight.abandon();
    let find = pilot.report().objectives.remove(0);
    assert!(
        find.result.to_string().contains("0/5 found, 1 false"),
        "{}",
        find.result
    );
}

#[test]
fn a_line_left_too_early_keeps_no_flight_open_after_the_landing() {
    let source = include_str!("../../../missions/04-line-inspection.toml");
    let mut pilot = Pilot::flying(mission(source), 1);
    pilot.take_off(18.0);
    pilot.goto(33.0, 0.0, 8.0);
    pilot.wait(5.0);
    mark_as(&mut pilot, [0.0, 40.0], FindKind::Defect);
    fly_home(&mut pilot);
    pilot.wait(25.0);
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    assert!(pilot.now.as_secs() < 200, "{:?}", pilot.now);
}

#[test]
fn in_flight_a_report_is_counted_but_not_judged() {
    let shown = |offset_m: f64| {
        let mut pilot = Pilot::flying(mission(SEARCH), 4);
        let [east, north] = truth(SEARCH, 4);
        pilot.take_off(30.0);
        pilot.goto(north, east, 10.0);
        pilot.wait(10.0);
        mark_as(&mut pilot, [east, north + offset_m], FindKind::Person);
        pilot.wait(1.0);
        let progress = pilot.flight.progress();
        let objective = progress.objectives[0].clone();
        (pilot, objective, progress.score_so_far)
    };
    let (mut pilot, right, score) = shown(1.0);
    assert_eq!(right.state, ObjectiveState::Open);
    assert_eq!(right.detail, "judged later: 1");
    let (_, wrong, score_of_wrong) = shown(30.0);
    assert_eq!(
        (right, score),
        (wrong, score_of_wrong),
        "no telling which is right"
    );
    pilot.land();
    pilot.wait(30.0);
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed, "one of five");
    let result = pilot.report().objectives[0].result.to_string();
    assert!(result.contains("1/5 found, 0 false"), "{result}");
}

#[test]
fn a_flight_ends_when_the_last_report_is_20_s_old_right_or_wrong() {
    let ends_after = |wrong_m: f64| {
        let mut pilot = Pilot::flying(mission(SEARCH), 4);
        let [east, north] = truth(SEARCH, 4);
        pilot.take_off(5.0);
        pilot.land();
        assert_eq!(
            pilot.flight.outcome(),
            FlightOutcome::Flying,
            "nothing has been reported"
        );
        let landed = pilot.now;
        mark_as(&mut pilot, [east + wrong_m, north], FindKind::Person);
        while !pilot.flight.is_over() {
            pilot.tick();
        }
        pilot.now.saturating_sub(landed).as_secs()
    };
    assert_eq!((ends_after(0.0), ends_after(40.0)), (20, 20));
}

/// Only looks before a report count, and whether the report is right plays no role.
#[test]
fn a_place_is_checked_by_a_stop_there_before_the_report() {
    let objective = "[[objectives]]\nid = \"checked\"\ntitle = \"checked\"\nkind = \"checked\"\n\
                     radius = 8\nmax_speed = 1\nheights = [10, 20]\ndwell = 4\nvalue = 1\n[scoring]";
    let file = RADIATION.replacen("[scoring]", objective, 1);
    let shown = |pilot: &mut Pilot| {
        pilot.wait(0.5);
        let objectives = pilot.flight.progress().objectives;
        let found = objectives.iter().find(|it| it.title == "checked");
        found.expect("it is there").detail.to_string()
    };
    let mut pilot = Pilot::flying(mission(&file), 2);
    pilot.take_off(15.0);
    pilot.goto(40.0, 0.0, 8.0);
    mark_as(&mut pilot, [0.0, 40.0], FindKind::Source);
    assert_eq!(shown(&mut pilot), "0/1 reports");
    pilot.wait(5.0);
    assert_eq!(shown(&mut pilot), "0/1 reports", "too late");
    mark_as(&mut pilot, [5.0, 42.0], FindKind::Source);
    assert_eq!(shown(&mut pilot), "1/2 reports");
    pilot.goto(80.0, 0.0, 8.0);
    pilot.goto(40.0, 0.0, 8.0);
    mark_as(&mut pilot, [0.0, 60.0], FindKind::Source);
    assert_eq!(shown(&mut pilot), "1/3 reports", "too fast");
}

/// The first comparison of the map is after 100 s.
#[test]
fn a_map_of_a_fire_is_as_good_as_what_was_seen_of_it_and_how_lately() {
    let fit_after_100_s = |east_m: f64, north_m: f64| {
        let mut pilot = Pilot::flying(mission(WATCH), 3);
        pilot.take_off(60.0);
        pilot.goto(north_m, east_m, 30.0);
        while pilot.now.as_secs() < 102 {
            pilot.tick();
        }
        let result = pilot.report().objectives[0].result.to_string();
        result.parse::<f64>().expect("one figure")
    };
    let [east, north] = truth_of_fire(WATCH, 3);
    let (above, away) = (fit_after_100_s(east, north), fit_after_100_s(90.0, 50.0));
    assert!(above > 0.5, "{above}");
    assert!(away.abs() < 1e-9, "{away}");
}

fn truth_of_fire(file: &str, seed: u64) -> Point {
    let world = World::new(&mission(file), seed);
    let burning = world.objects().find(|(_, object)| object.present);
    burning.expect("it burns").1.at
}

#[test]
fn a_village_that_nobody_cares_for_burns() {
    let mut pilot = Pilot::flying(mission(ATTACK), 1);
    pilot.take_off(10.0);
    while pilot.now.as_secs() < 470 {
        pilot.tick();
    }
    let report = pilot.report();
    assert!(!report.objectives[0].met, "{}", report.objectives[0].result);
    assert_eq!(
        report.objectives[1].result,
        "burnt: 100 % of an unfought fire"
    );
}

#[test]
fn the_dose_is_the_dose_rate_over_time() {
    let world = World::new(&mission(RADIATION), 2);
    let rate = world.amount(Quantity::DoseRate, [0.0, 0.0], 0.0);
    let file = RADIATION.replace("id = \"home\"", "id = \"dose\"").replace(
        "kind = \"recover\"\nradius = 3\nbattery_pct = 25",
        "kind = \"dose\"\nlimit_usv = 1",
    );
    let mut pilot = Pilot::flying(mission(&file), 2);
    pilot.wait(60.0);
    let expected = format!("highest dose {:.2} uSv", rate * 60.0 / 3600.0);
    assert_eq!(pilot.report().objectives[1].result.to_string(), expected);
}

/// A flight of one vehicle that carries a plan, with a fault or without.
fn with_plan(faulty: usize) -> Pilot {
    let board = format!(
        "[board]\nfaulty = {faulty}\nfaults = [\"gap\"]\n\
         plans = [{{ up = 20, places = [[0, 20], [0, 40], [9, 40], [9, 20]] }}]\n[fleet]"
    );
    let objective = |kind: &str| {
        format!(
            "[[objectives]]\nid = \"{kind}\"\ntitle = \"{kind}\"\nvalue = 1\nkind = \"{kind}\"\n"
        )
    };
    let kinds = ["rehearsed", "mended", "kept"].map(objective).concat();
    let source = include_str!("../../../missions/01-air-sample.toml");
    let source = source.replacen("[fleet]", &board, 1).replacen(
        "[scoring]",
        &format!("{kinds}[scoring]"),
        1,
    );
    Pilot::flying(mission(&source), 1)
}

/// Takes off in AUTO; returns whether `rehearsed`, `mended` and `kept` are met.
fn fly_plan(pilot: &mut Pilot) -> [bool; 3] {
    let heartbeat = pilot.vehicle().heartbeat.as_mut().expect("there");
    heartbeat.mode.number = 3;
    pilot.take_off(20.0);
    let objectives = pilot.flight.progress().objectives;
    ["rehearsed", "mended", "kept"].map(|id| {
        let found = objectives
            .iter()
            .find(|it| it.title == id)
            .expect("it is there");
        found.state == ObjectiveState::Met
    })
}

#[test]
fn a_sound_plan_is_kept_and_a_faulty_one_is_mended() {
    let mut pilot = with_plan(0);
    assert_eq!(fly_plan(&mut pilot), [false, true, true], "nothing to mend");
    let mut pilot = with_plan(0);
    pilot.command("1 plan upload a.plan", RowState::Done);
    pilot.wait(1.0);
    pilot.command("1 plan rehearse", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(fly_plan(&mut pilot), [true, true, false]);
    let mut pilot = with_plan(1);
    assert_eq!(
        fly_plan(&mut pilot),
        [false, false, true],
        "nothing to keep"
    );
    // Once the plan has been flown with its fault, a new one comes too late.
    pilot.command("1 plan upload a.plan", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(fly_plan(&mut pilot), [false, false, true]);
    let mut pilot = with_plan(1);
    pilot.command("1 plan upload a.plan", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(fly_plan(&mut pilot), [false, true, true]);
}

/// Before the first flight, the objective counts the rehearsals, and a new plan has to be rehearsed again.
#[test]
fn a_rehearsal_shows_as_progress_before_the_flight() {
    let mut pilot = with_plan(0);
    let shown = |pilot: &Pilot| {
        let objectives = pilot.flight.progress().objectives;
        let found = objectives.iter().find(|it| it.title == "rehearsed");
        found.expect("it is there").detail.to_string()
    };
    pilot.wait(1.0);
    assert_eq!(shown(&pilot), "rehearsed: 0/1");
    pilot.command("1 plan rehearse", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(shown(&pilot), "rehearsed: 1/1");
    pilot.command("1 plan upload a.plan", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(shown(&pilot), "rehearsed: 0/1");
    pilot.command("1 plan rehearse", RowState::Done);
    pilot.wait(1.0);
    assert_eq!(fly_plan(&mut pilot), [true, true, false]);
    assert_eq!(shown(&pilot), "flown: 1");
}

#[test]
fn the_debrief_says_which_plan_had_which_fault() {
    let mut pilot = with_plan(1);
    let shown = |pilot: &Pilot| {
        let objectives = pilot.flight.progress().objectives;
        let found = objectives.iter().find(|it| it.title == "mended");
        found.expect("it is there").detail.to_string()
    };
    fly_plan(&mut pilot);
    assert!(!shown(&pilot).contains("left out"), "{}", shown(&pilot));
    pilot.land();
    pilot.flight.abandon();
    let report = pilot.report();
    let mended = report.objectives.iter().find(|it| it.id == "mended");
    let result = mended.expect("it is there").result.to_string();
    assert_eq!(
        result,
        "flown with a faulty plan: 1; 1: two places left out"
    );
}
