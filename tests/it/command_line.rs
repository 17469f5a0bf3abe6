//! The program without a terminal: `run`, `check` and wrong usage.

mod check;
mod class;
mod crew;
mod designs;
mod exams;
mod output;
mod plans;
mod rehearsals;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::terminal::program;

fn sortie(arguments: &[&str]) -> Output {
    let program = program();
    let data = tempfile::tempdir().expect("a temporary folder");
    Command::new(&program[0])
        .args(&program[1..])
        .args(arguments)
        .env("SORTIE_DATA", data.path())
        .env("NO_COLOR", "1")
        .output()
        .expect("the program runs")
}

/// Runs the program in a folder that is also its user's folder for settings and records.
fn sortie_in(folder: &Path, arguments: &[&str]) -> Output {
    let program = program();
    Command::new(&program[0])
        .args(&program[1..])
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CONFIG_HOME", folder)
        .env("XDG_DATA_HOME", folder)
        .env("XDG_STATE_HOME", folder)
        .env("NO_COLOR", "1")
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, content) in files {
        let path = folder.path().join(name);
        let parent = path.parent().expect("it is in the folder");
        fs::create_dir_all(parent).expect("created");
        fs::write(path, content).expect("written");
    }
    folder
}

#[test]
fn the_reference_pilot_passes_with_the_same_bytes_twice() {
    let arguments = [
        "run",
        "missions/01-air-sample.toml",
        "--pilot",
        "missions/pilots/01-air-sample.pilot",
        "--json",
        "--no-timing",
    ];
    let (first, second) = (sortie(&arguments), sortie(&arguments));
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    assert_eq!(text(&first.stdout), text(&second.stdout));
    let report: serde_json::Value = serde_json::from_slice(&first.stdout).expect("one document");
    assert_eq!(report["passed"], true);
    assert!(
        report["score"].as_u64().is_some_and(|score| score >= 700),
        "{}",
        report["score"]
    );
}

#[test]
fn missions_are_flown_to_see_who_passes_them() {
    let flown = sortie(&["check", "--fly", "d00", "--seeds", "1"]);
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stderr));
    let table = text(&flown.stdout);
    assert_eq!(table.matches("passed  1/1").count(), 1, "{table}");
    assert_eq!(table.matches("passed  0/1").count(), 1, "{table}");
}

/// A drill needs no naive pilot; a mission does.
#[test]
fn a_mission_without_a_naive_pilot_is_named() {
    let drill = include_str!("../../missions/drills/d00-arm-and-hover.toml");
    let mission = drill.replace("drill_of = \"00-first-flight\"\n", "");
    assert_ne!(mission, drill);
    let pilot = include_str!("../../missions/pilots/d00-arm-and-hover.pilot");
    for (source, is_named) in [(drill, false), (mission.as_str(), true)] {
        let folder = folder_with(&[("mine.toml", source), ("d00-arm-and-hover.pilot", pilot)]);
        let path = folder.path().join("mine.toml");
        let path = path.to_str().expect("Unicode");
        let flown = sortie(&["check", "--fly", path, "--seeds", "1"]);
        let said = text(&flown.stderr);
        assert_eq!(flown.status.code(), Some(0), "{said}");
        let expected = "d00-arm-and-hover: no naive pilot `d00-naive`, so none was flown";
        assert_eq!(said.contains(expected), is_named, "{said}");
    }
}

#[test]
fn a_mission_that_its_own_pilot_does_not_pass_is_told() {
    let mission = include_str!("../../missions/drills/d00-arm-and-hover.toml");
    let folder = folder_with(&[
        ("mine.toml", mission),
        ("d00-arm-and-hover.pilot", "wait 5s\n"),
    ]);
    let path = folder.path().join("mine.toml");
    let path = path.to_str().expect("Unicode");
    let flown = sortie(&["check", "--fly", path, "--seeds", "2", "--json"]);
    assert_eq!(flown.status.code(), Some(1), "{}", text(&flown.stderr));
    let rows: Vec<serde_json::Value> = serde_json::from_slice(&flown.stdout).expect("a list");
    let told: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                row["pilot"].as_str(),
                row["seed"].as_u64(),
                row["good"].as_bool(),
            )
        })
        .collect();
    let wanted = [("reference", false), ("do-nothing", true)]
        .map(|(pilot, good)| [1, 2].map(|seed| (Some(pilot), Some(seed), Some(good))));
    assert_eq!(told, wanted.concat());
}

#[test]
fn only_the_wall_time_differs_between_equal_runs() {
    let arguments = ["run", "01", "--pilot", "01-air-sample", "--json"];
    let read = |output: Output| -> serde_json::Value {
        serde_json::from_slice(&output.stdout).expect("one document")
    };
    let mut timed = read(sortie(&arguments));
    let plain = read(sortie(&[&arguments[..], &["--no-timing"]].concat()));
    let removed = timed
        .as_object_mut()
        .and_then(|report| report.remove("wall_time_s"));
    assert!(removed.is_some_and(|time| time.is_f64()));
    assert_eq!(timed, plain);
}

#[test]
fn seeds_change_the_world() {
    let of = |seed| {
        sortie(&[
            "run",
            "01",
            "--pilot",
            "01-air-sample",
            "--json",
            "--no-timing",
            "--seed",
            seed,
        ])
    };
    assert_ne!(of("1").stdout, of("2").stdout);
}

#[test]
fn a_pilot_that_only_arms_fails_with_a_low_score() {
    let output = sortie(&[
        "run",
        "01",
        "--pilot",
        "missions/pilots/01-naive.pilot",
        "--json",
        "--no-timing",
    ]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one document");
    assert_eq!(report["passed"], false);
    assert!(
        report["score"].as_u64().is_some_and(|score| score < 300),
        "{}",
        report["score"]
    );
}

#[test]
fn a_drill_and_its_pilot_go_by_their_numbers() {
    let flown = sortie(&["run", "d03", "--pilot", "d03", "--json", "--no-timing"]);
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stderr));
    let report: serde_json::Value = serde_json::from_slice(&flown.stdout).expect("one document");
    assert_eq!(report["mission"], "d03-up-the-wind");
    assert_eq!(report["passed"], true);
}

#[test]
fn a_drill_is_flown_by_its_number() {
    let folder = folder_with(&[]);
    let flown = sortie_in(folder.path(), &["fly", "d03", "--plain", "--seed", "1"]);
    let said = text(&flown.stdout);
    assert!(said.starts_with("Drill: upwind\n"), "{said}");
    // The mission gets no messages, so it is not passed.
    assert_eq!(flown.status.code(), Some(1), "{}", text(&flown.stderr));
}

#[test]
fn a_flight_that_is_not_over_has_no_debrief() {
    let folder = folder_with(&[]);
    let runs = folder.path().join("sortie/runs");
    let arguments = ["run", "d05", "--pilot", "d05", "--seed", "3", "--json"];
    let flown = sortie_in(folder.path(), &arguments);
    assert!(flown.status.success(), "{}", text(&flown.stderr));
    let truth = |output: &Output| {
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        report["truth"]["objects"].as_array().map_or(0, Vec::len)
    };
    assert!(truth(&flown) > 0, "{}", text(&flown.stdout));
    let mut entries = fs::read_dir(&runs).expect("recorded").flatten();
    let is_run = |path: &PathBuf| path.to_string_lossy().ends_with(".run.jsonl");
    let path = entries.find_map(|it| Some(it.path()).filter(is_run));
    let path = path.expect("a run").to_string_lossy().into_owned();
    let whole = fs::read_to_string(&path).expect("written");
    let lines: Vec<&str> = whole.lines().collect();
    let unfinished = lines[..lines.len() - 1].join("\n") + "\n";
    fs::write(&path, unfinished).expect("written");
    let writing = fs::File::open(&path).expect("there");
    writing.lock().expect("no other console has it");
    for format in [
        &["debrief", path.as_str()][..],
        &["debrief", "--json", &path],
    ] {
        let refused = sortie_in(folder.path(), format);
        assert_eq!(refused.status.code(), Some(2));
        assert!(refused.stdout.is_empty());
        assert!(text(&refused.stderr).contains("this flight is not over"));
    }
    // A script that flies the same world must not show the truth either, nor must a copy of the
    // record.
    let again = sortie_in(folder.path(), &[&arguments[..], &["--no-record"]].concat());
    assert_eq!(truth(&again), 0, "{}", text(&again.stdout));
    let copy = folder.path().join("copy.run.jsonl");
    fs::copy(&path, &copy).expect("copied");
    let refused = sortie_in(folder.path(), &["debrief", &copy.to_string_lossy()]);
    assert!(text(&refused.stderr).contains("this flight is not over"));
    drop(writing);
    let shown = sortie_in(folder.path(), &["debrief", &path]);
    assert!(!shown.stdout.is_empty());
}

#[test]
fn missions_and_pilots_of_the_user_are_found_by_name_number_and_id() {
    let mission = fs::read_to_string("missions/01-air-sample.toml").expect("it is there");
    let mission = mission.replace("id = \"01-air-sample\"", "id = \"mine\"");
    assert!(mission.contains("id = \"mine\""));
    let folder = folder_with(&[
        ("sortie/missions/77-yard.toml", &mission),
        ("sortie/missions/pilots/77-yard.pilot", "all nonsense\n"),
    ]);
    for name in ["77-yard", "77", "mine"] {
        for pilot in ["77-yard", "77"] {
            let output = sortie_in(folder.path(), &["run", name, "--pilot", pilot]);
            let said = text(&output.stderr);
            assert!(
                said.contains("unknown command `nonsense`"),
                "{name} {pilot}: {said}"
            );
        }
    }
    let output = sortie_in(folder.path(), &["run", "88", "--pilot", "x"]);
    let said = text(&output.stderr);
    assert!(
        said.contains("01-air-sample, ") && said.contains("77-yard"),
        "{said}"
    );
}

#[test]
fn faults_say_what_and_what_to_do() {
    let cases: &[(&[&str], i32, &[&str])] = &[
        (
            &["run", "99", "--pilot", "x"],
            2,
            &["no mission `99`", "01-air-sample"],
        ),
        (
            &["run", "01", "--pilot", "nowhere.pilot"],
            2,
            &["nowhere.pilot"],
        ),
        (&["connect", "tpc:127.0.0.1:5760"], 2, &["tpc"]),
        (&["connect", "tcp:127.0.0.1:99999"], 2, &["99999"]),
        (
            &["fly", "--theme", "drak"],
            2,
            &["drak", "did you mean `dark`?"],
        ),
        (&["fly"], 1, &["needs a terminal"]),
        (&["sim", "--vehicles", "0"], 2, &["0"]),
        (&["sim", "--home", "91,0,0,0"], 2, &["latitude"]),
        (&["sim", "--home", "50,30,1e9,0"], 2, &["-1000 to 20000 m"]),
        (&["sim", "--udp", "127.0.0.1:0"], 2, &["port 0", "14550"]),
        (
            &["sim", "--tcp", "127.0.0.1:60000", "--vehicles", "600"],
            1,
            &["600 vehicle(s)", "beyond 65535", "--tcp"],
        ),
        (
            &["sim", "--frame", "Cargo.toml"],
            2,
            &["Cargo.toml:1:2: not JSON"],
        ),
        (&["sim", "--frame", "nowhere.json"], 2, &["nowhere.json"]),
        (
            &["join", "sortie-join/1/9-A/seat-07"],
            2,
            &["not a join line: a part of it is missing"],
        ),
        (
            &["join", "seat-07.join"],
            2,
            &["cannot use seat-07.join: no such file"],
        ),
        (
            &["join", "./Cargo.toml"],
            2,
            &["./Cargo.toml is not a join line: it does not begin with `sortie-join/1/`"],
        ),
        (
            &["fly", "--class", "9-A", "--desk", "192.168.1.5:7447"],
            2,
            &[
                "`--desk` is only for join files: the class at /tmp/sortie-class-9-A/desk is on this host",
            ],
        ),
        (
            &["fly", "00", "--class", "9-A", "--desk", "192.168.1.5:desk"],
            2,
            &["`192.168.1.5:desk` is not an address: write HOST:PORT"],
        ),
        (
            &["fly", "00", "--desk", "192.168.1.5:7447"],
            2,
            &["`--desk` needs a class: name its join file"],
        ),
        (&["bench", "decode", "Cargo.toml"], 1, &["byte 0", "tlog"]),
    ];
    for (arguments, code, words) in cases {
        let output = sortie(arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(*code), "{arguments:?}: {said}");
        for word in *words {
            assert!(
                said.contains(word),
                "{arguments:?} does not say {word:?}: {said}"
            );
        }
    }
}

#[test]
fn of_thousands_of_faults_the_first_fifty_are_shown() {
    let faulty: Vec<String> = (0..3000).map(|at| format!("wrong{at} = 1")).collect();
    let folder = folder_with(&[("many.toml", &faulty.join("\n"))]);
    let output = sortie_in(folder.path(), &["run", "many.toml", "--pilot", "00"]);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    assert_eq!(said.matches("many.toml:").count(), 50, "{said}");
    assert!(said.contains("more faults"), "{said}");
}

#[test]
fn what_holds_for_missions_of_the_home_screen_goes_with_no_command() {
    for arguments in [["--speedup", "4", "doctor"], ["--seed", "7", "man"]] {
        let output = sortie(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains("after the command"));
    }
    assert_eq!(sortie(&["--speedup", "0"]).status.code(), Some(2));
    // The only fault is the missing terminal.
    assert_eq!(
        sortie(&["--speedup", "4", "--seed", "7"]).status.code(),
        Some(1)
    );
}
