use proptest::prelude::*;

use super::fake::{Pilot, do_nothing, fly_the_cells};
use super::*;
use crate::debrief;
use crate::scoring::{Component, EventKind, FlightOutcome, Medal};
use crate::text::Locale;

mod in_flight;

const AIR_SAMPLE: &str = include_str!("../../missions/01-air-sample.toml");

fn air_sample() -> Mission {
    Mission::parse(AIR_SAMPLE).expect("the shipped mission is good")
}

#[test]
fn the_first_mission_has_nine_cells_and_a_pad_with_names() {
    let mission = air_sample();
    let places = mission.places();
    let (north, east) = mission.starts()[0].at.offset_to(places["A1"]);
    assert!(
        (north - 40.0).abs() < 1e-3 && (east + 20.0).abs() < 1e-3,
        "{north} {east}"
    );
    let (north, east) = places["pad"].offset_to(places["C3"]);
    assert!(
        (north - 80.0).abs() < 1e-3 && (east - 20.0).abs() < 1e-3,
        "{north} {east}"
    );
    assert_eq!(places.len(), 12);
}

#[test]
fn flying_all_cells_earns_gold_whatever_the_seed() {
    for seed in 0..20 {
        let report = fly_the_cells(seed).report();
        assert!(
            report.passed,
            "{}",
            debrief::text(&report, &Locale::default())
        );
        assert_eq!(report.medal, Some(Medal::Gold));
        assert!(
            report.score >= 900,
            "{}",
            debrief::text(&report, &Locale::default())
        );
        assert_eq!(report.objectives[0].result, "9/9 cells");
    }
}

#[test]
fn a_good_flight_ends_by_itself_two_seconds_after_the_disarm() {
    let flight = fly_the_cells(1);
    assert_eq!(flight.flight.outcome(), FlightOutcome::Passed);
    let after = flight
        .now
        .saturating_sub(flight.disarmed_at.expect("it landed"));
    assert!((1.9..2.2).contains(&after.as_secs_f64()), "{after:?}");
}

#[test]
fn arming_and_doing_nothing_fails_with_a_low_score() {
    let report = do_nothing().report();
    assert!(!report.passed);
    assert_eq!(report.outcome, FlightOutcome::TimedOut);
    assert_eq!(report.medal, None);
    assert!(
        report.score < 250,
        "{}",
        debrief::text(&report, &Locale::default())
    );
}

#[test]
fn equal_flights_give_equal_bytes_and_other_seeds_other_readings() {
    let json = |seed| serde_json::to_string(&fly_the_cells(seed).report()).expect("plain data");
    assert_eq!(json(7), json(7));
    assert_ne!(json(7), json(8));
}

#[test]
fn a_report_survives_storage() {
    let report = fly_the_cells(3).report();
    let json = serde_json::to_string(&report).expect("plain data");
    let back: Report = serde_json::from_str(&json).expect("our own output");
    let again = serde_json::to_string(&back).expect("plain data");
    assert_eq!(json, again);
    let english = Locale::default();
    assert_eq!(
        debrief::text(&report, &english),
        debrief::text(&back, &english)
    );
    let order = [
        "mission",
        "revision",
        "seed",
        "backend",
        "passed",
        "score",
        "medal",
        "sim_time_s",
        "objectives",
        "components",
        "ledger",
        "events",
    ];
    let places: Vec<_> = order
        .iter()
        .map(|key| json.find(&format!("\"{key}\":")))
        .collect();
    assert!(places.is_sorted() && places[0] == Some(1), "{places:?}");
}

#[test]
fn flying_too_fast_too_low_or_elsewhere_samples_nothing() {
    for (speed, height, north_offset) in [
        (7.0, 20.0, 0.0),
        (3.5, 12.0, 0.0),
        (3.5, 45.0, 0.0),
        (3.5, 20.0, -200.0),
    ] {
        let mut pilot = Pilot::new(1);
        pilot.take_off(height);
        for (north, east) in super::fake::ROUTE {
            pilot.goto(north + north_offset, east, speed);
        }
        let progress = pilot.flight.progress();
        assert!(
            progress.cells.iter().all(|cell| !cell.sampled),
            "{speed} {height} {north_offset}"
        );
    }
}

#[test]
fn motors_stopped_in_the_air_lose_the_vehicle_and_the_mission() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.set_armed(false);
    pilot.tick();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    let report = pilot.report();
    assert!(
        report
            .events
            .iter()
            .any(|event| event.kind == EventKind::Rule && event.text.contains("motors stopped"))
    );
    let safety = report
        .components
        .iter()
        .find(|c| c.component == Component::Safety)
        .expect("it applies");
    assert!((safety.value - 0.4).abs() < 1e-9);
}

/// Each row: a status text in flight, and the broken rule that it shows.
#[test]
fn status_texts_show_failsafes_and_crashes() {
    for (text, rule) in [
        ("Battery 1 is low 10.70V used 341 mAh", Some("battery low")),
        (
            "Battery 1 is critical 9.60V used 554 mAh",
            Some("battery critical"),
        ),
        (
            "SIM Hit ground at 13.6 m/s",
            Some("hit the ground at 13.6 m/s"),
        ),
        (
            "Crash: Disarming: AngErr=154>30",
            Some("Crash: Disarming: AngErr=154>30"),
        ),
        ("GCS Failsafe", Some("GCS Failsafe")),
        ("GCS Failsafe Cleared", None),
        ("SIM Hit ground at 0.499 m/s", None),
        ("EKF3 IMU0 MAG0 in-flight yaw alignment complete", None),
    ] {
        let mut pilot = Pilot::new(1);
        pilot.hear("Battery 1 is low: from before the flight");
        pilot.take_off(20.0);
        pilot.hear(text);
        pilot.wait(1.0);
        let report = pilot.report();
        let rules: Vec<String> = report
            .events
            .iter()
            .filter(|event| event.kind == EventKind::Rule)
            .map(|event| event.text.to_string())
            .collect();
        assert_eq!(rules, Vec::from_iter(rule.map(str::to_owned)), "{text}");
    }
}

#[test]
fn the_end_of_the_time_is_announced_and_final() {
    let mut pilot = do_nothing();
    let report = pilot.report();
    let texts: Vec<String> = report
        .events
        .iter()
        .map(|event| event.text.to_string())
        .collect();
    assert_eq!(texts, ["60 s left", "30 s left", "mission timed out"]);
    pilot.take_off(20.0);
    assert_eq!(pilot.report(), report);
}

#[test]
fn leaving_the_fence_costs_more_the_longer_it_lasts() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.goto(-42.0, 0.0, 2.0);
    pilot.goto(0.0, 0.0, 2.0);
    let report = pilot.report();
    let breaches = report
        .events
        .iter()
        .filter(|event| event.text.contains("outside the fence"))
        .count();
    assert_eq!(breaches, 1, "one breach, however long");
    let safety = report
        .components
        .iter()
        .find(|c| c.component == Component::Safety)
        .expect("it applies");
    assert!((0.77..0.80).contains(&safety.value), "{}", safety.value);
}

#[test]
fn landing_off_the_pad_fails_the_recovery() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.survey();
    pilot.goto(5.0, 0.0, 5.0);
    pilot.land();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    let report = pilot.report();
    assert!(!report.objectives[3].met);
    assert!(
        report.improvements[0].text.contains("Land within 3 m")
            && report.improvements[0].text.contains("you were 5.0 m away"),
        "{:?}",
        report.improvements
    );
}

#[test]
fn advice_names_what_failed_and_nothing_else() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.survey();
    pilot.goto(0.0, 0.0, 10.0);
    pilot.wait(320.0);
    pilot.land();
    let report = pilot.report();
    let advice = report
        .improvements
        .iter()
        .find(|improvement| improvement.text.contains("Come home"));
    let advice = advice.map_or(String::new(), |improvement| improvement.text.to_string());
    assert!(advice.contains("below 25 %: you had 0 %"), "{report:?}");
    assert!(!advice.contains("pad"), "{advice}");
}

#[test]
fn a_flight_can_be_given_up() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    pilot.flight.abandon();
    pilot.tick();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Abandoned);
    let report = pilot.report();
    assert!(report.given_up && report.score == 0);
    let words = debrief::text(&report, &Locale::default());
    assert!(words.contains("given up: no points"), "{words}");
    assert_eq!(
        pilot.flight.progress().objectives[0].state,
        ObjectiveState::Missed
    );
}

#[test]
fn a_flight_that_the_instructor_ends_keeps_its_points() {
    let mut pilot = Pilot::new(1);
    pilot.take_off(20.0);
    let before = pilot.flight.progress().score_so_far.expect("it has begun");
    pilot.flight.stop();
    let report = pilot.report();
    assert_eq!(report.outcome, FlightOutcome::Stopped);
    assert!(!report.passed && !report.given_up);
    assert!(report.score >= before, "{} {before}", report.score);
}

proptest! {
    /// Whatever the telemetry, the mission does not panic, and its values stay within their bounds.
    #[test]
    fn no_telemetry_upsets_a_flight(
        altitude_m in proptest::num::f64::ANY,
        lat_deg in proptest::num::f64::ANY,
        down_m_s in proptest::num::f32::ANY,
        charge in proptest::num::f32::ANY,
        flips in proptest::collection::vec(any::<bool>(), 1..30),
    ) {
        let mut pilot = Pilot::new(1);
        pilot.take_off(3.0);
        for flip in flips {
            pilot.set_armed(flip);
            let vehicle = pilot.vehicle();
            if let Some(global) = &mut vehicle.global {
                global.altitude_m = altitude_m;
                global.at_point.lat_deg = lat_deg;
                global.down_m_s = down_m_s;
            }
            vehicle.batteries[0].consumed_mah = Some(charge);
            pilot.tick();
        }
        let progress = pilot.flight.progress();
        prop_assert!(progress.score_so_far.is_none_or(|score| score <= 1000));
        prop_assert!(progress.readings.iter().all(|reading| reading.value.is_finite()));
        let report = pilot.report();
        prop_assert!(report.energy_wh.is_none_or(f64::is_finite));
        prop_assert!(crate::debrief::text(&report, &Locale::default()).lines().all(|line| line.chars().count() <= 80));
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "\\PC{0,200}") {
        let _ = Mission::parse(&text);
    }

    /// A mission file with a missing or repeated line is either read, or refused with a position.
    #[test]
    fn damaged_files_are_refused_with_a_place(line in 0usize..110, double in any::<bool>()) {
        let mut lines: Vec<&str> = AIR_SAMPLE.lines().collect();
        let line = line % lines.len();
        if double { lines.insert(line, lines[line]); } else { lines.remove(line); }
        let source = lines.join("\n");
        if let Err(faults) = Mission::parse(&source) {
            prop_assert!(!faults.is_empty());
            for fault in faults {
                prop_assert!(fault.span.end <= source.len() + 1);
            }
        }
    }
}

#[test]
fn vehicles_carry_what_the_fleet_does_and_their_own() {
    let fleet = "sensors = [\"s_voc\"]\nloads = { ball = 2, kit = 1 }\n\
        vehicles = [{ sensors = [\"s_pm25\", \"s_voc\"], loads = { ball = 4, kit = 0 } }]";
    let source = AIR_SAMPLE.replace("sensors = [\"s_voc\"]", fleet);
    let mission = Mission::parse(&source).expect("it is good");
    let [fit] = &mission.seats.fits[..] else {
        panic!("one vehicle, one fit: {:?}", mission.seats.fits)
    };
    let sensors: Vec<&str> = fit.sensors.iter().map(|sensor| sensor.id).collect();
    assert_eq!(sensors, ["s_voc", "s_pm25"]);
    let loads: Vec<(ground_truth::Load, u32)> = fit.loads.clone().into_iter().collect();
    assert_eq!(loads, [(ground_truth::Load::Ball, 4)]);
    assert_eq!(mission.seats.sensors, fit.sensors);
}
