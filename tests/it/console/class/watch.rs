//! The screen of a seat, watched at the desk.

use std::time::Duration;

use sortie::app::event::{ClassEvent, TerminalEvent};
use sortie::app::state::{Activity, Room};
use sortie::campaign::Stake;
use sortie::class::protocol::{DeskMessage, SeatMessage};
use sortie::class::{
    CellStyle, ConnectionId, Deed, Insight, ObjectiveInsight, ObjectiveStanding, Outcome, Picture,
    PictureCell, PictureSender, Refusal, TargetInsight, VehicleInsight, VehiclePlace, Watching,
};
use sortie::text::Language;

use super::desk::{deeds, desk, join, report, say};
use super::injects::flight_with_injects;
use super::{flying_mission, joined, order, outcomes, pass, place, welcome};
use crate::harness::Console;

/// A picture with a number in each row, and one that shows where the columns are.
fn picture(columns: u16, rows: u16) -> Picture {
    let mut picture = Picture::blank(columns, rows);
    let style = CellStyle::default();
    for row in 0..rows {
        let text = format!("row {row:02} ").repeat(usize::from(columns) / 7);
        for (column, c) in (0..).zip(text.chars()) {
            let cell = PictureCell::new(&c.to_string(), style);
            picture.set(column, row, cell);
        }
    }
    picture
}

/// A seat sends its screen.
pub fn send_screen(console: &mut Console, connection: u64, user: &str, size: (u16, u16)) {
    let mut sender = PictureSender::default();
    let picture = picture(size.0, size.1);
    while let Some(part) = sender.next(|| Some(picture.clone()), Duration::ZERO) {
        say(console, connection, user, SeatMessage::Screen(part));
    }
}

fn watched(console: &Console) -> Option<usize> {
    let desk = console.state().class_role().desk();
    desk.expect("it is a desk").watching().screen()
}

fn tiles(console: &Console) -> Vec<usize> {
    let desk = console.state().class_role().desk();
    match desk.expect("it is a desk").watching() {
        Watching::Tiles(seats) => seats.clone(),
        _ => Vec::new(),
    }
}

/// A flight as only the instructor sees it: vehicle 2 is not where its trainee sees it.
pub fn insight() -> Insight {
    let place = |east, north, height| VehiclePlace {
        at: [east, north],
        height,
    };
    let vehicle = |id, shown, truth| VehicleInsight {
        id,
        mode: "GUIDED".into(),
        battery: Some(80 - id as u8),
        shown: Some(shown),
        truth: Some(truth),
    };
    let objective = |title: &str, detail: &str, standing| ObjectiveInsight {
        title: title.into(),
        detail: detail.into(),
        standing,
    };
    let target = |at, is_found| TargetInsight { at, is_found };
    Insight {
        objectives: vec![
            objective("Take off", "4/4", ObjectiveStanding::Met),
            objective("Find both survivors", "1/2", ObjectiveStanding::Open),
            objective("Within four minutes", "4:32", ObjectiveStanding::Missed),
            objective("Land at the pads", "0/4", ObjectiveStanding::Open),
        ],
        alerts: vec!["vehicle 3: battery 12 %".into()],
        vehicles: vec![
            vehicle(1, place(100, 200, 200), place(110, 200, 201)),
            vehicle(2, place(400, 900, 250), place(900, 1200, 250)),
            vehicle(3, place(-300, 500, 120), place(-300, 510, 120)),
        ],
        fences: vec![vec![[-800, -200], [1500, -200], [1500, 1800], [-800, 1800]]],
        targets: vec![target([600, 1500], false), target([-200, 900], true)],
    }
}

/// A seat tells what is behind its screen.
pub fn send_insight(console: &mut Console, connection: u64, user: &str) {
    let insight = Box::new(insight());
    say(console, connection, user, SeatMessage::Insight(insight));
}

#[test]
fn enter_shows_the_screen_of_a_seat_until_escape() {
    let mut console = desk(Language::English);
    console.press("down").press("enter");
    assert_eq!(watched(&console), Some(1));
    let screen = console.screen(80, 24);
    assert!(screen.contains("waiting for the first picture"), "{screen}");
    // Only what is watched is taken in.
    send_screen(&mut console, 1, "anna", (80, 24));
    send_screen(&mut console, 2, "bohdan", (80, 24));
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("row 20") && !screen.contains("row 21"),
        "{screen}"
    );
    console.press("f");
    assert_eq!(deeds(&console), [("bohdan".to_owned(), Deed::Freeze)]);
    console.press("esc");
    assert_eq!(watched(&console), None);
    assert!(console.screen(80, 24).contains("vira"));

    console.give("class watch @vira");
    assert_eq!(watched(&console), Some(2));
    console.give("class unwatch");
    assert_eq!(watched(&console), None);
    console.give("class watch @vira");
    console.give("show home");
    pass(&mut console, 1);
    assert_eq!(watched(&console), None, "it is not shown any more");
}

#[test]
fn tiles_show_marked_seats_or_the_first_of_the_board_and_enter_watches_one() {
    let mut console = desk(Language::English);
    for (connection, user) in [(4, "daryna"), (5, "ihor")] {
        join(&mut console, connection, user);
    }
    console.press("w");
    assert_eq!(tiles(&console), [0, 1, 3, 4], "the first four, by name");
    console.press("right").press("down").press("f");
    assert_eq!(deeds(&console), [("ihor".to_owned(), Deed::Freeze)]);
    console.press("enter");
    assert_eq!(watched(&console), Some(4));
    console.press("esc");
    assert_eq!(tiles(&console), [0, 1, 3, 4], "back to the tiles");
    console.press("left").press("up").press("r");
    let resumed = ("anna".to_owned(), Deed::Resume);
    assert_eq!(deeds(&console)[0], resumed);
    console.press("esc");
    assert!(tiles(&console).is_empty());

    console
        .press("home")
        .press("space")
        .press("end")
        .press("space");
    console.press("w");
    assert_eq!(tiles(&console), [0, 2], "anna and vira are marked");
    console.give("show home");
    pass(&mut console, 1);
    assert!(tiles(&console).is_empty(), "they are not shown any more");
}

#[test]
fn the_state_of_a_flight_stands_beside_its_screen_or_in_its_place() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("enter");
    send_screen(&mut console, 1, "anna", (100, 30));
    send_insight(&mut console, 1, "anna");
    let (wide, narrow) = ((200, 50), (80, 24));
    let both = console.screen(wide.0, wide.1);
    assert!(
        both.contains("row 05") && both.contains("seen 58 m away"),
        "{both}"
    );
    assert!(!console.screen(narrow.0, narrow.1).contains("survivors"));
    console.press("s");
    let state = console.screen(narrow.0, narrow.1);
    assert!(
        state.contains("survivors") && !state.contains("row 05"),
        "{state}"
    );
    console.press("i");
    for (columns, rows) in [wide, narrow] {
        let injects = console.screen(columns, rows);
        assert!(injects.contains("gust"), "{injects}");
    }
    console.press("esc");
    assert_eq!(watched(&console), Some(0), "first the injects are closed");
    assert!(console.screen(narrow.0, narrow.1).contains("row 05"));
}

#[test]
fn a_key_that_is_refused_leaves_the_next_key_alone() {
    let mut console = desk(Language::English);
    console.hear(ClassEvent::Left(ConnectionId(1)));
    console.press("down").press("down").press("f");
    let screen = console.screen(120, 40);
    assert!(screen.contains("no connected seat is meant"), "{screen}");
    console.press("home").press("f");
    assert_eq!(deeds(&console), [("bohdan".to_owned(), Deed::Freeze)]);
}

#[test]
fn injects_are_offered_before_seats() {
    let mut console = desk(Language::English);
    report(&mut console, 1, "anna", flight_with_injects());
    console.press("e").press("tab");
    let screen = console.screen(120, 40);
    assert!(screen.contains(": class inject gust"), "{screen}");
}

#[test]
fn arrows_move_over_a_screen_that_does_not_fit() {
    let mut console = desk(Language::English);
    console.hear(TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    });
    console.press("enter");
    send_screen(&mut console, 1, "anna", (120, 40));
    let screen = console.screen(80, 24);
    assert!(screen.contains("rows 1–21 of 40"), "{screen}");
    console.press("end").press("right").press("right");
    let screen = console.screen(80, 24);
    assert!(screen.contains("rows 20–40 of 40"), "{screen}");
    assert!(screen.contains("columns 17–96 of 120"), "{screen}");
    assert!(
        screen.contains("row 39") && !screen.contains("row 18"),
        "{screen}"
    );
    console.press("up").press("left");
    let screen = console.screen(80, 24);
    assert!(screen.contains("rows 19–39 of 40"), "{screen}");
    assert!(screen.contains("columns 9–88 of 120"), "{screen}");
}

#[test]
fn an_old_picture_says_so() {
    let mut console = desk(Language::English);
    console.press("enter");
    send_screen(&mut console, 1, "anna", (80, 24));
    pass(&mut console, 1);
    assert!(!console.screen(120, 40).contains("old:"));
    pass(&mut console, 1);
    let screen = console.screen(120, 40);
    assert!(screen.contains("old: nothing has come for 2 s"), "{screen}");
    console.hear(ClassEvent::Left(ConnectionId(1)));
    let screen = console.screen(120, 40);
    assert!(screen.contains("old: the seat has left"), "{screen}");
}

#[test]
fn the_header_of_a_seat_says_that_its_screen_is_watched() {
    let mut console = flying_mission(Stake::Graded);
    let watch = |console: &mut Console, on| {
        console.hear(ClassEvent::Said(DeskMessage::Watch { on, insight: false }));
        console.screen(120, 40)
    };
    let watching = "petro watches this screen";
    assert!(watch(&mut console, true).contains(watching));
    assert!(console.screen(80, 24).contains("petro watches"));
    assert!(!watch(&mut console, false).contains(watching));
    watch(&mut console, true);
    console.hear(ClassEvent::Lost);
    welcome(&mut console);
    assert!(!console.screen(120, 40).contains(watching));
}

#[test]
fn a_trainee_looks_on_only_when_no_flight_is_under_way() {
    for (stake, refusal) in [
        (Stake::Graded, Refusal::Flying),
        (Stake::Exam, Refusal::Exam),
    ] {
        let mut console = flying_mission(stake);
        order(&mut console, 1, Deed::LookOn);
        let refused = Outcome::Refused(refusal);
        assert_eq!(outcomes(&console), [(1, refused)]);
        assert!(!place(&console).seat().looks_on());
    }
    let mut console = joined();
    order(&mut console, 1, Deed::LookOn);
    pass(&mut console, 1);
    assert_eq!(outcomes(&console), [(1, Outcome::Done)]);
    assert_eq!(console.state().room(), Room::Class);
    let mut sender = PictureSender::default();
    let shown = picture(100, 30);
    while let Some(part) = sender.next(|| Some(shown.clone()), Duration::ZERO) {
        console.hear(ClassEvent::Said(DeskMessage::Show(part)));
    }
    console.hear(TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    });
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("petro shows") && screen.contains("row 20"),
        "{screen}"
    );
    console.press("end");
    assert!(console.screen(80, 24).contains("row 29"));
    console.press("esc");
    assert!(!place(&console).seat().looks_on());
    assert_eq!(console.state().room(), Room::Home);
    // The desk ends it, its connection breaks, or a flight begins.
    for ending in 0..3 {
        order(&mut console, 2 + ending, Deed::LookOn);
        assert!(place(&console).seat().looks_on());
        match ending {
            0 => {
                console.hear(ClassEvent::Said(DeskMessage::Hide));
            }
            1 => {
                console.hear(ClassEvent::Lost);
                welcome(&mut console);
            }
            _ => console.start(Activity::Free),
        }
        pass(&mut console, 1);
        assert!(!place(&console).seat().looks_on(), "{ending}");
        assert_ne!(console.state().room(), Room::Class, "{ending}");
    }
}
