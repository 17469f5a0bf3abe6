//! Keys: the user's own bindings, and the way out of a room.

use sortie::app::state::{Overlay, Room};

use super::palette_line;
use crate::harness::Console;

/// A flight of six vehicles with a keymap file.
fn flying(keymap: &str) -> Console {
    let console = Console::set_up(|setup| {
        let read = setup.keymap.overlay(keymap, &setup.themes);
        read.expect("it is right");
    });
    console.in_flight(6)
}

#[test]
fn a_line_goes_to_whom_it_names_else_to_the_list_that_was_typed_else_to_the_selection() {
    let mut console = flying("[fly]\nz = \"arm\"\nx = \"all arm\"\n");
    assert_eq!(console.press("z").sent_to(), [1]);
    console.press("space");
    assert_eq!(console.write("2-3").press("z").sent_to(), [2, 3]);
    assert_eq!(console.press("z").sent_to(), [1]);
    assert_eq!(console.write("2-3").press("x").sent_to().len(), 6);
    assert_eq!(console.press("z").sent_to(), [1], "the list is used up");
}

#[test]
fn a_dangerous_line_asks_and_a_line_that_cannot_be_given_stays() {
    let mut console = flying("[fly]\nz = \"1-3 kill\"\nx = \"@red arm\"\n");
    console.press("z");
    assert!(console.effects.is_empty());
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Confirm(_))
    ));
    assert_eq!(console.press("3").sent_to(), [1, 2, 3]);
    console.press("x");
    assert!(console.effects.is_empty());
    assert_eq!(palette_line(&console), "@red arm");
}

#[test]
fn the_help_shows_what_the_keys_mean_now() {
    let mut console = flying("[anywhere]\nf5 = \"all rtl\"\n\"?\" = \"notices\"\nf2 = \"help\"\n");
    console.give("help");
    let screen = console.screen(120, 200);
    assert!(screen.contains("F5"), "{screen}");
    assert!(screen.contains("all rtl"), "{screen}");
    let line_of = |words: &str| {
        let mut lines = screen.lines();
        lines.find(|line| line.contains(words)).unwrap_or_default()
    };
    assert!(line_of("show this help").contains("F2"), "{screen}");
    assert!(!line_of("show this help").contains('?'), "{screen}");
}

#[test]
fn escape_leaves_the_hangar_where_no_flight_runs() {
    let mut console = Console::new();
    console.press("G");
    assert_eq!(console.state().room(), Room::Hangar);
    console.press("esc");
    assert_eq!(console.state().room(), Room::Home);
}
