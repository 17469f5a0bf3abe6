//! Verification of flights without a mission.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Stdio;

use super::{run, said, sortie};

/// Flies one vehicle by lines from a pipe; returns the log of its inputs.
fn flown(data: &Path) -> PathBuf {
    let fly = ["fly", "--plain", "--vehicles", "1", "--speedup", "20"];
    let mut console = sortie(data, "", &fly)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("it runs");
    let mut input = console.stdin.take().expect("a pipe");
    let lines = b"wait all ready\nall guided\nall arm\nall takeoff 10\nwait 25s\nall land\n";
    input.write_all(lines).expect("it reads");
    drop(input);
    assert!(console.wait().expect("it ends").success());
    let entries = fs::read_dir(data.join("sortie/runs")).expect("a folder");
    let mut paths = entries.flatten().map(|entry| entry.path());
    let is_inputs = |path: &PathBuf| path.to_string_lossy().ends_with(".inputs.jsonl");
    paths.find(is_inputs).expect("a log of inputs")
}

#[test]
fn only_the_states_of_the_vehicles_verify_a_free_flight() {
    let data = tempfile::tempdir().expect("a folder");
    let inputs = flown(data.path());
    let whole = fs::read_to_string(&inputs).expect("text");
    let verify = |text: &str| {
        fs::write(&inputs, text).expect("it is written");
        let output = run(data.path(), "", &["verify"]);
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        (output.status.code(), printed + &said(&output))
    };
    let without = |part: &str| -> String {
        let lines = whole.split_inclusive('\n');
        lines.filter(|line| !line.contains(part)).collect()
    };
    let (code, printed) = verify(&whole);
    assert_eq!(code, Some(0), "{printed}");
    let (first, _) = whole.split_once('\n').expect("a head");
    let (cut, _) = whole.split_at(whole.rfind("{\"s\"").expect("the end"));
    for (text, expected_code, expected) in [
        (format!("{first}\n"), 2, "nothing to compare"),
        (without("\"state\":"), 2, "nothing to compare"),
        (without("\"s\":1000,\"state\""), 1, "lacks the state"),
        (cut.to_owned(), 1, "its end is missing"),
    ] {
        let (code, printed) = verify(&text);
        assert_eq!(code, Some(expected_code), "{printed}");
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
}
