//! The room with all commands of the session.

use sortie::app::event::{TerminalEvent, VehicleEvent};
use sortie::app::state::Room;
use sortie::ledger::{
    EntryId, ForeignCommand, ForeignId, LedgerNumber, RowState, RowUpdate, StationId,
};
use sortie::text::Text;
use sortie::wire::MavAddress;

use crate::harness::Console;

/// Three commands: one that was refused by one vehicle, one in progress, one done.
fn commanded() -> Console {
    let mut console = Console::flying(4);
    console.at(5).give("all arm");
    for vehicle in 1..=3 {
        console.row(vehicle, RowState::Done, None);
    }
    console.row(
        4,
        RowState::Refused,
        Some("arm refused: PreArm: Need Position Estimate"),
    );
    console.at(9).give("1-3 takeoff 20");
    console.row(1, RowState::Accepted, None);
    console.at(12).give("4 land");
    console.row(4, RowState::Done, None);
    console
}

fn shown(console: &Console) -> Vec<u32> {
    let shown = console.state().rooms().ledger().shown().iter();
    let own = shown.filter_map(|key| match key.number() {
        LedgerNumber::Own(id) => Some(id.0),
        LedgerNumber::Foreign(_) => None,
    });
    own.collect()
}

#[test]
fn the_room_tells_each_command_and_each_vehicle_of_the_one_under_the_cursor() {
    let mut console = commanded();
    for key in ["c", "C"] {
        console.press("F").press(key);
        assert!(console.state().room() == Room::Ledger, "{key}");
    }
    let screen = console.press("home").screen(120, 40);
    for part in [
        "all arm",
        "3 effect seen, 1 refused",
        "1-3 takeoff 20",
        "4 land",
    ] {
        assert!(screen.contains(part), "{part}: {screen}");
    }
    let reason = "arm refused: PreArm: Need Position Estimate";
    assert!(screen.contains(reason), "{screen}");
    console.press("F").give("ledger");
    assert!(console.state().room() == Room::Ledger);
}

#[test]
fn commands_are_filtered_by_vehicle_verb_and_outcome() {
    let mut console = commanded();
    console.press("C");
    for (filter, expected) in [
        ("", vec![0, 1, 2]),
        ("4", vec![0, 2]),
        ("1-2", vec![0, 1]),
        ("takeoff", vec![1]),
        ("ефлущаа", vec![1]),
        ("refused", vec![0]),
        ("failed 4", vec![0]),
        ("arm 9", vec![]),
    ] {
        console
            .press("/")
            .press("ctrl-u")
            .write(filter)
            .press("enter");
        assert_eq!(shown(&console), expected, "{filter}");
    }
    assert!(console.screen(80, 24).contains("no command matches"));
    console.press("esc");
    assert_eq!(shown(console.press("o")), [0], "failed");
    assert_eq!(shown(console.press("o")), [1], "under way");
    assert_eq!(shown(console.press("o")), [2], "done");
    assert_eq!(shown(console.press("o")), [0, 1, 2]);
    console.press("F").write("4").press("enter").press("C");
    assert_eq!(shown(console.press("v")), [0, 2]);
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("ledger  only vehicle 4: 2 of 3"),
        "{screen}"
    );
    assert_eq!(shown(console.press("v")), [0, 1, 2]);
}

#[test]
fn the_list_follows_the_newest_until_the_cursor_moves() {
    let mut console = commanded();
    console.press("C").give("2 hold").at(13);
    assert_eq!(console.state().rooms().ledger().place(), 3);
    console.press("k").give("3 hold").at(14);
    assert_eq!(
        console.state().rooms().ledger().place(),
        2,
        "it stays on its command"
    );
    console.press("end").give("1 hold").at(15);
    assert_eq!(console.state().rooms().ledger().place(), 5);
    console.press("F").press("C");
    assert_eq!(console.state().rooms().ledger().place(), 5);
}

#[test]
fn esc_takes_back_what_was_opened_then_the_filter_then_leaves() {
    let mut console = commanded();
    console
        .write("2-3")
        .press("enter")
        .press("C")
        .press("o")
        .press("enter");
    assert!(console.state().rooms().ledger().is_opened());
    console.press("esc");
    assert!(!console.state().rooms().ledger().is_opened() && shown(&console) == [0]);
    assert_eq!(shown(console.press("esc")).len(), 3);
    assert!(console.press("esc").state().room() == Room::Fly);
    assert_eq!(
        console.state().session().selection().len(),
        2,
        "the selection is none of its business"
    );
}

#[test]
fn thousands_of_commands_with_a_filter_stay_quick() {
    let mut console = Console::flying(3);
    for number in 0..2000 {
        let line = format!("all param get P{number}");
        console.hear(TerminalEvent::Line(line));
    }
    console.press("C").press("/").write("p199").press("enter");
    assert_eq!(shown(&console).len(), 11);
    // A changed row must not cause a search of all commands.
    for number in 0..2000 {
        console.hear(VehicleEvent::Row(RowUpdate {
            entry: EntryId(number),
            vehicle: 1,
            state: RowState::Done,
            tries: 1,
            at: console.state().now(),
            explanation: None,
        }));
    }
    assert!(console.screen(200, 50).contains("11 of 2000 match"));
}

#[test]
fn the_mark_of_a_longer_list_leaves_the_tries_in_sight() {
    let mut console = Console::flying(1);
    for _ in 0..40 {
        console.give("1 hold");
    }
    console.give("ledger");
    let screen = console.screen(80, 24);
    assert!(screen.contains('▲'), "{screen}");
    let mut listed = screen
        .lines()
        .filter(|line| line.contains("1 hold") && line.contains("queued"));
    let shows_tries = |line: &str| {
        let figures = line.trim_end_matches(['▲', '▼', ' ']);
        figures.ends_with(|it: char| it.is_ascii_digit())
    };
    assert!(screen.matches("queued  ").count() > 10, "{screen}");
    assert!(listed.all(shows_tries), "{screen}");
}

/// A command given by station 254/230.
fn foreign(id: u32, at_s: u64) -> ForeignCommand {
    let at = std::time::Duration::from_secs(at_s);
    ForeignCommand {
        id: ForeignId(id),
        station: StationId(MavAddress {
            system: 254,
            component: 230,
        }),
        vehicle: 3,
        at,
        last_at: at,
        what: Text::verbatim("mode RTL"),
        count: 1,
        state: RowState::Accepted,
        explanation: None,
    }
}

/// A trainee waits for the end of a survey in the column of the table.
#[test]
fn the_end_of_a_movement_is_not_hidden_by_a_setting_given_meanwhile() {
    let mut console = commanded();
    console.at(20).give("4 goto n 40 e 0");
    let movement = console.state().session().ledger().entries().len() as u32 - 1;
    console.row(4, RowState::InProgress(15), None);
    console.at(21).give("4 speed 3.5");
    console.row(4, RowState::Done, None);
    let at = console.at(30).state().now();
    console.hear(VehicleEvent::Row(RowUpdate {
        entry: EntryId(movement),
        vehicle: 4,
        state: RowState::Done,
        tries: 1,
        at,
        explanation: None,
    }));
    let (latest, _) = console.state().session().latest(4).expect("a command");
    assert_eq!(latest.line, "4 goto n 40 e 0");
}

#[test]
fn commands_of_other_stations_are_rows_that_are_not_the_operators() {
    let mut console = commanded();
    let repeated = ForeignCommand {
        count: 4,
        ..foreign(0, 10)
    };
    for command in [foreign(0, 10), repeated] {
        console.hear(VehicleEvent::Foreign(command));
    }
    let refused = ForeignCommand {
        state: RowState::Refused,
        explanation: Some(Text::verbatim("denied")),
        ..foreign(1, 14)
    };
    console.hear(VehicleEvent::Foreign(refused));
    for (columns, rows) in [(80, 24), (200, 50)] {
        let screen = console.press("F").screen(columns, rows);
        assert!(screen.contains("GCS 254/230: 3 mode RTL"), "{screen}");
        let screen = console.press("C").screen(columns, rows);
        for part in [
            "GCS 254/230: 3 mode RTL",
            "accepted, 4 times",
            "refused: denied",
        ] {
            assert!(screen.contains(part), "{part}: {screen}");
        }
    }
    // They are neither the vehicle's last command nor among those that count.
    let session = console.state().session();
    let (latest, _) = session.latest(3).expect("a command");
    assert_eq!(latest.line, "1-3 takeoff 20");
    assert_eq!(session.ledger().entries().len(), 3);
    assert!(!console.state().rooms().ledger().is_opened());
    console.press("end").press("enter");
    assert!(
        !console.state().rooms().ledger().is_opened(),
        "one row is all"
    );
    for (filter, expected) in [
        ("3", 2),
        ("254/230", 2),
        ("rtl", 2),
        ("failed 3", 1),
        ("4", 0),
    ] {
        console
            .press("/")
            .press("ctrl-u")
            .write(filter)
            .press("enter");
        let shown = console.state().rooms().ledger().shown().iter();
        let others = shown.filter(|key| matches!(key.number(), LedgerNumber::Foreign(_)));
        assert_eq!(others.count(), expected, "{filter}");
    }
}
