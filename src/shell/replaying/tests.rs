//! Records of the console, and their replay.

use std::sync::Arc;

use super::*;
use crate::app::State;
use crate::app::event::TerminalEvent;
use crate::app::room::Room;
use crate::language::SeekTarget;
use crate::mission::Mission;
use crate::record::{Head, Subject};
use crate::shell::pace::TICK;
use crate::shell::{ConsoleOptions, Opening};
use crate::store::{RecordLimits, Records, Runs};

const FIRST: &str = include_str!("../../../missions/00-first-flight.toml");

async fn run(console: &mut Console, seconds: u32) {
    for _ in 0..seconds * 10 {
        tokio::time::sleep(TICK).await;
        console.tick().await;
    }
}

async fn say(console: &mut Console, line: &str) {
    console.feed(TerminalEvent::Line(line.to_owned())).await;
}

/// The mission's state as the console shows it: its time, and its lines of text.
fn told(state: &State) -> (Option<Duration>, Vec<String>, Vec<String>) {
    let session = state.session();
    let entries = session.ledger().entries();
    (
        session.mission().map(|it| it.elapsed),
        session
            .mission()
            .iter()
            .flat_map(|it| &it.objectives)
            .map(|it| it.detail.to_string())
            .collect(),
        entries
            .flat_map(|entry| {
                let rows = entry.rows.iter();
                rows.map(|row| format!("{}: {}", entry.line, row.state))
            })
            .collect(),
    )
}

/// A console that flies the first mission and keeps its records in a folder.
async fn flying(data: &Path) -> Console {
    Box::pin(flying_in(data, false)).await
}

/// A console that flies the first mission, with rooms or as `--plain`.
async fn flying_in(data: &Path, has_rooms: bool) -> Console {
    let mission = Mission::parse(FIRST).expect("it is good");
    let mut options = ConsoleOptions::for_test(Opening::Mission(Arc::new(mission)));
    let limits = RecordLimits::default();
    options.preferences.records = Some(Records::within(data, limits));
    options.preferences.runs = Some(Runs::within(data));
    let mut console = Console::new(options, has_rooms);
    let (columns, rows) = (120, 40);
    console.feed(TerminalEvent::Resize { columns, rows }).await;
    console.begin().await;
    console
}

async fn abandon(console: &mut Console) {
    say(console, "abandon").await;
    let confirmed = crate::shell::key(crossterm::event::KeyCode::Char('y'));
    console.feed(confirmed).await;
    run(console, 2).await;
}

/// The telemetry of the vehicles, their texts, the commands and the objectives, as the screens show them.
fn shown(state: &State) -> [Vec<String>; 4] {
    let vehicles = state.session().vehicles().values().map(|it| {
        let is = it.heartbeat.as_ref().map(|it| (it.mode, it.armed));
        let place = it
            .global
            .map(|it| (it.at_point, it.altitude_m, it.east_m_s, it.heading_deg));
        let attitude = it
            .attitude
            .map(|it| (it.roll_deg, it.pitch_deg, it.yaw_deg));
        let packs = it.batteries.iter();
        let packs: Vec<_> = packs.map(|it| (it.voltage_v, it.consumed_mah)).collect();
        format!("{} {is:?} {place:?} {attitude:?} {packs:?}", it.id)
    });
    let notices = state.notices().lines().map(|it| &it.notice);
    let texts = notices.filter(|it| it.vehicle.is_some());
    let texts = texts.map(|it| format!("{:?} {}", it.vehicle, it.text));
    let (_, objectives, rows) = told(state);
    [vehicles.collect(), texts.collect(), rows, objectives]
}

/// Goes to a time of the replay, and waits until it is shown.
async fn show(console: &mut Console, at: Duration) -> [Vec<String>; 4] {
    console.steer_replay(ReplayEffect::Seek(SeekTarget::At(at)));
    while !console.replaying.as_ref().is_some_and(Replay::is_there) {
        run(console, 1).await;
    }
    console.take_in().await;
    shown(console.app.state())
}

#[tokio::test(start_paused = true)]
async fn the_record_of_a_mission_ends_soon_after_the_mission() {
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying(data.path())).await;
    run(&mut console, 20).await;
    abandon(&mut console).await;
    run(&mut console, 60).await;
    say(&mut console, "bookmark late").await;
    let said = console.app.state().message().map(|it| it.text.clone());
    assert_eq!(said, Some(text!("bookmark-not-recorded")));
    say(&mut console, "leave").await;
    let records = Records::within(data.path(), RecordLimits::default());
    let files = records.list().remove(0);
    assert!(!files.is_cut_off());
    let began = files.head().expect("a journal").began_unix_us;
    let frames = files.frames().expect("a tlog");
    let span = crate::replay::TlogSpan::read(frames).expect("frames");
    let length = span.length_from(began).as_secs();
    assert!((20..28).contains(&length), "{length} s");
}

#[tokio::test(start_paused = true)]
async fn a_pause_moves_the_time_of_day_of_what_follows() {
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying(data.path())).await;
    run(&mut console, 5).await;
    say(&mut console, "pause").await;
    run(&mut console, 30).await;
    say(&mut console, "continue").await;
    run(&mut console, 5).await;
    abandon(&mut console).await;
    say(&mut console, "replay").await;
    console.take_in().await;
    let view = console.app.state().replay().expect("a replay");
    let day = |at_s| {
        let since = view.day.unix_us(0, Duration::from_secs(at_s));
        since / 1_000_000
    };
    assert_eq!((day(4), day(8)), (4, 38));
    let length = view.length.as_secs();
    assert!((9..16).contains(&length), "{length} s");
}

#[tokio::test(start_paused = true)]
async fn a_brief_that_was_only_read_leaves_no_record() {
    let data = tempfile::tempdir().expect("a folder");
    let mission = Mission::parse(FIRST).expect("it is good");
    let mut options = ConsoleOptions::for_test(Opening::Mission(Arc::new(mission)));
    let records = Records::within(data.path(), RecordLimits::default());
    options.preferences.records = Some(records.clone());
    options.preferences.runs = Some(Runs::within(data.path()));
    let mut console = Console::new(options, true);
    let (columns, rows) = (120, 40);
    console.feed(TerminalEvent::Resize { columns, rows }).await;
    Box::pin(console.begin()).await;
    run(&mut console, 10).await;
    assert!(console.app.state().session().is_reading());
    assert_eq!(records.list().len(), 1);
    console.end_session();
    let left = std::fs::read_dir(records.folder()).expect("a folder");
    assert_eq!(left.count(), 0);
}

#[tokio::test(start_paused = true)]
async fn a_replay_shows_what_the_console_showed_in_flight() {
    const LINES: [&str; 4] = [
        "all guided",
        "all arm",
        "all takeoff 20",
        "all goto n 30 up 15",
    ];
    const SEEKS: u32 = 12;
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying(data.path())).await;
    let began = console.clock.now();
    let mut flown = Vec::new();
    for second in 0..48_usize {
        if let Some(line) = LINES.get(second / 4).filter(|_| second % 4 == 3) {
            say(&mut console, line).await;
        }
        run(&mut console, 1).await;
        flown.push((
            console.clock.now().saturating_sub(began),
            shown(console.app.state()),
        ));
    }
    abandon(&mut console).await;
    say(&mut console, "replay").await;
    console.take_in().await;
    let replay = console.replaying.as_mut().expect("it runs");
    replay.wait_for_index();
    for number in 0..SEEKS {
        // Played on from the last moment at another rate, then to a moment before or after.
        let rate = [0.5, 4.0, 64.0][number as usize % 3];
        console.steer_replay(ReplayEffect::Rate(rate));
        console.steer_replay(ReplayEffect::Play(true));
        run(&mut console, 1).await;
        console.steer_replay(ReplayEffect::Play(false));
        let share = f64::from(number) * 0.618_033_988_75 % 1.0;
        let (at, live) = &flown[(share * flown.len() as f64) as usize];
        // A frame contains what came before its end, and the console's tick may lie within it.
        let mut near = Vec::new();
        for frames in 0..4 {
            near.push(show(&mut console, *at + crate::replay::FRAME * frames).await);
        }
        for (part, live) in live.iter().enumerate() {
            let is_shown = near.iter().any(|it| it[part] == *live);
            assert!(is_shown, "at {at:?}: {live:#?}\n{:#?}", near[1][part]);
        }
    }
}

#[tokio::test(start_paused = true)]
async fn a_session_that_starts_in_a_replay_is_live_and_begins_with_its_brief() {
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying_in(data.path(), true)).await;
    run(&mut console, 3).await;
    let begun = crate::shell::key(crossterm::event::KeyCode::Enter);
    console.feed(begun).await;
    run(&mut console, 5).await;
    abandon(&mut console).await;
    for (opened, line) in [
        ("replay", "fly 00"),
        ("review", "fly 00"),
        ("replay", "fly"),
        ("replay", "connect udpin:127.0.0.1:0"),
    ] {
        say(&mut console, opened).await;
        run(&mut console, 2).await;
        assert!(console.app.state().replay().is_some(), "{opened}");
        say(&mut console, line).await;
        run(&mut console, 5).await;
        let state = console.app.state();
        assert!(console.replaying.is_none() && state.replay().is_none());
        let is_mission = line == "fly 00";
        assert_eq!(state.session().is_reading(), is_mission, "{opened} {line}");
        assert_eq!(state.room() == Room::Mission, is_mission, "{opened} {line}");
        assert!(!state.session().has_flight_begun(), "{opened} {line}");
        say(&mut console, "leave").await;
    }
}

#[tokio::test(start_paused = true)]
async fn a_session_that_cannot_start_ends_the_replay_too() {
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying(data.path())).await;
    run(&mut console, 5).await;
    abandon(&mut console).await;
    say(&mut console, "replay").await;
    run(&mut console, 1).await;
    let taken = std::net::UdpSocket::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("a port").port();
    say(&mut console, &format!("connect udpin:127.0.0.1:{port}")).await;
    run(&mut console, 1).await;
    let state = console.app.state();
    assert!(state.replay().is_none() || console.replaying.is_some());
}

#[tokio::test(start_paused = true)]
async fn a_mission_that_was_flown_is_replayed_with_its_objectives_and_its_debrief() {
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Box::pin(flying(data.path())).await;
    run(&mut console, 5).await;
    for line in ["all guided", "all arm", "all takeoff 20", "bookmark up"] {
        say(&mut console, line).await;
        run(&mut console, 3).await;
    }
    run(&mut console, 30).await;
    let flown = told(console.app.state());
    abandon(&mut console).await;
    let report = console
        .app
        .state()
        .rooms()
        .debrief()
        .session()
        .cloned()
        .expect("a debrief");

    // Another console is recording a newer flight.
    let records = Records::within(data.path(), RecordLimits::default());
    let head = Head::new(Subject::Free, 4_000_000_000_000_000);
    let other = records.begin(&head, None, "2999-01-01T00:00:00Z", Vec::new);
    drop(other.expect("a record"));
    say(&mut console, "replay").await;
    console.take_in().await;
    let replay = console.replaying.as_mut().expect("it runs");
    replay.wait_for_index();
    console.steer_replay(ReplayEffect::Seek(SeekTarget::End));
    for _ in 0..100 {
        console.take_in().await;
        run(&mut console, 1).await;
    }
    let state = console.app.state();
    let replayed = told(state);
    assert!(flown.0 > Some(Duration::from_secs(30)), "{flown:?}");
    assert!(replayed.0 >= flown.0, "{replayed:?} {flown:?}");
    assert_eq!(replayed.1.len(), flown.1.len());
    assert_eq!(replayed.2, flown.2);
    let again = state.rooms().debrief().session().expect("a debrief");
    assert_eq!(again.report().score, report.report().score);
}
