//! Records of missions without an end.

use std::fs;
use std::path::Path;

use super::{FLIGHT, run, runs, said};

/// Verifies the record of a killed console, and the same record as if the flight had been left.
pub(super) fn assert_verified_as_far_as_it_goes(data: &Path) {
    let verify = || {
        let output = run(data, "", &["verify", "--json"]);
        assert_eq!(output.status.code(), Some(3), "{}", said(&output));
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        document
    };
    let cut = verify();
    assert_eq!(cut["verdict"], "verified_cut");
    assert!(cut["to_s"].as_f64().expect("a time") > 1.0, "{cut}");
    assert!(cut["score"].is_null(), "{cut}");
    // A console that was left ends the journal; this is the only difference between the two.
    let journal = runs(&data.join("sortie/runs"))[0]
        .to_string_lossy()
        .replace(".run.", ".flight.");
    let mut lines = fs::read_to_string(&journal).expect("there");
    let last = lines.lines().next_back().expect("a line");
    let (time, _) = last.split_once(",\"").expect("a time");
    lines = format!("{lines}{time},\"end\":null}}\n");
    fs::write(&journal, lines).expect("it is written");
    assert_eq!(verify()["verdict"], "verified_left");
}

#[test]
fn a_record_without_its_end_is_never_plainly_verified() {
    let data = tempfile::tempdir().expect("a temporary folder");
    let into = data.path().join("runs").to_string_lossy().into_owned();
    let flight = [&FLIGHT[..], &["--record", &into]].concat();
    assert_eq!(run(data.path(), "", &flight).status.code(), Some(0));
    let file = runs(Path::new(&into)).remove(0);
    let name = file.to_string_lossy().into_owned();
    let record = fs::read_to_string(&file).expect("there");
    let end = record.rfind("{\"end\"").expect("an end");
    let middle = record[..end / 2 + end / 4].rfind('\n').expect("a line") + 1;
    for (kept, code, words) in [
        (end, 1, "the mission was over, but the end of its record"),
        (middle, 3, "verified up to"),
    ] {
        fs::write(&file, &record[..kept]).expect("it is written");
        let output = run(data.path(), "", &["verify", &name]);
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(code), "{printed}");
        assert!(printed.contains(words), "{printed}");
    }
    // The journal ends normally, but the drones flew on: the end of the record was removed.
    let output = run(data.path(), "", &["verify", &name, "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(document["verdict"], "verified_cut");
}
