//! The table: order, filter, groups, selection.

use sortie::app::effect::{Effect, TerminalEffect};
use sortie::app::event::TerminalEvent;
use sortie::app::state::Overlay;
use sortie::vehicle::Vehicle;

use super::selection;
use crate::fixtures;
use crate::harness::Console;

fn rows(console: &Console) -> Vec<u16> {
    console.state().rooms().fly().rows().to_vec()
}

fn charged(id: u16, percent: u8) -> Vehicle {
    let mut vehicle = fixtures::parked(id);
    vehicle.batteries[0].remaining_percent = Some(percent);
    vehicle
}

fn message(console: &Console) -> String {
    let message = console.state().message();
    message.map_or(String::new(), |message| message.text.to_string())
}

#[test]
fn the_table_is_ordered_by_any_column_in_either_direction() {
    let mut console = Console::flying(4);
    for (id, percent) in [(1, 50), (2, 80), (3, 30), (4, 60)] {
        console.vehicle(charged(id, percent));
    }
    assert_eq!(rows(&console), [1, 2, 3, 4]);
    console.give("sort bat");
    assert_eq!(rows(&console), [3, 1, 4, 2]);
    assert_eq!(rows(console.press("S")), [2, 4, 1, 3]);
    assert!(console.screen(80, 24).contains("by -bat"));
    console.give("sort -id");
    assert_eq!(rows(&console), [4, 3, 2, 1]);
    console.give("sort");
    assert_eq!(rows(&console), [1, 2, 3, 4]);
    console.press("s");
    assert!(message(&console).contains("sorted by alert"));
    console.give("sort colour");
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Palette(_))
    ));
    assert!(console.screen(120, 40).contains("unknown column `colour`"));
}

#[test]
fn rows_move_at_most_once_a_second_and_not_for_noise() {
    let mut console = Console::flying(3);
    for (id, percent) in [(1, 50), (2, 60), (3, 70)] {
        console.vehicle(charged(id, percent));
    }
    console.at(10).give("sort bat");
    console.vehicle(charged(3, 20));
    assert_eq!(rows(&console), [1, 2, 3], "not yet");
    assert_eq!(rows(console.at(11)), [3, 1, 2]);
    console.vehicle(charged(2, 49)).vehicle(charged(1, 51));
    assert_eq!(rows(console.at(12)), [3, 2, 1], "2 has lost much");
    console.vehicle(charged(2, 50));
    console.vehicle(charged(1, 49));
    assert_eq!(rows(console.at(13)), [3, 2, 1], "a percent is noise");
}

#[test]
fn the_cursor_keeps_its_vehicle_when_the_order_changes() {
    let mut console = Console::flying(30);
    console.vehicle(charged(30, 5));
    console.press("j").press("j");
    assert_eq!(console.state().session().cursor(), Some(3));
    console.give("sort -id");
    assert_eq!(console.state().session().cursor(), Some(3));
    assert_eq!(console.press("j").state().session().cursor(), Some(2));
    assert_eq!(console.press("home").state().session().cursor(), Some(30));
}

#[test]
fn typing_filters_and_what_fits_nothing_is_counted() {
    let mut console = Console::flying(12);
    for id in 7..=12 {
        console.vehicle(fixtures::airborne(id, 10.0, 20.0));
    }
    console.press("/").write("arm");
    assert_eq!(rows(&console), [7, 8, 9, 10, 11, 12], "at every key");
    assert!(console.screen(80, 24).contains("6 of 12 match \"arm\""));
    assert_eq!(
        console.state().session().cursor(),
        Some(7),
        "on something shown"
    );
    console.press("ctrl-u").write("фкь");
    assert_eq!(rows(&console), [7, 8, 9, 10, 11, 12], "by its keys");
    console.press("ctrl-u").write("arm");
    console.write(" !9").press("enter");
    assert_eq!(rows(&console), [7, 8, 10, 11, 12]);
    assert_eq!(selection(console.press("*")), [7, 8, 10, 11, 12]);
    console.give("filter nonsense");
    assert!(
        console
            .screen(80, 24)
            .contains("no vehicle matches \"nonsense\"")
    );
    assert!(console.screen(120, 40).contains("(5 hidden)"));
    console.press("esc");
    assert!(
        selection(&console).is_empty(),
        "Esc takes the selection first"
    );
    assert_eq!(console.press("esc").state().rooms().fly().rows().len(), 12);
}

#[test]
fn a_vehicle_under_the_cursor_stays_in_sight_while_the_filter_is_kept() {
    let mut console = Console::flying(3);
    console.give("filter ground");
    console.press("j").at(5);
    for id in 1..=3 {
        console.vehicle(fixtures::airborne(id, 0.0, 10.0));
    }
    assert_eq!(rows(console.at(7)), [2]);
    assert_eq!(console.state().session().cursor(), Some(2));
    console.vehicle(fixtures::parked(9));
    assert_eq!(rows(&console), [2, 9], "what is new is there at once");
}

#[test]
fn groups_are_named_shown_selected_and_dissolved() {
    let mut console = Console::flying(6);
    assert!(!console.screen(80, 24).contains("group"));
    console.give("group red 1-3").give("group blue 3-4");
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("group") && screen.contains("blue"),
        "{screen}"
    );
    console.give("select @red");
    assert_eq!(selection(&console), [1, 2, 3]);
    assert!(console.screen(80, 24).contains("selected 3: 1-3 @red"));
    console.press("@").write("blue").press("enter");
    assert_eq!(selection(&console), [3, 4]);
    console.give("filter @blue").give("select filter");
    assert_eq!(selection(&console), [3, 4]);
    console.give("filter").give("select invert");
    assert_eq!(selection(&console), [1, 2, 5, 6]);
    console.give("ungroup blue");
    console.give("select @blue");
    assert!(console.screen(120, 40).contains("no group `blue`"));
}

#[test]
fn columns_are_chosen_by_name() {
    let mut console = Console::flying(2);
    console.give("columns id volt bat");
    let screen = console.screen(80, 24);
    let titles = screen.lines().nth(2).expect("titles");
    assert_eq!(
        titles.split_whitespace().collect::<Vec<_>>(),
        ["id", "volt", "bat"]
    );
    console.give("columns id colour");
    assert!(
        console
            .screen(120, 40)
            .contains("expected COLUMN (id, name, group")
    );
    console.press("esc");
    console.give("columns");
    assert!(console.screen(80, 24).contains("alert"));
}

#[test]
fn a_paste_without_a_line_to_go_to_is_told() {
    let mut console = Console::flying(1);
    console.hear(TerminalEvent::Paste("1 arm\n".to_owned()));
    assert!(
        console
            .effects
            .iter()
            .all(|effect| *effect == Effect::Terminal(TerminalEffect::Bell))
    );
    assert!(message(&console).contains("nothing was pasted"));
}

#[test]
fn a_long_wrong_word_leaves_room_for_what_is_wrong_with_it() {
    let mut console = Console::flying(1);
    console.give(&format!("1 {}", "x".repeat(300)));
    let screen = console.screen(80, 24);
    assert!(screen.contains("xxx…`"), "{screen}");
    let fault = console.state().overlay().and_then(|overlay| match overlay {
        Overlay::Palette(palette) => palette.fault(),
        _ => None,
    });
    let said = fault.expect("a fault").message.to_string();
    let end = said.rsplit('`').next().expect("words after it").trim();
    assert!(screen.contains(end), "{end:?}: {screen}");
}
