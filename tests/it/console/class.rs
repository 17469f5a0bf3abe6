//! A class: what a seat does for its desk. The desk, injects and the watched screen are below.

use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::{ClassEvent, Event, SessionEvent};
use sortie::app::state::{Activity, ClassRole, Overlay, SeatPlace};
use sortie::campaign::Stake;
use sortie::class::protocol::{DeskMessage, VERSION};
use sortie::class::{Consent, Deed, Happening, Order, OrderId, Outcome, Refusal, Seat, Stage};
use sortie::ledger::RowState;
use sortie::mission::Progress;

use crate::fixtures;
use crate::harness::Console;

mod addressing;
mod desk;
mod grading;
mod injects;
mod lessons;
mod pilots;
mod situations;
mod start;
mod tries;
mod watch;

pub use desk::{deeds, desk, empty_desk, flight, join, report, say};
pub use grading::grading;
pub use injects::flight_with_injects;
pub use lessons::{begin, carry_out, first_lesson};
pub use watch::{send_insight, send_screen};

/// A console in a class; the desk of petro is found.
fn seat(consent: Consent) -> Console {
    let mut console = Console::set_up(|setup| {
        let seat = Seat::new(7, consent);
        setup.class = ClassRole::Seat(Box::new(SeatPlace::new(seat, "9-A".to_owned())));
    });
    let instructor = "petro".to_owned();
    console.hear(ClassEvent::Found { instructor });
    console
}

fn welcome(console: &mut Console) {
    console.hear(ClassEvent::Said(DeskMessage::Welcome {
        protocol: VERSION,
        class: "9-A".into(),
        name: "anna".into(),
        instructor: "petro".into(),
    }));
}

fn joined() -> Console {
    let mut console = seat(Consent::Given);
    welcome(&mut console);
    console
}

/// A flight of a mission whose clock runs.
fn flying_mission(stake: Stake) -> Console {
    let mut console = joined();
    start(&mut console, "m01", stake);
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 30.0 * f64::from(id), 20.0));
    }
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("F");
    console
}

/// The flight of a mission begins.
fn start(console: &mut Console, mission: &str, stake: Stake) {
    console.start(Activity::Mission {
        id: mission.to_owned(),
        title: "Air sample at the yard".into(),
        stake,
    });
}

/// Gives an order to the seat.
fn order(console: &mut Console, number: u32, deed: Deed) {
    let id = OrderId { desk: 1, number };
    let order = Order { id, deed };
    console.hear(ClassEvent::Said(DeskMessage::Order(order)));
}

fn place(console: &Console) -> &SeatPlace {
    console.state().class_role().seat().expect("it is a seat")
}

fn journal(console: &Console) -> Vec<Happening> {
    let entries = place(console).seat().journal().entries();
    entries.map(|entry| entry.what.clone()).collect()
}

/// The outcomes of orders so far, by number.
fn outcomes(console: &Console) -> Vec<(u32, Outcome)> {
    let ended = journal(console).into_iter().filter_map(|what| match what {
        Happening::Order { id, outcome, .. } => Some((id.number, outcome)),
        _ => None,
    });
    ended.collect()
}

fn session_effects(console: &Console) -> Vec<&SessionEffect> {
    let effects = console.effects.iter();
    let session = effects.filter_map(|effect| match effect {
        Effect::Session(effect) => Some(effect),
        _ => None,
    });
    session.collect()
}

fn pass(console: &mut Console, seconds: u64) {
    let now = console.state().wall() + Duration::from_secs(seconds);
    console.hear(Event::Tick { now, wall: now });
}

/// Lets time pass until no message is on the last line, while the desk is there.
fn quiet(console: &mut Console) {
    for _ in 0..3 {
        pass(console, 8);
        console.hear(ClassEvent::Said(DeskMessage::Here));
    }
}

#[test]
fn a_configured_class_is_joined_after_a_yes_and_asked_about_once() {
    let mut console = seat(Consent::Unasked);
    pass(&mut console, 1);
    let screen = console.screen(120, 40);
    assert!(screen.contains("Join the class of petro?"), "{screen}");
    console.press("y");
    assert_eq!(place(&console).seat().consent(), Consent::Given);
    welcome(&mut console);
    assert!(console.screen(120, 40).contains("desk: petro"));

    let mut console = seat(Consent::Unasked);
    pass(&mut console, 1);
    console.press("n");
    assert_eq!(place(&console).seat().consent(), Consent::Declined);
    pass(&mut console, 60);
    assert!(console.state().overlay().is_none());
    console.give("class join");
    assert_eq!(place(&console).seat().consent(), Consent::Given);
    console.give("class leave");
    assert_eq!(place(&console).seat().consent(), Consent::Declined);
}

#[test]
fn the_question_waits_until_no_other_one_is_open() {
    let mut console = seat(Consent::Unasked);
    console.press(":");
    pass(&mut console, 1);
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Palette(_))
    ));
    console.press("esc");
    pass(&mut console, 1);
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Confirm(_))
    ));
}

#[test]
fn a_message_is_shown_kept_and_rings_and_comes_once() {
    let mut console = flying_mission(Stake::Graded);
    let deed = Deed::Message {
        text: "land first".into(),
    };
    order(&mut console, 1, deed.clone());
    let said = console.state().message().expect("a message");
    assert_eq!(said.text.to_string(), "petro: land first");
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    let notices = console.state().notices().lines().len();
    order(&mut console, 1, deed);
    assert_eq!(outcomes(&console).len(), 1);
    assert_eq!(console.state().notices().lines().len(), notices);
}

#[test]
fn a_frozen_flight_is_not_resumed_by_the_trainee_while_the_desk_is_there() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, Deed::Freeze);
    assert_eq!(session_effects(&console), [&SessionEffect::Pause]);
    assert_eq!(outcomes(&console), [], "the effect has not been seen");
    console.hear(SessionEvent::Paused(true));
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    let noted = console.effects.iter();
    let line = noted.filter_map(|effect| match effect {
        Effect::Class(ClassEffect::Note(line)) => Some(line.text().to_string()),
        _ => None,
    });
    assert_eq!(line.collect::<Vec<_>>(), ["petro has frozen the flight"]);
    assert!(console.screen(120, 40).contains("FROZEN"));
    let stage = |console: &Console| console.state().seat_report(false).flight.map(|it| it.stage);
    assert_eq!(stage(&console), Some(Stage::Frozen));
    console.press("p");
    assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
    for line in ["class leave", "restart", "1 arm"] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(screen.contains("petro has frozen"), "{line} {screen}");
        console.press("esc");
    }
    assert!(console.state().class_role().watcher().is_some());
    console.hear(ClassEvent::Lost);
    assert!(
        console
            .screen(120, 40)
            .contains("`continue` lets your flight go on")
    );
    console.press("p");
    assert_eq!(session_effects(&console), [&SessionEffect::Continue]);
}

#[test]
fn a_silent_desk_does_not_hold_a_flight() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, Deed::Freeze);
    console.hear(SessionEvent::Paused(true));
    for _ in 0..3 {
        pass(&mut console, 8);
        console.hear(ClassEvent::Said(DeskMessage::Here));
    }
    console.press("p");
    assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
    pass(&mut console, 10);
    console.press("p");
    assert_eq!(session_effects(&console), [&SessionEffect::Continue]);
}

#[test]
fn resume_ends_a_freeze_and_is_refused_without_one() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, Deed::Resume);
    let refused = Outcome::Refused(Refusal::NotFrozen);
    assert_eq!(outcomes(&console), [(1, refused)]);
    order(&mut console, 2, Deed::Freeze);
    console.hear(SessionEvent::Paused(true));
    order(&mut console, 3, Deed::Resume);
    assert_eq!(session_effects(&console), [&SessionEffect::Continue]);
    console.hear(SessionEvent::Paused(false));
    assert_eq!(
        outcomes(&console)[1..],
        [(2, Outcome::Done), (3, Outcome::Done)]
    );
    assert_eq!(
        console.state().seat_report(false).flight.map(|it| it.stage),
        Some(Stage::Flying)
    );
}

#[test]
fn an_order_without_a_visible_effect_says_so_after_five_seconds() {
    let mut console = flying_mission(Stake::Graded);
    order(&mut console, 1, Deed::Freeze);
    pass(&mut console, 4);
    assert_eq!(outcomes(&console), []);
    pass(&mut console, 1);
    assert_eq!(outcomes(&console), [(1, Outcome::NoEffect)]);
}

#[test]
fn in_an_exam_only_messages_bookmarks_and_the_end_are_carried_out() {
    let mut console = flying_mission(Stake::Exam);
    for (number, deed) in (1..).zip([Deed::Hint, Deed::Freeze, Deed::Resume]) {
        order(&mut console, number, deed);
        assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
    }
    let refused = Outcome::Refused(Refusal::Exam);
    let all: Vec<(u32, Outcome)> = (1..=3).map(|number| (number, refused)).collect();
    assert_eq!(outcomes(&console), all);
    let text = "text".into();
    order(&mut console, 4, Deed::Message { text });
    assert_eq!(outcomes(&console)[3], (4, Outcome::Done));
    let text = "text".into();
    order(&mut console, 5, Deed::Mark { text });
    let is_mark = |effect: &Effect| matches!(effect, Effect::Class(ClassEffect::Mark { .. }));
    assert!(console.effects.iter().any(is_mark));
    order(&mut console, 6, Deed::End);
    assert_eq!(session_effects(&console), [&SessionEffect::Stop]);
    let report = Box::new(fixtures::report());
    console.hear(SessionEvent::MissionEnded(report));
    let ended: Vec<(u32, Outcome)> = outcomes(&console).split_off(4);
    assert_eq!(ended, [(6, Outcome::Done)]);
}

#[test]
fn a_hint_of_the_desk_is_an_order_in_the_ledger() {
    let mut console = flying_mission(Stake::Graded);
    let progress = Progress {
        clues: sortie::mission::ClueProgress {
            next: Some((1, 0.0)),
            ..fixtures::progress().clues
        },
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
    order(&mut console, 1, Deed::Hint);
    let entries = console.state().session().ledger().entries();
    let lines: Vec<String> = entries.map(|entry| entry.line.clone()).collect();
    assert_eq!(lines, ["all hint"]);
    let is_command = |what: &Happening| matches!(what, Happening::Command { .. });
    assert!(!journal(&console).iter().any(is_command));
    let flight = console.state().seat_report(false).flight;
    assert_eq!(flight.map(|it| it.last_command), Some(None));
    for vehicle in console.sent_to() {
        console.row(vehicle, RowState::Done, None);
    }
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
}

#[test]
fn a_bookmark_is_done_when_the_shell_has_set_it() {
    let mut console = flying_mission(Stake::Graded);
    let text = "too close".into();
    order(&mut console, 1, Deed::Mark { text });
    let wanted = console.effects.clone();
    let [Effect::Class(ClassEffect::Mark { id, text })] = wanted.as_slice() else {
        panic!("{wanted:?}");
    };
    assert_eq!(text, "petro: too close");
    assert_eq!(outcomes(&console), []);
    let id = *id;
    let refusal = Refusal::NotRecorded;
    console.hear(ClassEvent::Begun {
        id,
        refusal: Some(refusal),
    });
    let refused = Outcome::Refused(refusal);
    assert_eq!(outcomes(&console), [(1, refused)]);
}

#[test]
fn without_a_flight_orders_that_need_one_are_refused() {
    let mut console = joined();
    for (number, deed) in (1..).zip([Deed::Hint, Deed::Freeze, Deed::End]) {
        order(&mut console, number, deed);
    }
    let refused = |refusal| Outcome::Refused(refusal);
    assert_eq!(
        outcomes(&console),
        [
            (1, refused(Refusal::NoMission)),
            (2, refused(Refusal::NotFlying)),
            (3, refused(Refusal::NoMission)),
        ]
    );
}

#[test]
fn the_journal_has_starts_commands_failures_and_ends() {
    let mut console = flying_mission(Stake::Graded);
    console.give("1 land");
    console.row(1, RowState::Refused, Some("no"));
    console.row(1, RowState::Refused, Some("no"));
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    let line = || "1 land".into();
    let report = fixtures::report();
    let expected = [
        Happening::Command { line: line() },
        Happening::Failed {
            line: line(),
            vehicle: 1,
        },
        Happening::Ended {
            score: report.score,
            passed: report.passed,
        },
    ];
    let journal = journal(&console);
    let started = Happening::Started {
        mission: Some("m01".into()),
    };
    assert_eq!(journal[0], started);
    let met = journal[1..].iter();
    let others = met.skip_while(|it| matches!(it, Happening::Objective { .. }));
    assert_eq!(others.cloned().collect::<Vec<_>>(), expected);
    let flight = console.state().seat_report(false).flight;
    assert_eq!(
        flight.map(|it| (it.failures, it.stage)),
        Some((1, Stage::Over))
    );
}

/// It once said that a flight continues, also at home.
#[test]
fn a_seat_that_does_not_fly_is_told_only_that_the_desk_is_gone() {
    let said = |console: &mut Console| {
        console.hear(ClassEvent::Lost);
        let mut lines = console.state().notices().lines();
        lines.next_back().expect("a notice").notice.text.to_string()
    };
    assert_eq!(said(&mut joined()), "the desk is gone");
    let mut flying = flying_mission(Stake::Graded);
    let gone = "the desk is gone; your flight continues";
    assert_eq!(said(&mut flying), gone);
}

/// A hint is no command to a vehicle.
#[test]
fn a_hint_that_is_refused_is_no_failure_of_a_vehicle() {
    let mut console = flying_mission(Stake::Graded);
    console.give("hint");
    console.row(1, RowState::Refused, Some("no"));
    let failed = |it: &Happening| matches!(it, Happening::Failed { .. });
    assert!(!journal(&console).iter().any(failed));
}

/// The carrier knows only the user of the tunnel, who is the trainee.
#[test]
fn behind_a_tunnel_the_desk_says_who_the_instructor_is() {
    let mut console = seat(Consent::Given);
    let instructor = "anna".to_owned();
    console.hear(ClassEvent::Found { instructor });
    welcome(&mut console);
    assert!(console.screen(120, 40).contains("desk: petro"));
    let text = "land".into();
    order(&mut console, 1, Deed::Message { text });
    let said = console.state().message().expect("a message");
    assert_eq!(said.text.to_string(), "petro: land");
}
