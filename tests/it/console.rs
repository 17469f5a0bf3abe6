//! The console's reactions to keys and lines, as scripts.

use std::sync::Arc;

use sortie::app::effect::{Effect, Launch, SessionEffect, TerminalEffect};
use sortie::app::event::{Event, SessionEvent, TerminalEvent, VehicleEvent};
use sortie::app::state::{Activity, Overlay, Room};
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

mod alerts;
mod career;
pub mod class;
mod command_line;
mod commands;
mod forget;
mod forwards;
pub mod hangar;
mod keymap;
mod map;
mod pace;
mod palette;
mod panes;
pub mod parameters;
mod pause;
mod plans;
mod pointer;
mod radio;
mod swarm;
mod traffic;

fn selection(console: &Console) -> Vec<u16> {
    console
        .state()
        .session()
        .selection()
        .iter()
        .copied()
        .collect()
}

fn palette_line(console: &Console) -> String {
    match console.state().overlay() {
        Some(Overlay::Palette(palette)) => palette.input().value().to_owned(),
        other => panic!("the command line is not open: {other:?}"),
    }
}

#[test]
fn a_line_with_targets_goes_to_exactly_those() {
    let mut console = Console::flying(4);
    console.give("2-3 arm");
    assert_eq!(console.sent_to(), [2, 3]);
    let entry = console
        .state()
        .session()
        .ledger()
        .entries()
        .next()
        .expect("an entry");
    assert_eq!((entry.line.as_str(), entry.rows.len()), ("2-3 arm", 2));
}

#[test]
fn a_line_without_targets_goes_to_the_selection_else_to_the_cursor() {
    let mut console = Console::flying(6);
    console.press("j").give("arm");
    assert_eq!(console.sent_to(), [2]);
    console.write("1,4-5").press("enter").give("arm");
    assert_eq!(console.sent_to(), [1, 4, 5]);
    let entry = console
        .state()
        .session()
        .ledger()
        .entries()
        .next_back()
        .expect("an entry");
    assert_eq!(entry.line, "1,4-5 arm", "the ledger names them");
}

#[test]
fn vehicles_are_selected_by_numbers_space_star_and_exclamation_mark() {
    let mut console = Console::flying(9);
    assert_eq!(
        selection(console.write("3-9").press("enter")),
        [3, 4, 5, 6, 7, 8, 9]
    );
    assert_eq!(selection(console.press("!")), [1, 2]);
    assert_eq!(
        selection(console.press("space")),
        [1, 2, 3],
        "the cursor was on 3"
    );
    assert_eq!(selection(console.press("*")).len(), 9);
    assert!(selection(console.press("esc")).is_empty());
    console.write("2-3").press("enter");
    console.write("17-19").press("enter");
    assert_eq!(
        console
            .state()
            .message()
            .map(|it| it.text.to_string())
            .as_deref(),
        Some("no vehicle 17-19: the selection is unchanged")
    );
    assert_eq!(selection(&console), [2, 3]);
    assert_eq!(selection(console.write("9-11").press("enter")), [9]);
}

#[test]
fn keys_that_nobody_can_see_the_effect_of_do_nothing() {
    let small = TerminalEvent::Resize {
        columns: 79,
        rows: 24,
    };
    let large = TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    };
    let mut console = Console::flying(3);
    console.give("1 kill").hear(small.clone());
    console.press("1");
    assert!(console.effects.is_empty(), "the question is gone");
    console.give("all arm").press("*").press("j");
    console.hear(TerminalEvent::Paste("1 arm".to_owned()));
    assert!(console.effects.is_empty() && selection(&console).is_empty());
    assert_eq!(console.state().session().cursor(), Some(1));
    console.hear(large).press("1");
    assert!(console.effects.is_empty(), "it does not come back");
    console.press("esc").press(":").write("1 arm").hear(small);
    assert!(console.press("enter").effects.is_empty());
    assert_eq!(palette_line(&console), "1 arm", "a line waits");
    assert_eq!(console.press("ctrl-c").effects, [Effect::Quit]);
}

#[test]
fn the_home_screen_starts_what_is_under_the_cursor() {
    let mut console = Console::new();
    assert_eq!(
        console.press("enter").effects,
        [Effect::Session(SessionEffect::StartMission(
            Launch::graded("m01")
        ))]
    );
    assert_eq!(
        console.press("j").press("enter").effects,
        [Effect::Session(SessionEffect::StartFree)]
    );
    console
        .press("j")
        .press("enter")
        .write("tcp:1.2.3.4:5760 udpin::14550");
    let addresses = ["tcp:1.2.3.4:5760", "udpin::14550"]
        .map(str::to_owned)
        .to_vec();
    assert_eq!(
        console.press("enter").effects,
        [Effect::Session(SessionEffect::Connect(addresses))]
    );
    assert!(
        console.state().overlay().is_some(),
        "the prompt waits for the outcome"
    );
    console.start(Activity::Connected {
        addresses: Vec::new(),
    });
    assert!(console.state().overlay().is_none());
    assert!(console.state().room() == Room::Fly);
}

#[test]
fn what_would_be_lost_is_asked_about() {
    let mut console = Console::flying(1);
    assert_eq!(
        console.give("quit").effects,
        [Effect::Quit],
        "nothing is armed"
    );
    console.vehicle(fixtures::airborne(1, 0.0, 10.0));
    assert!(console.press("ctrl-c").effects.is_empty());
    assert_eq!(console.press("y").effects, [Effect::Quit]);
    assert!(console.give("leave").effects.is_empty());
    assert_eq!(
        console.press("y").effects,
        [Effect::Session(SessionEffect::Leave)]
    );
    assert!(console.state().room() == Room::Home);
    assert!(console.state().session().vehicles().is_empty());
    console.vehicle(fixtures::parked(1));
    assert!(
        console.state().session().vehicles().is_empty(),
        "late telemetry belongs to nobody"
    );
}

#[test]
fn keys_meant_for_the_flight_do_not_close_the_debrief() {
    let mut console = Console::flying(1);
    console
        .at(100)
        .hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert!(console.press("h").effects.is_empty());
    assert!(console.state().room() == Room::Debrief);
    let footer = "keys are ignored for a moment";
    assert!(console.screen(80, 24).contains(footer));
    let before = console.state().revision();
    console.hear(Event::Tick {
        now: std::time::Duration::from_millis(101_050),
        wall: std::time::Duration::from_millis(101_050),
    });
    assert!(console.state().revision() > before);
    assert!(!console.screen(80, 24).contains(footer));
    assert_eq!(
        console.press("h").effects,
        [Effect::Session(SessionEffect::Leave)]
    );
}

#[test]
fn a_line_being_typed_survives_the_end_of_the_mission() {
    let mut console = Console::flying(1);
    console.press(":").write("1 r");
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.write("tl");
    assert_eq!(palette_line(&console), "1 rtl");
}

#[test]
fn only_visible_changes_move_the_revision() {
    let mut console = Console::flying(2);
    console.at(5);
    let before = console.state().revision();
    console.hear(Event::Tick {
        now: std::time::Duration::from_millis(5400),
        wall: std::time::Duration::from_millis(5400),
    });
    let same = Arc::clone(&console.state().session().vehicles()[&1]);
    console.hear(Event::Vehicle(VehicleEvent::Telemetry(same)));
    assert_eq!(console.state().revision(), before);
    console.at(6);
    assert!(console.state().revision() > before);
}

#[test]
fn the_cursor_begins_on_the_first_vehicle_and_stays_where_it_was_put() {
    let mut console = Console::flying(0);
    console
        .vehicle(fixtures::parked(4))
        .vehicle(fixtures::parked(2));
    assert_eq!(console.state().session().cursor(), Some(2));
    console.press("j").vehicle(fixtures::parked(1));
    assert_eq!(console.state().session().cursor(), Some(4));
}

#[test]
fn serious_notices_ring_the_bell() {
    let mut console = Console::flying(1);
    console.notice(Severity::Warning, Some(1), "low");
    assert!(console.effects.is_empty());
    console.notice(Severity::Critical, Some(1), "EKF failsafe");
    assert_eq!(console.effects, [Effect::Terminal(TerminalEffect::Bell)]);
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(60))]
    #[test]
    fn no_sequence_of_keys_breaks_the_console(
        keys in proptest::collection::vec(proptest::sample::select(KEYS), 1..80),
    ) {
        let mut console = Console::flying(3);
        for key in keys {
            console.press(key);
            let effects = std::mem::take(&mut console.effects);
            if effects.contains(&Effect::Session(SessionEffect::Leave)) {
                proptest::prop_assert!(console.state().session().activity().is_none());
            }
            proptest::prop_assert!(!effects.iter().any(is_kill), "killed without its question");
        }
        console.screen(80, 24);
    }
}

/// Keys without digits, so that no question about a kill can be answered.
const KEYS: &[&str] = &[
    ":",
    "?",
    "*",
    "!",
    "space",
    "enter",
    "esc",
    "tab",
    "shift-tab",
    "up",
    "down",
    "left",
    "end",
    "backspace",
    "a",
    "l",
    "k",
    "i",
    "q",
    "u",
    "t",
    "y",
    "h",
    "r",
    "b",
    "c",
    "n",
    "L",
    "j",
    "-",
    ",",
    "@",
    "ж",
    "/",
    "s",
    "S",
    "x",
    "C",
    "F",
    "o",
    "v",
    "ctrl-c",
    "ctrl-p",
    "ctrl-w",
    "ctrl-u",
];

fn is_kill(effect: &Effect) -> bool {
    matches!(effect, Effect::Order { order, .. } if order.verb.name == "kill")
}
