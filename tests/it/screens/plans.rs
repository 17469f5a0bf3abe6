//! The room of plans: a survey with a fence, beside another draft.

use sortie::app::event::TerminalEvent;
use sortie::text::Language;

use super::check;
use crate::fixtures;
use crate::harness::Console;

/// Two vehicles on the ground, and a small survey drawn by lines.
fn drawing(language: Language) -> Console {
    let mut console = Console::in_language(language).in_flight(2);
    for line in [
        "draft new north",
        "draft add takeoff 20",
        "draft add n 150 e -120",
        "draft add rtl",
        "draft new survey",
        "draft add takeoff 30",
        "draft add n 40 e -60",
        "draft add n 40 e 60 up 45",
        "draft add n 80 e 60",
        "draft add n 80 e -60 up 30 frame terrain",
        "draft set 5 hold 5s",
        "draft add speed",
        "draft set 6 speed 4",
        "draft add n 120 e -60",
        "draft add n 120 e 60",
        "draft jump 8 to 3 times 2",
        "draft add rtl",
        "draft fence polygon n -20 e -90",
        "draft fence corner n -20 e 90",
        "draft fence corner n 110 e 90",
        "draft fence corner n 110 e -90",
        "draft fence circle 15 out n 60 e 0",
        "draft rally n -10 e 70",
    ] {
        console.give(line);
    }
    console.hear(TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    });
    console.press("1").press("z").press("j").press("j");
    console
}

fn sized(console: &Console, columns: u16, rows: u16) -> Console {
    let mut console = console.clone();
    console.hear(TerminalEvent::Resize { columns, rows });
    console.press("z").press("k").press("j");
    console
}

#[test]
fn a_survey_being_drawn() {
    for language in Language::ALL {
        let console = drawing(language);
        for (columns, rows) in [(80, 24), (120, 40), (200, 50), (60, 20)] {
            let screen = sized(&console, columns, rows).screen(columns, rows);
            let name = format!("plans_{}_{columns}x{rows}", language.code());
            insta::assert_snapshot!(name, screen);
        }
    }
}

#[test]
fn the_fence_and_a_marked_range() {
    let mut console = drawing(Language::English);
    console.press("2").press("j");
    insta::assert_snapshot!("plans_fence_80x24", console.screen(80, 24));
    console
        .press("1")
        .press("j")
        .press(" ")
        .press("j")
        .press("j");
    insta::assert_snapshot!("plans_marked_80x24", console.screen(80, 24));
}

#[test]
fn without_a_draft_the_room_says_how_to_begin() {
    let mut console = Console::flying(1);
    console.press("E");
    check("plans_empty", &console);
    let mut alone = Console::new();
    alone.press("E");
    check("plans_nowhere", &alone);
    alone.give(&format!(
        "draft home {} {}",
        fixtures::HOME.lat_deg,
        fixtures::HOME.lon_deg
    ));
    alone.press("z").press("a");
    insta::assert_snapshot!("plans_without_vehicles_80x24", alone.screen(80, 24));
}
