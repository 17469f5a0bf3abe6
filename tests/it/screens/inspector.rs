//! The room of messages.

use std::io::BufReader;
use std::sync::Arc;
use std::time::Duration;

use sortie::app::effect::{Effect, FileEffect};
use sortie::app::event::LinkEvent;
use sortie::app::room::messages::{LinkTraffic, traffic_request};
use sortie::inspector::{Census, FrameWay, WatchedMessage};
use sortie::link::TlogReader;
use sortie::text::{Language, Locale};
use sortie::ui::Look;
use sortie::wire::{Anatomy, Encoder, ground_station_heartbeat};

use super::link_room;
use crate::harness::Console;

/// A link's counts for a recording whose end is set to 100 s.
fn recorded(name: &str, peer: u32) -> Census {
    let path = format!(
        "{}/tests/data/recordings/{name}",
        env!("CARGO_MANIFEST_DIR")
    );
    let file = std::fs::File::open(path).expect("a recording");
    let records: Vec<_> = TlogReader::new(BufReader::new(file))
        .map(|record| record.expect("intact"))
        .collect();
    let last = records.last().expect("records").unix_us;
    let mut census = Census::default();
    for record in &records {
        let ago = Duration::from_micros(last - record.unix_us);
        let at = Duration::from_secs(100).saturating_sub(ago);
        let frame = Anatomy::of(&record.bytes).expect("a frame");
        if frame.system != 255 {
            census.note(FrameWay::received(peer), &record.bytes, true, at);
        }
    }
    let mut beat = Vec::new();
    Encoder::new(255, 190).encode(&ground_station_heartbeat(), &mut beat);
    census.note(FrameWay::sent(peer), &beat, true, Duration::from_secs(99));
    census
}

fn traffic(name: &str, census: Census) -> LinkTraffic {
    LinkTraffic {
        name: name.to_owned().into(),
        now: Duration::from_millis(100_200),
        census: Some(census),
        watched: Vec::new(),
    }
}

/// A console in the room of messages, with one link that has carried a flight.
fn inspecting() -> Console {
    let mut console = Console::flying(1);
    console.press("I");
    let flight = traffic("tcp:127.0.0.1:5760", recorded("flight.tlog", 0));
    console.hear(LinkEvent::Traffic(vec![flight]));
    console
}

/// Moves the cursor to the only message that matches a filter.
fn choose(console: &mut Console, name: &str) {
    console.press("/").write(name).press("enter").press("end");
}

#[track_caller]
pub(super) fn shows(console: &Console, expected: &[&str]) {
    let screen = console.screen(80, 24);
    for text in expected {
        assert!(screen.contains(text), "{text}:\n{screen}");
    }
}

#[track_caller]
fn hides(console: &Console, unwanted: &[&str]) {
    let screen = console.screen(80, 24);
    for text in unwanted {
        assert!(!screen.contains(text), "{text}:\n{screen}");
    }
}

#[test]
fn the_tree_leads_from_the_link_to_the_fields_with_units_and_names() {
    let mut console = inspecting();
    shows(
        &console,
        &["- 1 tcp:127.0.0.1:5760", "system 12 received", "QUADROTOR"],
    );
    choose(&mut console, "heartbeat");
    console.press("up").press("up").press("up");
    shows(
        &console,
        &["HEARTBEAT (0)", "2 QUADROTOR", "3 ARDUPILOTMEGA"],
    );
    choose(&mut console, "");
    console.press("esc");
    choose(&mut console, "ekf");
    shows(
        &console,
        &[
            "EKF_STATUS_REPORT (193)",
            "ATTITUDE VELOCITY_HORIZ",
            "velocity_variance",
        ],
    );
}

#[test]
fn sources_with_one_system_id_are_two_branches() {
    let mut console = inspecting();
    let mut both = recorded("flight.tlog", 0);
    let mut beat = Vec::new();
    Encoder::new(12, 1).encode(&ground_station_heartbeat(), &mut beat);
    both.note(FrameWay::received(1), &beat, true, Duration::from_secs(99));
    both.name_peer(1, "10.0.0.9:14550".to_owned());
    console.hear(LinkEvent::Traffic(vec![
        traffic("udpin:0.0.0.0:14550", both),
        traffic("tcp:127.0.0.1:5760", recorded("flight.tlog", 0)),
    ]));
    choose(&mut console, "heartbeat");
    let screen = console.screen(120, 40);
    assert_eq!(screen.matches("- system 12 ").count(), 3, "{screen}");
    assert!(screen.contains("10.0.0.9:14550"), "{screen}");
}

#[test]
fn branches_close_and_open_and_stay_so_when_the_room_is_left() {
    let mut console = inspecting();
    console.press("down").press("left");
    shows(&console, &["+ system 12 received"]);
    hides(&console, &["ATTITUDE"]);
    console.press("F").press("I");
    shows(&console, &["+ system 12 received"]);
    console.press("enter");
    shows(&console, &["- system 12 received", "SYS_STATUS"]);
    console.press("z");
    shows(&console, &["+ system 12", "+ system 255"]);
    console.press("z");
    shows(&console, &["- system 12"]);
}

#[test]
fn a_filter_finds_what_is_folded_away_and_esc_takes_it_back() {
    let mut console = inspecting();
    console.press("z").press("/").write("vfr");
    shows(&console, &["VFR_HUD", "show only"]);
    hides(&console, &["SYS_STATUS"]);
    console.press("ctrl-u").write("мак_рг");
    shows(&console, &["VFR_HUD"]);
    console.press("enter").press("esc");
    hides(&console, &["VFR_HUD"]);
    console.press("/").write("nothing like it").press("enter");
    shows(&console, &["no message matches"]);
}

#[test]
fn messages_are_ordered_by_name_rate_or_age() {
    let mut console = inspecting();
    let first = |console: &Console| {
        let screen = console.screen(80, 24);
        let at = screen.lines().position(|line| line.contains("component 1"));
        screen
            .lines()
            .nth(at.expect("a component") + 1)
            .expect("a line")
            .trim()
            .to_owned()
    };
    assert!(first(&console).starts_with("HEARTBEAT"));
    console.press("s");
    assert!(
        first(&console).starts_with("ATTITUDE"),
        "{}",
        first(&console)
    );
    console.press("s");
    shows(&console, &["by rate"]);
    console.press("s");
    shows(&console, &["by age"]);
}

#[test]
fn the_picture_stands_still_while_it_is_paused() {
    let mut console = inspecting();
    console.press("p");
    assert_eq!(traffic_request(console.state()), None);
    console.hear(LinkEvent::Traffic(vec![traffic(
        "another",
        Census::default(),
    )]));
    shows(&console, &["PAUSED", "tcp:127.0.0.1:5760"]);
    console.press("p");
    console.hear(LinkEvent::Traffic(vec![traffic(
        "another",
        Census::default(),
    )]));
    hides(&console, &["PAUSED", "tcp:127.0.0.1:5760"]);
}

#[test]
fn the_last_frame_is_shown_byte_by_byte() {
    let mut console = inspecting();
    choose(&mut console, "vfr");
    console.press("x");
    shows(&console, &["000 fd", "VFR_HUD (74)"]);
    hides(&console, &["airspeed"]);
    console.press("x");
    shows(&console, &["airspeed", "m/s"]);
}

#[test]
fn a_field_is_drawn_as_a_graph_wherever_one_is_until_it_is_let_go() {
    let mut console = inspecting();
    choose(&mut console, "vfr");
    console.press("g");
    shows(&console, &["choose a field first"]);
    console.press("tab").press("down").press("g");
    let shown = traffic_request(console.state()).expect("something");
    assert_eq!((shown.census, shown.watched.len()), (true, 1));
    let (_, key) = *shown.watched.first().expect("one");
    let census = recorded("flight.tlog", 0);
    let frame = census.tally(key).expect("it").last.clone();
    let frames = (0..50).map(|at| (Duration::from_secs(50 + at), frame.clone()));
    let watched = WatchedMessage {
        key,
        frames: frames.collect(),
        dropped: 0,
    };
    console.press("F");
    let elsewhere = traffic_request(console.state()).expect("the graph goes on");
    assert!(!elsewhere.census);
    console.hear(LinkEvent::Traffic(vec![LinkTraffic {
        census: None,
        watched: vec![watched],
        ..traffic("tcp:127.0.0.1:5760", Census::default())
    }]));
    console.press("I");
    shows(
        &console,
        &["VFR_HUD.groundspeed m/s", "60 s: ", "~groundspeed"],
    );
    console.press("g");
    hides(&console, &["60 s: "]);
    console.press("F");
    assert_eq!(traffic_request(console.state()), None);
}

#[test]
fn what_no_dialect_knows_is_shown_by_its_number_and_bytes() {
    let mut console = inspecting();
    let mut census = Census::default();
    let foreign = [0xFD, 2, 0, 0, 5, 9, 1, 0x30, 0xEF, 0, 0x41, 0x42, 1, 2];
    let from = FrameWay::received(0);
    for second in 97..=99 {
        let shown = census
            .tallies()
            .next()
            .is_some_and(|(key, it)| census.is_credible(key, it));
        assert!(!shown, "it may be noise");
        census.note(from, &foreign, false, Duration::from_secs(second));
    }
    console.hear(LinkEvent::Traffic(vec![traffic(
        "serial:/dev/ttyUSB0:57600",
        census,
    )]));
    console.press("end");
    shows(&console, &["#61232", "no dialect that", "000 fd 02", "AB"]);
}

#[test]
fn hundreds_of_sources_scroll() {
    let mut console = inspecting();
    let mut census = Census::default();
    for system in 1..=250 {
        let mut beat = Vec::new();
        Encoder::new(system, 1).encode(&ground_station_heartbeat(), &mut beat);
        census.note(
            FrameWay::received(system.into()),
            &beat,
            true,
            Duration::from_secs(99),
        );
    }
    console.hear(LinkEvent::Traffic(vec![traffic(
        "udpin:0.0.0.0:14550",
        census,
    )]));
    console.press("home");
    shows(&console, &["+ system 1 received"]);
    console.press("end");
    shows(&console, &["+ system 250 received"]);
    console
        .press("right")
        .press("right")
        .press("right")
        .press("right");
    shows(&console, &["HEARTBEAT (0)", "autopilot"]);
}

fn translated(console: &Console, language: Language) -> String {
    let look = Look {
        locale: Arc::new(Locale::new(language)),
        ..Look::default()
    };
    let backend = ratatui::backend::TestBackend::new(80, 24);
    let mut terminal = ratatui::Terminal::new(backend).expect("a test terminal");
    let draw = |frame: &mut ratatui::Frame<'_>| sortie::ui::draw(console.state(), &look, frame);
    terminal.draw(draw).expect("a test terminal");
    let cells = &terminal.backend().buffer().content;
    let line = |row: &[ratatui::buffer::Cell]| {
        let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    };
    cells.chunks(80).map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn both_rooms_as_they_look() {
    let mut messages = inspecting();
    choose(&mut messages, "vfr");
    messages.press("/").press("ctrl-u").press("enter");
    messages.press("tab").press("down").press("down").press("g");
    let links = link_room::ailing();
    for (name, console) in [("messages", &messages), ("links", &links)] {
        for (width, height) in [(80, 24), (120, 40)] {
            let name = format!("room_{name}_{width}x{height}");
            insta::assert_snapshot!(name, console.screen(width, height));
        }
        let name = format!("room_{name}_uk_80x24");
        insta::assert_snapshot!(name, translated(console, Language::Ukrainian));
    }
}

#[test]
fn the_last_frame_is_put_on_the_command_line_to_be_sent_again() {
    let mut console = inspecting();
    console.press("e");
    shows(&console, &["choose a message first"]);
    choose(&mut console, "heartbeat");
    console.press("up").press("up").press("up").press("e");
    let screen = console.screen(200, 50);
    assert!(
        screen.contains("send HEARTBEAT custom_mode=") && screen.contains("type=QUADROTOR"),
        "{screen}"
    );
}

#[test]
fn statistics_begin_anew_and_are_exported_from_any_room() {
    let mut console = inspecting();
    console.press("r");
    shows(&console, &["new statistics"]);
    let request = traffic_request(console.state()).expect("the room is open");
    assert_eq!((request.census, request.resets), (true, 1));
    console.press("F");
    let pending = traffic_request(console.state()).expect("the reset is still due");
    assert_eq!(pending.resets, 1);
    let reset = |resets: u32| {
        let mut census = recorded("flight.tlog", 0);
        census.reset_statistics(resets, Duration::from_secs(90));
        census
    };
    console.hear(LinkEvent::Traffic(vec![traffic("link", reset(1))]));
    assert_eq!(traffic_request(console.state()), None);
    console.give("messages export ~/link.txt");
    assert!(console.screen(80, 24).contains(".csv"));
    console.press("esc").give("messages export link.csv");
    assert!(console.effects.is_empty(), "the next count is exported");
    let request = traffic_request(console.state()).expect("counts for the export");
    assert!(request.census);
    console.hear(LinkEvent::Traffic(vec![traffic("link", reset(1))]));
    let [
        Effect::File(FileEffect::Write {
            path,
            text,
            replace: false,
            ..
        }),
    ] = console.effects.as_slice()
    else {
        panic!("{:?}", console.effects);
    };
    assert_eq!(path, "link.csv");
    assert!(
        text.starts_with("link,direction,") && text.contains(",ATTITUDE,"),
        "{text}"
    );
    assert_eq!(traffic_request(console.state()), None);
}

#[test]
fn wide_screens_list_jitter_and_silence() {
    let mut console = inspecting();
    choose(&mut console, "attitude");
    let screen = console.screen(200, 50);
    for text in ["jitter", "silent", "interval up to", "lost 158 (6.0 %)"] {
        assert!(screen.contains(text), "{text}:\n{screen}");
    }
}
