use proptest::prelude::*;

use super::observer::Observer;
use super::*;
use crate::alert::AlertKind;
use crate::app::State;
use crate::doctor::Cause;
use crate::link::TlogWriter;
use crate::moment::MomentKind;
use crate::record::{Happening, JournalLine};
use crate::vehicle::Transfer;
use crate::wire::Decoder;

mod as_live;
mod following;
mod playing;
mod recorded;
mod runs;

use recorded::{Recorded, record};

const BEGAN_US: u64 = 1_700_000_000_000_000;

const fn s(s: u64) -> Duration {
    Duration::from_secs(s)
}

fn watched(recorded: &Recorded) -> (Replay, Observer) {
    watched_at(&recorded.frames)
}

fn watched_at(frames: &Path) -> (Replay, Observer) {
    let (mut replay, _) = Replay::open(frames, &Config::default()).expect("a recording");
    replay.wait_for_index();
    let film = replay.film();
    let (view, begun) = (film.view(), replay.stage.begun());
    let observer = Observer::new(view, &film.started(), &Config::default(), begun);
    (replay, observer)
}

fn seek(replay: &mut Replay, observer: &mut Observer, to: Duration) {
    go(replay, observer, SeekTarget::At(to));
}

fn go(replay: &mut Replay, observer: &mut Observer, target: SeekTarget) {
    let mut events = replay.steer(ReplayEffect::Seek(target));
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
        session.alerts(),
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
fn commands_of_other_stations_are_those_of_the_moment() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    for (at_s, expected) in [
        (12, Some("GCS 254/230: 2 mode RTL: accepted, 2 times")),
        (10, Some("GCS 254/230: 2 mode RTL: accepted")),
        (5, None),
    ] {
        seek(&mut replay, &mut observer, s(at_s));
        let ledger = observer.app().state().session().ledger();
        let rows = ledger.foreign();
        let shown = rows.map(|it| format!("{}: {}", it.line(), it.outcome()));
        let shown: Vec<String> = shown.collect();
        assert_eq!(shown.first().map(String::as_str), expected, "{at_s}");
        assert!(shown.len() < 2);
    }
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
    replay.wait_for_index();
    let gaps = replay.index.gaps();
    let [gap] = gaps.as_slice() else {
        panic!("one gap: {gaps:?}");
    };
    assert!(gap.end >= gap.start + s(14), "{gap:?}");
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

/// The length is an estimate until all of the recording has been read; its last frames and the result come later.
#[test]
fn the_end_is_that_of_the_whole_recording() {
    let recorded = record();
    let (mut replay, _) = Replay::open(&recorded.frames, &Config::default()).expect("a recording");
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::End)));
    while !replay.is_there() {
        drop(replay.tick(Duration::ZERO));
    }
    replay.wait_for_index();
    for _ in 0..3 {
        drop(replay.tick(Duration::ZERO));
    }
    assert_eq!(replay.now(), replay.length());
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
