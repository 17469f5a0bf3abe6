use std::path::PathBuf;

use proptest::prelude::*;

use super::observer::Observer;
use super::*;
use crate::alert::AlertKind;
use crate::app::State;
use crate::doctor::Cause;
use crate::ledger::RowState;
use crate::link::TlogWriter;
use crate::moment::MomentKind;
use crate::record::{EntryLine, Happening, Head, JournalLine, PathLine, RowLine, Subject};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::vehicle::Transfer;
use crate::wire::{Decoder, Encoder};
use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, HEARTBEAT_DATA, MISSION_REQUEST_LIST_DATA, MavAutopilot, MavCmd, MavMessage,
    MavMissionType, MavParamType, MavType, PARAM_SET_DATA,
};

mod as_live;

const BEGAN_US: u64 = 1_700_000_000_000_000;

const fn s(s: u64) -> Duration {
    Duration::from_secs(s)
}

/// A record of two vehicles of the embedded simulator, one of which is armed at 16 s and takes off; nothing is recorded
/// between 20 s and 35 s.
struct Recorded {
    _folder: tempfile::TempDir,
    frames: PathBuf,
}

fn beat() -> MavMessage {
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_GCS,
        autopilot: MavAutopilot::MAV_AUTOPILOT_INVALID,
        ..HEARTBEAT_DATA::default()
    })
}

fn command(command: MavCmd, params: [f32; 3]) -> MavMessage {
    MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command,
        target_system: 1,
        target_component: 1,
        param1: params[0],
        param2: params[1],
        param7: params[2],
        ..COMMAND_LONG_DATA::default()
    })
}

/// The ground station's messages in one tick of a tenth of a second.
fn said(tick: u64) -> Vec<MavMessage> {
    let order = |what, params: [f32; 3]| command(what, params);
    let mut said = Vec::new();
    if tick.is_multiple_of(10) {
        said.push(beat());
    }
    match tick {
        20 => said.push(order(
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
            [33.0, 200_000.0, 0.0],
        )),
        120 | 380 => said.push(MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_id: "WPNAV_SPEED".into(),
            param_value: tick as f32,
            target_system: 1,
            target_component: 1,
            param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
        })),
        // All three lists are asked for at once, as by a console whose requests a slow recording would miss.
        33 => said.extend(
            [
                MavMissionType::MAV_MISSION_TYPE_MISSION,
                MavMissionType::MAV_MISSION_TYPE_FENCE,
                MavMissionType::MAV_MISSION_TYPE_RALLY,
            ]
            .map(|mission_type| {
                MavMessage::MISSION_REQUEST_LIST(MISSION_REQUEST_LIST_DATA {
                    target_system: 1,
                    target_component: 1,
                    mission_type,
                })
            }),
        ),
        150 => said.push(order(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 0.0])),
        160 => said.push(order(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0])),
        165 => said.push(order(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 12.0])),
        _ => {}
    }
    said
}

fn record() -> Recorded {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = folder.path().join("flight.tlog");
    let start = Start {
        at: crate::geo::LatLon::new(50.45, 30.52),
        altitude_amsl_m: 180.0,
        heading_deg: 0.0,
    };
    let mut world = World::new(&WorldConfig::row(2, start));
    let ports: Vec<PortId> = (0..2).map(|vehicle| world.connect(vehicle)).collect();
    let mut encoder = Encoder::new(255, 190);
    let mut file = std::fs::File::create(&frames).expect("writable");
    let mut tlog = TlogWriter::new(&mut file);
    for tick in 0..450_u64 {
        let at_us = BEGAN_US + tick * 100_000;
        let is_gap = (200..350).contains(&tick);
        let mut write = |bytes: &[u8]| {
            if !is_gap {
                tlog.write(at_us, bytes).expect("writable");
            }
        };
        for message in said(tick) {
            let mut bytes = Vec::new();
            encoder.encode(&message.into(), &mut bytes);
            for &port in &ports {
                world.receive(port, &bytes);
            }
            write(&bytes);
        }
        while world.now() < FRAME * (tick as u32 + 1) {
            world.step();
        }
        for (vehicle, &port) in ports.iter().enumerate() {
            // After the gap, the second vehicle is heard one second later.
            let is_late = vehicle == 1 && (350..360).contains(&tick);
            let mut output = Vec::new();
            world.take_output(port, &mut output);
            let mut decoder = Decoder::new();
            decoder.push(&output);
            while let Some(frame) = decoder.next_frame() {
                if !is_late {
                    write(decoder.bytes_of(&frame));
                }
            }
        }
    }
    write_journal(&frames);
    Recorded {
        _folder: folder,
        frames,
    }
}

/// Writes a journal with a refused command and a bookmark.
fn write_journal(frames: &std::path::Path) {
    let head = Head::new(Subject::Free, BEGAN_US);
    let verb = crate::language::verb("arm").expect("it is one");
    let entry = EntryLine {
        id: 0,
        line: "2 arm".to_owned(),
        verb,
        risk: crate::ledger::Risk::None,
        vehicles: vec![2],
    };
    let row = |state| {
        Happening::Row(RowLine {
            id: 0,
            vehicle: 2,
            state,
            tries: 1,
            why: Some("it is tired".to_owned()),
        })
    };
    let path = PathLine {
        vehicle: 1,
        points: vec![[50.46, 30.52]],
    };
    let lines = [
        (s(6), Happening::Entry(entry)),
        (s(6), row(RowState::Sent)),
        (s(7), row(RowState::Refused)),
        (s(8), Happening::Paths(vec![path])),
        (
            s(12),
            Happening::Bookmark {
                text: "here".to_owned(),
            },
        ),
        (s(38), Happening::Paths(Vec::new())),
        (s(40), Happening::End),
    ];
    let mut text = head.to_line();
    for (at, what) in lines {
        text.push_str(&JournalLine::new(at, what).to_line());
    }
    std::fs::write(frames.with_extension("flight.jsonl"), text).expect("writable");
}

fn watched(recorded: &Recorded) -> (Replay, Observer) {
    let (mut replay, _) = Replay::open(&recorded.frames, &Config::default()).expect("a recording");
    replay.wait_for_index();
    let film = replay.film();
    let view = film.view();
    let observer = Observer::new(view, &film.started(), &Config::default());
    (replay, observer)
}

fn seek(replay: &mut Replay, observer: &mut Observer, to: Duration) {
    let mut events = replay.steer(ReplayEffect::Seek(SeekTarget::At(to)));
    while replay.player.goal() >= replay.stage.now() + FRAME {
        events.extend(replay.approach());
    }
    observer.see_all(events);
}

/// The console's state as text, with everything that a screen can show.
fn known(state: &State) -> String {
    let session = state.session();
    let trails = state.rooms().map().trails();
    format!(
        "{:?}\n{:#?}\n{:#?}\n{:?}\n{:?}\n{:?}\n{trails:?}\n{:?}\n{:?}",
        state.now(),
        session.vehicles(),
        session.ledger(),
        state.notices().lines().collect::<Vec<_>>(),
        session.alarms(),
        session.paths(),
        state.rooms().fly().rows(),
        state.rooms().parameters().lists(),
    )
}

/// The state at these times when the recording is played without jumps.
fn straight(recorded: &Recorded, times: &[Duration]) -> Vec<String> {
    let (mut replay, mut observer) = watched(recorded);
    let mut found = Vec::new();
    for &to in times {
        seek(&mut replay, &mut observer, to);
        found.push(known(observer.app().state()));
    }
    found
}

#[test]
fn a_moment_is_the_same_by_whatever_way_one_comes_to_it() {
    let recorded = record();
    let times: Vec<Duration> = (0..45)
        .map(|at| s(at) + Duration::from_millis(at % 10 * 100))
        .collect();
    let expected = straight(&recorded, &times);
    assert!(expected[30] != expected[10]);
    let (mut replay, mut observer) = watched(&recorded);
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let (replay, observer) = (
        std::cell::RefCell::new(&mut replay),
        std::cell::RefCell::new(&mut observer),
    );
    runner
        .run(&(0..times.len()), |at| {
            seek(
                &mut replay.borrow_mut(),
                &mut observer.borrow_mut(),
                times[at],
            );
            let is = known(observer.borrow().app().state());
            prop_assert!(is == expected[at], "at {:?}", times[at]);
            Ok(())
        })
        .expect("all moments are alike");
}

#[test]
fn the_table_and_the_parameters_are_those_of_the_moment() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    let known = |observer: &Observer| {
        let rooms = observer.app().state().rooms();
        let speed = rooms.parameters().get(1, "WPNAV_SPEED").map(|it| it.value);
        (rooms.fly().rows().to_vec(), speed)
    };
    // A jump restores vehicles that this console has never seen before.
    for (at, speed) in [(30, 120.0), (44, 380.0), (20, 120.0)] {
        seek(&mut replay, &mut observer, s(at));
        assert_eq!(known(&observer), (vec![1, 2], Some(speed)), "at {at} s");
    }
    seek(&mut replay, &mut observer, s(5));
    assert_eq!(known(&observer).1, None);
}

#[test]
fn plans_are_read_from_the_answers_that_were_recorded() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    let states = |observer: &Observer| {
        let vehicles = observer.app().state().session().vehicles();
        let plans = vehicles[&1].plans.clone();
        [
            plans.plan.transfer,
            plans.fence.transfer,
            plans.rally.transfer,
        ]
    };
    seek(&mut replay, &mut observer, s(2));
    assert_eq!(states(&observer), [Transfer::Unasked; 3]);
    seek(&mut replay, &mut observer, s(40));
    assert_eq!(states(&observer), [Transfer::Done; 3]);
}

#[test]
fn paths_of_joint_manoeuvres_are_those_of_the_moment() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    for (at, count) in [(30, 1), (5, 0), (9, 1), (39, 0), (37, 1)] {
        seek(&mut replay, &mut observer, s(at));
        let paths = observer.app().state().session().paths().len();
        assert_eq!(paths, count, "at {at} s");
    }
}

#[test]
fn a_gap_is_a_gap_and_no_lost_link() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    seek(&mut replay, &mut observer, s(30));
    assert!(
        replay.stage.gap().is_some_and(|gap| gap >= s(14)),
        "{:?}",
        replay.stage.gap()
    );
    let state = observer.app().state();
    assert!(state.session().vehicles().values().all(|it| !it.link.lost));
    seek(&mut replay, &mut observer, s(40));
    assert_eq!(replay.stage.gap(), None);
    let state = observer.app().state();
    assert!(state.session().vehicles().values().all(|it| !it.link.lost));
    let mut notices = state.notices().lines();
    assert!(notices.all(|line| line.notice.kind != Some(AlertKind::LinkLost)));
}

#[test]
fn the_link_doctor_says_that_a_recording_is_played() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    for at in [1, 40, 3] {
        seek(&mut replay, &mut observer, s(at));
        let findings = observer.app().state().session().findings();
        let causes: Vec<_> = findings.iter().map(|it| (it.link, &it.cause)).collect();
        assert_eq!(causes, [(0, &Cause::Recording)], "at {at} s");
    }
}

#[test]
fn moments_are_found_and_stopped_at() {
    let recorded = record();
    let (mut replay, _) = watched(&recorded);
    replay.wait_for_index();
    let moments = replay.moments().to_vec();
    let of = |kind| moments.iter().filter(move |it| it.kind == kind);
    assert_eq!(of(MomentKind::Bookmark).count(), 1);
    let refusal = of(MomentKind::Refusal).next().expect("a refusal");
    assert_eq!((refusal.at, &refusal.vehicles[..]), (s(7), &[2][..]));
    assert!(
        of(MomentKind::Arming).any(|it| it.vehicles == [1]),
        "{moments:?}"
    );
    let in_order = moments.is_sorted_by_key(|it| it.at);
    assert!(in_order);

    drop(replay.steer(ReplayEffect::StopAt(vec![MomentKind::Refusal])));
    let mut now = Duration::ZERO;
    while replay.player.is_playing() {
        drop(replay.tick(now));
        now += FRAME;
    }
    // The frame that shows the refusal.
    assert_eq!(replay.now(), s(7) + FRAME);

    drop(replay.steer(ReplayEffect::Moment { forward: true }));
    assert!(replay.player.goal() > s(7));
}

#[test]
fn a_stretch_is_played_over_and_over_at_a_rate() {
    let recorded = record();
    let (mut replay, _) = watched(&recorded);
    drop(replay.steer(ReplayEffect::Loop(Some(LoopTarget::Times {
        from: s(10),
        to: s(12),
    }))));
    drop(replay.steer(ReplayEffect::Rate(4.0)));
    let mut seen = Vec::new();
    for tick in 0..20 {
        drop(replay.tick(FRAME * tick));
        seen.push(replay.now().as_millis());
    }
    assert!(
        seen.iter().all(|at| (10_000..12_000).contains(at)),
        "{seen:?}"
    );
    assert_eq!(&seen[..4], [10_000, 10_400, 10_800, 11_200]);
    assert!(seen.windows(2).any(|two| two[1] < two[0]));
}

#[test]
fn frames_go_both_ways_and_the_end_is_the_end() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    seek(&mut replay, &mut observer, s(10));
    drop(replay.steer(ReplayEffect::Step { forward: false }));
    assert_eq!(replay.now() + FRAME, s(10));
    drop(replay.steer(ReplayEffect::Step { forward: true }));
    assert_eq!(replay.now(), s(10));
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::End)));
    while replay.player.goal() >= replay.stage.now() + FRAME {
        drop(replay.approach());
    }
    assert!(replay.is_at_end());
    drop(replay.steer(ReplayEffect::Play(true)));
    assert_eq!(replay.now(), Duration::ZERO);
}

#[test]
fn a_clock_that_was_set_meanwhile_makes_no_recording_of_years() {
    let recorded = record();
    let later = recorded.frames.with_file_name("later.tlog");
    let file = std::fs::File::open(&recorded.frames).expect("there");
    let mut tlog = TlogWriter::new(Vec::new());
    for entry in crate::link::TlogReader::new(file) {
        let entry = entry.expect("sound");
        let is_set = entry.unix_us >= BEGAN_US + 18_000_000;
        let unix_us = entry.unix_us + if is_set { 500_000_000_000_000 } else { 0 };
        tlog.write(unix_us, &entry.bytes).expect("memory");
    }
    std::fs::write(&later, tlog.into_inner()).expect("writable");
    let (mut replay, _) = Replay::open(&later, &Config::default()).expect("a recording");
    replay.wait_for_index();
    let length = replay.length();
    assert!(length >= s(40) && length < s(60), "{length:?}");
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::End)));
    while !replay.is_there() {
        drop(replay.approach());
    }
    assert!(replay.is_at_end());
}

#[test]
fn a_recording_is_exported_in_every_format_and_replaces_nothing() {
    let recorded = record();
    let replay = Replay::read_through(&recorded.frames, &Config::default()).expect("it is good");
    let moments = replay.moments();
    let film = Film::open(&recorded.frames).expect("a recording");
    let folder = recorded.frames.parent().expect("a folder");
    for (format, name, expected) in [
        (ExportFormat::Kml, "f.kml", "<gx:Track>"),
        (
            ExportFormat::Gpx,
            "f.gpx",
            "<trkpt lat=\"50.45\" lon=\"30.52\">",
        ),
        (ExportFormat::GeoJson, "f.geojson", "\"LineString\""),
    ] {
        let path = folder.join(name);
        export(&film, moments, format, &path).expect("written");
        let text = std::fs::read_to_string(&path).expect("text");
        assert!(text.contains(expected), "{name}");
        assert!(text.contains("here"), "{name}: the moments");
        let fault = export(&film, moments, format, &path).expect_err("it exists");
        assert!(fault.to_string().contains("already exists"), "{fault}");
    }
    let tables = folder.join("tables");
    export(&film, moments, ExportFormat::Csv, &tables).expect("written");
    let beats = std::fs::read_to_string(tables.join("HEARTBEAT.csv")).expect("a table");
    assert!(
        beats.starts_with("unix_s,system,component,sequence,custom_mode,type"),
        "{beats}"
    );
    let mcap = folder.join("f.mcap");
    export(&film, moments, ExportFormat::Mcap, &mcap).expect("written");
    let bytes = std::fs::read(&mcap).expect("there");
    let messages = mcap::MessageStream::new(&bytes).expect("it is one");
    let topics: std::collections::BTreeSet<String> = messages
        .map(|message| message.expect("sound").channel.topic.clone())
        .collect();
    assert!(topics.contains("/vehicle/1/location"), "{topics:?}");
    assert!(topics.contains("/mavlink/2/1/HEARTBEAT"), "{topics:?}");
}

#[test]
fn it_plays_backwards_and_stops_at_what_comes_up() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    replay.wait_for_index();
    seek(&mut replay, &mut observer, s(20));
    drop(replay.steer(ReplayEffect::StopAt(vec![MomentKind::Refusal])));
    drop(replay.steer(ReplayEffect::Rewind));
    let mut now = Duration::ZERO;
    let mut seen = Vec::new();
    while replay.player.is_playing() {
        drop(replay.tick(now));
        seen.push(replay.now());
        now += FRAME;
    }
    assert!(
        seen.is_sorted_by(|earlier, later| earlier >= later),
        "{seen:?}"
    );
    assert_eq!(replay.now(), s(7) + FRAME, "the refusal can be seen");
    drop(replay.steer(ReplayEffect::StopAt(Vec::new())));
    drop(replay.steer(ReplayEffect::Rewind));
    while replay.player.is_playing() {
        drop(replay.tick(now));
        now += FRAME;
    }
    assert_eq!(replay.now(), Duration::ZERO);
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::Next(MomentKind::Refusal))));
    while !replay.is_there() {
        drop(replay.tick(now));
    }
    assert_eq!(replay.now(), s(7) + FRAME);
}

#[test]
fn frames_are_replayed_without_a_journal_or_a_run_that_cannot_be_read() {
    let recorded = record();
    for (file, content) in [
        ("flight.jsonl", "{\"sortie_flight\":1,\"began\":7}\n"),
        ("flight.jsonl", "{\"sortie_flight\":2}\n"),
        ("run.jsonl", "not a run\n"),
    ] {
        std::fs::write(recorded.frames.with_extension(file), content).expect("written");
        let (mut replay, mut observer) = watched(&recorded);
        assert!(replay.damage().count() >= 1, "{file}: {content}");
        seek(&mut replay, &mut observer, s(40));
        let vehicles = observer.app().state().session().vehicles();
        assert_eq!(vehicles.len(), 2, "{file}: {content}");
    }
}

#[test]
fn a_review_that_cannot_be_read_is_not_replaced() {
    let recorded = record();
    let path = recorded.frames.with_extension("review.json");
    std::fs::write(&path, "{\"sortie_review\": 9}").expect("written");
    let (mut replay, _) = watched(&recorded);
    let review = Box::new(crate::review::Review::default());
    let said = replay.steer(ReplayEffect::Keep(review));
    assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
    let left = std::fs::read_to_string(&path).expect("it is there");
    assert!(left.contains('9'), "{left}");
}

#[test]
fn a_stretch_ends_with_the_recording() {
    let recorded = record();
    let (mut replay, _) = watched(&recorded);
    replay.wait_for_index();
    let length = replay.length();
    drop(replay.steer(ReplayEffect::Loop(Some(LoopTarget::Times {
        from: s(10),
        to: s(9999),
    }))));
    assert_eq!(replay.player.repeated(), Some((s(10), length)));
    let none = SeekTarget::Next(MomentKind::Rule);
    let said = replay.steer(ReplayEffect::Seek(none));
    assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
}

#[test]
fn a_stretch_lies_between_two_moments_of_a_kind() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    let bookmark = |at| Moment {
        at: s(at),
        vehicles: Vec::new(),
        kind: MomentKind::Bookmark,
        text: Text::verbatim("here"),
    };
    replay.contents.replace(vec![bookmark(10), bookmark(20)]);
    let bookmarks = || ReplayEffect::Loop(Some(LoopTarget::Moments(MomentKind::Bookmark)));
    seek(&mut replay, &mut observer, s(15));
    drop(replay.steer(bookmarks()));
    let looped = Some((s(10) + FRAME, s(20) + FRAME));
    assert_eq!(replay.player.repeated(), looped);
    assert_eq!(replay.player.goal(), s(10) + FRAME);
    for at in [5, 25] {
        seek(&mut replay, &mut observer, s(at));
        let said = replay.steer(bookmarks());
        assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
    }
    drop(replay.steer(ReplayEffect::Loop(None)));
    assert_eq!(replay.player.repeated(), None);
}
