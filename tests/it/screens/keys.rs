//! A rebound key is shown wherever a screen names it.

use sortie::app::action::Action;
use sortie::app::event::TerminalEvent;
use sortie::app::keymap::{HintKeys, Keymap, Meaning, Place};
use sortie::app::room;
use sortie::app::state::Room;

use crate::harness::Console;

/// With Alt, keys that no room has by default.
const LETTERS: &str = "abcdefghijklmnopqrstuvwxyz";

/// What the hints of a room lead to, each with the word of a keymap file for it.
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

/// A keymap file in which everything that the hints name has another key, and the old ones mean nothing.
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

/// A flight of three, in a room, with a keymap file.
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

/// Gives a line, whatever opens the command line.
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
    assert!(screen.contains("F4 turns it round"), "{screen}");
    give(&mut console, "show commands");
    let screen = console.screen(120, 40);
    assert!(screen.contains("press F5 and write one"), "{screen}");
}

#[test]
fn the_keys_of_a_list_of_vehicles_are_those_of_the_room() {
    for (room, commands) in [(Room::Fly, "a t g m h l r"), (Room::Map, "a t m r")] {
        let mut console = flying(room, "");
        console.press("2");
        let footer = footer(&console);
        assert!(
            footer.contains(&format!("{commands} commands them")),
            "{footer}"
        );
    }
}
