//! A class: what a seat does for its desk, and the keys of the desk.

use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect, SessionEffect};
use sortie::app::event::{ClassEvent, Event, SessionEvent};
use sortie::app::state::{Activity, ClassRole, Overlay, Room, SeatPlace};
use sortie::campaign::Stake;
use sortie::class::protocol::{DeskMessage, Hello, SeatMessage, VERSION};
use sortie::class::{
    ArmedInject, ConnectionId, Consent, Deed, Desk, FlightReport, Happening, LastCommand,
    OfferedInject, Order, OrderId, OrderState, Outcome, Refusal, Seat, SeatReport, Stage,
};
use sortie::ledger::RowState;
use sortie::mission::{Injected, Progress};
use sortie::text::Language;

use crate::fixtures;
use crate::harness::Console;

/// A console in a class; the desk of petro is found.
fn seat(consent: Consent) -> Console {
    let mut console = Console::set_up(|setup| {
        let seat = Seat::new(7, consent);
        setup.class = ClassRole::Seat(Box::new(SeatPlace::new(seat)));
    });
    let instructor = "petro".to_owned();
    console.hear(ClassEvent::Found { instructor });
    console
}

fn welcome(console: &mut Console) {
    console.hear(ClassEvent::Said(DeskMessage::Welcome {
        protocol: VERSION,
        class: "9-A".into(),
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
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake,
    });
    for id in 1..=4 {
        console.vehicle(fixtures::airborne(id, 30.0 * f64::from(id), 20.0));
    }
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("F");
    console
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
    assert_eq!(line.collect::<Vec<_>>(), ["petro: freeze: done"]);
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
fn in_an_exam_only_a_message_and_the_end_are_carried_out() {
    let mut console = flying_mission(Stake::Exam);
    let text = "text".into();
    for (number, deed) in (1..).zip([Deed::Hint, Deed::Mark { text }, Deed::Freeze, Deed::Resume]) {
        order(&mut console, number, deed);
        assert_eq!(session_effects(&console), Vec::<&SessionEffect>::new());
    }
    let refused = Outcome::Refused(Refusal::Exam);
    let all: Vec<(u32, Outcome)> = (1..=4).map(|number| (number, refused)).collect();
    assert_eq!(outcomes(&console), all);
    let text = "text".into();
    order(&mut console, 5, Deed::Message { text });
    assert_eq!(outcomes(&console)[4], (5, Outcome::Done));
    order(&mut console, 6, Deed::End);
    assert_eq!(session_effects(&console), [&SessionEffect::Stop]);
    let report = Box::new(fixtures::report());
    console.hear(SessionEvent::MissionEnded(report));
    let ended: Vec<(u32, Outcome)> = outcomes(&console).split_off(5);
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

/// A desk with the seats anna, bohdan and vira.
pub fn desk(language: Language) -> Console {
    let mut console = Console::set_up(|setup| {
        setup.class = ClassRole::Desk(Box::new(Desk::new(5, "9-A".into())));
        setup.locale = std::sync::Arc::new(sortie::text::Locale::new(language));
    });
    for (connection, user) in [(1, "anna"), (2, "bohdan"), (3, "vira")] {
        join(&mut console, connection, user);
    }
    console
}

/// Connects a seat of a trainee to the desk.
pub fn join(console: &mut Console, connection: u64, user: &str) {
    let hello = Hello {
        protocol: VERSION,
        sitting: connection,
    };
    say(console, connection, user, SeatMessage::Hello(hello));
}

/// A seat reports its flight.
pub fn report(console: &mut Console, connection: u64, user: &str, flight: FlightReport) {
    let report = Box::new(SeatReport {
        trainee: format!("{user} k.").as_str().into(),
        flight: Some(flight),
    });
    say(
        console,
        connection,
        user,
        SeatMessage::Report { last: 0, report },
    );
}

/// A seat says something.
pub fn say(console: &mut Console, connection: u64, user: &str, message: SeatMessage) {
    console.hear(ClassEvent::Heard {
        connection: ConnectionId(connection),
        user: user.to_owned(),
        message,
    });
}

/// A flight in which the last command was given some seconds ago.
pub fn flight(age_s: f64) -> FlightReport {
    FlightReport {
        mission: Some("01-air-sample".into()),
        stage: Stage::Flying,
        clock_s: 272.0,
        score: Some(412),
        objectives_done: 1,
        objectives: 3,
        objectives_open: 2,
        vehicles: 4,
        airborne: 3,
        least_separation_m: Some(4.2),
        workload_percent: Some(35),
        failures: 2,
        last_command: Some(LastCommand {
            line: "1-2 goto n 30 e 10 up 20".into(),
            age_s,
        }),
        ..FlightReport::default()
    }
}

fn given(console: &Console) -> Vec<(String, Deed, OrderState)> {
    let desk = console.state().class_role().desk().expect("it is a desk");
    let seats = desk.seats().iter();
    let orders = seats.flat_map(|seat| {
        let orders = seat.orders();
        orders.map(|given| (seat.name.clone(), given.order.deed.clone(), given.state))
    });
    orders.collect()
}

fn deeds(console: &Console) -> Vec<(String, Deed)> {
    given(console)
        .into_iter()
        .map(|(name, deed, _)| (name, deed))
        .collect()
}

#[test]
fn a_key_gives_an_order_to_the_seat_under_the_cursor_or_to_marked_ones() {
    let mut console = desk(Language::English);
    assert_eq!(console.state().room(), Room::Class);
    console.press("f");
    assert_eq!(deeds(&console), [("anna".to_owned(), Deed::Freeze)]);
    console
        .press("down")
        .press("space")
        .press("down")
        .press("space");
    console.press("r");
    let resumed = [
        ("anna".to_owned(), Deed::Freeze),
        ("bohdan".to_owned(), Deed::Resume),
        ("vira".to_owned(), Deed::Resume),
    ];
    assert_eq!(deeds(&console), resumed);
    console.press("esc").press("h");
    assert_eq!(
        deeds(&console).last(),
        Some(&("vira".to_owned(), Deed::Hint))
    );
}

#[test]
fn a_line_names_a_seat_or_all_of_them() {
    let mut console = desk(Language::English);
    console.give("class message @bohdan land first");
    let text = "land first".into();
    let said = [("bohdan".to_owned(), Deed::Message { text })];
    assert_eq!(deeds(&console), said);
    console.give("class freeze @all");
    assert_eq!(deeds(&console).len(), 4);
    console.press("m").write("all of you").press("enter");
    let text = "all of you".into();
    assert!(deeds(&console).contains(&("anna".to_owned(), Deed::Message { text })));
    for line in ["class freeze @nobody", "class message @nobody hello"] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(screen.contains("nobody"), "{screen}");
        assert_eq!(deeds(&console).len(), 5, "{line}");
    }
}

#[test]
fn the_end_of_missions_is_asked_about() {
    let mut console = desk(Language::English);
    console.press("*").press("x");
    assert_eq!(deeds(&console), []);
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("END MISSION for anna, bohdan, vira"),
        "{screen}"
    );
    console.press("y");
    assert_eq!(deeds(&console).len(), 3);
}

#[test]
fn the_cursor_stays_on_its_seat_when_rows_move() {
    let mut console = desk(Language::English);
    console.press("down");
    for (connection, user, age_s) in [(1, "anna", 5.0), (2, "bohdan", 5.0), (3, "vira", 80.0)] {
        report(&mut console, connection, user, flight(age_s));
    }
    console.press("f");
    assert_eq!(deeds(&console), [("bohdan".to_owned(), Deed::Freeze)]);
}

#[test]
fn orders_go_only_to_connected_seats_and_a_seat_that_says_no_hello_is_denied() {
    let mut console = desk(Language::English);
    console.hear(ClassEvent::Left(ConnectionId(1)));
    console.give("class freeze @anna");
    assert_eq!(deeds(&console), []);
    let message = SeatMessage::Report {
        last: 0,
        report: Box::default(),
    };
    say(&mut console, 9, "eve", message);
    assert!(matches!(
        console.effects.as_slice(),
        [Effect::Class(ClassEffect::Deny { .. })]
    ));
}

/// A flight of a mission that permits some injects.
fn flying_with_injects(stake: Stake) -> Console {
    let mut console = flying_mission(stake);
    mission_says(&mut console, &[]);
    console
}

/// The mission has carried out these injects so far, each with its condition.
fn mission_says(console: &mut Console, injected: &[(&str, Option<&str>)]) {
    let inject = |name: &str, title: &str| sortie::mission::Inject {
        name: name.to_owned(),
        title: title.to_owned().into(),
    };
    let injected = injected.iter().map(|(name, when)| Injected {
        name: (*name).to_owned(),
        when: when.map(str::to_owned),
    });
    let progress = Progress {
        injects: vec![
            inject("gust", "Gust of wind"),
            inject("motor_fail", "Motor failure"),
        ],
        injected: injected.collect(),
        ..fixtures::progress()
    };
    console.hear(SessionEvent::Mission(Box::new(progress)));
}

fn inject(name: &str, when: Option<&str>) -> Deed {
    let name = name.into();
    let when = when.map(Into::into);
    Deed::Inject { name, when }
}

/// The shell does what the last order wants.
fn begin(console: &mut Console, number: u32) {
    let id = OrderId { desk: 1, number };
    let refusal = None;
    console.hear(ClassEvent::Begun { id, refusal });
}

#[test]
fn an_inject_is_done_when_the_mission_has_carried_it_out_and_the_trainee_is_not_told() {
    let mut console = flying_with_injects(Stake::Graded);
    let notices = console.state().notices().lines().len();
    let message = console.state().message().map(|it| it.text.to_string());
    order(&mut console, 1, inject("gust", None));
    let wanted = console.effects.clone();
    let [Effect::Class(ClassEffect::Inject { name, when, .. })] = wanted.as_slice() else {
        panic!("{wanted:?}");
    };
    assert_eq!((name.as_str(), when), ("gust", &None));
    begin(&mut console, 1);
    assert_eq!(outcomes(&console), [], "the effect has not been seen");
    mission_says(&mut console, &[("gust", None)]);
    let noted = console.effects.iter().find_map(|effect| match effect {
        Effect::Class(ClassEffect::Note(line)) => Some(line.text().to_string()),
        _ => None,
    });
    assert_eq!(noted.as_deref(), Some("petro: inject gust: done"));
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    assert_eq!(console.state().notices().lines().len(), notices);
    let now = console.state().message().map(|it| it.text.to_string());
    assert_eq!(now, message);

    order(&mut console, 2, inject("gust", None));
    begin(&mut console, 2);
    pass(&mut console, 5);
    assert_eq!(outcomes(&console)[1..], [(2, Outcome::NoEffect)]);
}

#[test]
fn injects_that_cannot_be_are_refused_in_silence() {
    let refusals = |console: &mut Console, deed: Deed| {
        let notices = console.state().notices().lines().len();
        order(console, 1, deed);
        assert_eq!(console.state().notices().lines().len(), notices);
        match outcomes(console).as_slice() {
            [(1, Outcome::Refused(refusal))] => *refusal,
            other => panic!("{other:?}"),
        }
    };
    let gust = || inject("gust", None);
    assert_eq!(refusals(&mut joined(), gust()), Refusal::NoMission);
    let mut exam = flying_with_injects(Stake::Exam);
    assert_eq!(refusals(&mut exam, gust()), Refusal::Exam);
    let mut console = flying_with_injects(Stake::Graded);
    assert_eq!(
        refusals(&mut console, inject("link_loss", None)),
        Refusal::NoInject
    );
    let mut console = flying_with_injects(Stake::Graded);
    console.hear(SessionEvent::Paused(true));
    assert_eq!(refusals(&mut console, gust()), Refusal::Paused);
    let mut console = flying_with_injects(Stake::Graded);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert_eq!(refusals(&mut console, gust()), Refusal::NotFlying);
    let mut console = flying_with_injects(Stake::Graded);
    let name = None;
    assert_eq!(
        refusals(&mut console, Deed::Disarm { name }),
        Refusal::NotArmed
    );
}

fn armed(console: &Console) -> Vec<String> {
    let flight = console.state().seat_report(false).flight;
    let armed = flight.expect("it flies").armed.into_iter();
    armed.map(|it| format!("{} {}", it.name, it.when)).collect()
}

#[test]
fn an_armed_inject_is_reported_until_it_comes_or_is_disarmed() {
    let mut console = flying_with_injects(Stake::Graded);
    for (number, name, when) in [
        (1, "gust", "t > 60"),
        (2, "gust", "t > 90"),
        (3, "motor_fail", "t > 90"),
    ] {
        order(&mut console, number, inject(name, Some(when)));
        begin(&mut console, number);
    }
    assert_eq!(
        armed(&console),
        ["gust t > 60", "gust t > 90", "motor_fail t > 90"]
    );
    pass(&mut console, 60);
    mission_says(&mut console, &[("gust", Some("t > 60"))]);
    let name = Some("gust".into());
    order(&mut console, 4, Deed::Disarm { name });
    begin(&mut console, 4);
    assert_eq!(armed(&console), ["motor_fail t > 90"]);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert_eq!(armed(&console), [""; 0]);
    let ended = [
        (1, Outcome::Armed),
        (2, Outcome::Armed),
        (3, Outcome::Armed),
        (1, Outcome::Done),
        (2, Outcome::Disarmed),
        (4, Outcome::Done),
        (3, Outcome::Disarmed),
    ];
    assert_eq!(outcomes(&console), ended);
}

/// A flight whose mission permits an inject, and in which another one waits.
pub fn flight_with_injects() -> FlightReport {
    let (name, title) = ("gust".into(), "Gust of wind".into());
    let armed = ArmedInject {
        name: "motor_fail".into(),
        when: "vehicle(2).z > 20".into(),
    };
    FlightReport {
        injects: vec![OfferedInject { name, title }],
        armed: vec![armed],
        ..flight(5.0)
    }
}

#[test]
fn the_desk_completes_injects_and_checks_conditions_before_it_sends() {
    let mut console = desk(Language::English);
    console.give("class inject gust");
    assert_eq!(deeds(&console), [], "no seat permits it");
    console.press("esc");
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("e");
    let screen = console.screen(120, 40);
    assert!(screen.contains("Gust of wind"), "{screen}");
    console.press("esc");
    console.give("class inject @anna gust when alt > 20");
    let screen = console.screen(120, 40);
    assert!(screen.contains("alt"), "{screen}");
    assert_eq!(deeds(&console), []);
    console.press("esc");
    console.give("class inject @anna gust");
    console.give("class inject @anna gust when t > 60 and inside('lane') > 0");
    console.give("class disarm @anna gust");
    console.give("class disarm @anna");
    let expected = [
        inject("gust", None),
        inject("gust", Some("t > 60 and inside('lane') > 0")),
        Deed::Disarm {
            name: Some("gust".into()),
        },
        Deed::Disarm { name: None },
    ];
    let anna = |deed| ("anna".to_owned(), deed);
    assert_eq!(deeds(&console), expected.map(anna));
}

#[test]
fn the_list_of_injects_closes_before_marks_are_removed() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("space").press("i");
    let screen = console.screen(80, 24);
    assert!(screen.contains("gust: Gust of wind"), "{screen}");
    console.press("esc");
    assert!(!console.screen(80, 24).contains("gust: Gust of wind"));
    assert_eq!(console.state().rooms().class().marked(), 1);
    console.press("esc");
    assert_eq!(console.state().rooms().class().marked(), 0);
}
