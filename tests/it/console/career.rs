//! The missions that a career allows, and the ways to fly them: for credits, daily, as an exam, for practice.

use std::time::Duration;

use sortie::app::effect::{Effect, Launch, SessionEffect};
use sortie::app::event::{CareerEvent, Event, SessionEvent};
use sortie::app::room::home;
use sortie::app::state::{Activity, Career, Overlay, Room};
use sortie::campaign::Stake;
use sortie::workshop::Design;

use crate::fixtures;
use crate::fixtures::career::{TODAY, campaign, career, flight, newcomer, nobody, trained_by};
use crate::harness::Console;

mod profiles;
mod progress;

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
    let newcomers: [fn() -> Console; 2] = [nobody, || trained_by(newcomer())];
    for start in newcomers {
        let mut console = start();
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
fn quitting_asks_first_if_a_flight_is_not_stored() {
    let mut console = trained_by(newcomer());
    console
        .hear(CareerEvent::AtRisk(1))
        .press(":")
        .write("quit")
        .press("enter");
    assert!(console.effects.is_empty());
    let screen = console.screen(100, 30);
    assert!(
        screen.contains("one flight is not stored yet, and would be lost"),
        "{screen}"
    );
    console.press("y");
    assert_eq!(console.effects, [Effect::Quit]);
    let mut console = trained_by(newcomer());
    console
        .hear(CareerEvent::AtRisk(1))
        .hear(CareerEvent::AtRisk(0));
    console.press(":").write("quit").press("enter");
    assert_eq!(console.effects, [Effect::Quit]);
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
