//! What a career has shown: results, credits that are left, hints that fade, and the mission or drill that comes next.

use sortie::campaign::{Aids, CareerEntry, CareerFlight, MissionCourse, Offer, Skill};
use sortie::mission::{Mission, Phase, Requires};
use sortie::scoring::TryReport;

use super::*;

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
    let source = include_str!("../../../../missions/drills/d01-slow-line.toml");
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
