//! Clicks with the mouse, and the search in the help.

use sortie::app::action::Action;
use sortie::app::event::TerminalEvent;
use sortie::app::state::{Overlay, Room};

use crate::harness::Console;

#[test]
fn a_click_on_a_row_moves_the_cursor_there() {
    let mut console = Console::flying(5);
    assert_eq!(console.state().session().cursor(), Some(1));
    assert!(console.click("  4 copter"));
    assert_eq!(console.state().session().cursor(), Some(4));
    assert!(!console.click("swarm"), "a rule means nothing");
}

#[test]
fn a_click_on_a_line_of_home_chooses_it_and_one_on_a_key_presses_it() {
    let mut console = Console::new();
    assert!(console.click("Connect to vehicles"));
    let shown = console.screen(120, 40);
    assert!(
        shown
            .lines()
            .any(|line| line.contains('>') && line.contains("Connect")),
        "{shown}"
    );
    assert!(console.click("? help"));
    assert!(matches!(console.state().overlay(), Some(Overlay::Help(_))));
}

#[test]
fn what_lies_over_a_room_keeps_clicks_from_it() {
    let mut console = Console::flying(2);
    console.press(":");
    console.hear(TerminalEvent::Choose(Action::Show(Room::Home)));
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn the_help_narrows_to_what_is_searched_for_until_esc_clears_it() {
    let mut console = Console::flying(1);
    console.press("?");
    let whole = console.screen(120, 40);
    assert!(whole.contains("open the command line"), "{whole}");
    console.press("/").write("takeoff");
    let found = console.screen(120, 40);
    assert!(
        found.contains("/takeoff_") && found.contains("climb"),
        "{found}"
    );
    assert!(!found.contains("open the command line"), "{found}");
    console.press("enter");
    assert!(
        console.screen(120, 40).contains("/takeoff "),
        "the search stays"
    );
    console.press("esc");
    assert_eq!(console.screen(120, 40), whole);
    console.press("esc");
    assert!(console.state().overlay().is_none());
}
