//! The room of files as text.

use sortie::app::effect::Effect;
use sortie::app::event::VehicleEvent;
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::session::{FtpEntry, ListedFolder};
use sortie::text::Language;

use crate::harness::Console;

fn entry(name: &str, size: Option<u32>) -> FtpEntry {
    FtpEntry {
        name: name.to_owned(),
        size,
    }
}

fn lists(console: &mut Console, folder: &str, entries: Vec<FtpEntry>) {
    console.hear(VehicleEvent::Folder(ListedFolder {
        vehicle: 1,
        folder: folder.to_owned(),
        entries,
    }));
}

fn row(console: &mut Console, id: u32, state: RowState, why: Option<&str>) {
    console.hear(VehicleEvent::Row(RowUpdate {
        entry: EntryId(id),
        vehicle: 1,
        state,
        tries: 1,
        at: std::time::Duration::from_secs(2),
        explanation: why.map(Into::into),
    }));
}

/// The lines that the console has given, by the effects of its last event.
fn given(console: &Console) -> Vec<String> {
    let effects = console.effects.iter();
    let lines = effects.filter_map(|effect| match effect {
        Effect::Order { order, .. } => Some(order.line.clone()),
        _ => None,
    });
    lines.collect()
}

/// The room with the root of vehicle 1.
fn in_the_room(language: Language) -> Console {
    let mut console = Console::in_language(language).in_flight(2);
    console.press("X");
    console.at(1);
    assert_eq!(given(&console), ["1 ftp list /"]);
    row(&mut console, 0, RowState::Sent, None);
    let root = vec![
        entry("@ROMFS", None),
        entry("@SYS", None),
        entry("APM", None),
        entry("scripts", None),
        entry("copter.parm", Some(15_140)),
        entry("eeprom.bin", Some(16_384)),
    ];
    lists(&mut console, "/", root);
    row(&mut console, 0, RowState::Done, Some("6 entries: ..."));
    console
}

fn check(name: &str, console: &Console) {
    for (width, height) in [(80, 24), (200, 50)] {
        insta::assert_snapshot!(
            format!("files_{name}_{width}x{height}"),
            console.screen(width, height)
        );
    }
}

#[test]
fn folders_are_entered_left_and_listed_once() {
    let mut console = in_the_room(Language::English);
    check("root", &console);
    console.press("down").press("down").press("enter").at(2);
    assert_eq!(given(&console), ["1 ftp list /APM"]);
    check("asked", &console);
    row(&mut console, 1, RowState::TimedOut, Some("no answer"));
    check("unanswered", &console);
    console.press("r").at(3);
    assert_eq!(given(&console), ["1 ftp list /APM"]);
    lists(&mut console, "/APM", Vec::new());
    console.press("esc").at(4);
    assert_eq!(given(&console), [""; 0], "the root is known");
    assert!(console.screen(80, 24).contains("> APM/"));
}

#[test]
fn copies_show_their_progress_and_changes_list_the_folder_again() {
    let mut console = in_the_room(Language::English);
    console.press("end").press("g");
    assert!(
        console
            .screen(80, 24)
            .contains("1 ftp get /eeprom.bin to eeprom.bin")
    );
    console.press("enter");
    row(&mut console, 1, RowState::InProgress(40), None);
    console.press("u").write("~/a.lua").press("enter");
    check("question", &console);
    console.press("1");
    row(
        &mut console,
        2,
        RowState::Done,
        Some("copied to the vehicle: 120 B, checksum verified"),
    );
    check("copies", &console);
    console.at(2);
    assert_eq!(given(&console), ["1 ftp list /"]);
    console.press("x");
    assert!(console.screen(80, 24).contains("removes /eeprom.bin"));
    console.press("esc").press("s");
    assert_eq!(given(&console), ["1 ftp checksum /eeprom.bin"]);
}

#[test]
fn in_ukrainian() {
    let mut console = in_the_room(Language::Ukrainian);
    check("ukrainian", &console);
    console.press("u");
    insta::assert_snapshot!("files_put_ukrainian_80x24", console.screen(80, 24));
}
