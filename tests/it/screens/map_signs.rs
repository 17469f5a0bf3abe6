//! Names, signs and the cursor on the map: none of them is hidden by another.

use sortie::app::event::{SessionEvent, TerminalEvent};
use sortie::config::Symbols;
use sortie::mission::Mission;
use sortie::text::Language;
use sortie::vehicle::Target;

use super::map::{drawn, resized};
use crate::fixtures;
use crate::harness::Console;

/// A flight in which the first gate has been passed, and the lesson of the first mission leads to
/// the second.
fn at_the_first_gate() -> Console {
    let mut console = Console::flying(0);
    console.vehicle(fixtures::airborne(1, 10.0, 20.0));
    let source = include_str!("../../../missions/00-first-flight.toml");
    let lesson = Mission::parse(source).expect("a mission").advice.lesson;
    let mut progress = fixtures::progress();
    progress.lesson = lesson.into_iter().next();
    let gates = [("gate1", 40.0), ("gate2", 80.0), ("next", 80.0)];
    for (name, north_m) in gates {
        let place = fixtures::HOME.moved(north_m, 0.0);
        progress.places.insert(name.to_owned(), place);
    }
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    // The cursor leaves the name of the first gate.
    console.press("j").press("j").press("j");
    console
}

#[test]
fn the_next_gate_has_its_name_and_a_mark() {
    let size = (80, 24);
    let console = resized(at_the_first_gate(), size);
    for (symbols, next) in [(Symbols::Braille, "»gate2"), (Symbols::Ascii, ">>gate2")] {
        let text = drawn(&console, symbols, Language::English, size);
        assert!(text.contains(next) && text.contains("+gate1"), "{text}");
        assert!(!text.contains("+next"), "{text}");
    }
}

/// A hint that says `peak` means a name on the map, not `peak1` at the same place.
#[test]
fn the_highest_reading_of_all_has_the_name_that_hints_use() {
    let mut console = Console::flying(0);
    console.vehicle(fixtures::airborne(1, 10.0, 20.0));
    let mut progress = fixtures::progress();
    for (name, north_m) in [("peak", 60.0), ("peak1", 60.0), ("peak2", -60.0)] {
        let place = fixtures::HOME.moved(north_m, 0.0);
        progress.places.insert(name.to_owned(), place);
    }
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("M").press("z");
    let size = (80, 24);
    let console = resized(console, size);
    let text = drawn(&console, Symbols::Braille, Language::English, size);
    let mut rows = text.lines().map(str::trim_end);
    assert!(rows.any(|row| row.ends_with("+peak")), "{text}");
    assert!(text.contains("+peak2"), "{text}");
    assert!(!text.contains("+peak1"), "{text}");
}

#[test]
fn a_step_of_a_lesson_shows_on_the_map_too() {
    for size in [(80, 24), (120, 40)] {
        let console = resized(at_the_first_gate(), size);
        let text = drawn(&console, Symbols::Braille, Language::English, size);
        let step = console.state().session().mission();
        let step = step.and_then(|it| it.lesson.as_ref()).expect("a step");
        let words = step.text.to_string();
        let last = words.rsplit(' ').next().expect("a word");
        assert!(text.contains("now: Each step is explained"), "{text}");
        assert!(text.contains(last), "{words}\n{text}");
    }
}

/// The drafts have the same names as the map.
#[test]
fn the_room_of_plans_calls_the_highest_reading_peak_too() {
    let mut console = Console::flying(0);
    console.vehicle(fixtures::airborne(1, 10.0, 20.0));
    let mut progress = fixtures::progress();
    for name in ["peak", "peak1"] {
        let place = fixtures::HOME.moved(60.0, 0.0);
        progress.places.insert(name.to_owned(), place);
    }
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.give("draft new north");
    console.give("draft add n 100 e 60");
    console.press("1").press("z");
    let text = drawn(&console, Symbols::Braille, Language::English, (80, 24));
    assert!(text.contains("peak") && !text.contains("peak1"), "{text}");
}

/// The target is drawn at the gate itself.
#[test]
fn a_gate_keeps_its_name_while_a_vehicle_flies_to_it() {
    let mut console = at_the_first_gate();
    let mut vehicle = fixtures::airborne(1, 60.0, 20.0);
    vehicle.target = Some(Target {
        at_point: Some(fixtures::HOME.moved(80.0, 0.0)),
        altitude_m: Some(20.0),
        velocity_m_s: None,
        at: std::time::Duration::ZERO,
    });
    console.vehicle(vehicle);
    let text = drawn(
        &resized(console, (80, 24)),
        Symbols::Braille,
        Language::English,
        (80, 24),
    );
    assert!(text.contains("gate2") && text.contains("gate1"), "{text}");
}

#[test]
fn the_cursor_leaves_the_name_of_a_place_readable() {
    let mut console = at_the_first_gate();
    console.hear(TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    });
    let shown = |console: &Console| drawn(console, Symbols::Braille, Language::English, (80, 24));
    let before = shown(&console);
    let find = |text: &str, what: &str| {
        let mut rows = text.lines().enumerate();
        rows.find_map(|(row, line)| {
            let at = line.find(what)?;
            Some((line[..at].chars().count(), row))
        })
    };
    let (to, row) = find(&before, "gate1").expect("a gate");
    let (column, cursor_row) = find(&before, "┼").expect("a cursor");
    let down = if row > cursor_row { "j" } else { "k" };
    for _ in 0..row.abs_diff(cursor_row) {
        console.press(down);
    }
    let across = if to > column { "l" } else { "h" };
    for _ in 0..to.abs_diff(column) {
        console.press(across);
    }
    let after = shown(&console);
    assert_eq!(find(&after, "gate1"), Some((to, row)), "{after}");
    assert_eq!(
        find(&after, "┼"),
        None,
        "its letter is highlighted: {after}"
    );
}

/// `(2)` would look like the number of a vehicle.
#[test]
fn vehicles_in_one_place_are_counted_with_a_sign() {
    let mut console = Console::flying(0);
    console.vehicle(fixtures::airborne(1, 80.0, 20.0));
    for id in [2, 3] {
        let mut vehicle = fixtures::airborne(id, 0.0, 20.0);
        let global = vehicle.global.as_mut().expect("it has a position");
        global.at_point = fixtures::HOME;
        console.vehicle(vehicle);
    }
    console.press("M").press("z");
    let console = resized(console, (80, 24));
    let text = drawn(&console, Symbols::Braille, Language::English, (80, 24));
    assert!(text.contains("×2") && !text.contains("(2)"), "{text}");
}
