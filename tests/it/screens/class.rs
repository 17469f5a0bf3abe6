//! The room of a class: the desk with few and with thirty seats, and a seat.

use sortie::app::event::ClassEvent;
use sortie::class::protocol::SeatMessage;
use sortie::class::{
    ConnectionId, Danger, DangerKind, Entry, FlightReport, Happening, JournalBatch, Stage,
};
use sortie::text::Language;

use crate::console::class::{
    desk, empty_desk, flight, flight_with_injects, join, report, say, send_insight, send_screen,
};
use crate::harness::Console;

mod exams;
mod grading;
mod lessons;
mod replay;
mod results;

/// A seat in each state.
fn busy(language: Language) -> Console {
    let mut console = desk(language);
    let kind = DangerKind::Collision;
    let near = Some(Danger { kind, in_s: 4.0 });
    report(
        &mut console,
        3,
        "vira",
        FlightReport {
            danger: near,
            ..flight(12.0)
        },
    );
    report(
        &mut console,
        2,
        "bohdan",
        FlightReport {
            alerts: 2,
            oldest_alert_s: Some(34.0),
            ..flight(150.0)
        },
    );
    report(&mut console, 1, "anna", flight(75.0));
    for (connection, user, stage) in [
        (4, "daryna", Stage::Reading),
        (5, "ihor", Stage::Frozen),
        (6, "marko", Stage::Over),
        (7, "olena", Stage::Flying),
    ] {
        join(&mut console, connection, user);
        report(
            &mut console,
            connection,
            user,
            FlightReport {
                stage,
                ..flight(3.0)
            },
        );
    }
    join(&mut console, 8, "taras");
    join(&mut console, 9, "zoya");
    console.hear(ClassEvent::Left(ConnectionId(9)));
    let entry = |number, what| Entry {
        number,
        clock_s: Some(272.0),
        what,
    };
    let line = || "2 goto n 900 e 0".into();
    let entries = vec![
        entry(1, Happening::Command { line: line() }),
        entry(
            2,
            Happening::Failed {
                line: line(),
                vehicle: 2,
            },
        ),
    ];
    let batch = JournalBatch {
        kept_from: 1,
        entries,
    };
    say(&mut console, 3, "vira", SeatMessage::Entries(batch));
    console
        .press("home")
        .press("f")
        .press("down")
        .press("space");
    console
}

#[test]
fn the_board_has_those_first_who_need_help() {
    for language in Language::ALL {
        let mut console = busy(language);
        console.press("up");
        for (width, height) in [(80, 24), (120, 40), (200, 50)] {
            let name = format!("class_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn the_injects_of_a_seat_can_be_shown() {
    for language in Language::ALL {
        let mut console = desk(language);
        report(&mut console, 1, "anna", flight_with_injects());
        console.press("i");
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("injects_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn the_screen_of_a_seat_is_shown_as_it_is() {
    for language in Language::ALL {
        let mut console = desk(language);
        console.press("enter");
        send_screen(&mut console, 1, "anna", (100, 30));
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("watch_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn the_state_of_a_flight_is_beside_a_watched_screen() {
    for language in Language::ALL {
        let mut console = desk(language);
        report(&mut console, 1, "anna", flight_with_injects());
        console.press("enter");
        send_screen(&mut console, 1, "anna", (100, 30));
        send_insight(&mut console, 1, "anna");
        let name = format!("watch_beside_{}_200x50", language.code());
        insta::assert_snapshot!(name, console.screen(200, 50));
        console.press("s");
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("watch_state_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn four_seats_have_a_tile_each() {
    for language in Language::ALL {
        let mut console = busy(language);
        console.press("esc").press("w");
        for (connection, user) in [(1, "anna"), (2, "bohdan"), (3, "vira")] {
            send_insight(&mut console, connection, user);
        }
        for (width, height) in [(80, 24), (120, 40), (200, 50)] {
            let name = format!("tiles_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}

#[test]
fn thirty_seats_fit_a_screen_of_forty_rows() {
    let mut console = desk(Language::English);
    for number in 4..=30 {
        let user = format!("user{number}");
        join(&mut console, number, &user);
        report(&mut console, number, &user, flight(5.0));
    }
    let screen = console.screen(120, 40);
    for number in 4..=30 {
        assert!(screen.contains(&format!("user{number} ")), "{screen}");
    }
    assert!(!console.screen(80, 24).contains("user30 "));
    console.press("end");
    assert!(console.screen(80, 24).contains("vira"));
}

#[test]
fn without_a_desk_the_room_says_how_to_join() {
    let mut console = Console::new();
    console.press("K");
    let screen = console.screen(80, 24);
    assert!(screen.contains("`--class` and the name"), "{screen}");
}

#[test]
fn an_empty_board_says_whole_how_trainees_join() {
    for (width, height) in [(80, 24), (120, 40)] {
        let screen = empty_desk(Language::English).screen(width, height);
        let words: Vec<&str> = screen.split_whitespace().collect();
        let text = words.join(" ");
        assert!(
            text.contains("with `sortie join` and their join lines."),
            "{screen}"
        );
    }
}
