//! Records that are verified, and edited ones that are not.

use std::fs;
use std::path::Path;

use super::{FLIGHT, run, runs, said};

#[test]
fn a_signature_is_part_of_what_is_verified() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path();
    let keys = data.join("keys").to_string_lossy().into_owned();
    let [secret, public] = ["key", "pub"].map(|half| format!("{keys}/minisign.{half}"));
    let verified = || {
        let output = run(data, "", &["verify", "--json", "--public-key", &public]);
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        (output.status.code(), document)
    };
    run(data, "", &FLIGHT);
    let made = run(
        data,
        "",
        &["records", "key", "--output", &keys, "--no-password"],
    );
    assert_eq!(made.status.code(), Some(0), "{}", said(&made));
    let (code, unsigned) = verified();
    assert_eq!((code, &unsigned["signature"]), (Some(1), &"none".into()));
    let signed = run(data, "", &["records", "sign", "--key", &secret]);
    assert_eq!(signed.status.code(), Some(0), "{}", said(&signed));
    let (code, document) = verified();
    assert_eq!((code, &document["signature"]), (Some(0), &"valid".into()));
    let comment = document["signed_comment"].as_str().expect("a comment");
    let score = format!("score:{}", document["score"]);
    assert!(
        comment.contains(&score) && comment.contains("seed:1"),
        "{comment}"
    );
    // A signature proves nothing about the flight: an edited record that is signed again still differs.
    let [record] = &runs(&data.join("sortie/runs"))[..] else {
        panic!("one run")
    };
    let text = fs::read_to_string(record).expect("there");
    fs::write(record, text.replace("\"seed\":1,", "\"seed\":2,")).expect("written");
    let (code, edited) = verified();
    assert_eq!((code, &edited["signature"]), (Some(1), &"invalid".into()));
    run(data, "", &["records", "sign", "--key", &secret]);
    let (code, again) = verified();
    assert_eq!((code, &again["signature"]), (Some(1), &"valid".into()));
    assert_eq!(again["verdict"], "differs");
}

/// A record as versions without a checksum wrote it.
fn without_checksum(record: &str) -> String {
    const FIELD: &str = ",\"checksum\":\"";
    let (before, after) = record.split_once(FIELD).expect("it has a checksum");
    let (_, rest) = after.split_once('"').expect("it ends");
    format!("{before}{rest}")
}

#[test]
fn a_record_is_verified_as_long_as_it_is_not_edited() {
    let data = tempfile::tempdir().expect("a temporary folder");
    let into = data.path().join("runs").to_string_lossy().into_owned();
    let flown = run(
        data.path(),
        "",
        &[&FLIGHT[..], &["--record", &into]].concat(),
    );
    assert_eq!(flown.status.code(), Some(0), "{}", said(&flown));
    let file = runs(Path::new(&into)).remove(0);
    let name = file.to_string_lossy().into_owned();
    let verify = |code: i32| {
        let output = run(data.path(), "", &["verify", &name, "--json"]);
        assert_eq!(output.status.code(), Some(code), "{}", said(&output));
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        document
    };
    let good = verify(0);
    assert_eq!(good["verdict"], "verified");
    for (named, code, said_so) in [
        ("1", 2, "nothing is recorded yet"),
        (&into, 2, "is not a file"),
        ("none.tlog", 2, "no record and no file none.tlog"),
    ] {
        let output = run(data.path(), "", &["verify", named]);
        assert_eq!(output.status.code(), Some(code), "{named}");
        let words = String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output);
        assert!(words.contains(said_so), "{named}: {words}");
    }
    assert_eq!(good["seed"], 1);
    assert_eq!(
        (&good["score"], &good["flown_by"]),
        (&good["recorded_score"], &"bundled".into())
    );
    let record = fs::read_to_string(&file).expect("there");
    // Each row: the edited text, its replacement, and the verdict.
    for (from, to, verdict) in [
        ("weights = {", "weights = { ", "other_mission"),
        ("\"seed\":1,", "\"seed\":2,", "differs"),
        ("\"mission\":\"", "\"mission\":\"x", "other_mission"),
        ("\"revision\":", "\"revision\":1", "other_mission"),
        ("\"medal\":\"gold\"", "\"medal\":\"silver\"", "differs"),
        (
            "{\"tick\":{\"t\":40000,",
            "{\"tick\":{\"t\":39900,",
            "differs",
        ),
        (
            "\"flown_by\":\"bundled-pilot\"",
            "\"flown_by\":\"hand\"",
            "differs",
        ),
        ("\"program\":\"", "\"program\":\"9.", "other_program"),
        (
            "\"program\":",
            "\"profile\":\"Another\",\"program\":",
            "differs",
        ),
    ] {
        assert!(record.contains(from), "{from}");
        fs::write(&file, record.replacen(from, to, 1)).expect("it is written");
        assert_eq!(verify(1)["verdict"], verdict, "{from}");
    }
    let relabelled = record.replacen("\"backend\":\"embedded\"", "\"backend\":\"ardupilot\"", 1);
    assert_ne!(relabelled, record);
    // The input log shows that the embedded simulator flew it.
    fs::write(&file, without_checksum(&relabelled)).expect("it is written");
    assert_eq!(verify(1)["verdict"], "differs");
    fs::write(&file, &record).expect("it is written");
    fs::remove_file(name.replace(".run.", ".inputs.")).expect("it was there");
    assert_eq!(verify(1)["verdict"], "rescored");
    // A record that claims to be from ArduPilot is scored again, but not verified. Its checksum no
    // longer matches, so the checksum is removed: older versions wrote records without one.
    fs::write(&file, &relabelled).expect("it is written");
    assert_eq!(verify(1)["verdict"], "differs");
    fs::write(&file, without_checksum(&relabelled)).expect("it is written");
    let rescored = verify(0);
    assert_eq!(rescored["verdict"], "rescored");
    let unproved = rescored["unproved"].as_array().expect("a list");
    assert!(unproved.contains(&"profile".into()), "{unproved:?}");
    let other = without_checksum(&relabelled).replacen("\"score\":", "\"score\":1", 1);
    fs::write(&file, other).expect("it is written");
    assert_eq!(verify(1)["verdict"], "rescored");
}
