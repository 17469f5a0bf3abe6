//! The room of the mission, the home screen during a session, and the debrief, in both languages.

use std::sync::Arc;

use sortie::app::effect::PaceChange;
use sortie::app::event::{SessionEvent, TerminalEvent};
use sortie::app::state::{Activity, Room};
use sortie::campaign::Stake;
use sortie::mission::Mission;
use sortie::text::{Language, Locale};
use sortie::vehicle::Severity;

use crate::fixtures;
use crate::harness::Console;

const SHIPPED: &str = include_str!("../../../missions/01-air-sample.toml");

/// The home screen with the shipped mission under the cursor.
fn shipped(language: Language) -> Console {
    Console::set_up(|setup| {
        setup.locale = Arc::new(Locale::new(language));
        setup.missions = vec![Mission::parse(SHIPPED).expect("good").listing()];
    })
}

fn flying() -> Console {
    let mut console = Console::new();
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    console.vehicle(fixtures::airborne(1, 20.0, 20.1));
    let mut progress = fixtures::progress();
    progress.hint = Some("take off".into());
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console.press("b");
    console
}

fn check(name: &str, console: &mut Console, sizes: &[(u16, u16)]) {
    for &(columns, rows) in sizes {
        console.hear(TerminalEvent::Resize { columns, rows });
        let screen = console.screen(columns, rows);
        insta::assert_snapshot!(format!("{name}_{columns}x{rows}"), screen);
    }
}

const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (200, 50)];

#[test]
fn the_room_before_the_flight_and_during_it() {
    let mut before = shipped(Language::English);
    check("room_mission_before", before.press("B"), &SIZES);
    check("room_mission_flying", &mut flying(), &SIZES);
}

#[test]
fn the_room_in_ukrainian() {
    let mut before = shipped(Language::Ukrainian);
    check("room_mission_uk", before.press("B"), &SIZES[..2]);
    before.hear(TerminalEvent::Resize {
        columns: 80,
        rows: 24,
    });
    before.press("end");
    check("room_mission_uk_end", &mut before, &SIZES[..1]);
    before.press("H");
    check("home_uk", &mut before, &SIZES[..2]);
    before.press("j");
    check("home_free_uk", &mut before, &SIZES[..1]);
}

#[test]
fn scrolling_ends_with_the_last_line_and_comes_back_at_once() {
    let mut console = shipped(Language::English);
    console.press("B");
    let top = console.screen(80, 24);
    console.press("end").press("down").press("down");
    let end = console.screen(80, 24);
    assert_ne!(top, end);
    assert!(end.contains("gold needs"), "{end}");
    assert_ne!(console.press("up").screen(80, 24), end);
    assert_eq!(console.press("home").screen(80, 24), top);
}

#[test]
fn enter_flies_the_mission_that_was_read_and_escape_leads_back() {
    let mut console = shipped(Language::English);
    console.press("B").press("esc");
    assert_eq!(console.state().room(), Room::Home);
    console.press("B").press("enter");
    assert_eq!(console.effects.len(), 1, "{:?}", console.effects);
    let mut console = flying();
    assert_eq!(console.state().room(), Room::Mission);
    console.press("enter");
    assert!(console.effects.is_empty(), "{:?}", console.effects);
    console.press("esc");
    assert_eq!(console.state().room(), Room::Fly);
}

#[test]
fn without_a_mission_the_room_says_so() {
    let mut console = Console::flying(1);
    let screen = console.give("brief").screen(80, 24);
    assert!(screen.contains("no mission is being flown"), "{screen}");
}

#[test]
fn the_home_screen_says_that_a_session_goes_on() {
    let mut console = flying();
    console.press("H");
    check("home_running", &mut console, &SIZES[..1]);
    assert_eq!(console.press("F").state().room(), Room::Fly);
}

#[test]
fn a_debrief_follows_the_language_and_can_be_read_in_later_flights() {
    let mut console = flying();
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    assert!(console.screen(80, 24).contains("TIMELINE"));
    console.at(2).give("set lang uk");
    assert!(console.screen(80, 24).contains("ПЕРЕБІГ"));
    console.at(300).press("h");
    assert_eq!(console.state().room(), Room::Home);
    assert!(console.press("D").screen(80, 24).contains("ПЕРЕБІГ"));
    console.start(Activity::Free);
    assert!(console.press("D").screen(80, 24).contains("ПЕРЕБІГ"));
}

#[test]
fn without_a_debrief_the_whole_reason_is_shown() {
    let screen = Console::new().press("D").screen(80, 24);
    let words = screen.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("`seek end` leads there."), "{screen}");
}

#[test]
fn a_long_target_cuts_no_other_column() {
    let console = Console::set_up(|setup| {
        let text = include_str!("../../../missions/04-line-inspection.toml");
        setup.missions = vec![Mission::parse(text).expect("good").listing()];
    });
    for width in 150..=220 {
        let screen = console.screen(width, 50);
        let is_beside = screen.contains("── objectives");
        let expected = if is_beside { 3 } else { 0 };
        let shown = screen.matches("mandatory").count();
        assert_eq!(shown, expected, "{width}\n{screen}");
    }
}

#[test]
fn the_hint_keeps_a_row_however_full_the_pane_is() {
    let mut console = flying();
    for id in 2..=12 {
        console.vehicle(fixtures::airborne(id, 20.0, 20.1));
    }
    let mut progress = fixtures::progress();
    progress.hint = Some("take off".into());
    progress.objectives.extend(progress.objectives.clone());
    console.hear(SessionEvent::Mission(Box::new(progress)));
    let screen = console.press("F").screen(80, 24);
    assert!(screen.contains("hint: take off"), "{screen}");
}

/// The left pane of the flight screen, with single spaces.
fn left_pane(console: &Console) -> String {
    let screen = console.screen(80, 24);
    let rows = screen
        .lines()
        .map(|row| row.chars().take(40).collect::<String>());
    let words: Vec<String> = rows
        .flat_map(|row| {
            row.split_whitespace()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .collect();
    words.join(" ")
}

#[test]
fn a_long_hint_is_whole_beside_counts_and_above_a_long_message() {
    let mut console = flying();
    for id in 2..=6 {
        console.vehicle(fixtures::airborne(id, 20.0, 20.1));
    }
    let hint = "Commands go to the drone under the cursor. Try one that it cannot carry out yet: press t, \
                type `20`, Enter. The ledger shows why it is refused, and what you have to do before it.";
    let mut progress = fixtures::progress();
    progress.hint = Some(hint.into());
    progress.objectives.extend(progress.objectives.clone());
    console.hear(SessionEvent::Mission(Box::new(progress)));
    console.press("F");
    assert!(
        left_pane(&console).contains(hint),
        "{}",
        console.screen(80, 24)
    );
    let message = "a message that is so long that it takes two rows of a screen with eighty columns, \
                   above the last row";
    console.hear(SessionEvent::Speedup(PaceChange {
        speedup: 1.0,
        because: Some(message.into()),
    }));
    let screen = console.screen(80, 24);
    assert!(screen.contains("above the last row"), "{screen}");
    assert!(left_pane(&console).contains(hint), "{screen}");
    // The objectives that have no row left are marked.
    assert!(screen.contains('▼'), "{screen}");
}

#[test]
fn notices_keep_the_clock_of_their_session() {
    let mut console = flying();
    console.at(200).notice(Severity::Info, Some(1), "a text");
    let told = |console: &mut Console| {
        let screen = console.give("notices").screen(80, 24);
        let line = screen.lines().find(|line| line.contains("a text"));
        let line = line.expect("the notice").trim_matches(['│', ' ', '>']);
        console.press("esc");
        line.to_owned()
    };
    let before = told(&mut console);
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.at(300).press("h");
    assert_eq!(console.state().room(), Room::Home);
    assert_eq!(told(&mut console), before);
}

#[test]
fn missions_are_listed_with_the_number_that_fly_takes() {
    let mut listing = fixtures::listing();
    listing.id = "07-clearance".to_owned();
    listing.title = "Clearance team".into();
    let console = Console::set_up(|setup| setup.missions.push(listing));
    let home = console.screen(80, 24);
    assert!(home.contains("07 Clearance team"), "{home}");
    // An id without a leading number is not shown as a name.
    assert!(home.contains(">   Air sample at the yard"), "{home}");
}

#[test]
fn what_passing_brings_is_told_before() {
    let mut console = shipped(Language::English);
    let brief = console.press("B").screen(80, 60);
    assert!(brief.contains("for passing"), "{brief}");
    assert!(
        brief.contains("300 credits, part particle counter"),
        "{brief}"
    );
}
