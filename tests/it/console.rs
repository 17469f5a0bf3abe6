//! What the console does with keys and lines, told as scripts.

use sortie::app::effect::Effect;
use sortie::app::event::Event;
use sortie::app::state::{Activity, LinkSummary, Overlay, Screen};
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

fn selection(console: &Console) -> Vec<u16> {
    console.state.session.selection.iter().copied().collect()
}

fn palette_line(console: &Console) -> String {
    match &console.state.overlay {
        Some(Overlay::Palette(palette)) => palette.input.value().to_owned(),
        other => panic!("the command line is not open: {other:?}"),
    }
}

fn fault_word(console: &Console) -> String {
    match &console.state.overlay {
        Some(Overlay::Palette(palette)) => {
            let fault = palette.fault.as_ref().expect("a fault");
            palette.input.value()[fault.span.clone()].to_owned()
        }
        other => panic!("the command line is not open: {other:?}"),
    }
}

#[test]
fn a_line_with_targets_goes_to_exactly_those() {
    let mut console = Console::flying(4);
    console.give("2-3 arm");
    assert_eq!(console.sent_to(), [2, 3]);
    let entry = console
        .state
        .session
        .ledger
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
        .state
        .session
        .ledger
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
        console.state.message().map(|it| it.text.as_str()),
        Some("there is no vehicle 17-19: the selection stays as it was")
    );
    assert_eq!(selection(&console), [2, 3]);
    assert_eq!(selection(console.write("9-11").press("enter")), [9]);
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
    assert!(console.screen(80, 24).contains("KILL 3: 1 3 5 - type 3"));
    console.press("3");
    assert_eq!(console.sent_to(), [1, 3, 5]);
    for wrong in ["5", "enter", "y", "esc", "ctrl-c", "left"] {
        console.give("1,3,5 kill").press(wrong);
        assert!(console.effects.is_empty(), "{wrong}");
        console.press("3");
        assert!(console.effects.is_empty(), "no is no after {wrong}");
        console.press("esc").press("esc");
        assert!(console.state.overlay.is_none(), "{wrong}");
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
        assert!(console.screen(80, 24).contains("Enter or Esc goes on"));
        console.press(end);
        assert!(console.effects.is_empty());
        assert!(console.state.overlay.is_none(), "{end}");
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
    assert!(console.state.overlay.is_none() && console.effects.is_empty());
}

#[test]
fn keys_that_nobody_can_see_the_effect_of_do_nothing() {
    let small = Event::Resize {
        columns: 79,
        rows: 24,
    };
    let large = Event::Resize {
        columns: 80,
        rows: 24,
    };
    let mut console = Console::flying(3);
    console.give("1 kill").hear(small.clone());
    console.press("1");
    assert!(console.effects.is_empty(), "the question is gone");
    console.give("all arm").press("*").press("j");
    console.hear(Event::Paste("1 arm".to_owned()));
    assert!(console.effects.is_empty() && selection(&console).is_empty());
    assert_eq!(console.state.session.cursor, Some(1));
    console.hear(large).press("1");
    assert!(console.effects.is_empty(), "it does not come back");
    console.press("esc").press(":").write("1 arm").hear(small);
    assert!(console.press("enter").effects.is_empty());
    assert_eq!(palette_line(&console), "1 arm", "a line waits");
    assert_eq!(console.press("ctrl-c").effects, [Effect::Quit]);
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
        console.state.history.is_empty(),
        "a line that did nothing is not history"
    );
    assert_eq!(console.state.session.ledger.entries().len(), 0);
}

#[test]
fn a_finished_word_that_is_wrong_is_marked_while_the_line_is_written() {
    let fault = |console: &Console| match &console.state.overlay {
        Some(Overlay::Palette(palette)) => palette
            .fault
            .as_ref()
            .map(|fault| palette.input.value()[fault.span.clone()].to_owned()),
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
            let Some(Overlay::Palette(palette)) = &console.state.overlay else {
                panic!("the command line has closed");
            };
            let written = palette.input.value();
            assert_eq!(palette.fault, None, "{written}");
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
            .contains("Enter asks before it sends to 2-3")
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
    assert_eq!(console.effects, [Effect::SetTheme("monochrome".to_owned())]);
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
fn the_home_screen_starts_what_is_under_the_cursor() {
    let mut console = Console::new();
    assert_eq!(
        console.press("enter").effects,
        [Effect::StartMission("m01".to_owned())]
    );
    assert_eq!(
        console.press("j").press("enter").effects,
        [Effect::StartFree]
    );
    console
        .press("j")
        .press("enter")
        .write("tcp:1.2.3.4:5760 udpin::14550");
    let addresses = ["tcp:1.2.3.4:5760", "udpin::14550"]
        .map(str::to_owned)
        .to_vec();
    assert_eq!(console.press("enter").effects, [Effect::Connect(addresses)]);
    assert!(
        console.state.overlay.is_some(),
        "the prompt waits for the outcome"
    );
    console.start(Activity::Connected {
        addresses: Vec::new(),
    });
    assert!(console.state.overlay.is_none());
    assert!(matches!(console.state.screen, Screen::Fly { .. }));
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
    assert_eq!(console.press("y").effects, [Effect::LeaveSession]);
    assert!(matches!(console.state.screen, Screen::Home { .. }));
    assert!(console.state.session.vehicles.is_empty());
    console.vehicle(fixtures::parked(1));
    assert!(
        console.state.session.vehicles.is_empty(),
        "late telemetry belongs to nobody"
    );
}

#[test]
fn keys_meant_for_the_flight_do_not_close_the_debrief() {
    let mut console = Console::flying(1);
    console
        .at(100)
        .hear(Event::MissionEnded(Box::new(fixtures::report())));
    assert!(console.press("h").effects.is_empty());
    assert!(matches!(console.state.screen, Screen::Debrief { .. }));
    let footer = "keys work in a moment";
    assert!(console.screen(80, 24).contains(footer));
    let before = console.state.revision();
    console.hear(Event::Tick {
        now: std::time::Duration::from_millis(101_050),
    });
    assert!(console.state.revision() > before);
    assert!(!console.screen(80, 24).contains(footer));
    assert_eq!(console.press("h").effects, [Effect::LeaveSession]);
}

#[test]
fn a_line_being_typed_survives_the_end_of_the_mission() {
    let mut console = Console::flying(1);
    console.press(":").write("1 r");
    console.hear(Event::MissionEnded(Box::new(fixtures::report())));
    console.write("tl");
    assert_eq!(palette_line(&console), "1 rtl");
}

#[test]
fn only_visible_changes_move_the_revision() {
    let mut console = Console::flying(2);
    console.at(5);
    let before = console.state.revision();
    console.hear(Event::Tick {
        now: std::time::Duration::from_millis(5400),
    });
    console.vehicle(fixtures::parked(1));
    assert_eq!(console.state.revision(), before);
    console.at(6);
    assert!(console.state.revision() > before);
}

#[test]
fn a_vehicle_that_goes_leaves_cursor_and_selection_in_order() {
    let mut console = Console::flying(3);
    console.press("*").press("j").press("j");
    console.hear(Event::VehicleGone(3));
    assert_eq!(console.state.session.cursor, Some(2));
    assert_eq!(selection(&console), [1, 2]);
    console
        .hear(Event::VehicleGone(1))
        .hear(Event::VehicleGone(2));
    assert_eq!(console.state.session.cursor, None);
    console.screen(80, 24);
}

#[test]
fn the_cursor_begins_on_the_first_vehicle_and_stays_where_it_was_put() {
    let mut console = Console::flying(0);
    console
        .vehicle(fixtures::parked(4))
        .vehicle(fixtures::parked(2));
    assert_eq!(console.state.session.cursor, Some(2));
    console.press("j").vehicle(fixtures::parked(1));
    assert_eq!(console.state.session.cursor, Some(4));
}

#[test]
fn rows_of_a_group_command_go_their_own_ways() {
    let mut console = Console::flying(3);
    console.give("all arm");
    console
        .row(1, RowState::Done, None)
        .row(2, RowState::Sent, None);
    console.row(
        3,
        RowState::Refused,
        Some("arm refused: PreArm: Need Position Estimate"),
    );
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("3 vehicles: 1 effect seen, 1 sent, 1 refused"),
        "{screen}"
    );
    assert!(
        screen.contains("vehicle 3: arm refused: PreArm: Need Position Estimate"),
        "{screen}"
    );
}

#[test]
fn what_a_vehicle_answered_stands_beside_the_question() {
    let mut console = Console::flying(4);
    console.give("1 param get WPNAV_SPEED");
    let answered = "WPNAV_SPEED = 500";
    console
        .row(1, RowState::Accepted, Some(answered))
        .row(1, RowState::Done, None);
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("1 param get WPNAV_SPEED  = 500"),
        "{screen}"
    );
    console.give("all param get WPNAV_SPEED");
    for vehicle in [1, 3, 4] {
        console.row(vehicle, RowState::Done, Some(answered));
    }
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("vehicles 1,3-4: WPNAV_SPEED = 500"),
        "while one is missing: {screen}"
    );
    console.row(2, RowState::Done, Some("WPNAV_SPEED = 700"));
    let screen = console.screen(120, 40);
    assert!(
        screen.contains("WPNAV_SPEED  1,3-4: 500   2: 700"),
        "{screen}"
    );
}

#[test]
fn one_reason_of_many_vehicles_is_one_line() {
    let mut console = Console::flying(3);
    console.give("all takeoff 10");
    for vehicle in 1..=3 {
        let text =
            format!("needs GUIDED: vehicle {vehicle} is in LOITER; say `{vehicle} guided` first");
        console.row(vehicle, RowState::Refused, Some(&text));
    }
    let screen = console.screen(120, 40);
    let merged = "vehicles 1-3: needs GUIDED: it is in LOITER; say `1-3 guided`";
    assert!(screen.contains(merged), "{screen}");
}

#[test]
fn a_session_begins_at_zero_and_without_the_notices_of_the_one_before() {
    let mut console = Console::flying(1);
    console.at(100).notice(Severity::Error, None, "old trouble");
    console.hear(Event::NoticesDropped(3));
    console.start(Activity::Free);
    console.vehicle(fixtures::parked(1)).at(165);
    console.give("1 arm").notice(Severity::Info, Some(1), "new");
    let screen = console.screen(80, 24);
    assert!(!screen.contains("old trouble") && !screen.contains("dropped"));
    for expected in ["   01:05", "01:05 1 arm", "01:05 info  1: new"] {
        assert!(screen.contains(expected), "{expected}: {screen}");
    }
}

#[test]
fn why_a_link_is_down_is_never_cut() {
    let mut console = Console::flying(0);
    let reason = "cannot open the recording none.tlog: there is no such file in the folder that the \
                  console was started from; give its whole path";
    console.hear(Event::Links(vec![LinkSummary {
        name: "file:none.tlog".to_owned(),
        state: "ended".to_owned(),
        error: Some(reason.to_owned()),
        ..LinkSummary::default()
    }]));
    let screen = console.screen(80, 24);
    assert!(
        !screen.contains('…') && screen.contains("its whole path"),
        "{screen}"
    );
    let mut console = Console::flying(2);
    console.notice(
        Severity::Error,
        None,
        &format!("link file:none.tlog: {reason}"),
    );
    let screen = console.screen(80, 24);
    assert!(!screen.contains('…') && screen.contains("path"), "{screen}");
}

#[test]
fn the_table_shows_the_command_that_is_under_way() {
    let mut console = Console::flying(1);
    console.give("1 goto n 100 e 0");
    console.row(1, RowState::Accepted, None);
    console.give("1 param get WPNAV_SPEED");
    console.row(1, RowState::Done, Some("WPNAV_SPEED = 500"));
    assert!(console.screen(80, 24).contains("goto accepted"));
    console.give("1 land");
    assert!(console.screen(80, 24).contains("land queued"));
    console.row(1, RowState::Done, None);
    assert!(console.screen(80, 24).contains("goto accepted"));
    console.hear(Event::Row(RowUpdate {
        entry: EntryId(0),
        vehicle: 1,
        state: RowState::Done,
        tries: 1,
        at: std::time::Duration::ZERO,
        explanation: None,
    }));
    assert!(console.screen(80, 24).contains("land done"));
}

#[test]
fn the_ledger_and_the_notices_can_be_looked_back_through() {
    let mut console = Console::flying(1);
    for number in 0..60 {
        console.give(&format!("1 param get P{number}_"));
        console.row(1, RowState::Refused, Some("no such parameter"));
        console.notice(Severity::Info, Some(1), &format!("said {number}_"));
    }
    for (key, word) in [("c", "get P"), ("n", "said ")] {
        let sees = |console: &Console, number: u32| {
            console.screen(80, 24).contains(&format!("{word}{number}_"))
        };
        console.press(key);
        assert!(sees(&console, 59) && !sees(&console, 0), "{key}");
        assert!(sees(console.press("home"), 0) && !sees(&console, 59));
        assert!(sees(console.press("page-down").press("page-down"), 20));
        assert!(!sees(console.press("page-up").press("page-up"), 59));
        assert!(sees(console.press("end"), 59));
        assert!(!sees(console.press("home").press("j"), 59));
        console.press("esc");
        assert!(console.state.overlay.is_none());
    }
    console
        .press("n")
        .notice(Severity::Info, Some(1), "the newest");
    assert!(console.screen(80, 24).contains("the newest"), "it follows");
    console.press("k").press("k");
    let before = console.screen(80, 24);
    assert!(before.contains("notices   59 of 61"), "{before}");
}

#[test]
fn serious_notices_ring_the_bell() {
    let mut console = Console::flying(1);
    console.notice(Severity::Warning, Some(1), "low");
    assert!(console.effects.is_empty());
    console.notice(Severity::Critical, Some(1), "EKF failsafe");
    assert_eq!(console.effects, [Effect::Bell]);
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
            if effects.contains(&Effect::LeaveSession) {
                proptest::prop_assert!(console.state.session.activity.is_none());
            }
            proptest::prop_assert!(!effects.iter().any(is_kill), "killed without its question");
        }
        console.screen(80, 24);
    }
}

/// No digit among them, so that no question about a kill can be answered.
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
    "ctrl-c",
    "ctrl-p",
    "ctrl-w",
    "ctrl-u",
];

fn is_kill(effect: &Effect) -> bool {
    matches!(effect, Effect::Command { verb, .. } if verb.name == "kill")
}
