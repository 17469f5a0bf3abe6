//! The choice of a profile, and the missions that its career allows.

use std::time::Duration;

use sortie::app::effect::{CareerEffect, Effect, Launch, SessionEffect};
use sortie::app::event::{CareerEvent, Event, SessionEvent};
use sortie::app::room::home;
use sortie::app::state::{Activity, Career, Overlay, Purpose, Room, Trainee};
use sortie::campaign::{Aids, CareerEntry, CareerFlight, MissionCourse, Offer, Skill, Stake};
use sortie::mission::{Mission, Phase, Requires};
use sortie::scoring::TryReport;
use sortie::text::Language;
use sortie::workshop::Design;

use crate::fixtures;
use crate::fixtures::career::{TODAY, campaign, career, flight, newcomer, nobody, trained_by};
use crate::harness::Console;

mod profiles;

fn under_cursor(console: &Console) -> String {
    let shown = home::under_cursor(console.state());
    shown.map_or_else(String::new, |shown| shown.id.clone())
}

fn said(console: &Console) -> String {
    let message = console.state().message();
    message.map_or_else(String::new, |message| message.text.to_string())
}

fn go_to(console: &mut Console, mission: &str) {
    console.press("home");
    for _ in 0..20 {
        if under_cursor(console) == mission {
            return;
        }
        console.press("j");
    }
    panic!("{mission} is not on the home screen");
}

fn in_flight(console: &mut Console) {
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
}

#[test]
fn a_newcomer_flies_the_first_mission_with_the_first_key() {
    for mut console in [nobody(), trained_by(newcomer())] {
        console.press("enter");
        let launch = Launch::graded("00-first-flight");
        assert_eq!(
            console.effects,
            [Effect::Session(SessionEffect::StartMission(launch))]
        );
    }
}

#[test]
fn the_cursor_begins_where_there_is_most_to_learn_and_stays_where_it_was_put() {
    let mut console = nobody();
    let career = career();
    let next = career.next_mission().expect("there is more").to_owned();
    console.hear(CareerEvent::Career(Some(Box::new(career.clone()))));
    assert_eq!(under_cursor(&console), next);
    go_to(&mut console, "00-first-flight");
    // A part was bought, or another console changed the profile: no flight has ended.
    console.hear(CareerEvent::Career(Some(Box::new(career.clone()))));
    assert_eq!(under_cursor(&console), "00-first-flight");
    let mut history = career.history.clone();
    history.push(flight("00-first-flight", 0, 700, &[]));
    let flown = Career {
        day: TODAY,
        ..Career::new("oksana", history, career.course)
    };
    let next = flown.next_mission().expect("there is more").to_owned();
    console.hear(CareerEvent::Career(Some(Box::new(flown))));
    assert_eq!(under_cursor(&console), next);
}

#[test]
fn a_locked_mission_is_not_flown_in_any_way_and_says_why() {
    for key in ["enter", "d", "e", "p"] {
        let mut console = trained_by(newcomer());
        go_to(&mut console, "01-air-sample");
        console.press(key);
        assert!(console.effects.is_empty(), "{key}: {:?}", console.effects);
        assert!(console.state().overlay().is_none(), "{key}");
        assert_eq!(
            said(&console),
            "Air sample is locked: pass First flight",
            "{key}"
        );
    }
}

#[test]
fn an_open_mission_is_flown_for_credits_with_the_seed_of_the_day_as_an_exam_or_for_practice() {
    let start = |stake, seed| {
        let launch = Launch {
            stake,
            seed,
            ..Launch::graded("00-first-flight")
        };
        [Effect::Session(SessionEffect::StartMission(launch))]
    };
    let mut console = trained_by(newcomer());
    console.press("enter");
    assert_eq!(console.effects, start(Stake::Graded, None));
    console.press("d");
    assert_eq!(console.effects, start(Stake::Daily, None));
    console.press("e");
    assert!(console.effects.is_empty(), "the exam is asked for first");
    console.press("y");
    assert_eq!(console.effects, start(Stake::Exam, None));
    console.press("p");
    assert!(console.effects.is_empty(), "the seed is asked for first");
    console.write("x7").press("enter");
    assert!(console.effects.is_empty(), "x7 is no seed");
    console.press("backspace").press("backspace");
    console.write("77").press("enter");
    assert_eq!(console.effects, start(Stake::Practice, Some(77)));
    console.press("p").press("enter");
    assert_eq!(console.effects, start(Stake::Practice, None));
}

fn starter() -> Design {
    let starter = include_str!("../../../designs/starter.toml");
    Design::from_toml(starter).expect("it is good")
}

/// The number of missions for which drones have been chosen.
fn fleets(console: &Console) -> usize {
    let missions = console.state().training().missions().iter();
    missions
        .filter(|mission| !console.state().training().fleet(&mission.id).is_empty())
        .count()
}

/// A trainee who has chosen a design for the mission under the cursor.
fn with_a_fleet(career: Career) -> Console {
    let mut console = Console::set_up(|setup| {
        setup.missions = campaign().0;
        setup.stock = vec![starter()];
    });
    console.hear(CareerEvent::Career(Some(Box::new(career))));
    console.press("W").press("f").press("enter");
    assert_eq!(fleets(&console), 1);
    console
}

#[test]
fn practice_is_flown_with_the_fleet_that_was_chosen() {
    let mut console = with_a_fleet(newcomer());
    console.press("H").press("p").press("enter");
    let [Effect::Session(SessionEffect::StartMission(launch))] = console.effects.as_slice() else {
        panic!("{:?}", console.effects);
    };
    assert_eq!(launch.fleet, [starter()]);
}

#[test]
fn an_enter_after_the_answer_belongs_to_it_for_a_second_on_the_wall() {
    let answered = |wall_ms| {
        let mut console = trained_by(newcomer());
        console.press("e").press("y");
        in_flight(&mut console);
        console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
        // The clock of the session is stopped while the brief is read.
        console.hear(Event::Tick {
            now: Duration::ZERO,
            wall: Duration::from_millis(wall_ms),
        });
        console.press("enter");
        console.state().room()
    };
    assert_eq!(answered(500), Room::Mission);
    assert_eq!(answered(1500), Room::Fly);
}

#[test]
fn nothing_is_said_to_start_while_it_is_asked_whether_it_may() {
    let mut console = Console::new();
    in_flight(&mut console);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("H").press("enter");
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Confirm(_))
    ));
    assert_eq!(said(&console), "");
    console.press("y");
    assert_eq!(said(&console), "starting the mission ...");
}

#[test]
fn leaving_a_flight_that_counts_says_that_it_counts_as_a_try() {
    let reason = |stake| {
        let mut console = Console::new();
        console.start(Activity::Mission {
            id: "m01".to_owned(),
            title: "Air sample at the yard".into(),
            stake,
        });
        console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
        console.give("leave");
        let Some(Overlay::Confirm(question)) = console.state().overlay() else {
            panic!("{stake:?}");
        };
        question.reason().to_string()
    };
    assert!(reason(Stake::Graded).contains("counts as a try"));
    assert!(reason(Stake::Daily).contains("counts as a try"));
    assert!(reason(Stake::Practice).contains("would not count"));
}

#[test]
fn practice_and_scripts_are_no_best_of_a_mission() {
    let one = |score, is_practice| TryReport {
        attempt: 1,
        when: "2026-11-20T14:03:22Z".to_owned(),
        score: Some(score),
        medal: None,
        passed: false,
        seed: 1,
        revision: 1,
        is_practice,
    };
    let mut console = Console::new();
    let best = |console: &Console| {
        console
            .state()
            .training()
            .best_try("m01")
            .and_then(|it| it.score)
    };
    let tries = |tries: Vec<TryReport>| CareerEvent::Tries([("m01".to_owned(), tries)].into());
    console.hear(tries(vec![one(900, true)]));
    assert_eq!(best(&console), None);
    console.hear(tries(vec![one(900, true), one(300, false)]));
    assert_eq!(best(&console), Some(300));
}

#[test]
fn home_says_how_the_exam_went() {
    let exam = |score| {
        let CareerEntry::Flight(flown) = flight("00-first-flight", 0, score, &[]) else {
            panic!("no flight");
        };
        let history = vec![CareerEntry::Flight(CareerFlight {
            stake: Stake::Exam,
            ..flown
        })];
        let mut console = trained_by(Career::new("oksana", history, campaign().1));
        go_to(&mut console, "00-first-flight");
        console.screen(120, 40)
    };
    let (passed, failed) = (exam(800), exam(300));
    assert!(passed.contains("passed, 800 points"), "{passed}");
    assert!(failed.contains("not passed, 300 points"), "{failed}");
}

#[test]
fn an_exam_that_would_end_a_flight_says_so() {
    let mut console = Console::new();
    in_flight(&mut console);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("H").press("e");
    let screen = console.screen(80, 24);
    assert!(screen.contains("mission"), "{screen}");
    let Some(Overlay::Confirm(question)) = console.state().overlay() else {
        panic!("{screen}");
    };
    let reason = question.reason().to_string();
    assert!(
        reason.contains("no hints, no pause") && reason.contains("; "),
        "{reason}"
    );
}

#[test]
fn hints_that_come_by_themselves_fade_and_those_that_are_asked_for_stay() {
    let (_, course) = campaign();
    let offer = course.offer("01-air-sample").expect("it is there").clone();
    let mut progress = fixtures::progress();
    progress.feedback = Some("3 cells".into());
    progress.clues.given = vec![(1, "look at the wind".into())];
    let seen = |aids, skill: f64, phase| {
        let shown = offer.skills.iter();
        let shown: Vec<_> = shown.map(|known| (*known, skill, "cells")).collect();
        let career = Career {
            aids,
            day: TODAY,
            ..Career::new(
                "oksana",
                vec![flight("01-air-sample", 0, 900, &shown); 2],
                course.clone(),
            )
        };
        let mut progress = progress.clone();
        progress.phase = phase;
        career.fade(&offer.id, &mut progress);
        assert_eq!(progress.clues.given.len(), 1, "{aids:?}");
        (progress.hint.is_some(), progress.feedback.is_some())
    };
    // Failed twice: far from known. Met twice: well beyond the first steps.
    for (aids, skill, phase, expected) in [
        (Aids::Full, 1.0, Phase::Ground, (true, true)),
        (Aids::Fading, 0.0, Phase::Ground, (true, true)),
        (Aids::Fading, 1.0, Phase::Ground, (false, true)),
        (Aids::Fading, 1.0, Phase::Air, (false, true)),
        (Aids::Fading, 0.5, Phase::Air, (true, true)),
        (Aids::None, 0.0, Phase::Ground, (false, false)),
    ] {
        assert_eq!(
            seen(aids, skill, phase),
            expected,
            "{aids:?} {skill} {phase:?}"
        );
    }
}

#[test]
fn a_flight_under_way_hears_of_it_in_every_room() {
    let (_, course) = campaign();
    let mut console = nobody();
    let career = Career {
        aids: Aids::None,
        ..Career::new("oksana", Vec::new(), course)
    };
    console.hear(CareerEvent::Career(Some(Box::new(career))));
    in_flight(&mut console);
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    let progress = console.state().session().mission();
    assert_eq!(progress.expect("it is flown").hint, None);
    assert!(console.state().rooms().mission().hints().is_empty());
}

#[test]
fn the_seed_of_the_day_is_told_once_it_was_flown() {
    let mut career = career();
    assert!(!career.flew_daily("00-first-flight"));
    for (days_ago, stake, expected) in [
        (1, Stake::Daily, false),
        (0, Stake::Graded, false),
        (0, Stake::Daily, true),
    ] {
        let CareerEntry::Flight(mut flown) = flight("00-first-flight", days_ago, 700, &[]) else {
            panic!("it is a flight");
        };
        flown.stake = stake;
        career.history.push(CareerEntry::Flight(flown));
        assert_eq!(career.flew_daily("00-first-flight"), expected, "{stake:?}");
        assert!(!career.flew_daily("01-air-sample"));
    }
}

#[test]
fn credits_are_left_as_long_as_the_best_flight_is_not_perfect() {
    let (_, course) = campaign();
    let offer = course
        .offer("00-first-flight")
        .expect("it is there")
        .clone();
    let left = |scores: &[u16]| {
        let flights = scores.iter();
        let flights = flights.map(|score| flight("00-first-flight", 0, *score, &[]));
        Career::new("oksana", flights.collect(), course.clone()).credits_left(&offer)
    };
    assert_eq!(left(&[]), 200);
    assert_eq!(left(&[400]), 200, "not passed");
    assert_eq!(left(&[600, 800, 700]), 40);
    assert_eq!(left(&[1000]), 0);
}

#[test]
fn a_mission_of_ones_own_progress_is_found_on_the_home_screen() {
    let mut console = trained_by(career());
    console.press("T").press("tab").press("j").press("enter");
    assert_eq!(console.state().room(), Room::Home);
    // The second line is the drill: it is flown through its mission.
    assert_eq!(under_cursor(&console), "01-air-sample");
}

#[test]
fn after_a_flight_the_key_for_the_next_mission_flies_what_is_next() {
    let mut console = trained_by(career());
    let career = career();
    let (_, next) = career.next().expect("there is more");
    in_flight(&mut console);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.at(5).press("n");
    assert_eq!(
        console.effects,
        [Effect::Session(SessionEffect::StartMission(
            Launch::graded(next.id.clone())
        ))]
    );
}

/// A career in which only the second drill of the mission 02 can be recommended.
fn due_for_the_second_drill() -> Career {
    let trains = |id: &str, skill, of: Option<&str>| {
        let (_, course) = campaign();
        let offer = course.offer(id).expect("it is in the course").clone();
        Offer {
            skills: vec![skill],
            drill_of: of.map(str::to_owned),
            requires: Requires::default(),
            vehicles: 1,
            ..offer
        }
    };
    let mission = "02-formation";
    let course = MissionCourse::new([
        trains(mission, Skill::K10, None),
        trains("d02-hold-the-line", Skill::K10, Some(mission)),
        trains("d17-give-way", Skill::K8, Some(mission)),
        trains("03-plume-source", Skill::K8, None),
    ]);
    let shown = [(Skill::K10, 1.0, "Kept formation")];
    let flown = [mission, "d02-hold-the-line", "03-plume-source"];
    let history = flown.map(|id| flight(id, 1, 900, &shown));
    Career {
        day: TODAY,
        ..Career::new("oksana", history.into(), course)
    }
}

#[test]
fn the_recommended_drill_is_named_and_flown_though_it_is_not_the_first_of_its_mission() {
    let career = due_for_the_second_drill();
    let (_, next) = career.next().expect("there is more");
    assert_eq!(next.id, "d17-give-way");
    let launch = Launch::graded("d17-give-way");
    let start = [Effect::Session(SessionEffect::StartMission(launch))];
    let mut console = trained_by(career.clone());
    assert_eq!(under_cursor(&console), "02-formation");
    let listing = home::under_cursor(console.state()).expect("a mission");
    let facts = home::facts(console.state(), listing);
    let mut told = facts.iter().map(|fact| fact.what.to_string());
    let is_named = told.any(|what| what.contains("Drill: give way"));
    assert!(is_named, "{facts:?}");
    assert_eq!(console.press("t").effects, start);
    in_flight(&mut console);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.at(5).press("n");
    assert_eq!(console.effects, start);
}

#[test]
fn a_skill_leads_to_the_mission_that_trains_it_or_says_why_there_is_none() {
    let mut console = trained_by(due_for_the_second_drill());
    go_to(&mut console, "00-first-flight");
    console.press("T");
    let to = |console: &mut Console, skill: Skill| {
        console.press("home");
        for _ in 0..Skill::ALL.iter().take_while(|it| **it != skill).count() {
            console.press("j");
        }
        console.press("enter");
    };
    to(&mut console, Skill::K5);
    assert_eq!(console.state().room(), Room::Standing);
    assert!(said(&console).contains("no mission of the course trains"));
    to(&mut console, Skill::K8);
    assert_eq!(console.state().room(), Room::Home);
    assert_eq!(under_cursor(&console), "02-formation");
    console.press("T").press("tab").press("tab");
    let footer = console.screen(80, 24);
    let footer = footer.lines().last().unwrap_or_default();
    assert!(!footer.contains("mission"), "{footer}");
}

#[test]
fn a_drill_is_shown_without_credits() {
    let source = include_str!("../../../missions/drills/d01-slow-line.toml");
    let drill = Mission::parse(source).expect("no faults");
    let course = MissionCourse::new([Offer::of(&drill)]);
    let mut console = Console::set_up(|setup| setup.missions = vec![drill.listing()]);
    let career = Career::new("oksana", Vec::new(), course);
    console.hear(CareerEvent::Career(Some(Box::new(career))));
    let listing = &console.state().training().missions()[0];
    let facts = home::facts(console.state(), listing);
    let told: Vec<String> = facts.iter().map(|fact| fact.what.to_string()).collect();
    assert!(told.contains(&"no credits".to_owned()), "{told:?}");
    assert!(!told.iter().any(|what| what.contains("0 cr")), "{told:?}");
}
