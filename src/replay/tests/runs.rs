//! Recordings with the run of a mission.

use super::*;
use crate::mission::fake::Pilot;
use crate::mission::record::Occasion;
use crate::record::{Head, Subject};

/// A run that stops while the vehicle is in the air.
fn run_left() -> String {
    let mut pilot = Pilot::new(7);
    pilot.flight.start_record(&Occasion::default());
    pilot.take_off(20.0);
    pilot.flight.take_record()
}

/// A recording with this run, and with a journal in which the mission's clock runs for 40 s.
fn recorded_with(run: &str) -> Recorded {
    let recorded = record();
    let mission = Subject::Mission("01-air-sample".to_owned());
    let mut journal = Head::new(mission, BEGAN_US).to_line();
    for second in 1..=40 {
        let what = Happening::Mission { ms: second * 1000 };
        journal.push_str(&JournalLine::new(s(second), what).to_line());
    }
    let write = |name: &str, text: &str| {
        std::fs::write(recorded.frames.with_extension(name), text).expect("writable");
    };
    write("flight.jsonl", &journal);
    write("run.jsonl", run);
    recorded
}

#[test]
fn a_damaged_run_is_reported_and_one_without_an_end_is_not() {
    let whole = run_left();
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    let middle = lines.len() / 2;
    let (start, end) = (lines[..middle].concat(), lines[middle + 1..].concat());
    let cut_line = &lines[middle][..lines[middle].len() / 2];
    for (run, faults) in [
        (whole.clone(), 0),
        (format!("{start}{cut_line}"), 1),
        (format!("{start}}}{{\n{end}"), 1),
    ] {
        let recorded = recorded_with(&run);
        let (replay, _) = watched(&recorded);
        let found: Vec<String> = replay.damage().map(|it| it.to_string()).collect();
        assert_eq!(found.len(), faults, "{found:?}");
        let line = format!("line {}", middle + 1);
        assert!(found.iter().all(|it| it.contains(&line)), "{found:?}");
    }
}

#[test]
fn damaged_and_missing_frames_are_reported() {
    let recorded = recorded_with(&run_left());
    let own = std::fs::read(&recorded.frames).expect("frames");
    let middle = own.len() / 2;
    let mut damaged = own.clone();
    damaged[middle..middle + 100].fill(0);
    for (bytes, named) in [
        (&damaged[..], "the recording is damaged at byte"),
        (&own[..own.len() - 4], "its last record, at byte"),
    ] {
        std::fs::write(&recorded.frames, bytes).expect("writable");
        let (mut replay, _) = watched(&recorded);
        let found: Vec<String> = replay.damage().map(|it| it.to_string()).collect();
        assert!(found.len() == 1 && found[0].contains(named), "{found:?}");
        let is_told =
            |event: &Event| matches!(event, Event::Notice(it) if it.text.to_string() == found[0]);
        let told = [replay.tick(FRAME), replay.tick(FRAME * 2)];
        let counts = told.map(|events| events.iter().filter(|it| is_told(it)).count());
        assert_eq!(counts, [1, 0], "{named}");
    }
}

#[test]
fn a_journal_of_another_flight_is_reported_and_left_out() {
    let recorded = recorded_with(&run_left());
    let (replay, _) = watched(&recorded);
    assert_eq!(replay.damage().count(), 0);
    let journal = recorded.frames.with_extension("flight.jsonl");
    let own = std::fs::read_to_string(&journal).expect("text");
    let began = format!("\"began_unix_us\":{BEGAN_US}");
    for (from, to, named) in [
        (
            "01-air-sample",
            "03-plume-source",
            "another flight (03-plume-source)",
        ),
        (
            began.as_str(),
            "\"began_unix_us\":1",
            "does not fit the first frame",
        ),
        (
            began.as_str(),
            "\"began_unix_us\":1e308",
            "the first line is damaged",
        ),
    ] {
        std::fs::write(&journal, own.replacen(from, to, 1)).expect("writable");
        let (replay, events) = Replay::open(&recorded.frames, &Config::default()).expect("frames");
        let found: Vec<String> = replay.damage().map(|it| it.to_string()).collect();
        assert!(found.len() == 1 && found[0].contains(named), "{found:?}");
        assert!(replay.film().journal().is_none(), "{named}");
        let is_told =
            |event: &Event| matches!(event, Event::Notice(it) if it.text.to_string() == found[0]);
        assert!(events.iter().any(is_told), "{named}");
    }
}

#[test]
fn the_clock_of_a_mission_that_was_left_runs_to_its_end() {
    let recorded = recorded_with(&run_left());
    let (mut replay, mut observer) = watched(&recorded);
    for at in [5, 39] {
        seek(&mut replay, &mut observer, s(at));
        let elapsed = observer
            .app()
            .state()
            .session()
            .mission()
            .map(|it| it.elapsed);
        // A frame shows what came before its end.
        assert_eq!(elapsed, Some(s(at - 1)));
    }
    assert!(!observer.app().state().session().is_over());
    let report = replay.report().expect("it was flown");
    assert_eq!(report.outcome.title().to_string(), "not finished");
}

#[test]
fn a_time_of_the_mission_is_shown_when_it_is_gone_to() {
    let recorded = recorded_with(&run_left());
    let (mut replay, mut observer) = watched(&recorded);
    go(&mut replay, &mut observer, SeekTarget::Mission(s(20)));
    let mission = observer.app().state().session().mission();
    assert_eq!(mission.map(|it| it.elapsed), Some(s(20)));
}

#[test]
fn a_missing_moment_is_told_with_its_direction() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    drop(replay.tick(Duration::ZERO));
    let failed = |said: Vec<Event>| match &said[..] {
        [Event::Failed(fault)] => fault.to_string(),
        other => panic!("{other:?}"),
    };
    let refusal = MomentKind::Refusal;
    for (at, target, told) in [
        (
            20,
            SeekTarget::Next(refusal),
            "no later moment of this kind: refusal",
        ),
        (
            2,
            SeekTarget::Previous(refusal),
            "no earlier moment of this kind: refusal",
        ),
        (
            2,
            SeekTarget::Next(MomentKind::Rule),
            "no such moment in the record",
        ),
    ] {
        seek(&mut replay, &mut observer, s(at));
        assert_eq!(failed(replay.steer(ReplayEffect::Seek(target))), told);
    }
    for (at, forward, told) in [
        (0, false, "no earlier moment"),
        (44, true, "no later moment"),
    ] {
        seek(&mut replay, &mut observer, s(at));
        assert_eq!(failed(replay.steer(ReplayEffect::Moment { forward })), told);
    }
}
