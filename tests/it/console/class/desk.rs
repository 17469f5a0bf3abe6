//! The keys and the lines of the desk.

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::ClassEvent;
use sortie::app::state::{ClassRole, Room};
use sortie::class::protocol::{Hello, SeatMessage, VERSION};
use sortie::class::{
    ConnectionId, Deed, Desk, FlightReport, LastCommand, OrderState, SeatReport, Stage,
};
use sortie::text::Language;

use crate::harness::Console;

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
        name: None,
    };
    say(console, connection, user, SeatMessage::Hello(hello));
}

/// A seat reports its flight.
pub fn report(console: &mut Console, connection: u64, user: &str, flight: FlightReport) {
    let report = Box::new(SeatReport {
        trainee: format!("{user} k.").as_str().into(),
        flight: Some(flight),
        ..SeatReport::default()
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

/// The orders so far, each with its seat.
pub fn deeds(console: &Console) -> Vec<(String, Deed)> {
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
