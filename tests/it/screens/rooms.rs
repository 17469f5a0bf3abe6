//! Every room in every language, at usual sizes, with and without colours.

use std::sync::Arc;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::style::Color;
use sortie::app::state::Room;
use sortie::text::Language;
use sortie::ui::{self, ColourDepth, Look, Theme};

use super::busy_in;
use crate::harness::Console;

/// The sizes of an ordinary terminal and of a large one.
const SIZES: [(u16, u16); 2] = [(80, 24), (120, 40)];
const ODD_SIZES: [(u16, u16); 3] = [(60, 20), (200, 50), (300, 100)];

fn in_room(room: Room, language: Language) -> Console {
    let mut console = busy_in(language);
    console.press("esc").give(&format!("show {}", room.name()));
    console
}

fn drawn(console: &Console, (width, height): (u16, u16), theme: Theme) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a test terminal");
    let look = Look {
        theme,
        locale: Arc::clone(console.state().locale()),
        ..Look::default()
    };
    terminal
        .draw(|frame| ui::draw(console.state(), &look, frame))
        .expect("a test terminal");
    terminal.backend().buffer().clone()
}

#[test]
fn every_room_in_both_languages() {
    for room in Room::ALL {
        for language in Language::ALL {
            let console = in_room(room, language);
            for (width, height) in SIZES {
                let (room, language) = (room.name(), language.code());
                let name = format!("room_{room}_{language}_{width}x{height}");
                insta::assert_snapshot!(name, console.screen(width, height));
            }
        }
    }
}

#[test]
fn a_room_without_colours_says_the_same() {
    for room in Room::ALL {
        let console = in_room(room, Language::English);
        for size in SIZES {
            let coloured = drawn(&console, size, Theme::default());
            let plain = drawn(
                &console,
                size,
                Theme::default().for_colours(ColourDepth::None),
            );
            let words = |buffer: &Buffer| -> String {
                let cells = buffer.content.iter();
                cells.map(ratatui::buffer::Cell::symbol).collect()
            };
            assert_eq!(words(&coloured), words(&plain), "{}", room.name());
            let reset = |colour| colour == Color::Reset;
            let is_plain = plain
                .content
                .iter()
                .all(|cell| reset(cell.fg) && reset(cell.bg));
            assert!(is_plain, "{}", room.name());
        }
    }
}

#[test]
fn every_room_fits_every_size() {
    for room in Room::ALL {
        for language in Language::ALL {
            let console = in_room(room, language);
            for size in ODD_SIZES {
                let buffer = drawn(&console, size, Theme::default());
                let is_empty = buffer.content.iter().all(|cell| cell.symbol() == " ");
                assert!(!is_empty, "{} at {size:?}", room.name());
            }
        }
    }
}
