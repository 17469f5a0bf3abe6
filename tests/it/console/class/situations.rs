//! Situations that the desk captures and recalls.

use std::time::Duration;

use sortie::app::FlightSnapshot;
use sortie::app::effect::{SessionEffect, SituationEffect};
use sortie::app::event::{ClassEvent, SessionEvent};
use sortie::app::state::{Activity, Overlay};
use sortie::campaign::Stake;
use sortie::class::{CapturedSituation, Deed, FlightReport, OrderId, Outcome, Refusal};
use sortie::text::Language;

use super::desk::{deeds, desk, flight, report};
use super::{flying_mission, joined, order, outcomes, pass, session_effects};
use crate::fixtures;
use crate::harness::Console;

fn capture(name: &str) -> Deed {
    let name = name.into();
    Deed::Capture { name }
}

fn recall(situation: &str) -> Deed {
    let situation = situation.into();
    Deed::Recall { situation }
}

/// Gives an order that the shell carries out.
fn carry_out(console: &mut Console, number: u32, deed: Deed) {
    order(console, number, deed);
    let id = OrderId { desk: 1, number };
    let refusal = None;
    console.hear(ClassEvent::Begun { id, refusal });
}

fn names(console: &Console) -> Vec<String> {
    let flight = console.state().seat_report(false).flight;
    let names = flight.expect("it flies").situations.into_iter();
    names.map(|it| it.name.to_string()).collect()
}

fn slots(console: &Console) -> Vec<usize> {
    let effects = session_effects(console).into_iter();
    let slots = effects.filter_map(|effect| match effect {
        SessionEffect::Situation(
            SituationEffect::Capture { slot, .. } | SituationEffect::Recall { slot, .. },
        ) => Some(*slot),
        _ => None,
    });
    slots.collect()
}

#[test]
fn situations_have_names_and_numbers_and_a_name_is_captured_again() {
    let mut console = flying_mission(Stake::Graded);
    carry_out(&mut console, 1, capture(""));
    carry_out(&mut console, 2, capture("before the turn"));
    carry_out(&mut console, 3, capture("1"));
    assert_eq!(names(&console), ["1", "before the turn"]);
    for (number, wanted, slot) in [(4, "before the turn", 1), (5, "2", 1), (6, "1", 0)] {
        order(&mut console, number, recall(wanted));
        assert_eq!(slots(&console), [slot], "{wanted}");
    }
    order(&mut console, 7, recall("3"));
    let refused = Outcome::Refused(Refusal::NoSituation);
    assert_eq!(outcomes(&console).last(), Some(&(7, refused)));
    for number in 8..16 {
        carry_out(&mut console, number, capture(""));
    }
    order(&mut console, 16, capture(""));
    let refused = Outcome::Refused(Refusal::TooManySituations);
    assert_eq!(outcomes(&console).last(), Some(&(16, refused)));
}

#[test]
fn a_recalled_flight_is_frozen_practice_with_the_vehicles_and_the_ledger_of_that_time() {
    let mut console = flying_mission(Stake::Graded);
    console.give("1 land");
    carry_out(&mut console, 1, capture(""));
    let before = FlightSnapshot::of(console.state());
    pass(&mut console, 3);
    console.give("2 land");
    console.vehicle(fixtures::airborne(1, 90.0, 3.0));
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    order(&mut console, 2, recall("1"));
    console.hear(SessionEvent::Paused(true));
    console.hear(SessionEvent::Recalled(Box::new(before)));
    let id = OrderId { desk: 1, number: 2 };
    let refusal = None;
    console.hear(ClassEvent::Begun { id, refusal });
    assert_eq!(outcomes(&console).last(), Some(&(2, Outcome::Done)));
    let session = console.state().session();
    assert_eq!(session.ledger().entries().len(), 1);
    assert!(!session.is_over());
    assert!(matches!(
        session.activity(),
        Some(Activity::Mission {
            stake: Stake::Practice,
            ..
        })
    ));
    let screen = console.screen(120, 40);
    assert!(screen.contains("FROZEN"), "{screen}");
    console.press("p");
    assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
}

#[test]
fn what_cannot_be_captured_is_refused_with_the_reason() {
    let refused = |console: &mut Console, deed: Deed| {
        order(console, 1, deed);
        match outcomes(console).as_slice() {
            [(1, Outcome::Refused(refusal))] => *refusal,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(&mut joined(), capture("")), Refusal::NotFlying);
    let mut exam = flying_mission(Stake::Exam);
    assert_eq!(refused(&mut exam, capture("")), Refusal::Exam);
    let mut exam = flying_mission(Stake::Exam);
    assert_eq!(refused(&mut exam, recall("1")), Refusal::Exam);
    let mut connected = joined();
    let addresses = vec!["udpin:0.0.0.0:14550".to_owned()];
    connected.start(Activity::Connected { addresses });
    assert_eq!(refused(&mut connected, capture("")), Refusal::CannotFreeze);
}

/// A flight with an unnamed situation and a named one.
fn with_situations() -> FlightReport {
    let captured = |name: &str, is_named, clock_s| CapturedSituation {
        name: name.into(),
        is_named,
        clock_s,
    };
    FlightReport {
        situations: vec![
            captured("1", false, 60.0),
            captured("before the turn", true, 189.5),
        ],
        ..flight(5.0)
    }
}

/// `R` once threw away what was flown without a question.
#[test]
fn a_recall_is_asked_about_with_what_it_throws_away() {
    let mut console = desk(Language::English);
    for (connection, user) in [(1, "anna"), (2, "bohdan")] {
        report(&mut console, connection, user, with_situations());
    }
    console.give("class recall @all 2");
    let none: [(String, Deed); 0] = [];
    assert_eq!(deeds(&console), none);
    let Some(Overlay::Confirm(asked)) = console.state().overlay() else {
        panic!("nothing is asked");
    };
    assert_eq!(asked.question().to_string(), "RECALL “2” for anna, bohdan");
    let reason = asked.reason().to_string();
    let lost = "anna goes back to 03:09: the last 01:22 of the flight will be lost";
    assert!(reason.contains(lost), "{reason}");
    console.press("y");
    assert_eq!(deeds(&console).len(), 3);
    // A seat without the situation refuses, and loses nothing.
    console.give("class recall @vira 2");
    assert_eq!(deeds(&console).len(), 4);
}

/// Only the journal once knew that the instructor took part; and times of the flight that was left behind were once
/// later than the end.
#[test]
fn the_debrief_says_what_the_instructor_did() {
    let mut console = flying_mission(Stake::Graded);
    let at = |console: &mut Console, seconds| {
        let mut progress = fixtures::progress();
        progress.elapsed = Duration::from_secs(seconds);
        console.hear(SessionEvent::Mission(Box::new(progress)));
    };
    at(&mut console, 50);
    let vehicles = vec![1, 2];
    order(&mut console, 1, Deed::TakeOver { vehicles });
    at(&mut console, 60);
    carry_out(&mut console, 2, capture("the turn"));
    let before = FlightSnapshot::of(console.state());
    at(&mut console, 80);
    let vehicles = vec![2];
    order(&mut console, 3, Deed::HandBack { vehicles });
    let vehicles = vec![3];
    order(&mut console, 4, Deed::TakeOver { vehicles });
    at(&mut console, 90);
    order(&mut console, 5, recall("1"));
    console.hear(SessionEvent::Paused(true));
    console.hear(SessionEvent::Recalled(Box::new(before)));
    let (id, refusal) = (OrderId { desk: 1, number: 5 }, None);
    console.hear(ClassEvent::Begun { id, refusal });
    at(&mut console, 65);
    let vehicles = Vec::new();
    order(&mut console, 6, Deed::HandBack { vehicles });
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    pass(&mut console, 2);
    let debrief = console
        .state()
        .rooms()
        .debrief()
        .shown()
        .expect("a debrief");
    let told = debrief.report().instructor.acts().iter();
    let told: Vec<String> = told.map(|act| act.text().to_string()).collect();
    let expected = [
        "petro flew 2 from 00:50 to 01:00",
        "petro flew 1 from 00:50 to 01:05",
        "petro returned to the situation “the turn”: the flight continued from 01:00",
        "petro flew 3 from 01:00 to 01:05",
    ];
    assert_eq!(told, expected);
    let screen = console.screen(120, 60);
    for line in expected {
        assert!(screen.contains(line), "{screen}");
    }
}

#[test]
fn the_desk_lists_the_situations_of_a_seat() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", with_situations());
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("situations: 1 01:00, 2 before the turn 03:09"),
        "{screen}"
    );
    console.press("C").press("enter");
    console.press("R").write("before the turn").press("enter");
    console.press("y");
    console.give("class capture @anna low battery");
    let expected = [
        capture(""),
        recall("before the turn"),
        capture("low battery"),
    ];
    assert_eq!(
        deeds(&console),
        expected.map(|deed| ("anna".to_owned(), deed))
    );
}
