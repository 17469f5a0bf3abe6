//! The room of plans: a survey with a fence, beside another draft.

use sortie::app::event::{Event, FileEvent, TerminalEvent};
use sortie::draft::{TrialFlight, TrialPilot, Tried};
use sortie::geo::{Square, Terrain};
use sortie::ledger::RowState;
use sortie::rehearsal::{Approach, FlightEnding, Flown};
use sortie::text::{Language, Text};

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

/// The room shows the outcome of commands to vehicles, each on its own line, and the next possible
/// step.
#[test]
fn the_last_command_and_the_next_step_are_shown() {
    let mut console = drawing(Language::English);
    console.give("1-2 plan upload survey.plan");
    console.row(1, RowState::InProgress(40), None);
    let screen = console.screen(80, 24);
    assert!(screen.contains("1-2 plan upload survey.plan"), "{screen}");
    console.row(1, RowState::Done, Some("9 items (7f3a)")).row(
        2,
        RowState::Refused,
        Some("item 3 is too far away"),
    );
    for (columns, rows) in [(80, 24), (200, 50)] {
        let name = format!("plans_refused_{columns}x{rows}");
        insta::assert_snapshot!(name, sized(&console, columns, rows).screen(columns, rows));
    }
}

/// The result of a rehearsal is whole at 80 columns, and names all pairs in conflict.
#[test]
fn the_result_of_a_rehearsal_is_not_cut() {
    let mut console = drawing(Language::English);
    let pairs = "vehicle-1 + vehicle-3 01:03, vehicle-2 + vehicle-4 02:10";
    console.hear(Event::Tried(Tried {
        text: Text::verbatim(format!(
            "2 conflicts: {pairs}; `draft deconflict` separates them"
        )),
        details: vec![
            Text::verbatim("too close: vehicle-1 and vehicle-3"),
            Text::verbatim("too close: vehicle-2 and vehicle-4"),
        ],
        is_sound: false,
        ..Tried::default()
    }));
    console.press("k");
    for (columns, rows) in [(80, 24), (200, 50)] {
        let screen = sized(&console, columns, rows).screen(columns, rows);
        let words = screen.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(pairs), "{screen}");
        insta::assert_snapshot!(format!("plans_conflicts_{columns}x{rows}"), screen);
    }
}

/// The flights of six drafts, with a breach, a failsafe, and three pairs in conflict in one place.
fn six_flights() -> TrialFlight {
    let flown = Flown {
        time_s: 141.0,
        energy_used_percent: 28.6,
        farthest_m: 184.2,
        broke_fence_s: None,
        has_fence: true,
        was_kept_armed: false,
        ending: FlightEnding::Landed,
        moved_east_m: 0.0,
    };
    let pilot = |(id, flown)| TrialPilot {
        name: format!("vehicle-{id}"),
        sharer: Some(id),
        flown,
    };
    let breach = Flown {
        broke_fence_s: Some(44.0),
        ..flown
    };
    let home = Flown {
        ending: FlightEnding::LeftPlan(6),
        energy_used_percent: 88.0,
        ..flown
    };
    let flights = [flown, flown, breach, flown, home, flown];
    let pair = |(a, b, horizontal_m)| Approach {
        a,
        b,
        horizontal_m,
        vertical_m: 0.4,
        at_s: 63.0 + horizontal_m,
        place: fixtures::HOME.moved(60.0, 40.0),
        limit_m: 5.0,
        late_s: None,
    };
    let pairs = [(0, 2, 0.8), (1, 3, 1.1), (0, 3, 2.4), (4, 5, 38.0)];
    TrialFlight {
        pilots: (1..).zip(flights).map(pilot).collect(),
        closest: pairs.map(pair).to_vec(),
    }
}

/// The figures of a rehearsal replace the items until a key shows the items again; the map has a
/// sign for each conflict.
#[test]
fn the_figures_of_a_rehearsal_are_shown() {
    let mut console = drawing(Language::English);
    console.hear(Event::Tried(Tried {
        text: Text::verbatim("3 conflicts; `draft deconflict` separates them"),
        is_sound: false,
        flight: Some(six_flights()),
        is_awaited: true,
        ..Tried::default()
    }));
    for (columns, rows) in [(80, 24), (200, 50)] {
        let screen = sized(&console, columns, rows).screen(columns, rows);
        for sign in ["!1/3", "!2/4", "!1/4"] {
            assert!(screen.contains(sign), "{sign}: {screen}");
        }
        insta::assert_snapshot!(format!("plans_figures_{columns}x{rows}"), screen);
    }
    console.press("j").press("j").press("j");
    let screen = console.screen(80, 24);
    assert!(screen.contains("5 + 6"), "{screen}");
    console.press("d");
    assert!(!console.screen(80, 24).contains("71 %"));
    console.press("d").press("u");
    assert!(!console.screen(80, 24).contains("71 %"), "another draft");
}

/// Long names of drafts are shortened so that both names of a pair differ, and the number of
/// further failures is shown.
#[test]
fn figures_of_drafts_with_long_names() {
    let mut console = drawing(Language::English);
    let mut flight = six_flights();
    for (pilot, name) in flight.pilots.iter_mut().zip(["north", "south", "east"]) {
        (pilot.name, pilot.sharer) = (format!("survey-area-{name}"), None);
    }
    console.hear(Event::Tried(Tried {
        text: Text::verbatim("survey-area-east breaches its fence at 00:44"),
        further: 2,
        left_out: Some(Text::verbatim("not flown: field (no vehicle has it)")),
        flight: Some(flight),
        is_awaited: true,
        ..Tried::default()
    }));
    for (columns, rows) in [(80, 24), (200, 50)] {
        let screen = sized(&console, columns, rows).screen(columns, rows);
        insta::assert_snapshot!(format!("plans_long_names_{columns}x{rows}"), screen);
    }
}

/// The most used keys are in the footer at 80 columns.
#[test]
fn the_survey_key_is_shown_at_80_columns() {
    let screen = drawing(Language::English).screen(80, 24);
    assert!(screen.contains("S survey"), "{screen}");
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

#[test]
fn of_six_drafts_the_open_one_is_shown_with_its_name() {
    let mut console = Console::flying(6);
    console.press("E");
    for name in ["north", "south", "survey", "long-search", "return", "sixth"] {
        console.give(&format!("draft new {name}"));
        console.give("draft add takeoff 20");
    }
    for name in ["sixth", "north", "long-search"] {
        console.give(&format!("draft use {name}"));
        let screen = console.screen(80, 24);
        let tabs = screen.lines().nth(1).expect("a row of drafts");
        assert!(tabs.contains(&format!("{name}*")), "{tabs}");
        assert!(tabs.contains("[1 plan 1]"), "{tabs}");
        let signs = tabs.split("[1 plan").next().unwrap_or_default();
        let words: Vec<&str> = signs.split_whitespace().collect();
        assert!(words.len() >= 6, "each draft stands apart: {tabs}");
    }
    insta::assert_snapshot!("plans_six_80x24", console.screen(80, 24));
}

/// Ground that rises from 170 m at home by 1 m for each 5 m to the north.
fn slope() -> Terrain {
    const SIDE: usize = 1201;
    let square = Square::of(fixtures::HOME);
    let heights = (0..SIDE).map(|row| {
        let lat_deg = f64::from(square.lat) + 1.0 - row as f64 / (SIDE - 1) as f64;
        let north_m = (lat_deg - fixtures::HOME.lat_deg) * 111_195.0;
        (180.0 + north_m / 5.0).clamp(0.0, 9000.0) as i16
    });
    let bytes: Vec<u8> = heights
        .flat_map(|height| std::iter::repeat_n(height.to_be_bytes(), SIDE))
        .flatten()
        .collect();
    let mut terrain = Terrain::default();
    terrain.add(square, &bytes).expect("the right size");
    terrain
}

#[test]
fn the_heights_show_the_ground_and_legs_that_come_too_close_to_it() {
    let mut console = drawing(Language::English);
    console.give("draft ground srtm");
    console.hear(FileEvent::Ground {
        folder: "srtm".to_owned(),
        terrain: slope(),
    });
    console.press("k").press("j");
    insta::assert_snapshot!("plans_ground_80x24", console.screen(80, 24));
    let wide = sized(&console, 200, 50);
    insta::assert_snapshot!("plans_ground_200x50", wide.screen(200, 50));
}
