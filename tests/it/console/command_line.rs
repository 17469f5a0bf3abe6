//! The command line, and the questions that it asks.

use sortie::app::effect::{Effect, TerminalEffect};
use sortie::app::event::{SessionEvent, TerminalEvent};
use sortie::app::state::{Overlay, Room};
use sortie::vehicle::AnnouncedMode;

use super::{palette_line, selection};
use crate::fixtures;
use crate::harness::Console;

fn fault_word(console: &Console) -> String {
    match console.state().overlay() {
        Some(Overlay::Palette(palette)) => {
            let fault = palette.fault().expect("a fault");
            palette.input().value()[fault.span.clone()].to_owned()
        }
        other => panic!("the command line is not open: {other:?}"),
    }
}

#[test]
fn quick_keys_only_write_a_line() {
    let mut console = Console::flying(2);
    console.press("a");
    assert!(console.effects.is_empty());
    assert_eq!(palette_line(&console), "arm");
    console.press("enter");
    assert_eq!(console.sent_to(), [1]);
    console.write("1-2").press("t").write("20").press("enter");
    assert_eq!(
        console.sent_to(),
        [1, 2],
        "numbers typed before the key become the targets"
    );
}

#[test]
fn a_dangerous_verb_wants_the_number_of_its_targets() {
    let mut console = Console::flying(5);
    console.give("1,3,5 kill");
    assert!(console.effects.is_empty());
    let asked = "KILL vehicles 1 3 5 - press 3 (vehicle count)";
    assert!(console.screen(80, 24).contains(asked));
    console.press("3");
    assert_eq!(console.sent_to(), [1, 3, 5]);
    for wrong in ["5", "enter", "y", "esc", "ctrl-c", "left"] {
        console.give("1,3,5 kill").press(wrong);
        assert!(console.effects.is_empty(), "{wrong}");
        console.press("3");
        assert!(console.effects.is_empty(), "no is no after {wrong}");
        console.press("esc").press("esc");
        assert!(console.state().overlay().is_none(), "{wrong}");
    }
    let mut console = Console::flying(12);
    console.give("all kill").press("1");
    assert!(console.effects.is_empty());
    assert_eq!(console.press("2").sent_to().len(), 12);
}

#[test]
fn keys_after_a_wrong_answer_reach_nothing_until_enter_or_escape() {
    for end in ["enter", "esc"] {
        let mut console = Console::flying(3);
        console.give("1 kill").write("2 l3-*a1");
        assert!(console.screen(80, 24).contains("Enter or Esc: back"));
        console.press(end);
        assert!(console.effects.is_empty());
        assert!(console.state().overlay().is_none(), "{end}");
        assert!(selection(&console).is_empty());
        console.write("2").press("enter");
        assert_eq!(selection(&console), [2], "keys work again after {end}");
    }
}

#[test]
fn a_line_begun_over_a_question_is_taken_as_a_line() {
    let mut console = Console::flying(3);
    console.give("1 kill").write(":2 land");
    assert_eq!(palette_line(&console), "2 land");
    assert_eq!(console.press("enter").sent_to(), [2]);
    assert!(selection(&console).is_empty());
}

#[test]
fn a_question_of_yes_or_no_takes_n_at_once() {
    let mut console = Console::flying(1);
    console.vehicle(fixtures::airborne(1, 0.0, 10.0));
    console.press("ctrl-c").press("n");
    assert!(console.state().overlay().is_none() && console.effects.is_empty());
}

#[test]
fn the_key_of_y_confirms_in_the_ukrainian_layout_too() {
    for (letter, is_yes) in [("н", true), ("Н", true), ("т", false), ("й", false)] {
        let mut console = Console::flying(1);
        console.vehicle(fixtures::airborne(1, 0.0, 10.0));
        console.press("ctrl-c").write(letter);
        assert_eq!(!console.effects.is_empty(), is_yes, "{letter}");
    }
}

#[test]
fn a_question_in_ukrainian_names_the_key_of_y_in_both_layouts() {
    let mut console = Console::flying(1);
    console.vehicle(fixtures::airborne(1, 0.0, 10.0));
    console.give("set lang uk").press("ctrl-c");
    let screen = console.screen(80, 24);
    assert!(screen.contains("натисніть y (н)"), "{screen}");
    console.press("esc").give("1 kill");
    let screen = console.screen(80, 24);
    assert!(screen.contains("натисніть 1 ("), "{screen}");
}

#[test]
fn an_enter_that_is_added_to_an_answer_is_not_meant_for_what_follows() {
    for (later_s, is_meant) in [(0, false), (2, true)] {
        let mut console = Console::flying(1);
        console.vehicle(fixtures::airborne(1, 0.0, 10.0));
        console.at(100).give("leave").press("y");
        assert_eq!(console.state().room(), Room::Home);
        console.at(100 + later_s).press("enter");
        let has_begun = !console.effects.is_empty() || console.state().room() != Room::Home;
        assert_eq!(has_begun, is_meant, "{later_s} s");
    }
}

#[test]
fn an_enter_added_to_the_answer_about_an_order_does_nothing_in_the_room() {
    let mut console = Console::flying(1);
    console.press("P").at(100).give("reboot").press("1");
    assert_eq!(console.sent_to(), [1]);
    console.at(100).press("enter");
    assert!(console.state().overlay().is_none());
}

#[test]
fn a_wrong_line_stays_with_the_wrong_word_marked() {
    let mut console = Console::flying(4);
    for (line, word) in [
        ("1-2 takeof 20", "takeof"),
        ("all takeoff high", "high"),
        ("7 arm", "7"),
        ("@red arm", "@red"),
        ("theme drak", "drak"),
        ("select 1-x", "1-x"),
    ] {
        console.give(line);
        assert!(console.effects.is_empty(), "{line}");
        assert_eq!(palette_line(&console), line);
        assert_eq!(fault_word(&console), word, "{line}");
        console.press("esc");
    }
    assert!(
        console.state().typing().last_line().is_none(),
        "a line that did nothing is not history"
    );
    assert_eq!(console.state().session().ledger().entries().len(), 0);
}

#[test]
fn a_finished_word_that_is_wrong_is_marked_while_the_line_is_written() {
    let fault = |console: &Console| match console.state().overlay() {
        Some(Overlay::Palette(palette)) => palette
            .fault()
            .map(|fault| palette.input().value()[fault.span.clone()].to_owned()),
        other => panic!("the command line is not open: {other:?}"),
    };
    let mut console = Console::flying(4);
    console.press(":").write("1-2 takeof");
    assert_eq!(fault(&console), None, "it may become `takeoff`");
    console.write(" ");
    assert_eq!(fault(&console).as_deref(), Some("takeof"));
    console.press("left");
    assert_eq!(fault(&console), None, "it is being mended");
    console.press("ctrl-u").press("end").press("ctrl-u");
    console.write("1 takeoff high ");
    assert_eq!(fault(&console).as_deref(), Some("high"));
    let screen = console.screen(80, 24);
    assert!(screen.contains("takeoff ALTITUDE"), "its usage: {screen}");
}

#[test]
fn no_line_is_marked_on_the_way_to_a_right_one() {
    for line in [
        "1-4 goto n 100 e 50 up 30 ",
        "1,3 goto 50.4501 30.5234 up 40 ",
        "all takeoff 20 ",
        "1 mode loiter ",
        "2 param get WPNAV_SPEED ",
        "2 param set WPNAV_SPEED 700 ",
        "1 servo 5 1500 ",
        "1 yaw 90 ",
        "1 home here ",
        "theme dark ",
        "group red 1-3 ",
        "select 1-3 ",
        "all guided ",
        "kill ",
    ] {
        let mut console = Console::flying(4);
        console.press(":");
        for c in line.chars() {
            console.press(&c.to_string());
            let Some(Overlay::Palette(palette)) = console.state().overlay() else {
                panic!("the command line has closed");
            };
            let written = palette.input().value();
            assert_eq!(palette.fault(), None, "{written}");
        }
    }
}

#[test]
fn a_complete_line_says_to_whom_it_goes() {
    let mut console = Console::flying(4);
    console.press(":").write("all takeoff ");
    assert!(!console.screen(80, 24).contains("Enter sends"));
    console.write("20");
    assert!(console.screen(80, 24).contains("Enter sends to 1-4"));
    console.press("ctrl-u").write("2-3 kill");
    assert!(
        console
            .screen(80, 24)
            .contains("Enter sends to 2-3 once you confirm")
    );
}

#[test]
fn waiting_is_for_pilot_scripts() {
    let mut console = Console::flying(1);
    console.give("wait all armed");
    assert_eq!(fault_word(&console), "wait");
    assert!(
        console
            .screen(80, 24)
            .contains("`wait` is for pilot scripts")
    );
}

#[test]
fn commands_without_vehicles_are_refused_on_the_spot() {
    let mut console = Console::new();
    for line in ["arm", "all arm", "1 arm"] {
        console.give(line);
        assert!(console.effects.is_empty(), "{line}");
        assert!(!fault_word(&console).is_empty(), "{line}");
        console.press("esc");
    }
}

#[test]
fn tab_completes_and_goes_round() {
    let mut console = Console::flying(2);
    console.press(":").write("theme ").press("tab");
    assert_eq!(palette_line(&console), "theme dark ");
    console.press("tab");
    assert_eq!(palette_line(&console), "theme light ");
    console.press("shift-tab").press("shift-tab");
    assert_eq!(palette_line(&console), "theme monochrome ");
    console.press("enter");
    assert_eq!(
        console.effects,
        [Effect::Terminal(TerminalEffect::SetTheme(
            "monochrome".to_owned()
        ))]
    );
    console.press(":").write("all tko").press("tab");
    assert!(
        palette_line(&console).starts_with("all takeoff "),
        "{}",
        palette_line(&console)
    );
}

#[test]
fn the_arrows_bring_older_lines_back_and_return_to_the_draft() {
    let mut console = Console::flying(2);
    console.give("1 arm").give("2 arm");
    console.press(":").write("1 ta").press("up");
    assert_eq!(palette_line(&console), "2 arm");
    console.press("up").press("up");
    assert_eq!(palette_line(&console), "1 arm");
    console.press("down").press("down");
    assert_eq!(palette_line(&console), "1 ta");
}

#[test]
fn groups_and_selections_are_made_on_the_command_line() {
    let mut console = Console::flying(4);
    console.give("group red 2-3").give("@red arm");
    assert_eq!(console.sent_to(), [2, 3]);
    assert_eq!(selection(console.give("select @red")), [2, 3]);
    assert!(selection(console.give("select none")).is_empty());
}

#[test]
fn a_line_takes_no_more_than_anybody_could_mean() {
    let mut console = Console::flying(2);
    console.press(":").write(&"a".repeat(450));
    assert_eq!(palette_line(&console).len(), 400);
    console.press("backspace").write("bc");
    assert!(
        palette_line(&console).ends_with("ab"),
        "there was room for one"
    );
}

#[test]
fn what_the_console_has_said_goes_with_what_it_was_about() {
    let said = |console: &Console| console.state().message().is_some();
    let refused = || {
        let mut console = Console::flying(2);
        console.give("1 kill").press("n").press("esc");
        assert!(said(&console));
        console
    };
    assert!(!said(refused().press(":")), "an overlay opens");
    assert!(!said(refused().press("M")), "another room is shown");
    assert!(!said(refused().press("x").press("M")), "even after another");
    assert!(!said(refused().at(5)), "an acknowledgement is brief");
    let mut console = refused();
    console.hear(TerminalEvent::Line("1 arm".to_owned()));
    assert!(!said(&console), "another line is given");
    let mut console = refused();
    let report = Box::new(fixtures::report());
    console.hear(SessionEvent::MissionEnded(report));
    assert!(!said(&console), "the debrief opens");
}

#[test]
fn lines_are_never_glued_together_by_a_paste() {
    for pasted in ["all guided\nall arm\n", "all guided\rall arm", "a\r\nb"] {
        let mut console = Console::flying(2);
        console.press(":");
        console.hear(TerminalEvent::Paste(pasted.to_owned()));
        assert_eq!(palette_line(&console), "", "{pasted:?}");
        let told = "nothing was pasted: the text has 2 lines";
        assert!(console.screen(120, 40).contains(told), "{pasted:?}");
        console.hear(TerminalEvent::Paste("all arm\r\n".to_owned()));
        assert_eq!(palette_line(&console), "all arm");
    }
}

#[test]
fn keys_work_in_a_ukrainian_layout_and_letters_stay_letters_in_a_line() {
    let mut console = Console::flying(2);
    console.press("Ж");
    assert_eq!(palette_line(&console), "");
    console.write("злет");
    assert_eq!(palette_line(&console), "злет");
    console.press("esc").press("ф");
    assert_eq!(palette_line(&console), "arm", "ф lies on the key of a");
}

#[test]
fn signs_count_by_their_keys_where_they_mean_nothing_else() {
    let mut console = Console::flying(2);
    console.press("\"");
    assert_eq!(palette_line(&console), "select @");
    console.press("esc").press(".");
    assert!(matches!(
        console.state().overlay(),
        Some(Overlay::Prompt(_))
    ));
    console.press("esc").press(",");
    assert!(matches!(console.state().overlay(), Some(Overlay::Help(_))));
    console.press("esc").write("1,2").press("enter");
    assert_eq!(
        selection(&console),
        [1, 2],
        "a comma in a list stays a comma"
    );
    console.press("M").press(".");
    assert!(console.state().overlay().is_none(), "it centres the map");
}

#[test]
fn the_modes_that_a_vehicle_announces_have_its_names() {
    let mut console = Console::flying(1);
    let mut vehicle = fixtures::parked(1);
    for (index, number, name, is_selectable) in [
        (1, 65, "LAWN_MOWER", true),
        (2, 66, "HIDE", false),
        (3, 0, "STEERED", true),
    ] {
        let mode = AnnouncedMode {
            index,
            number,
            name: name.to_owned(),
            is_selectable,
        };
        vehicle.modes.add(mode, 3);
    }
    vehicle.intended_mode = Some(65);
    console.vehicle(vehicle);
    assert!(console.screen(80, 24).contains("STEERED"));
    let screen = console.press("V").screen(80, 24);
    assert!(screen.contains("STEERED (set: LAWN_MOWER)"), "{screen}");
    let screen = console.press("F").press("m").screen(80, 24);
    assert!(screen.contains("LAWN_MOWER"), "{screen}");
    assert!(
        !screen.contains("HIDE") && !screen.contains("STABILIZE"),
        "{screen}"
    );
    console.press("esc").give("1 mode lawnmower");
    assert_eq!(console.sent_to(), [1]);
}

/// A line typed below open notices was once lost.
#[test]
fn the_command_line_opens_from_the_notices_too() {
    let mut console = Console::flying(1);
    console
        .press("n")
        .press(":")
        .write("1 guided")
        .press("enter");
    assert_eq!(console.sent_to(), [1]);
}
