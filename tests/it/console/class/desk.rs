//! The keys and the lines of the desk.

use std::time::Duration;

use sortie::app::effect::{ClassEffect, Effect};
use sortie::app::event::{ClassEvent, Event};
use sortie::app::state::ClassRole;
use sortie::class::protocol::{Hello, SeatMessage, VERSION};
use sortie::class::{
    ConnectionId, Deed, Desk, Entry, FlightReport, Happening, JournalBatch, LastCommand, OrderId,
    OrderState, Outcome, Refusal, SeatRecord, SeatReport, Stage,
};
use sortie::text::Language;

use crate::harness::Console;

/// A desk that no seat has joined yet.
pub fn empty_desk(language: Language) -> Console {
    Console::set_up(|setup| {
        setup.class = ClassRole::Desk(Box::new(Desk::new(5, "9-A".into(), "petro".into())));
        setup.locale = std::sync::Arc::new(sortie::text::Locale::new(language));
    })
}

/// A desk with the seats anna, bohdan and vira.
pub fn desk(language: Language) -> Console {
    let mut console = empty_desk(language);
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
fn the_board_names_the_address_at_which_the_desk_listens() {
    let console = Console::set_up(|setup| {
        let desk = Desk::new(5, "9-A".into(), "petro".into());
        let desk = desk.listening_at("127.0.0.1:7461".into());
        setup.class = ClassRole::Desk(Box::new(desk));
    });
    let screen = console.screen(120, 40);
    assert!(screen.contains("class 9-A at 127.0.0.1:7461"), "{screen}");
    let screen = empty_desk(Language::English).screen(120, 40);
    assert!(screen.contains("class 9-A: "), "{screen}");
}

/// A trainee with two consoles once counted as two seats.
#[test]
fn the_board_counts_a_seat_once_however_many_consoles_it_has() {
    let mut console = desk(Language::English);
    join(&mut console, 4, "anna");
    let screen = console.screen(120, 40);
    assert!(screen.contains("anna-2"), "{screen}");
    let both = "3 of 3 seats connected, 4 consoles";
    assert!(screen.contains(both), "{screen}");
    console.hear(ClassEvent::Left(ConnectionId(1)));
    let screen = console.screen(120, 40);
    assert!(screen.contains("3 of 3 seats connected"), "{screen}");
    console.hear(ClassEvent::Left(ConnectionId(4)));
    let screen = console.screen(120, 40);
    assert!(screen.contains("2 of 3 seats connected"), "{screen}");
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

/// Which seats have refused an order was once to be found only seat by seat.
#[test]
fn an_order_to_several_seats_has_a_summary() {
    let mut console = desk(Language::English);
    console.give("class freeze @all");
    let numbers = orders_to(&console);
    let said = |console: &Console| {
        let message = console.state().message().expect("a message");
        message.text.to_string()
    };
    answer(&mut console, 1, numbers[0], Outcome::Done);
    answer(
        &mut console,
        2,
        numbers[1],
        Outcome::Refused(Refusal::NotFlying),
    );
    assert_eq!(said(&console), "freeze: sent to anna, bohdan, vira");
    answer(&mut console, 3, numbers[2], Outcome::Done);
    let end = "freeze: 2 seats done, 1 refused (bohdan: the flight has not begun, or is over)";
    assert_eq!(said(&console), end);

    console.give("class message @anna land");
    let later = console.state().wall() + Duration::from_secs(11);
    console.hear(Event::Tick {
        now: later,
        wall: later,
    });
    assert_eq!(said(&console), "message “land”: not answered");
}

/// The orders so far by their numbers, by seat.
fn orders_to(console: &Console) -> Vec<OrderId> {
    let desk = console.state().class_role().desk().expect("it is a desk");
    let orders = desk.seats().iter().flat_map(SeatRecord::orders);
    orders.map(|given| given.order.id).collect()
}

/// A seat says how an order ended, as the first entry of its journal.
fn answer(console: &mut Console, connection: u64, id: OrderId, outcome: Outcome) {
    let user = ["anna", "bohdan", "vira"][connection as usize - 1];
    let entry = Entry {
        number: 1,
        clock_s: None,
        what: Happening::Order {
            id,
            deed: Deed::Freeze,
            outcome,
            why: None,
        },
    };
    let batch = JournalBatch {
        kept_from: 1,
        entries: vec![entry],
    };
    say(console, connection, user, SeatMessage::Entries(batch));
}

/// `q` once closed the desk without a word about vehicles that the instructor flew.
#[test]
fn the_end_of_the_desk_is_asked_about_while_seats_depend_on_it() {
    let quits = |console: &Console| console.effects.contains(&Effect::Quit);
    let mut console = desk(Language::English);
    console.press("q");
    assert!(quits(&console));

    let stage = |stage| FlightReport {
        stage,
        ..flight(5.0)
    };
    for (flight, reason) in [
        (
            super::pilots::flight_taken(),
            "go back to their trainees (anna)",
        ),
        (
            stage(Stage::Frozen),
            "resume their frozen flights themselves",
        ),
        (stage(Stage::Held), "start their held missions themselves"),
    ] {
        let mut console = desk(Language::English);
        report(&mut console, 1, "anna", flight);
        console.press("q");
        assert!(!quits(&console), "{reason}");
        let screen = console.screen(120, 40);
        assert!(screen.contains(reason), "{screen}");
        console.press("y");
        assert!(quits(&console), "{reason}");
    }
}

/// A desk that was quit within half a second after a freeze once left the flight frozen without a word.
#[test]
fn what_was_just_ordered_counts_before_a_seat_reports_it() {
    let quits = |console: &mut Console| {
        console.effects.clear();
        console.press("q");
        let quits = console.effects.contains(&Effect::Quit);
        console.press("esc");
        quits
    };
    for (line, reason) in [
        (
            "class freeze @anna",
            "resume their frozen flights themselves",
        ),
        (
            "class fly m01 hold @anna",
            "start their held missions themselves",
        ),
        ("class take @anna", "go back to their trainees (anna)"),
    ] {
        let mut console = desk(Language::English);
        console.give(line);
        console.press("q");
        let screen = console.screen(120, 40);
        assert!(screen.contains(reason), "{screen}");
    }

    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight(5.0));
    assert!(quits(&mut console));
    console.give("class freeze @anna");
    assert!(!quits(&mut console), "it may be on its way");
    // A report that was on its way does not count.
    report(&mut console, 1, "anna", flight(5.0));
    assert!(!quits(&mut console));
    let order = orders_to(&console)[0];
    answer(&mut console, 1, order, Outcome::Done);
    assert!(!quits(&mut console), "the next report will show it");
    report(&mut console, 1, "anna", flight(5.0));
    assert!(quits(&mut console), "the trainee has resumed it");

    let mut console = desk(Language::English);
    console.give("class freeze @anna");
    let order = orders_to(&console)[0];
    let refused = Outcome::Refused(Refusal::NotFlying);
    answer(&mut console, 1, order, refused);
    assert!(quits(&mut console));
}

#[test]
fn the_injects_of_a_named_seat_are_listed() {
    let mut console = desk(Language::English);
    report(&mut console, 2, "bohdan", super::flight_with_injects());
    console.give("class injects @bohdan");
    let screen = console.screen(120, 40);
    assert!(screen.contains("bohdan (bohdan k.): injects"), "{screen}");
    assert!(screen.contains("gust"), "{screen}");
}

#[test]
fn entries_that_a_seat_has_dropped_are_counted_on_the_board() {
    let mut console = desk(Language::English);
    let what = Happening::Started { mission: None };
    let (number, clock_s) = (41, None);
    let entry = Entry {
        number,
        clock_s,
        what,
    };
    let batch = JournalBatch {
        kept_from: number,
        entries: vec![entry],
    };
    say(&mut console, 1, "anna", SeatMessage::Entries(batch));
    let screen = console.screen(120, 40);
    let told = "40 earlier entries are no longer available";
    assert!(screen.contains(told), "{screen}");
}

#[test]
fn a_need_that_is_over_has_no_age() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight(90.0));
    let screen = console.screen(120, 40);
    assert!(screen.contains("no command 90 s"), "{screen}");
    report(&mut console, 1, "anna", flight(0.0));
    let screen = console.screen(120, 40);
    assert!(!screen.contains("no command"), "{screen}");
}
