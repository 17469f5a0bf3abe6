use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use rusqlite::Connection;

use super::*;
use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::{Mission, Stake};
use crate::store::{Landing, Runs};

/// The careers of a new folder with the profile Anna, whose database refuses flights.
fn full(data: &Path) -> (Careers, Connection) {
    let (mut careers, _) = Careers::open(data, store::course()).expect("our own folder");
    careers.create("Anna").expect("a new name");
    let database = Connection::open(data.join("profiles.sqlite")).expect("it is one");
    let refused = database.execute_batch(
        "CREATE TRIGGER full BEFORE INSERT ON entries BEGIN SELECT RAISE(ABORT, 'full'); END;",
    );
    refused.expect("writable");
    (careers, database)
}

/// A flight of a few seconds, with a record that was cut off; returns the record's path, too.
fn cut_flight(data: &Path) -> (WaitingFlight, PathBuf) {
    let source = include_str!("../../../../missions/drills/d00-arm-and-hover.toml");
    let mission = Arc::new(Mission::parse(source).expect("no faults"));
    let script = Script::parse("all guided\n", &Context::default()).expect("a command");
    let mut exercise = Exercise::new(Arc::clone(&mission), 1, script, Vec::new());
    exercise.step();
    let report = exercise.close();
    let begun = Runs::within(data).begin(&mission.id, "2026-11-20T14:03:22Z");
    let mut cut = begun.expect("writable");
    cut.append("{}\n").expect("writable");
    let path = cut.path().to_owned();
    let landing = Landing {
        id: cut.id().to_owned(),
        is_recorded: false,
        when: SystemTime::now(),
        stake: Stake::Graded,
    };
    let flight = WaitingFlight {
        whose: "Anna".to_owned(),
        run: RunEntry::of(&mission, &report, landing),
        cut: Some(cut),
    };
    (flight, path)
}

#[test]
fn a_flight_that_waits_leaves_no_cut_record_that_would_count_as_left() {
    let data = tempfile::tempdir().expect("a folder");
    let (mut careers, database) = full(data.path());
    let (flight, path) = cut_flight(data.path());
    careers.put(flight);
    assert!(path.exists());
    assert!(careers.enter().1.is_err());
    assert_eq!((careers.at_risk(), careers.deferred()), (1, 0));
    assert!(!path.exists(), "the record has no end");
    database.execute_batch("DROP TRIGGER full").expect("there");
    assert!(careers.enter().1.is_ok());
    assert!(!careers.has_waiting());
}

#[test]
fn a_cut_record_of_a_stored_flight_stays() {
    let data = tempfile::tempdir().expect("a folder");
    let (mut careers, database) = full(data.path());
    database.execute_batch("DROP TRIGGER full").expect("there");
    let (flight, path) = cut_flight(data.path());
    careers.put(flight);
    assert!(careers.enter().1.is_ok());
    assert!(fs::metadata(path).is_ok());
}
