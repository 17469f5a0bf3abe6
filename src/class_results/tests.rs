//! Trainees with flights of two missions.

use super::*;
use crate::campaign::{Evidence, Offer, Stake};
use crate::class::Witness;
use crate::exam_seal::{Seal, SealFault, TryReason};
use crate::scoring::FlownBy;

const MISSIONS: [&str; 2] = [
    include_str!("../../missions/00-first-flight.toml"),
    include_str!("../../missions/01-air-sample.toml"),
];

fn course() -> MissionCourse {
    let missions = MISSIONS.map(|source| Mission::parse(source).expect("it is good"));
    MissionCourse::new(missions.iter().map(Offer::of).collect::<Vec<_>>())
}

/// The share of its points that a flight reached of each objective.
fn flight(record: &str, mission: &str, score: u16, shares: &[f64]) -> ClassFlight {
    let objectives = shares
        .iter()
        .enumerate()
        .map(|(index, share)| FlownObjective {
            skill: Some(Skill::K3),
            result: ObjectiveReport {
                id: format!("o{index}"),
                title: format!("objective {index}").into(),
                mandatory: true,
                met: *share >= 1.0,
                result: Text::default(),
                target: Text::default(),
                points: share * 50.0,
                points_max: 50.0,
            },
        });
    ClassFlight {
        instructor: InstructorPart::default(),
        seal: None,
        record: record.to_owned(),
        when: "2026-11-20T14:03:22Z".to_owned(),
        profile: None,
        title: mission.into(),
        revision: 1,
        mission_file: None,
        seed: 1,
        sim_time_s: 100.0,
        has_own_fleet: false,
        has_pause: false,
        has_end: true,
        objectives: objectives.collect(),
        flight: CareerFlight {
            mission: mission.to_owned(),
            drill_of: None,
            tier: 0,
            reward: 0,
            vehicles: 1,
            stake: Stake::Graded,
            flown_by: Some(FlownBy::Hand),
            day: 20_000,
            score,
            passed: shares.iter().all(|share| *share >= 1.0),
            medal: None,
            evidence: vec![Evidence {
                skill: Skill::K3,
                outcome: f64::from(score) / 1000.0,
                basis: None,
                what: Text::default(),
            }],
            wear: 0,
            imported: false,
        },
    }
}

fn class() -> Vec<ClassTrainee> {
    let mut trainees = Vec::new();
    let flights = [
        ("bohdan", flight("b1", "00-first-flight", 300, &[1.0, 0.0])),
        ("anna", flight("a1", "00-first-flight", 500, &[1.0, 0.5])),
        ("anna", flight("a2", "00-first-flight", 900, &[1.0, 1.0])),
        ("anna", flight("a3", "01-air-sample", 400, &[0.2])),
    ];
    for (user, flight) in flights {
        add_flight(&mut trainees, user, flight);
    }
    trainees
}

#[test]
fn each_trainee_has_the_best_score_and_the_tries_of_each_mission() {
    let results = ClassResults::of(&course(), &class(), 20_000);
    let users: Vec<&str> = results.trainees.iter().map(|it| it.user.as_str()).collect();
    assert_eq!(users, ["anna", "bohdan"]);
    let first = results.trainees[0].mission("00-first-flight");
    let first = first.expect("anna has tried it");
    assert_eq!(
        (first.best, first.tries, first.is_passed()),
        (Some(900), 2, true)
    );
    let other = results.trainees[1].mission("00-first-flight");
    let other = other.expect("bohdan has tried it");
    assert_eq!(
        (other.best, other.tries, other.is_passed()),
        (Some(300), 1, false)
    );
    assert!(results.trainees[1].mission("01-air-sample").is_none());
    assert!(results.trainees[1].skill(Skill::K3).is_some());
    assert!(
        results.trainees[1].skill(Skill::K1).is_none(),
        "never shown"
    );
}

/// A seal that says that its try counts.
fn seal() -> Seal {
    let moment = "2026-11-20T14:03:22Z".to_owned();
    Seal {
        sortie_seal: 1,
        class: "9-A".to_owned(),
        exam: "final".to_owned(),
        exam_sha256: String::new(),
        begun: moment.clone(),
        user: "anna".to_owned(),
        mission: "00-first-flight".to_owned(),
        number: 1,
        tries: 1,
        openings: 1,
        seed: 1,
        record: "a2".to_owned(),
        files: Vec::new(),
        score: 900,
        passed: true,
        opened: None,
        until: moment.clone(),
        ended: None,
        handed_in: moment,
        witness: Witness::Whole { heads: 1 },
        reasons: Vec::new(),
        public_key: String::new(),
    }
}

#[test]
fn a_try_of_an_exam_counts_only_with_a_valid_seal_of_the_expected_key() {
    let check = |fault, is_known_key, reasons| SealCheck {
        seal: Some(Seal { reasons, ..seal() }),
        fingerprint: None,
        is_known_key,
        fault,
    };
    let best = |seal| {
        let mut trainees = Vec::new();
        let tried = flight("a1", "00-first-flight", 500, &[1.0, 0.5]);
        let sealed = ClassFlight {
            seal: Some(seal),
            ..flight("a2", "00-first-flight", 900, &[1.0, 1.0])
        };
        add_flight(&mut trainees, "anna", tried);
        add_flight(&mut trainees, "anna", sealed);
        // The exports have the best flights.
        let best = trainees[0].best_flights()[0].record.clone();
        let results = ClassResults::of(&course(), &trainees, 20_000);
        let anna = &results.trainees[0];
        assert_eq!(anna.tries + anna.practice, 2);
        (best, anna.tries)
    };
    let (first, sealed) = (("a1".to_owned(), 1), ("a2".to_owned(), 2));
    assert_eq!(best(check(None, Some(true), Vec::new())), sealed);
    assert_eq!(best(SealCheck::missing()), first);
    let changed = Some(SealFault::Signature);
    assert_eq!(best(check(changed, Some(true), Vec::new())), first);
    assert_eq!(best(check(None, None, Vec::new())), first, "not compared");
    let late = vec![TryReason::Late];
    assert_eq!(best(check(None, Some(true), late)), first);
}

#[test]
fn what_the_class_knows_least_is_first() {
    let results = ClassResults::of(&course(), &class(), 20_000);
    let known: Vec<(&str, &str, usize, usize, f64)> = results
        .objectives
        .iter()
        .map(|it| {
            (
                it.mission.as_str(),
                it.objective.as_str(),
                it.met,
                it.trainees,
                it.mean_percent,
            )
        })
        .collect();
    assert_eq!(
        known,
        [
            ("01-air-sample", "o0", 0, 1, 20.0),
            // Of anna, only the best flight counts.
            ("00-first-flight", "o1", 1, 2, 50.0),
            ("00-first-flight", "o0", 2, 2, 100.0),
        ]
    );
}

#[test]
fn the_scores_of_a_mission_are_spread_over_the_trainees() {
    let results = ClassResults::of(&course(), &class(), 20_000);
    let first = &results.missions[0];
    assert_eq!((first.trainees, first.passed, first.tries), (2, 1, 3));
    let scores = first.scores;
    assert_eq!(
        (scores.least, scores.median, scores.most),
        (300.0, 600.0, 900.0)
    );
    assert_eq!(Spread::of(Vec::new()), None);
    let four = Spread::of(vec![4.0, 1.0, 3.0, 2.0]).expect("figures");
    assert_eq!(
        (four.lower_quartile, four.median, four.upper_quartile),
        (1.8, 2.5, 3.3)
    );
}

#[test]
fn practice_is_counted_but_is_no_result() {
    let mut trainees = class();
    let mut practice = flight("b2", "00-first-flight", 1000, &[1.0, 1.0]);
    practice.flight.stake = Stake::Practice;
    add_flight(&mut trainees, "bohdan", practice);
    let mut script = flight("b3", "00-first-flight", 1000, &[1.0, 1.0]);
    script.flight.flown_by = Some(FlownBy::Script);
    add_flight(&mut trainees, "bohdan", script);
    let results = ClassResults::of(&course(), &trainees, 20_000);
    assert_eq!(
        (results.trainees[1].tries, results.trainees[1].practice),
        (1, 2)
    );
    assert!((results.missions[0].scores.least - 300.0).abs() < 1e-9);
}

#[test]
fn a_record_counts_once() {
    let mut trainees = class();
    add_flight(
        &mut trainees,
        "bohdan",
        flight("b1", "00-first-flight", 300, &[1.0, 0.0]),
    );
    assert_eq!(trainees[1].flights.len(), 1);
    assert_eq!(
        ClassResults::of(&course(), &[], 20_000),
        ClassResults::default()
    );
}
