//! A mission whose brief is held until the desk starts it, and what the trainee sees of a try.

use sortie::app::event::{ClassEvent, SessionEvent};
use sortie::app::state::{Activity, Room};
use sortie::campaign::Stake;
use sortie::class::protocol::DeskMessage;
use sortie::class::{Deed, ExamTry, Outcome, Stage};

use super::{joined, opened_try, order, outcomes, pass, quiet, start};
use crate::fixtures;
use crate::harness::Console;

/// A seat that reads the brief of a mission which the desk has opened.
fn reading(hold: bool) -> Console {
    let mut console = joined();
    let mission = "m01".into();
    let exam = false;
    order(
        &mut console,
        1,
        Deed::Fly {
            mission,
            exam,
            hold,
        },
    );
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    console.vehicle(fixtures::airborne(1, 30.0, 20.0));
    console
}

fn is_reading(console: &Console) -> bool {
    console.state().session().is_reading()
}

#[test]
fn a_held_brief_is_left_only_when_the_desk_starts_the_mission() {
    let mut console = reading(true);
    assert!(is_reading(&console));
    assert_eq!(console.state().room(), Room::Mission);
    for key in ["enter", "F", "M", "I"] {
        console.press(key);
        assert!(is_reading(&console), "{key}");
    }
    for line in ["1 arm", "all takeoff 20", "restart", "class leave"] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(
            screen.contains("petro starts the mission"),
            "{line} {screen}"
        );
        console.press("esc");
        assert!(is_reading(&console), "{line}");
    }
    order(&mut console, 2, Deed::Start);
    assert!(!is_reading(&console));
    assert_eq!(console.state().room(), Room::Fly);
    assert_eq!(outcomes(&console).last(), Some(&(2, Outcome::Done)));
}

#[test]
fn the_brief_says_that_the_instructor_starts() {
    let mut console = reading(true);
    quiet(&mut console);
    for (columns, rows) in [(120, 40), (80, 24)] {
        let screen = console.screen(columns, rows);
        assert!(screen.contains("petro starts the mission"), "{screen}");
        assert!(!screen.contains("Enter start"), "{screen}");
    }
    let stage = |console: &Console| console.state().seat_report(false).flight.map(|it| it.stage);
    assert_eq!(stage(&console), Some(Stage::Held));
    let mut console = reading(false);
    assert_eq!(stage(&console), Some(Stage::Reading));
    quiet(&mut console);
    assert!(console.screen(120, 40).contains("Enter start"));
    console.press("enter");
    assert!(!is_reading(&console), "others begin themselves");
}

#[test]
fn without_the_desk_the_trainee_starts_and_the_time_does_not_begin_by_itself() {
    let mut console = reading(true);
    console.press("F");
    console.hear(ClassEvent::Lost);
    pass(&mut console, 9);
    assert!(is_reading(&console));
    pass(&mut console, 2);
    assert!(is_reading(&console));
    assert_eq!(console.state().room(), Room::Mission);
    let screen = console.screen(120, 40);
    assert!(screen.contains("you start the mission"), "{screen}");
    console.press("enter");
    assert!(!is_reading(&console));
}

#[test]
fn another_flight_than_the_one_that_the_desk_opens_is_not_held() {
    let mut console = joined();
    let mission = "m02".into();
    let (exam, hold) = (false, true);
    order(
        &mut console,
        1,
        Deed::Fly {
            mission,
            exam,
            hold,
        },
    );
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    console.press("enter");
    assert!(!is_reading(&console));
}

#[test]
fn the_trainee_sees_which_try_it_is_and_the_time_that_is_left() {
    let mut console = joined();
    let opened = ExamTry {
        tries: 2,
        ..opened_try()
    };
    order(&mut console, 1, Deed::Examine(opened));
    start(&mut console, "00-first-flight");
    let screen = console.screen(120, 40);
    assert!(screen.contains("try 1 of 2, 10:00 left"), "{screen}");
    let screen = console.screen(80, 24);
    assert!(screen.contains("10:00 left"), "{screen}");
    console.press("enter");
    console.hear(ClassEvent::Said(DeskMessage::Here));
    pass(&mut console, 30);
    let screen = console.screen(120, 40);
    assert!(screen.contains("try 1 of 2, 09:30 left"), "{screen}");
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    let screen = console.screen(120, 40);
    assert!(!screen.contains("try 1 of 2"), "{screen}");
}

/// A hold for the same mission once kept the trainee in the brief of a try, whose time was running.
#[test]
fn a_try_of_an_exam_is_not_held() {
    let mut console = joined();
    let mission = "00-first-flight".into();
    let (exam, hold) = (false, true);
    order(
        &mut console,
        1,
        Deed::Fly {
            mission,
            exam,
            hold,
        },
    );
    order(&mut console, 2, Deed::Examine(opened_try()));
    start(&mut console, "00-first-flight");
    console.press("enter");
    assert!(!is_reading(&console));
}
