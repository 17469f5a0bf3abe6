//! Recorded runs as files: from other programs, damaged, on a full disk, from a killed console.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use sortie::link::TlogReader;

use crate::terminal::program;

mod endings;
mod folders;
mod free_flights;
mod journals;
mod verified;

/// How long the console may take to record something.
const PATIENCE: Duration = Duration::from_secs(60);

/// The program with its data in a folder; `before` is shell code that precedes it, if any.
fn sortie(data: &Path, before: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new("bash");
    let program = program();
    let line = format!("{before} exec \"$@\"");
    command.args(["-c", line.as_str(), "bash"]);
    command.args(&program).args(arguments);
    command
        .env("XDG_DATA_HOME", data)
        .env("XDG_CONFIG_HOME", data)
        .env("LC_ALL", "C.UTF-8");
    command
}

fn run(data: &Path, before: &str, arguments: &[&str]) -> Output {
    let mut command = sortie(data, before, arguments);
    command.output().expect("it runs")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn runs(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_run = |path: &PathBuf| path.to_string_lossy().ends_with(".run.jsonl");
    entries.map(|entry| entry.path()).filter(is_run).collect()
}

const FLIGHT: [&str; 6] = [
    "run",
    "01",
    "--pilot",
    "01-air-sample",
    "--json",
    "--no-timing",
];

#[test]
fn an_export_that_does_not_fit_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path();
    let tlog = Path::new("tests/data/recordings").join("flight.tlog");
    for (format, name) in [("csv", "tables"), ("mcap", "flight.mcap")] {
        let into = data.join(name);
        let (tlog, into) = (tlog.to_string_lossy(), into.to_string_lossy());
        let line = [
            "records", "export", &tlog, "--format", format, "--output", &into,
        ];
        let failed = run(data, "trap '' XFSZ; ulimit -f 8;", &line);
        assert_eq!(failed.status.code(), Some(1), "{}", said(&failed));
        assert!(
            said(&failed).contains("File too large"),
            "{}",
            said(&failed)
        );
        let left: Vec<_> = fs::read_dir(data).expect("there").flatten().collect();
        let is_left = |it: &&fs::DirEntry| it.file_name().to_string_lossy().contains(name);
        assert!(!left.iter().any(|it| is_left(&it)), "{left:?}");
        let written = run(data, "", &line);
        assert_eq!(written.status.code(), Some(0), "{}", said(&written));
        assert!(Path::new(&*into).exists());
    }
}

#[test]
fn a_scripts_flight_is_recorded_like_one_of_the_console() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path().join("data");
    let flown = run(&data, "", &FLIGHT);
    assert_eq!(flown.status.code(), Some(0), "{}", said(&flown));
    let shown = run(&data, "", &["records", "show", "--json"]);
    let record: serde_json::Value = serde_json::from_slice(&shown.stdout).expect("a document");
    assert_eq!(record["subject"], "01-air-sample");
    let kinds: Vec<&str> = record["moments"]
        .as_array()
        .expect("moments")
        .iter()
        .filter_map(|moment| moment["kind"].as_str())
        .collect();
    for kind in ["mode", "arming", "objective"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
    let frames = fs::File::open(record["frames"].as_str().expect("a path")).expect("it is there");
    let frames: Result<Vec<_>, _> = TlogReader::new(std::io::BufReader::new(frames)).collect();
    let frames = frames.expect("a sound tlog");
    // The source system of each MAVLink 2 frame: the sixth byte.
    let is_from = |system: u8| frames.iter().filter(|it| it.bytes[5] == system).count();
    assert!(
        is_from(1) > 1000 && is_from(255) > 100,
        "{} {}",
        is_from(1),
        is_from(255)
    );
    assert!(frames.is_sorted_by_key(|it| it.unix_us));
    let verified = run(&data, "", &["verify"]);
    assert_eq!(verified.status.code(), Some(0), "{}", said(&verified));
    // Also by its number and by its name.
    for named in ["1", record["name"].as_str().expect("a name")] {
        for command in ["verify", "debrief"] {
            let output = run(&data, "", &[command, named]);
            assert_eq!(output.status.code(), Some(0), "{command} {named}");
        }
    }

    let unrecorded = run(&data, "", &[&FLIGHT[..], &["--no-record"]].concat());
    assert_eq!(unrecorded.stdout, flown.stdout);
    assert_eq!(runs(&data.join("sortie/runs")).len(), 1);
}

#[test]
fn records_are_listed_with_their_result_and_deleted_only_by_plain_numbers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path();
    let flown = run(data, "", &FLIGHT);
    let report: serde_json::Value = serde_json::from_slice(&flown.stdout).expect("a report");
    let printed = |arguments: &[&str]| {
        let output = run(data, "", arguments);
        String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output)
    };
    let list = printed(&["records", "list"]);
    let medal = report["medal"].as_str().expect("a medal");
    let result = format!("{medal} {}", report["score"]);
    assert!(list.contains(&result), "{list}");
    assert!(
        list.lines().all(|line| line.chars().count() <= 80),
        "{list}"
    );
    let review = data.join("review.md");
    let path = review.to_str().expect("a plain path");
    printed(&["records", "export", "1", "--format", "md", "--output", path]);
    let review = fs::read_to_string(&review).expect("a review");
    let flown = format!(
        "mission 01-air-sample, revision {}, seed {}",
        report["revision"], report["seed"]
    );
    assert!(review.contains(&flown), "{review}");
    let reversed = printed(&["records", "delete", "3-1", "--yes"]);
    assert!(
        reversed.contains("3-1") && reversed.contains("reversed"),
        "{reversed}"
    );
    let asked = printed(&["records", "delete", "1"]);
    assert!(
        asked.contains("_01-air-sample_") && asked.contains("--yes"),
        "{asked}"
    );
    assert_eq!(runs(&data.join("sortie/runs")).len(), 1);
}

#[test]
fn a_disk_that_fills_up_costs_the_rest_of_the_record_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let whole = run(folder.path(), "", &FLIGHT);
    // Each row: the room in kB, and the number of files that remain.
    for (room_kb, left) in [(40, 1), (0, 0)] {
        let into = folder.path().join(format!("room-{room_kb}"));
        let name = into.to_string_lossy().into_owned();
        let limit = format!("trap '' XFSZ; ulimit -f {room_kb};");
        let output = run(
            folder.path(),
            &limit,
            &[&FLIGHT[..], &["--record", &name]].concat(),
        );
        // The program's document is written to a pipe, which has no limit.
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert_eq!(output.stdout, whole.stdout);
        // The frames and the run's record grow at the same time; each full file is reported once.
        assert!(said(&output).lines().count() <= 2, "{}", said(&output));
        assert!(said(&output).lines().all(|line| line.contains(&name)));
        let files = runs(&into);
        assert_eq!(files.len(), left);
        for file in files {
            let record = fs::read_to_string(&file).expect("there");
            assert!(record.ends_with('\n') && record.len() > 10_000);
            let name = file.to_string_lossy();
            let again = run(folder.path(), "", &["debrief", &name]);
            assert_eq!(again.status.code(), Some(1));
            assert!(
                said(&again).contains("stops before the end"),
                "{}",
                said(&again)
            );
        }
    }
}

#[test]
fn a_record_of_a_mission_that_was_rewritten_says_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let into = folder.path().join("kept");
    let name = into.to_string_lossy().into_owned();
    run(
        folder.path(),
        "",
        &[&FLIGHT[..], &["--record", &name]].concat(),
    );
    let file = runs(&into).pop().expect("a record");
    let record = fs::read_to_string(&file).expect("there");
    let of = |record: &str| {
        fs::write(&file, record).expect("writable");
        let name = file.to_string_lossy();
        let text = run(folder.path(), "", &["debrief", &name]).stdout;
        let json = run(folder.path(), "", &["debrief", &name, "--json"]).stdout;
        [text, json].map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
    };
    let [text, json] = of(&record);
    assert!(!text.contains("scores cannot be compared"), "{text}");
    assert!(json.contains("\"mission_file\": \"course\""), "{json}");
    let rewritten = record.replacen(
        "objective = 0.45, quality = 0.20",
        "objective = 0.65, quality = 0.00",
        1,
    );
    assert_ne!(record, rewritten);
    let [text, json] = of(&rewritten);
    assert!(
        text.contains("The mission file differs from 01-air-sample"),
        "{text}"
    );
    assert!(json.contains("\"mission_file\": \"altered\""), "{json}");
}

#[test]
fn what_is_no_run_is_refused_with_its_name_and_the_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = |name: &str, content: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, content).expect("written");
        path.to_string_lossy().into_owned()
    };
    let huge = file("huge", b"{\"sortie_run\":1}\n");
    let hole = File::options().write(true).open(&huge).expect("there");
    hole.set_len(65 * 1024 * 1024).expect("a hole");
    for (path, reason) in [
        (file("empty", b""), "not a recorded run"),
        (file("zeros", &[0; 4096]), "not a recorded run"),
        (
            file("text", b"schema = 1\nid = \"x\"\n"),
            "not a recorded run",
        ),
        (file("newer", b"{\"sortie_run\":2}\n"), "version 2"),
        (
            file("head", b"{\"sortie_run\":1}\n"),
            "first line is damaged",
        ),
        (huge, "too long"),
        (
            folder.path().to_string_lossy().into_owned(),
            "is not a file",
        ),
        (file("gone", b"") + "-not", "no record and no file"),
        ("/dev/zero".to_owned(), "is not a file"),
    ] {
        let output = run(folder.path(), "", &["debrief", &path]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{path}: {said}");
        assert!(said.contains(reason) && said.contains(&path), "{said}");
        assert!(output.stdout.is_empty() && !said.contains("panicked"));
    }
    let none = run(folder.path(), "", &["debrief"]);
    assert!(
        said(&none).contains("no run is recorded in"),
        "{}",
        said(&none)
    );
}

#[test]
fn a_console_that_is_killed_leaves_a_record_to_be_read() {
    let data = tempfile::tempdir().expect("a temporary folder");
    let arguments = ["fly", "01", "--plain", "--speedup", "20"];
    let mut console = sortie(data.path(), "", &arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it runs");
    let mut input = console.stdin.take().expect("a pipe");
    input
        .write_all(b"wait all ready\nall guided\nall arm\nall takeoff 20\n")
        .expect("it reads");
    let folder = data.path().join("sortie/runs");
    let deadline = Instant::now() + PATIENCE;
    let is_flying = |path: &PathBuf| fs::metadata(path).is_ok_and(|file| file.len() > 20_000);
    while !runs(&folder).iter().any(is_flying) {
        assert!(Instant::now() < deadline, "nothing is recorded");
        std::thread::sleep(Duration::from_millis(50));
    }
    console.kill().expect("it lives");
    console.wait().expect("it is gone");
    let record = fs::read_to_string(&runs(&folder)[0]).expect("there");
    assert!(record.ends_with('\n'), "only whole lines");
    let again = run(data.path(), "", &["debrief"]);
    assert_eq!(again.status.code(), Some(1), "{}", said(&again));
    assert!(
        said(&again).contains("stops before the end"),
        "{}",
        said(&again)
    );
    let page = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(
        page.contains("01-air-sample") && page.contains("NOT FINISHED"),
        "{page}"
    );
    assert_eq!(score_without_end(data.path(), &record, false), 200);
    assert_eq!(score_without_end(data.path(), &record, true), 0);
    endings::assert_verified_as_far_as_it_goes(data.path());
}

/// The score in the debrief of a record without an end: of practice, or of a flight that counts and
/// was therefore left early.
fn score_without_end(folder: &Path, record: &str, counts: bool) -> u64 {
    let (head, lines) = record.split_once('\n').expect("a head");
    let mut head: serde_json::Value = serde_json::from_str(head).expect("a head");
    if counts {
        head["stake"] = "graded".into();
        head["flown_by"] = "hand".into();
    }
    let file = folder.join("again.run.jsonl");
    fs::write(&file, format!("{head}\n{lines}")).expect("writable");
    let debrief = run(folder, "", &["debrief", "--json", &file.to_string_lossy()]);
    let report: serde_json::Value = serde_json::from_slice(&debrief.stdout).expect("JSON");
    report["score"].as_u64().expect("points")
}
