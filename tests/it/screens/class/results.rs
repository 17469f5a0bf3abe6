//! The results of a class at the desk.

use std::sync::Arc;

use sortie::app::event::ClassEvent;
use sortie::campaign::{CareerFlight, Evidence, Skill, Stake};
use sortie::class_results::{ClassFlight, ClassResults, ClassTrainee, FlownObjective, add_flight};
use sortie::mission::Mission;
use sortie::record::InstructorPart;
use sortie::scoring::{FlownBy, ObjectiveReport};
use sortie::store;
use sortie::text::{Language, Text};

use crate::console::class::desk;
use crate::harness::Console;

const DAY: i64 = 20_000;
const TITLES: [&str; 4] = [
    "Take off to 20 m",
    "Fly through the gates of the course in their order",
    "Sample 12 cells",
    "Land at home",
];

/// A flight of a mission of the course in which this share of each objective was reached.
fn flight(number: u32, mission: &Mission, shares: &[f64]) -> ClassFlight {
    let all = TITLES.iter().enumerate().zip(shares);
    let objectives = all.map(|((index, title), share)| FlownObjective {
        skill: Some(Skill::K7),
        result: ObjectiveReport {
            id: format!("objective-{index}"),
            title: (*title).into(),
            mandatory: true,
            met: *share >= 1.0,
            result: Text::default(),
            target: Text::default(),
            points: share * 100.0,
            points_max: 100.0,
        },
    });
    let objectives: Vec<FlownObjective> = objectives.collect();
    let passed = objectives.iter().all(|it| it.result.met);
    let score = (shares.iter().sum::<f64>() / shares.len() as f64 * 900.0) as u16;
    let evidence = [Skill::K1, Skill::K3, Skill::K7].map(|skill| Evidence {
        skill,
        outcome: shares[0],
        basis: None,
        what: Text::default(),
    });
    ClassFlight {
        instructor: InstructorPart::default(),
        seal: None,
        record: format!("2026-11-20T14-03-{number:02}Z_{}", mission.id),
        when: "2026-11-20T14:03:22Z".to_owned(),
        profile: None,
        title: mission.title.clone(),
        revision: mission.rev,
        mission_file: None,
        seed: 1,
        sim_time_s: 100.0,
        has_own_fleet: false,
        has_pause: false,
        has_end: true,
        objectives,
        flight: CareerFlight {
            mission: mission.id.clone(),
            drill_of: None,
            tier: 1,
            reward: 100,
            vehicles: 1,
            stake: Stake::Graded,
            flown_by: Some(FlownBy::Hand),
            day: DAY,
            score,
            passed,
            medal: None,
            evidence: evidence.into(),
            wear: 0,
            imported: false,
        },
    }
}

/// Five trainees, of whom some have flown two missions.
fn results() -> ClassResults {
    let missions = ["00", "01"].map(|number| store::mission(number).expect("it is embedded"));
    let mut trainees: Vec<ClassTrainee> = Vec::new();
    for (number, user, mission, shares) in [
        (1, "anna", 0, [1.0, 1.0, 1.0, 1.0]),
        (2, "anna", 1, [1.0, 0.4, 1.0, 0.0]),
        (3, "bohdan", 0, [1.0, 0.5, 0.0, 0.0]),
        (4, "bohdan", 0, [1.0, 1.0, 0.2, 1.0]),
        (5, "olena", 0, [0.5, 0.0, 0.0, 0.0]),
        (6, "taras", 0, [1.0, 1.0, 1.0, 1.0]),
        (7, "taras", 1, [1.0, 1.0, 1.0, 0.3]),
        (8, "vira", 0, [1.0, 1.0, 0.6, 0.5]),
    ] {
        let flight = flight(number, &missions[mission], &shares);
        add_flight(&mut trainees, user, flight);
    }
    ClassResults::of(&store::course(), &trainees, DAY)
}

fn with_results(language: Language) -> Console {
    let mut console = desk(language);
    console.hear(ClassEvent::Results(Arc::new(results())));
    console.press("t");
    console
}

#[test]
fn each_page_shows_a_side_of_the_results() {
    for language in Language::ALL {
        let mut console = with_results(language);
        for page in ["objectives", "missions", "skills", "by_mission", "by_skill"] {
            for (width, height) in [(80, 24), (120, 40)] {
                let name = format!("results_{page}_{}_{width}x{height}", language.code());
                insta::assert_snapshot!(name, console.screen(width, height));
            }
            console.press("t");
        }
    }
}

#[test]
fn arrows_turn_pages_and_escape_shows_the_board_again() {
    let mut console = with_results(Language::English);
    let first = console.screen(80, 24);
    console.press("right");
    assert_ne!(console.screen(80, 24), first);
    console.press("left");
    assert_eq!(console.screen(80, 24), first);
    console.press("esc");
    assert!(console.screen(80, 24).contains("last command"));
}

#[test]
fn without_a_record_the_page_says_when_one_comes() {
    let mut console = desk(Language::English);
    console.press("t");
    assert!(console.screen(80, 24).contains("being read"));
    console.hear(ClassEvent::Results(Arc::default()));
    assert!(console.screen(80, 24).contains("handed in"));
}
