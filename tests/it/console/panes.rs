//! The content of the panes and the table.

use sortie::app::event::{Event, LinkEvent, VehicleEvent};
use sortie::app::state::{Activity, LinkSummary};
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::text;
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

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
        let text = text!(
            "refused-not-guided",
            verb = "takeoff",
            mode = "LOITER",
            vehicle = vehicle
        );
        console.explained_row(vehicle, RowState::Refused, Some(text));
    }
    let screen = console.screen(120, 40);
    let merged = "vehicles 1-3: takeoff needs GUIDED: it is in LOITER; use `1-3 guided`";
    assert!(screen.contains(merged), "{screen}");
}

/// The map has no ledger, and a lesson asks for orders there.
#[test]
fn a_refusal_is_said_in_rooms_without_the_ledger() {
    let said = "vehicle 1: refused, takeoff refused: Mode not armable";
    for (room, is_said) in [("M", true), ("V", true), ("F", false)] {
        let mut console = Console::flying(2);
        console.press(room).give("1-2 takeoff 10");
        console.row(2, RowState::Done, None);
        let why = "takeoff refused: Mode not armable";
        console.row(1, RowState::Refused, Some(why));
        let message = console.state().message().map(|it| it.text.to_string());
        assert_eq!(
            message.as_deref() == Some(said),
            is_said,
            "{room}: {message:?}"
        );
    }
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
    console.hear(LinkEvent::Summaries(vec![LinkSummary {
        name: "file:none.tlog".into(),
        state: "ended".into(),
        error: Some(reason.into()),
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
    console.hear(VehicleEvent::Row(RowUpdate {
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
fn the_commands_and_the_notices_can_be_looked_back_through() {
    let mut console = Console::flying(1);
    for number in 0..60 {
        console.give(&format!("1 param get P{number}_"));
        console.row(1, RowState::Refused, Some("no such parameter"));
        console.notice(Severity::Info, None, &format!("said {number}_"));
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
        assert!(console.state().overlay().is_none());
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
fn a_long_address_does_not_push_out_whether_the_link_is_up() {
    let mut console = Console::flying(1);
    console.hear(LinkEvent::Summaries(vec![LinkSummary {
        name: "serial:/dev/serial/by-id/usb-autopilot-if00:115200".into(),
        ..LinkSummary::default()
    }]));
    let screen = console.screen(120, 40);
    let header = screen.lines().next().expect("a first line");
    assert!(header.contains(" down"), "{header}");
}

#[test]
fn a_crashed_vehicle_is_not_ready_and_reboots_have_a_row_of_their_own() {
    let mut console = Console::flying(1);
    assert!(console.screen(120, 40).contains(" ready"));
    let mut vehicle = fixtures::parked(1);
    vehicle.link.reboots = 2;
    vehicle.texts.push(sortie::vehicle::StatusText {
        severity: Severity::Critical,
        text: "Crash: Disarming: AngErr=179>30".to_owned(),
        at: std::time::Duration::ZERO,
    });
    console.vehicle(vehicle);
    let screen = console.screen(120, 40);
    assert!(!screen.contains(" ready"), "{screen}");
    assert!(screen.contains("reboots  2"), "{screen}");
}
