//! The screen of a seat, watched at the desk.

use std::time::Duration;

use sortie::app::event::{ClassEvent, TerminalEvent};
use sortie::campaign::Stake;
use sortie::class::protocol::{DeskMessage, SeatMessage};
use sortie::class::{CellStyle, ConnectionId, Deed, Picture, PictureCell, PictureSender};
use sortie::text::Language;

use super::desk::{deeds, desk, say};
use super::{flying_mission, pass, welcome};
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
    desk.expect("it is a desk").watched()
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
        console.hear(ClassEvent::Said(DeskMessage::Watch { on }));
        console.screen(120, 40)
    };
    let watching = "petro watches this screen";
    assert!(watch(&mut console, true).contains(watching));
    assert!(console.screen(80, 24).contains("watched"));
    assert!(!watch(&mut console, false).contains(watching));
    watch(&mut console, true);
    console.hear(ClassEvent::Lost);
    welcome(&mut console);
    assert!(!console.screen(120, 40).contains(watching));
}
