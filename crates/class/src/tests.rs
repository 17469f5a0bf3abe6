//! Seats and a desk over connections that lose, repeat and reorder lines, and break.

use std::time::Duration;

use proptest::prelude::*;

use super::protocol::{Denial, DeskMessage, Hello, SeatMessage, VERSION, read};
use super::reception::tests::{piece, submission};
use super::*;
use rig::{Rig, fates};

mod exams;
mod faults;
mod lessons;
mod rig;

const STEP: Duration = Duration::from_millis(100);

fn hello(sitting: u64) -> SeatMessage {
    SeatMessage::Hello(Hello {
        protocol: VERSION,
        sitting,
        name: None,
    })
}

fn desk() -> Desk {
    Desk::new(9, "9-A".into(), "petro".into())
}

fn seconds(count: u64) -> Duration {
    Duration::from_secs(count)
}

/// A seat without a flight.
#[derive(Default, Clone, Copy)]
struct Idle {
    looks_on: bool,
    is_flying: bool,
}

/// The content of the record that a seat hands in: three pieces and a half.
fn content() -> Vec<u8> {
    (0..PIECE * 7 / 2).map(|it| it as u8).collect()
}

impl SeatSource for Idle {
    fn report(&self) -> SeatReport {
        SeatReport {
            looks_on: self.looks_on,
            flight: self.is_flying.then(FlightReport::default),
            ..SeatReport::default()
        }
    }

    fn insight(&self) -> Option<Insight> {
        Some(Insight::default())
    }

    fn picture(&self) -> Option<Picture> {
        Some(Picture::blank(3, 2))
    }

    fn head(&self) -> Option<TryHead> {
        None
    }

    fn piece(&self, request: &PieceRequest) -> Option<Piece> {
        Some(piece(&content(), request))
    }
}

fn joined(desk: &mut Desk, connection: u64, user: &str, sitting: u64) {
    let outcome = desk.hear(
        ConnectionId(connection),
        user,
        hello(sitting),
        Duration::ZERO,
    );
    assert_eq!(outcome, Ok(DeskHeard::Known));
}

fn report(flight: Option<FlightReport>) -> SeatMessage {
    let report = Box::new(SeatReport {
        flight,
        ..SeatReport::default()
    });
    SeatMessage::Report { last: 0, report }
}

fn names(desk: &Desk) -> Vec<&str> {
    let board = desk.board().into_iter();
    board
        .map(|index| desk.seats()[index].name.as_str())
        .collect()
}

#[test]
fn seats_are_named_after_users_and_keep_their_rows() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    joined(&mut desk, 2, "anna", 11);
    joined(&mut desk, 3, "bohdan", 12);
    assert_eq!(names(&desk), ["anna", "anna-2", "bohdan"]);
    desk.leave(ConnectionId(1), seconds(1));
    assert_eq!(names(&desk), ["anna-2", "bohdan", "anna"]);
    // Another run of the console takes the row that is free; the run that sat there gets a new one.
    joined(&mut desk, 4, "anna", 13);
    assert_eq!(names(&desk), ["anna", "anna-2", "bohdan"]);
    joined(&mut desk, 5, "anna", 10);
    assert_eq!(names(&desk), ["anna", "anna-2", "anna-3", "bohdan"]);
}

#[test]
fn who_does_not_say_hello_or_speaks_another_version_is_denied() {
    let mut desk = desk();
    let at = ConnectionId(1);
    let said = desk.hear(at, "anna", report(None), Duration::ZERO);
    assert_eq!(said, Err(Denial::NoHello));
    let old = SeatMessage::Hello(Hello {
        protocol: 0,
        sitting: 1,
        name: None,
    });
    let said = desk.hear(at, "anna", old, Duration::ZERO);
    assert_eq!(said, Err(Denial::Version { desk: VERSION }));
    joined(&mut desk, 1, "anna", 10);
    let said = desk.hear(at, "anna", hello(10), Duration::ZERO);
    assert_eq!(said, Err(Denial::NoHello));
    for number in 2..=SEATS as u64 {
        joined(&mut desk, number, &format!("u{number}"), 1);
    }
    let said = desk.hear(ConnectionId(9999), "late", hello(1), Duration::ZERO);
    assert_eq!(said, Err(Denial::Full));
}

#[test]
fn a_stuck_trainee_is_first_as_soon_as_its_report_comes() {
    let mut desk = desk();
    for (number, user) in [(1, "anna"), (2, "bohdan"), (3, "vira")] {
        joined(&mut desk, number, user, number);
    }
    let flight = |clock_s| FlightReport {
        stage: Stage::Flying,
        objectives_open: 1,
        clock_s,
        ..FlightReport::default()
    };
    for (number, user, clock_s) in [(1, "anna", 30.0), (2, "bohdan", 30.0), (3, "vira", 61.0)] {
        let said = report(Some(flight(clock_s)));
        assert_eq!(
            desk.hear(ConnectionId(number), user, said, seconds(1)),
            Ok(DeskHeard::Known)
        );
    }
    assert_eq!(names(&desk), ["vira", "anna", "bohdan"]);
    // Who has been stuck longest is first.
    let said = report(Some(flight(60.5)));
    assert_eq!(
        desk.hear(ConnectionId(1), "anna", said, seconds(2)),
        Ok(DeskHeard::Known)
    );
    assert_eq!(names(&desk), ["vira", "anna", "bohdan"]);
}

#[test]
fn an_order_to_a_seat_that_is_gone_is_not_sent_after_ten_seconds() {
    let mut desk = desk();
    joined(&mut desk, 1, "anna", 10);
    desk.leave(ConnectionId(1), seconds(1));
    desk.give(&[0], &Deed::Freeze, seconds(2));
    assert!(!desk.expire(seconds(11)));
    assert!(desk.expire(seconds(12)));
    joined(&mut desk, 2, "anna", 10);
    let mut line = DeskLine::default();
    let said: Vec<DeskMessage> =
        std::iter::from_fn(|| line.next(&desk, ConnectionId(2), seconds(12))).collect();
    let welcome = matches!(said[0], DeskMessage::Welcome { .. });
    assert!(
        welcome && said[1..] == [DeskMessage::Ask { from: 1 }],
        "{said:?}"
    );
}

#[test]
fn nothing_is_said_before_the_trainee_agrees() {
    let mut seat = Seat::new(1, Consent::Unasked);
    let mut line = SeatLine::default();
    assert_eq!(line.next(&seat, &Idle::default(), seconds(1)), None);
    seat.decide(false);
    assert_eq!(line.next(&seat, &Idle::default(), seconds(1)), None);
    seat.decide(true);
    let said = line.next(&seat, &Idle::default(), seconds(1));
    assert_eq!(said, Some(hello(1)));
    // And nothing but the hello before the desk has welcomed the seat.
    assert_eq!(line.next(&seat, &Idle::default(), seconds(1)), None);
}

#[test]
fn a_seat_sends_its_screen_only_while_it_is_watched_and_again_after_a_break() {
    let mut rig = Rig::new(Vec::new());
    let run = |rig: &mut Rig, steps: u32| (0..steps).for_each(|_| rig.step());
    run(&mut rig, 5);
    assert_eq!(rig.desk.seats()[0].picture(), None);
    rig.desk.watch(Watching::Screen(0));
    run(&mut rig, 3);
    assert!(rig.seat.is_screen_watched());
    assert_eq!(rig.desk.seats()[0].picture(), Some(&Picture::blank(3, 2)));
    rig.reconnect();
    assert!(!rig.seat.is_screen_watched());
    run(&mut rig, 5);
    assert_eq!(rig.desk.seats()[0].picture(), Some(&Picture::blank(3, 2)));
    rig.desk.watch(Watching::Nothing);
    run(&mut rig, 3);
    assert!(!rig.seat.is_screen_watched());
    assert_eq!(rig.desk.seats()[0].picture(), None);
    // Watched again before the seat has heard that it was not.
    rig.desk.watch(Watching::Screen(0));
    run(&mut rig, 3);
    rig.desk.watch(Watching::Nothing);
    rig.desk.watch(Watching::Screen(0));
    assert_eq!(rig.desk.seats()[0].picture(), None);
    run(&mut rig, 20);
    assert_eq!(rig.desk.seats()[0].picture(), Some(&Picture::blank(3, 2)));
}

#[test]
fn tiles_ask_for_what_is_behind_the_screens_of_four_seats_without_the_screens() {
    let mut rig = Rig::new(Vec::new());
    let run = |rig: &mut Rig, steps: u32| (0..steps).for_each(|_| rig.step());
    run(&mut rig, 5);
    for number in 2..7 {
        joined(&mut rig.desk, 100 + number, "bohdan", number);
    }
    rig.desk.watch(Watching::Tiles(vec![0, 0, 1, 2, 9, 3, 4]));
    assert_eq!(rig.desk.watching().seats(), [0, 1, 2, 3]);
    rig.fly();
    run(&mut rig, 12);
    assert!(rig.seat.is_screen_watched());
    assert_eq!(rig.desk.seats()[0].picture(), None);
    assert!(rig.desk.seats()[0].insight().is_some());
    // A tile is watched whole.
    rig.desk.watch(Watching::Screen(0));
    assert!(rig.desk.seats()[0].insight().is_some());
    run(&mut rig, 3);
    assert_eq!(rig.desk.seats()[0].picture(), Some(&Picture::blank(3, 2)));
    rig.desk.watch(Watching::Nothing);
    run(&mut rig, 3);
    assert_eq!(rig.desk.seats()[0].insight(), None);
    assert!(!rig.seat.is_screen_watched());
}

#[test]
fn a_trainee_looks_on_at_what_the_desk_shows_until_either_ends_it() {
    let mut rig = Rig::new(Vec::new());
    let run = |rig: &mut Rig, steps: u32| (0..steps).for_each(|_| rig.step());
    run(&mut rig, 10);
    rig.desk.show(true);
    run(&mut rig, 10);
    // Nothing comes before the seat has carried out the order.
    assert_eq!(rig.seat.shown(), None);
    rig.desk.give(&[0], &Deed::LookOn, rig.now);
    run(&mut rig, 10);
    assert_eq!(rig.seat.shown(), Some(&Picture::blank(4, 1)));
    // Another order for those who came late leaves the picture to those who look on.
    rig.desk.give(&[0], &Deed::LookOn, rig.now);
    run(&mut rig, 2);
    assert!(rig.seat.shown().is_some());
    run(&mut rig, 10);
    rig.seat.look_on(false);
    run(&mut rig, 10);
    assert!(!rig.desk.seats()[0].looks_on());
    rig.desk.give(&[0], &Deed::LookOn, rig.now);
    run(&mut rig, 10);
    assert!(rig.seat.shown().is_some());
    rig.desk.show(false);
    run(&mut rig, 10);
    assert!(!rig.seat.looks_on());
    // A new connection begins without a picture, and with the same name.
    rig.seat.look_on(true);
    rig.reconnect();
    assert!(!rig.seat.looks_on());
}

#[test]
fn consoles_of_one_user_keep_their_names_when_the_desk_is_opened_again() {
    let mut desk = desk();
    let claims = |sitting, name: &str| {
        SeatMessage::Hello(Hello {
            protocol: VERSION,
            sitting,
            name: Some(name.into()),
        })
    };
    let hellos = [
        ("anna", claims(3, "anna-3")),
        ("anna", hello(4)),
        ("anna", claims(2, "anna-2")),
        // Names of others, and those that no seat gets.
        ("eve", claims(5, "anna")),
        ("eve", claims(6, "eve-0")),
        ("eve", claims(7, "eve-x")),
    ];
    for (connection, (user, hello)) in (1..).zip(hellos) {
        let heard = desk.hear(ConnectionId(connection), user, hello, Duration::ZERO);
        assert_eq!(heard, Ok(DeskHeard::Known));
    }
    let names: Vec<&str> = desk.seats().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["anna-3", "anna", "anna-2", "eve", "eve-2", "eve-3"]);
    // A console that was started anew takes a free seat; one with a name waits for its own.
    desk.leave(ConnectionId(2), seconds(1));
    let heard = desk.hear(ConnectionId(8), "anna", claims(8, "anna-4"), seconds(2));
    assert_eq!(heard, Ok(DeskHeard::Known));
    joined(&mut desk, 9, "anna", 9);
    assert_eq!(
        desk.seat_of(ConnectionId(8)).expect("it sits").name,
        "anna-4"
    );
    assert_eq!(desk.seat_of(ConnectionId(9)).expect("it sits").name, "anna");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn nothing_of_the_journal_is_lost_or_comes_twice_and_orders_are_done_once(
        fates in fates(),
        notes in prop::collection::vec(0_u8..40, 1..30),
    ) {
        let mut rig = Rig::new(fates);
        rig.seat.hand_in_mut().offer(submission(&content()));
        let what = Happening::Started { mission: None };
        for count in notes {
            for _ in 0..count {
                rig.seat.note(Some(1.0), what.clone());
            }
            if count % 3 == 0 && !rig.desk.seats().is_empty() {
                let now = rig.now;
                rig.desk.give(&[0], &Deed::Hint, now);
            }
            rig.step();
        }
        rig.fates.clear();
        for _ in 0..200 {
            rig.step();
        }
        let record = &rig.desk.seats()[0];
        prop_assert_eq!(rig.desk.seats().len(), 1);
        prop_assert_eq!(record.journal.missing(), 0);
        prop_assert!(record.journal.entries().eq(rig.seat.journal().entries()));
        prop_assert!(rig.done.values().all(|count| *count == 1));
        prop_assert!(rig.seat.hand_in().is_empty());
        prop_assert_eq!(rig.kept, 1);
        let files = &rig.reception.shelf().files;
        prop_assert!(files.values().all(|(bytes, is_whole)| *is_whole && *bytes == content()));
        for given in record.orders() {
            prop_assert_eq!(given.state, OrderState::Ended(Outcome::Done));
        }
    }

    /// Lines of a seat that means harm do no more than be refused.
    #[test]
    fn no_line_of_a_seat_stops_the_desk(lines in prop::collection::vec(".{0,80}", 0..20)) {
        let mut desk = desk();
        joined(&mut desk, 1, "anna", 10);
        for line in lines {
            if let Ok(message) = read::<SeatMessage>(line.as_bytes()) {
                let _ = desk.hear(ConnectionId(1), "anna", message, seconds(1));
            }
        }
        prop_assert_eq!(desk.seats().len(), 1);
    }

    #[test]
    fn entries_in_any_order_make_the_same_journal(order in prop::collection::vec(0_u64..40, 0..300)) {
        let mut journal = Journal::default();
        for _ in 0..40 {
            journal.note(None, Happening::Started { mission: None });
        }
        let mut copy = JournalCopy::default();
        for from in order {
            if let Some(mut batch) = journal.from(from + 1) {
                batch.entries.truncate(3);
                copy.receive(batch);
            }
        }
        let numbers = copy.entries().map(|entry| entry.number);
        prop_assert!(numbers.eq(1..=copy.last()));
    }
}
