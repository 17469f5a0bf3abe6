//! The flight screen and the room of commands, in trouble, in colour and without, in both languages.

use std::sync::Arc;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::style::Color;
use sortie::text::{Language, Locale};
use sortie::ui::{self, Look, Theme};

use super::{busy, busy_in};
use crate::fixtures;
use crate::harness::Console;

/// The screen with a look, and whether it has any colour.
fn seen(console: &Console, look: &Look, (width, height): (u16, u16)) -> (String, bool) {
    let backend = TestBackend::new(width, height);
    let mut terminal = Terminal::new(backend).expect("a test terminal");
    terminal
        .draw(|frame| ui::draw(console.state(), look, frame))
        .expect("a test terminal");
    let cells = &terminal.backend().buffer().content;
    let rows = cells.chunks(usize::from(width));
    let lines = rows.map(|row| {
        let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    });
    let plain = |cell: &ratatui::buffer::Cell| cell.fg == Color::Reset && cell.bg == Color::Reset;
    (
        lines.collect::<Vec<_>>().join("\n"),
        !cells.iter().all(plain),
    )
}

fn ukrainian() -> Look {
    Look {
        locale: Arc::new(Locale::new(Language::Ukrainian)),
        ..Look::default()
    }
}

/// Groups, a filter, an order, and alerts both acknowledged and not.
fn sorted() -> Console {
    let mut console = busy();
    let mut low = fixtures::airborne(5, 60.0, 12.0);
    low.batteries[0].remaining_percent = Some(9);
    console.at(200).vehicle(low);
    console.give("group red 1-3").give("select @red");
    console.give("ack 3").give("sort alert").give("filter !4");
    console
}

/// A copter, a boat under way and a rover that stands; the cursor is on the boat.
fn mixed(language: Language) -> Console {
    let mut console = busy_in(language);
    console.at(200).vehicle(fixtures::on_surface(2, true));
    console.vehicle(fixtures::on_surface(3, false));
    console.give("select 2");
    console
}

#[test]
fn rovers_and_boats_move_or_stand_and_have_no_height() {
    for (language, name) in [(Language::English, "en"), (Language::Ukrainian, "uk")] {
        for (width, height) in [(80, 24), (200, 50)] {
            let screen = mixed(language).screen(width, height);
            insta::assert_snapshot!(format!("fly_surface_{name}_{width}x{height}"), screen);
        }
    }
}

#[test]
fn the_table_in_order_with_groups_filter_and_alerts() {
    for (width, height) in [(80, 24), (120, 40), (200, 50)] {
        let screen = sorted().screen(width, height);
        insta::assert_snapshot!(format!("fly_sorted_{width}x{height}"), screen);
    }
}

#[test]
fn the_flight_screen_in_ukrainian_is_aligned_and_whole() {
    for (width, height) in [(80, 24), (120, 40), (200, 50)] {
        let (screen, _) = seen(&sorted(), &ukrainian(), (width, height));
        insta::assert_snapshot!(format!("fly_ukrainian_{width}x{height}"), screen);
    }
}

#[test]
fn the_room_of_commands_in_both_languages() {
    let mut console = busy();
    console.press("C").press("k");
    for (width, height) in [(120, 40), (200, 50)] {
        let screen = console.screen(width, height);
        insta::assert_snapshot!(format!("commands_{width}x{height}"), screen);
    }
    let (screen, _) = seen(&console, &ukrainian(), (80, 24));
    insta::assert_snapshot!("commands_ukrainian_80x24", screen);
    let screen = console.press("enter").screen(80, 24);
    insta::assert_snapshot!("commands_opened_80x24", screen);
}

#[test]
fn without_colour_nothing_is_lost() {
    let look = Look {
        theme: Theme::named("monochrome").expect("a theme"),
        ..Look::default()
    };
    let console = sorted();
    let (screen, has_colour) = seen(&console, &look, (80, 24));
    assert!(!has_colour);
    assert_eq!(screen, console.screen(80, 24));
    assert!(
        screen.contains("! BATTERY 9 %") && screen.contains(" LINK LOST"),
        "{screen}"
    );
}
