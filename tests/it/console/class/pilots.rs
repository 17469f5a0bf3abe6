//! The instructor takes vehicles over, and hands them back.

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::ClassEvent;
use sortie::app::state::Activity;
use sortie::campaign::Stake;
use sortie::class::protocol::DeskMessage;
use sortie::class::{Deed, FlightReport, Happening, Outcome, Refusal, Stage};
use sortie::ledger::RowState;
use sortie::text::Language;

use super::desk::{deeds, desk, flight, report};
use super::{flying_mission, joined, journal, order, outcomes, pass, quiet};
use crate::fixtures;
use crate::harness::Console;

fn take(vehicles: &[u16]) -> Deed {
    let vehicles = vehicles.to_vec();
    Deed::TakeOver { vehicles }
}

fn give(vehicles: &[u16]) -> Deed {
    let vehicles = vehicles.to_vec();
    Deed::HandBack { vehicles }
}

fn command(line: &str) -> Deed {
    let line = line.into();
    Deed::Command { line }
}

/// The vehicles that somebody else flies.
fn taken(console: &Console) -> Vec<u16> {
    let pilots = console.state().session().pilots();
    (1..=9).filter(|&id| pilots.of(id).is_some()).collect()
}

/// A flight of which the desk flies 3.
pub fn flight_taken() -> FlightReport {
    FlightReport {
        taken: vec![3],
        ..flight(5.0)
    }
}

#[test]
fn the_trainee_sees_who_flies_and_the_order_is_done_at_once() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, take(&[3]));
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    assert_eq!(taken(&console), [3]);
    for (columns, rows) in [(120, 40), (80, 24)] {
        let screen = console.screen(columns, rows);
        assert!(screen.contains("petro"), "{screen}");
    }
    let told = console.state().message().expect("a message");
    assert_eq!(told.text.to_string(), "petro now flies 3");
    order(&mut console, 2, take(&[]));
    assert_eq!(taken(&console), [1, 2, 3, 4]);
    order(&mut console, 3, give(&[1, 2]));
    assert_eq!(taken(&console), [3, 4]);
    order(&mut console, 4, give(&[]));
    assert_eq!(taken(&console), [0_u16; 0]);
    let noted = console.effects.iter().find_map(|effect| match effect {
        Effect::Class(ClassEffect::Note(line)) => Some(line.text().to_string()),
        _ => None,
    });
    assert_eq!(noted.as_deref(), Some("petro has handed back 3-4"));
}

#[test]
fn what_cannot_be_taken_over_is_refused_with_the_reason() {
    let refused = |console: &mut Console, deed: Deed| {
        order(console, 1, deed);
        match outcomes(console).as_slice() {
            [(1, Outcome::Refused(refusal))] => *refusal,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(&mut joined(), take(&[])), Refusal::NotFlying);
    let mut exam = flying_mission(Stake::Exam);
    assert_eq!(refused(&mut exam, take(&[])), Refusal::Exam);
    let flying = || flying_mission(Stake::Graded);
    assert_eq!(refused(&mut flying(), take(&[7])), Refusal::NoVehicle);
    assert_eq!(refused(&mut flying(), give(&[])), Refusal::NotTaken);
    assert_eq!(refused(&mut flying(), command("1 rtl")), Refusal::NotTaken);
}

#[test]
fn vehicles_that_may_be_real_are_taken_over_only_with_the_permission_of_the_seat() {
    let connected = || {
        let mut console = joined();
        let addresses = vec!["udpin:0.0.0.0:14550".to_owned()];
        console.start(Activity::Connected { addresses });
        console.vehicle(fixtures::airborne(1, 30.0, 20.0));
        console
    };
    let mut console = connected();
    order(&mut console, 1, take(&[1]));
    let refused = Outcome::Refused(Refusal::RealVehicle);
    assert_eq!(outcomes(&console), [(1, refused)]);
}

#[test]
fn a_command_of_the_instructor_is_in_the_ledger_under_that_name() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, take(&[2, 3]));
    order(&mut console, 2, command("rtl"));
    let entry = console.state().session().ledger().entries().next_back();
    let said = entry.map(|entry| entry.said().to_string());
    assert_eq!(said.as_deref(), Some("petro: 2-3 rtl"));
    assert_eq!(console.sent_to(), [2, 3]);
    let is_command = |what: &Happening| matches!(what, Happening::Command { .. });
    assert!(!journal(&console).iter().any(is_command));
    pass(&mut console, 5);
    assert_eq!(outcomes(&console)[1..], [(2, Outcome::UnderWay)]);
    console.hear(ClassEvent::Said(DeskMessage::Here));
    pass(&mut console, 8);
    assert_eq!(outcomes(&console).len(), 2, "it is said once");
    console.row(2, RowState::Done, None);
    console.row(3, RowState::Refused, Some("no position"));
    let ended = journal(&console).pop().expect("an entry");
    let Happening::Order { outcome, why, .. } = ended else {
        panic!("{ended:?}");
    };
    assert_eq!(outcome, Outcome::Refused(Refusal::Vehicle));
    assert_eq!(why.expect("a reason").as_str(), "3: no position");
    assert_eq!(
        console
            .state()
            .seat_report(false)
            .flight
            .map(|it| (it.failures, it.stage)),
        Some((0, Stage::Flying)),
        "it is no failure of the trainee"
    );
    let screen = console.screen(120, 40);
    assert!(screen.contains("petro: 2-3 rtl"), "{screen}");

    order(&mut console, 3, command("3 dance"));
    let ended = journal(&console).pop().expect("an entry");
    let Happening::Order {
        outcome: Outcome::Refused(Refusal::Line),
        why: Some(why),
        ..
    } = ended
    else {
        panic!("{ended:?}");
    };
    assert!(why.as_str().contains("dance"), "{why}");
    order(&mut console, 4, command("restart"));
    let refused = Outcome::Refused(Refusal::Line);
    assert_eq!(outcomes(&console).last(), Some(&(4, refused)));
}

#[test]
fn the_sticks_of_a_vehicle_that_is_taken_over_are_released() {
    let mut console = flying_mission(Stake::Practice);
    console.press("down").press("J");
    let cursor = console.state().session().cursor().expect("a vehicle");
    assert!(console.state().overlay().is_some());
    order(&mut console, 1, take(&[cursor]));
    pass(&mut console, 1);
    assert!(console.state().overlay().is_none());
    let is_release = |effect: &Effect| {
        let Effect::Session(SessionEffect::Sticks { vehicle, held }) = effect else {
            return false;
        };
        (*vehicle, *held) == (cursor, None)
    };
    assert!(console.effects.iter().any(is_release));
}

#[test]
fn a_silent_desk_flies_nothing() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, take(&[3]));
    for _ in 0..3 {
        pass(&mut console, 8);
        console.hear(ClassEvent::Said(DeskMessage::Here));
    }
    assert_eq!(taken(&console), [3]);
    console.hear(ClassEvent::Lost);
    pass(&mut console, 9);
    assert_eq!(taken(&console), [3], "the connection may come back");
    pass(&mut console, 1);
    assert_eq!(taken(&console), [0_u16; 0]);
    let mut notices = console.state().notices().lines();
    let told = notices.any(|it| {
        it.notice
            .text
            .to_string()
            .contains("petro no longer flies 3")
    });
    assert!(told);
}

#[test]
fn the_desk_takes_over_hands_back_and_commands() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_taken());
    let screen = console.screen(120, 40);
    assert!(screen.contains("you fly 3"), "{screen}");
    console.press("T").press("enter");
    console.press("G").write("1-2,4").press("enter");
    console.give("class take @anna 3");
    console.give("class say @anna 3 takeoff 20");
    console.give("class say @anna 3 kill");
    let screen = console.screen(120, 40);
    assert!(screen.contains("3 KILL for anna"), "{screen}");
    console.press("esc");
    let expected = [
        take(&[]),
        give(&[1, 2, 4]),
        take(&[3]),
        command("3 takeoff 20"),
    ];
    let anna = |deed| ("anna".to_owned(), deed);
    assert_eq!(deeds(&console), expected.map(anna));
    for line in [
        "class take @nobody 3",
        "class take filter",
        "class say @nobody 3 rtl",
        "class say restart",
    ] {
        console.give(line);
        console.press("esc");
        assert_eq!(deeds(&console).len(), 4, "{line}");
    }
    console.give(&format!("class say 3 goto {}", "1".repeat(200)));
    assert!(console.screen(120, 40).contains("longer than 200"));
    console.press("esc");
    // Without a watched seat, the desk has no vehicles; with one, its commands go there.
    console.give("class watch @anna");
    console.give("3 land");
    let last = deeds(&console).pop();
    assert_eq!(last, Some(("anna".to_owned(), command("3 land"))));
}

/// The trainee once read on the last line why commands of the instructor failed.
#[test]
fn what_fails_for_the_instructor_concerns_the_desk_only() {
    let mut console = flying_mission(Stake::Graded);
    console.press("M");
    order(&mut console, 1, take(&[2]));
    quiet(&mut console);
    let before = console.state().notices().lines().count();
    order(&mut console, 2, command("rtl"));
    console.row(2, RowState::Refused, Some("no position"));
    order(&mut console, 3, take(&[9]));
    let situation = "nowhere".into();
    order(&mut console, 4, Deed::Recall { situation });
    assert!(console.state().message().is_none());
    assert_eq!(console.state().notices().lines().count(), before);
    assert_eq!(outcomes(&console).len(), 4, "the desk hears of each");
}

#[test]
fn what_the_desk_watches_names_the_vehicles_that_it_flies() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_taken());
    console.press("w");
    let tiles = console.screen(120, 40);
    assert!(tiles.contains("you fly 3"), "{tiles}");
    console.press("enter");
    console.give("class state");
    let state = console.screen(80, 24);
    assert!(state.contains("you fly 3"), "{state}");
}
