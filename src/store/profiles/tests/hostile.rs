//! Files and rows written by another program.

use serde_json::{Value, json};

use super::{ProfileError, ProfileFile, anna, open, run};

/// Anna's profile as a document with one flight.
fn document() -> Value {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    profiles
        .store(&anna, &run("a", "one", 800))
        .expect("stored");
    let exported = profiles.export(&anna).expect("readable").write();
    serde_json::from_str(&exported).expect("just written")
}

#[test]
fn a_file_with_what_cannot_have_happened_is_refused_with_what_it_is() {
    ProfileFile::read(&document().to_string()).expect("as it was");
    for (place, value, named) in [
        ("/since", json!("\u{1b}[2J"), "since"),
        ("/entries/0/at", json!("yesterday"), "`at`"),
        ("/entries/0/id", json!("a\nb"), "`id`"),
        (
            "/entries/0/entry/day",
            json!(120_000_000_000_000_i64),
            "`day`",
        ),
        ("/entries/0/entry/score", json!(60_000), "`score`"),
        (
            "/entries/0/entry/mission",
            json!("\u{1b}]0;x\u{7}"),
            "`mission`",
        ),
        ("/runs/0/ended", json!("2026-11-20 14:03:22Z"), "`ended`"),
        ("/runs/0/recording", json!("../x"), "`recording`"),
        ("/runs/0/report/backend", json!("\u{9b}2J"), "`ardupilot`"),
    ] {
        let mut file = document();
        *file.pointer_mut(place).expect("it has one") = value;
        let Err(ProfileError::NoProfile { fault }) = ProfileFile::read(&file.to_string()) else {
            panic!("{place} was read");
        };
        assert!(fault.contains(named), "{place}: {fault}");
        assert!(!fault.chars().any(char::is_control), "{place}: {fault:?}");
    }
}

#[test]
fn a_name_that_a_file_brings_is_a_name_or_refused() {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let file = ProfileFile::read(&document().to_string()).expect("as it was");
    assert!(matches!(
        profiles.import(&file, "a\u{1b}[2J"),
        Err(ProfileError::Name)
    ));
}

#[test]
fn a_row_that_cannot_have_happened_counts_for_nothing_and_spoils_nothing() {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    for id in ["a", "b"] {
        profiles.store(&anna, &run(id, "one", 800)).expect("stored");
    }
    let edited = profiles.connection.execute_batch(
        "UPDATE entries SET entry = replace(entry, '20000', '120000000000000') WHERE id = 'a';
         UPDATE profiles SET since = char(27) || '[2J';",
    );
    edited.expect("writable");
    assert_eq!(profiles.history(&anna).expect("readable").len(), 1);
    let runs = profiles.runs(&anna).expect("readable");
    let ids: Vec<&str> = runs.iter().map(|run| run.id.as_str()).collect();
    assert_eq!(ids, ["b"]);
    let anna = profiles.find("Anna").expect("there");
    assert_eq!(anna.since, "?[2J");
}
