use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::*;
use crate::app::action::{LineAction, SelectAction};
use crate::app::room::Room;
use crate::text::Locale;

const FLY: Place = Place::In(Room::Fly);

fn keymap(source: &str) -> Keymap {
    let mut keymap = Keymap::default();
    let themes = ["dark".to_owned()];
    keymap.overlay(source, &themes).expect("it is right");
    keymap
}

fn press(keymap: &Keymap, written: &str, place: Place) -> Option<Meaning> {
    let (code, modifiers) = match Press::read(written).expect("a key") {
        Press::Plain(code) => (code, KeyModifiers::NONE),
        Press::Control(c) => (KeyCode::Char(c), KeyModifiers::CONTROL),
        Press::With(modifiers, code) => (code, modifiers),
        Press::Number => unreachable!("it has no spelling"),
    };
    keymap
        .resolve(KeyEvent::new(code, modifiers), place)
        .cloned()
}

#[test]
fn rows_take_the_place_of_the_defaults_of_their_context() {
    let keymap = keymap(
        "[anywhere]\n\"f5\" = \"all rtl\"\n\"Ctrl-T\" = \"@red takeoff ...\"\n\"n\" = \"theme dark\"\n\
         [fly]\n\"a\" = \"select-all\"\n\"?\" = false\n\"t\" = \"\"\n\"shift-up\" = \"invert\"\n\
         [prompt]\n\"ctrl-n\" = \"newer\"\n",
    );
    let give = |line: &str| Some(Meaning::Give(line.to_owned().into()));
    assert_eq!(press(&keymap, "f5", FLY), give("all rtl"));
    assert_eq!(press(&keymap, "f5", Place::Prompt), None);
    assert_eq!(press(&keymap, "n", FLY), give("theme dark"));
    let write = Meaning::Write("@red takeoff ".into());
    assert_eq!(press(&keymap, "ctrl-t", FLY), Some(write));
    assert_eq!(
        press(&keymap, "a", FLY),
        Some(Meaning::Do(Action::Select(SelectAction::SelectAll)))
    );
    assert_eq!(
        press(&keymap, "shift-up", FLY),
        Some(Meaning::Do(Action::Select(SelectAction::Invert)))
    );
    let newer = Some(Meaning::Do(Action::Line(LineAction::Newer)));
    assert_eq!(press(&keymap, "ctrl-n", Place::Prompt), newer);
    // Disabled in one room only, whether its meaning was the room's or general.
    assert_eq!(press(&keymap, "t", FLY), None);
    assert_eq!(press(&keymap, "?", FLY), None);
    let help = Some(Meaning::Do(Action::Help));
    assert_eq!(press(&keymap, "?", Place::In(Room::Home)), help);
    // Keys that are not named stay as they are.
    assert_eq!(
        press(&keymap, "r", FLY),
        press(&Keymap::default(), "r", FLY)
    );
    let mut bindings = keymap.bindings().iter();
    assert!(!bindings.any(|it| it.place == FLY && it.press.label() == "t"));
}

#[test]
fn faults_are_told_at_their_place_and_leave_the_rest_alone() {
    let cases = [
        (
            "[fyl]\n",
            "1:2: unknown context `fyl` (did you mean `fly`?)",
        ),
        ("fly = 3\n", "1:7: `fly` is a context: write `[fly]`"),
        ("[fly]\n\"f55\" = \"invert\"\n", "2:1: unknown key `f55`"),
        (
            "[fly]\n\"ctrl-m\" = \"invert\"\n",
            "2:1: terminals send the same code for `ctrl-m` and `enter`",
        ),
        (
            "[fly]\nx = \"inver\"\n",
            "2:5: unknown action or command `inver` (did you mean `invert`?)",
        ),
        ("[fly]\nx = \"all takeof 20\"\n", "2:10: "),
        ("[fly]\nx = \"all takeof ...\"\n", "2:10: "),
        ("[fly]\nx = \"takeoff 20 30\"\n", "2:17: "),
        ("[fly]\nx = \"theme drak\"\n", "2:12: unknown name `drak`"),
        ("[fly]\nx = = 3\n", "2:5: one `=` too many"),
        (
            "[fly]\nx = true\n",
            "2:5: expected the name of an action or a command line",
        ),
        (
            "[fly]\nx = [\"rtl\"]\n",
            "2:5: expected the name of an action or a command line",
        ),
        (
            "[fly]\nctrl-a = \"invert\"\nCtrl-A = \"select-all\"\n",
            "3:1: `Ctrl-A` is already used in this context, on line 2",
        ),
        (
            "[map]\nx = \"invert\"\n[anywhere]\nx = \"help\"\n",
            "2:1: `x` is used under `[anywhere]`, on line 4 (give one of them another key)",
        ),
        (
            "[fly]\nx = \"invert\"\nx = \"help\"\n",
            "3:1: duplicate key",
        ),
    ];
    for (source, expected) in cases {
        let mut keymap = Keymap::default();
        let themes = ["dark".to_owned()];
        let source = format!("{source}[reader]\ng = \"first\"\n");
        let faults = keymap.overlay(&source, &themes).expect_err(&source);
        let line = faults[0].one_line("k", &source);
        let said = line.strip_prefix("k:").expect("the name");
        assert!(said.starts_with(expected), "{source}: {line}");
        assert_eq!(faults.len(), 1, "{faults:?}");
        let first = press(&keymap, "g", Place::Reader);
        assert!(first.is_some(), "{source}");
    }
}

#[test]
fn a_key_may_be_switched_off_in_a_room_and_bound_anywhere() {
    let keymap = keymap("[anywhere]\nx = \"help\"\n[fly]\nx = false\n");
    assert_eq!(press(&keymap, "x", FLY), None);
    assert!(press(&keymap, "x", Place::In(Room::Map)).is_some());
}

#[test]
fn what_is_shown_reads_back_as_the_same() {
    let source = "[anywhere]\nf5 = \"all rtl\"\n[fly]\na = false\nn = \"@red takeoff ...\"\n\
                  '\\' = \"invert\"\n[reader]\n\"ctrl-left\" = \"first\"\n";
    let own = keymap(source);
    let shown = own.show(&Locale::default());
    assert_eq!(keymap(&shown), own, "{shown}");
    assert!(shown.contains("\"F5\" = \"all rtl\" # "), "{shown}");
    assert!(
        shown.contains("# \"?\" = \"help\" # show this help\n"),
        "{shown}"
    );
    // Without the comments, nothing of the default remains.
    let rows = shown.lines().filter(|line| line.starts_with(['"', '\'']));
    assert_eq!(rows.count(), 5, "{shown}");
    // The comments contain the default.
    let uncommented = Keymap::default().show(&Locale::default());
    let default: Vec<&str> = uncommented
        .lines()
        .filter(|line| !line.starts_with("# without"))
        .map(|line| line.strip_prefix("# ").unwrap_or(line))
        .collect();
    for place in default.join("\n").split("\n\n") {
        assert_eq!(
            keymap(place).bindings.len(),
            Keymap::default().bindings.len()
        );
    }
}
