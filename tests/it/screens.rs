//! Every screen and overlay as text, at usual sizes and at extreme ones.

use std::time::Duration;

use sortie::app::event::{Event, LinkEvent, SessionEvent};
use sortie::app::state::{Activity, LinkCounters, LinkSummary};
use sortie::campaign::Stake;
use sortie::ledger::RowState;
use sortie::text::Language;
use sortie::vehicle::{Severity, Vehicle};

use crate::fixtures;
use crate::harness::Console;

mod career;
mod class;
mod crew;
mod crowded;
mod debrief;
mod files;
mod fly;
mod hangar;
mod inspector;
mod keys;
mod legs;
mod link_room;
mod map;
mod map_signs;
mod mission;
mod on_board;
mod parameters;
mod plans;
mod replay;
mod review;
mod rooms;
mod shared;
mod vehicle;
mod wire;
mod workshop;

const SIZES: [(u16, u16); 2] = [(80, 24), (200, 50)];

fn check(name: &str, console: &Console) {
    for (width, height) in SIZES {
        insta::assert_snapshot!(
            format!("{name}_{width}x{height}"),
            console.screen(width, height)
        );
    }
}

fn link(name: &str, state: &str, up: bool) -> LinkSummary {
    LinkSummary {
        name: name.to_owned().into(),
        state: state.into(),
        up,
        bytes_in_per_s: 4123.0,
        bytes_out_per_s: 52.0,
        messages_in_per_s: 96.0,
        messages_out_per_s: 2.0,
        error: (!up).then(|| "port 14550 is in use: another program listens there".into()),
        counters: Some(LinkCounters {
            peers: 1,
            bad_crc: 3,
            skipped_bytes: 1205,
            lost: vec![((1, 1), 0), ((3, 1), 17)],
            unknown: 1,
            ..LinkCounters::default()
        }),
        round_trip: Some(Duration::from_millis(4)),
    }
}

/// A mission with every possible alarm and fault.
fn busy() -> Console {
    busy_in(Language::English)
}

fn busy_in(language: Language) -> Console {
    let mut console = Console::in_language(language);
    console.start(Activity::Mission {
        id: "m01".to_owned(),
        title: "Air sample at the yard".into(),
        stake: Stake::Graded,
    });
    console.press("F");
    let mut lost: Vehicle = fixtures::airborne(3, 120.0, 31.5);
    lost.link.lost = true;
    lost.link.last_heard = Some(Duration::from_secs(180));
    let mut unready = fixtures::parked(4);
    unready.health = unready.health.map(|health| sortie::vehicle::Health {
        healthy: 0,
        ..health
    });
    unready.prearm.push("Need Position Estimate".to_owned());
    console.at(185);
    for vehicle in [
        fixtures::airborne(1, 20.0, 20.1),
        fixtures::airborne(2, 35.0, 20.0),
        lost,
        unready,
    ] {
        console.vehicle(vehicle);
    }
    console.hear(LinkEvent::Summaries(vec![
        link("pipe:1", "up", true),
        link("udpin:0.0.0.0:14550", "retry in 4 s", false),
    ]));
    console.give("all arm");
    for vehicle in 1..=3 {
        console.row(vehicle, RowState::Done, None);
    }
    console.row(
        4,
        RowState::Refused,
        Some("arm refused: PreArm: Need Position Estimate"),
    );
    console.at(190).give("1-3 takeoff 20");
    console
        .row(1, RowState::Done, None)
        .row(2, RowState::Accepted, None)
        .row(3, RowState::TimedOut, Some("takeoff: no answer in 5 s"));
    console.notice(Severity::Info, Some(1), "Arming motors");
    console.notice(Severity::Info, Some(2), "Arming motors");
    console.notice(
        Severity::Critical,
        Some(4),
        "PreArm: Need Position Estimate",
    );
    console.notice(
        Severity::Critical,
        Some(4),
        "PreArm: Need Position Estimate",
    );
    console
        .at(191)
        .notice(Severity::Alert, Some(3), "link lost: nothing heard for 3 s");
    console.hear(Event::NoticesDropped(12));
    console.hear(SessionEvent::Mission(Box::new(fixtures::progress())));
    console
}

#[test]
fn home() {
    check("home", &Console::new());
    let mut console = Console::new();
    console.press("j");
    check("home_free", &console);
}

#[test]
fn connect_prompt_with_an_error() {
    let mut console = Console::new();
    console
        .press("down")
        .press("down")
        .press("enter")
        .write("tcp:nowhere")
        .press("enter");
    console.hear(Event::Failed(
        "`tcp:nowhere` has no port: write tcp:HOST:PORT".into(),
    ));
    check("connect", &console);
}

#[test]
fn free_flight_before_and_after_the_first_vehicles() {
    check("waiting", &Console::flying(0));
    check("free", &Console::flying(4));
}

#[test]
fn a_mission_in_flight() {
    check("mission", &busy());
    insta::assert_snapshot!("mission_120x40", busy().screen(120, 40));
}

#[test]
fn a_swarm_larger_than_the_screen() {
    let mut console = Console::flying(250);
    console.write("100-120,7").press("enter").press("down");
    check("large", &console);
}

#[test]
fn the_command_line_offers_and_marks() {
    let mut console = busy();
    check("palette_empty", console.press(":"));
    check(
        "palette_wrong",
        console.write("1-2 takeof 20").press("enter"),
    );
    console.press("esc").press(":");
    insta::assert_snapshot!(
        "palette_tab_80x24",
        console.write("t").press("tab").screen(80, 24)
    );
    console.press("esc").press(":");
    insta::assert_snapshot!(
        "palette_marked_80x24",
        console.write("1 takeoff high ").screen(80, 24)
    );
    console.press("esc").press(":");
    insta::assert_snapshot!(
        "palette_ready_80x24",
        console.write("1-2 takeoff 20").screen(80, 24)
    );
}

#[test]
fn questions_help_and_links() {
    let mut console = busy();
    check("confirm", console.give("1-3 kill"));
    insta::assert_snapshot!("cancelled_80x24", console.press("x").screen(80, 24));
    check("help", console.press("esc").press("?"));
    check("links", console.press("esc").give("links"));
    check("ledger", console.press("esc").press("c"));
    console.press("F");
    check("notices", console.press("esc").press("n").press("k"));
    insta::assert_snapshot!(
        "leave_80x24",
        console.press("esc").give("leave").screen(80, 24)
    );
}

#[test]
fn debrief() {
    let mut console = busy();
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    check("debrief", &console);
}

#[test]
fn a_terminal_that_is_too_small_is_told_so() {
    insta::assert_snapshot!("small_60x20", busy().screen(60, 20));
}

#[test]
fn no_size_of_terminal_panics() {
    let mut consoles = vec![
        Console::new(),
        Console::flying(0),
        Console::flying(250),
        busy(),
    ];
    for keys in [
        [":", "t"],
        ["?", "j"],
        ["L", "j"],
        ["b", "j"],
        ["c", "k"],
        ["n", "k"],
        ["C", "enter"],
        ["/", "x"],
        ["s", "S"],
        ["*", "j"],
    ] {
        let mut console = busy();
        console.press(keys[0]).press(keys[1]);
        consoles.push(console);
    }
    let mut console = busy();
    console.give("1-3 kill");
    consoles.push(console);
    let mut console = busy();
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    consoles.push(console);
    let widths = [1, 2, 5, 79, 80, 81, 97, 120, 159, 160, 161, 200, 250];
    draw_at_some_sizes(&consoles, &widths, &[1, 2, 3, 23, 24, 25, 33, 50, 80]);
}

/// Draws each console at a third of all sizes, so that each size is drawn by a third of the consoles.
fn draw_at_some_sizes(consoles: &[Console], widths: &[u16], heights: &[u16]) {
    for (nth, console) in consoles.iter().enumerate() {
        for (column, width) in widths.iter().enumerate() {
            for (row, height) in heights.iter().enumerate() {
                if (nth + column + row).is_multiple_of(3) {
                    console.screen(*width, *height);
                }
            }
        }
    }
}

#[test]
fn text_from_vehicles_never_reaches_the_terminal_as_control() {
    let mut console = busy();
    let escape = "x\u{1b}[2Jy\u{9b}31m\u{7}";
    console.notice(Severity::Critical, Some(1), escape);
    let mut vehicle = fixtures::parked(1);
    vehicle.health = vehicle.health.map(|health| sortie::vehicle::Health {
        healthy: 0,
        ..health
    });
    vehicle.prearm.push(escape.to_owned());
    console.vehicle(vehicle);
    for (width, height) in SIZES {
        let screen = console.screen(width, height);
        assert!(screen.contains('x'), "{screen}");
        let control = screen.chars().find(|&c| c.is_control() && c != '\n');
        assert_eq!(control, None, "{screen}");
    }
}
