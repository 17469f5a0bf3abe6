//! A key with another binding is shown wherever a screen names it.

use std::fs;
use std::path::PathBuf;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use sortie::app::action::Action;
use sortie::app::event::TerminalEvent;
use sortie::app::keymap::{HintKeys, Keymap, Meaning, Place, Press};
use sortie::app::room;
use sortie::app::state::Room;
use sortie::text::Language;
use sortie::ui::Theme;

use crate::harness::Console;

/// Letters that, with Alt, have no default binding in any room.
const LETTERS: &str = "abcdefghijklmnopqrstuvwxyz";

/// The actions in a room's hints, each with its name in a keymap file.
fn hinted(console: &Console) -> Vec<(Meaning, String)> {
    let mut found = Vec::new();
    for hint in room::hints(console.state()) {
        match hint.keys {
            HintKeys::Actions(actions) => {
                let named = |action: &Action| (Meaning::Do(*action), action.name().to_owned());
                found.extend(actions.iter().map(named));
            }
            HintKeys::Words(words) => {
                let value = format!("{} ...", words.trim_end());
                found.push((Meaning::words(words), value));
            }
            HintKeys::Lines(lines) => {
                found.extend(lines.iter().map(|words| {
                    let value = format!("{} ...", words.trim_end());
                    (Meaning::words(words), value)
                }));
            }
            HintKeys::VehicleList => {
                found.push((
                    Meaning::Do(Action::Submit),
                    Action::Submit.name().to_owned(),
                ));
            }
        }
    }
    found
}

/// A keymap file in which every action of the hints has another key and the default keys are unbound.
fn rebound(room: Room, hinted: &[(Meaning, String)]) -> (String, Vec<String>) {
    let keymap = Keymap::default();
    let place = Place::In(room);
    let mut file = format!("[{}]\n", room.name());
    let mut labels = Vec::new();
    for ((meaning, value), letter) in hinted.iter().zip(LETTERS.chars()) {
        labels.push(format!("Alt-{letter}"));
        file.extend(["\"alt-", &letter.to_string(), "\" = \"", value, "\"\n"]);
        let old = keymap.bindings().iter().filter(|binding| {
            let holds = binding.place == place || binding.place == Place::Anywhere;
            holds && binding.meaning == *meaning
        });
        let mut old: Vec<String> = old.map(|binding| binding.press.label()).collect();
        old.dedup();
        for label in old {
            let line = format!("{label:?} = false\n");
            if !file.contains(&line) {
                file += &line;
            }
        }
    }
    (file, labels)
}

/// A flight of three vehicles in a room, with a keymap file.
fn flying(room: Room, file: &str) -> Console {
    let console = Console::set_up(|setup| {
        let read = setup.keymap.overlay(file, &setup.themes);
        read.unwrap_or_else(|faults| panic!("{faults:?} in {file}"));
    });
    let mut console = console.in_flight(3);
    give(&mut console, &format!("show {}", room.name()));
    console.at(300);
    console
}

/// Enters a line, with any binding of the command line's key.
fn give(console: &mut Console, line: &str) {
    console.hear(TerminalEvent::Line(line.to_owned()));
}

fn footer(console: &Console) -> String {
    let screen = console.screen(600, 60);
    screen.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn every_footer_and_the_help_show_the_keys_that_are_in_force() {
    for room in Room::ALL {
        let hinted = hinted(&flying(room, ""));
        assert!(!hinted.is_empty(), "{}", room.name());
        let (file, labels) = rebound(room, &hinted);
        let mut console = flying(room, &file);
        let shown = footer(&console);
        for label in &labels {
            assert!(shown.contains(label), "{label} in {}: {shown}", room.name());
        }
        give(&mut console, "help");
        let help = console.screen(600, 200);
        for label in &labels {
            assert!(help.contains(label), "{label} in {}: {help}", room.name());
        }
    }
}

#[test]
fn an_action_without_a_key_has_no_hint() {
    assert!(footer(&flying(Room::Map, "")).contains("z all"));
    assert!(!footer(&flying(Room::Map, "[map]\nz = false\n")).contains("z all"));
}

#[test]
fn messages_name_the_key_that_is_in_force() {
    let file = "[fly]\nf4 = \"sort-reverse\"\n[anywhere]\nf5 = \"command-line\"\n";
    let mut console = flying(Room::Fly, file);
    console.press("s");
    let screen = console.screen(120, 40);
    assert!(screen.contains("F4 reverses the order"), "{screen}");
    give(&mut console, "show commands");
    let screen = console.screen(120, 40);
    assert!(screen.contains("press F5 and type one"), "{screen}");
}

#[test]
fn the_keys_of_a_list_of_vehicles_are_those_of_the_room() {
    for (room, commands) in [(Room::Fly, "a d m t l r h g w o"), (Room::Map, "a d m t r")] {
        let mut console = flying(room, "");
        console.press("2");
        let footer = footer(&console);
        assert!(
            footer.contains(&format!("{commands} write a command")),
            "{footer}"
        );
    }
}

/// Keys with names that cannot be ordinary words in a text.
const NAMED_KEYS: [&str; 12] = [
    "Enter",
    "Esc",
    "Tab",
    "Space",
    "Backspace",
    "Del",
    "Ins",
    "PgUp",
    "PgDn",
    "Ctrl-",
    "↑",
    "↓",
];

/// The first named key that is a separate word in a text.
fn named_key(text: &str) -> Option<&'static str> {
    let is_apart = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric() && c != '-');
    NAMED_KEYS.into_iter().find(|key| {
        text.match_indices(key).any(|(at, _)| {
            let after = text[at + key.len()..].chars().next();
            is_apart(text[..at].chars().next_back()) && (key.ends_with('-') || is_apart(after))
        })
    })
}

/// A keymap file in which every key of every place has another binding.
fn all_rebound() -> String {
    let keymap = Keymap::default();
    let mut file = String::new();
    for place in Place::all() {
        file.extend(["[", place.name(), "]\n"]);
        let here = keymap.bindings().iter();
        let here: Vec<_> = here.filter(|binding| binding.place == place).collect();
        // A room must not hide a key that works in all rooms.
        let unusual: Vec<char> = match place {
            Place::Anywhere => ('a'..='z').chain('0'..='9').chain('à'..='ö').collect(),
            Place::In(_) | Place::Replay | Place::Prompt | Place::Reader | Place::List => {
                ('A'..='Z').chain('α'..='ω').collect()
            }
        };
        assert!(here.len() <= unusual.len(), "{}", place.name());
        for (binding, letter) in here.into_iter().zip(unusual) {
            let value = match &binding.meaning {
                Meaning::Do(action) => action.name().to_owned(),
                Meaning::Write(line) => format!("{} ...", line.trim_end()),
                Meaning::Give(line) => line.clone().into_owned(),
                // A whole group of keys, which has no alternative binding.
                Meaning::Type => continue,
            };
            let old = binding.press.label();
            let rows = [
                format!("{old:?} = false\n"),
                format!("\"alt-{letter}\" = {value:?}\n"),
            ];
            file.extend(rows);
        }
    }
    file
}

fn event(press: Press) -> Option<KeyEvent> {
    let (code, modifiers) = match press {
        Press::Plain(code) => (code, KeyModifiers::NONE),
        Press::Control(letter) => (KeyCode::Char(letter), KeyModifiers::CONTROL),
        Press::With(modifiers, code) => (code, modifiers),
        Press::Number => return None,
    };
    Some(KeyEvent::new(code, modifiers))
}

/// Every room, and the result of each of its keys, each with its name.
fn all_shown(file: &str) -> Vec<(String, Console)> {
    let mut keymap = Keymap::default();
    let themes: Vec<String> = Theme::names().map(str::to_owned).collect();
    keymap.overlay(file, &themes).expect("it is good");
    let mut all = Vec::new();
    for room in Room::ALL {
        let start = flying(room, file);
        all.push((room.name().to_owned(), start.clone()));
        let places = [Place::In(room), Place::Anywhere];
        let here = keymap.bindings().iter();
        for binding in here.filter(|binding| places.contains(&binding.place)) {
            let mut console = start.clone();
            if let Some(key) = event(binding.press) {
                console.hear(TerminalEvent::Key(key));
                all.push((
                    format!("{} in {}", binding.press.label(), room.name()),
                    console,
                ));
            }
        }
    }
    for line in ["takeof 20", "1-3 kill", "notices", "restart"] {
        let mut console = flying(Room::Fly, file);
        give(&mut console, line);
        all.push((line.to_owned(), console.clone()));
        console.press("x");
        all.push((format!("{line}, then x"), console));
    }
    let mut typed = flying(Room::Fly, file);
    typed.press("2");
    all.push(("a list of vehicles".to_owned(), typed));
    all
}

#[test]
fn no_screen_shows_a_key_that_has_been_rebound() {
    let file = all_rebound();
    for (name, console) in all_shown(&file) {
        let shown = console.screen(140, 50);
        assert_eq!(named_key(&shown), None, "{name}:\n{shown}");
    }
    let usual = all_shown("").into_iter();
    let mut shows_one = usual.filter(|(_, console)| named_key(&console.screen(140, 50)).is_some());
    let hundredth = shows_one.nth(99);
    assert!(hundredth.is_some(), "with the usual keys, they are shown");
}

#[test]
fn a_question_names_the_keys_that_end_it() {
    let shown = |file| {
        let mut console = flying(Room::Fly, file);
        give(&mut console, "1-3 kill");
        console.press("x").screen(100, 30)
    };
    assert!(shown("").contains("Enter or Esc: back"), "{}", shown(""));
    let file = "[prompt]\nesc = false\nf2 = \"escape\"\nenter = false\nf3 = \"submit\"\n";
    assert!(shown(file).contains("F3 or F2: back"), "{}", shown(file));
}

/// Messages take keys from the keymap: a fixed name would be wrong after a change of the bindings.
#[test]
fn no_message_names_a_key() {
    // Without a screen, a line ends with Enter in any keymap.
    let of_pipes = "plain-asks";
    for language in Language::ALL {
        for (file, text) in messages(language) {
            for line in text.lines().filter(|line| !line.starts_with(['#'])) {
                let is_of_pipes = line.starts_with(of_pipes);
                assert!(is_of_pipes || named_key(line).is_none(), "{file}: {line}");
                let presses = ["press ", "натисн"].iter().any(|verb| line.contains(verb));
                assert!(!presses || line.contains("{ $"), "{file}: {line}");
            }
        }
    }
}

fn messages(language: Language) -> Vec<(String, String)> {
    let folder = format!("{}/locales/{}", env!("CARGO_MANIFEST_DIR"), language.code());
    let entries = fs::read_dir(&folder).expect("the language has a folder");
    let files = entries.map(|entry| entry.expect("it can be listed").path());
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("it can be read");
        (path.display().to_string(), text)
    };
    let found: Vec<(String, String)> = files.map(read).collect();
    assert!(found.len() > 10, "{folder}");
    found
}
