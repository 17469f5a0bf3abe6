//! A mission whose brief is held until the desk starts it.

use sortie::app::effect::SessionEffect;
use sortie::app::event::ClassEvent;
use sortie::app::state::Room;
use sortie::campaign::Stake;
use sortie::class::{Deed, Happening, Outcome, Stage};

use super::{joined, journal, order, outcomes, pass, quiet, session_effects, start};
use crate::fixtures;
use crate::harness::Console;

/// The order to open a mission.
pub fn fly(mission: &str, hold: bool) -> Deed {
    Deed::Fly {
        mission: mission.into(),
        exam: false,
        hold,
    }
}

/// A seat that reads the brief of a mission which the desk has opened.
fn reading(hold: bool) -> Console {
    let mut console = joined();
    order(&mut console, 1, fly("m01", hold));
    start(&mut console, "m01", Stake::Graded);
    console.vehicle(fixtures::airborne(1, 30.0, 20.0));
    console
}

pub fn is_reading(console: &Console) -> bool {
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
    order(&mut console, 1, fly("m02", true));
    start(&mut console, "m01", Stake::Graded);
    console.press("enter");
    assert!(!is_reading(&console));
}

/// `class end` was once refused while the brief was held, without a word about what to do.
#[test]
fn the_end_of_a_brief_leaves_it_without_a_score() {
    for hold in [true, false] {
        let mut console = reading(hold);
        order(&mut console, 2, Deed::End);
        assert_eq!(session_effects(&console), [&SessionEffect::Leave]);
        assert_eq!(outcomes(&console).last(), Some(&(2, Outcome::Done)));
        assert_eq!(console.state().room(), Room::Home);
        let is_end = |what: &Happening| matches!(what, Happening::Ended { .. });
        assert!(!journal(&console).iter().any(is_end));
        let notices = console.state().notices().lines();
        let told = notices.last().expect("a notice").notice.text.to_string();
        assert_eq!(told, "petro has ended the mission");
    }
}
