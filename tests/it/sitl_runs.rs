//! `sortie run` on ArduPilot's SITL: on the stand-in, and on the real one, named by `SORTIE_ARDUCOPTER`.

use std::ffi::OsStr;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::sitl;
use crate::stand_in::{Behaviour, StandIn};

/// How long the end of the processes may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// The folders of a user, and the program.
struct Scene {
    folder: tempfile::TempDir,
    program: PathBuf,
    mission: PathBuf,
    _stand_in: Option<StandIn>,
}

impl Scene {
    fn on_stand_in(behaviour: Behaviour) -> Self {
        let stand_in = StandIn::new(behaviour);
        Self {
            folder: tempfile::tempdir().expect("a temporary folder"),
            program: stand_in.program(),
            mission: "01".into(),
            _stand_in: Some(stand_in),
        }
    }

    fn on_the_real_one() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a temporary folder"),
            program: sitl::arducopter(),
            mission: "01".into(),
            _stand_in: None,
        }
    }

    /// Ends the mission after this many seconds of its time, which keeps a failed attempt short.
    fn limited_to(mut self, limit_s: u32) -> Self {
        let text = include_str!("../../missions/01-air-sample.toml");
        let limited = text
            .replace("time_limit = 480", &format!("time_limit = {limit_s}"))
            .replace("time = 210", "time = 10");
        assert_ne!(text, limited);
        self.mission = self.folder.path().join("limited.toml");
        fs::write(&self.mission, limited).expect("written");
        self
    }

    fn run(&self, pilot: impl AsRef<OsStr>, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sortie"));
        command
            .arg("run")
            .arg(&self.mission)
            .arg("--pilot")
            .arg(pilot)
            .args(["--backend", "ardupilot", "--arducopter"])
            .arg(&self.program)
            .args(arguments)
            .env("XDG_STATE_HOME", self.folder.path())
            .env("XDG_CONFIG_HOME", self.folder.path())
            .env("SORTIE_DATA", self.folder.path())
            .env("NO_COLOR", "1");
        command
    }

    fn output(&self, pilot: impl AsRef<OsStr>, arguments: &[&str]) -> Output {
        self.run(pilot, arguments).output().expect("it runs")
    }

    fn report(&self, pilot: impl AsRef<OsStr>, arguments: &[&str]) -> serde_json::Value {
        let output = self.output(pilot, arguments);
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", said(&output)))
    }

    /// Starts the run, and waits until it reports the beginning of the mission; also returns its
    /// later output.
    fn fly(&self) -> (Child, JoinHandle<String>) {
        let mut command = self.run("01-air-sample", &["--speedup", "1"]);
        let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("it starts");
        let lines = BufReader::new(child.stderr.take().expect("piped")).lines();
        let mut lines = lines.map(|line| line.expect("text"));
        let mut told = Vec::new();
        let begins = lines.any(|line| {
            told.push(line);
            told.last()
                .is_some_and(|line| line.contains("the mission begins"))
        });
        assert!(begins, "{told:#?}");
        assert!(!self.processes().is_empty());
        // The remaining output must be read, so that the program is not blocked.
        let rest = thread::spawn(move || lines.collect::<Vec<_>>().join("\n"));
        (child, rest)
    }

    /// The processes that run in the user's folders.
    fn processes(&self) -> Vec<i32> {
        let folder = self.folder.path().canonicalize().expect("it is there");
        let all = fs::read_dir("/proc").expect("Linux");
        let pid = |entry: fs::DirEntry| entry.file_name().to_str()?.parse().ok();
        let runs_here = |pid: &i32| {
            let at = fs::read_link(format!("/proc/{pid}/cwd"));
            at.is_ok_and(|at| at.starts_with(&folder))
        };
        all.flatten().filter_map(pid).filter(runs_here).collect()
    }

    fn assert_nothing_is_left(&self) {
        let begun = Instant::now();
        while !self.processes().is_empty() {
            assert!(begun.elapsed() < PATIENCE, "{:?}", self.processes());
            thread::sleep(Duration::from_millis(20));
        }
    }

    fn pilot(&self, lines: &str) -> PathBuf {
        let path = self.folder.path().join("my.pilot");
        fs::write(&path, lines).expect("written");
        path
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn the_reference_pilot_passes_on_the_stand_in() {
    let scene = Scene::on_stand_in(Behaviour::Normal);
    // At full speed, a busy machine can fly the vehicle past cells between two looks of the mission.
    let arguments = ["--json", "--no-timing", "--speedup", "6"];
    let output = scene.output("01-air-sample", &arguments);
    let printed = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}{printed}", said(&output));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one document");
    assert_eq!(
        (&report["backend"], &report["passed"]),
        (&"ardupilot".into(), &true.into())
    );
    // The score depends on how soon a busy machine lets the pilot react; the tests of `exercise` check it.
    assert!(report["score"].is_u64(), "{}", report["score"]);
    for stage in ["its process runs", "it can be armed", "the mission begins"] {
        assert!(said(&output).contains(stage), "{}", said(&output));
    }
    scene.assert_nothing_is_left();
}

#[test]
fn a_vehicle_that_dies_is_lost_and_ends_the_mission() {
    let scene = Scene::on_stand_in(Behaviour::Normal);
    let (mut child, rest) = scene.fly();
    for pid in scene.processes() {
        kill(Pid::from_raw(pid), Signal::SIGKILL).expect("it is ours");
    }
    let status = child.wait().expect("it is ours");
    let rest = rest.join().expect("it is read");
    assert_eq!(status.code(), Some(1), "{rest}");
    assert!(
        rest.contains("vehicle 1: its simulator has ended: the vehicle is lost"),
        "{rest}"
    );
    let obituaries = rest.matches("vehicle 1: it was ended from outside (SIGKILL)");
    assert_eq!(obituaries.count(), 1, "{rest}");
    assert!(rest.contains("mission failed"), "{rest}");
    scene.assert_nothing_is_left();
}

#[test]
fn a_program_that_does_not_start_is_told_with_what_it_said() {
    let scene = Scene::on_stand_in(Behaviour::ExitsBeforeConnecting);
    let output = scene.output("01-air-sample", &[]);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(
        said(&output).contains("the stand-in gives up"),
        "{}",
        said(&output)
    );
    assert!(output.stdout.is_empty());
}

#[test]
fn nothing_is_left_when_it_is_interrupted_or_killed() {
    let scene = Scene::on_stand_in(Behaviour::Normal);
    for signal in [Signal::SIGINT, Signal::SIGTERM, Signal::SIGKILL] {
        let (mut child, _rest) = scene.fly();
        kill(Pid::from_raw(child.id() as i32), signal).expect("it is ours");
        let status = child.wait().expect("it is ours");
        let code = (signal != Signal::SIGKILL).then_some(1);
        assert_eq!(status.code(), code, "{signal}");
        scene.assert_nothing_is_left();
    }
}

#[test]
fn faults_reach_the_stand_in_by_either_name() {
    let scene = Scene::on_stand_in(Behaviour::Normal).limited_to(20);
    let pilot = scene.pilot("all param set SIM_GPS1_ENABLE 0\nall param get SIM_GPS_DISABLE\n");
    let report = scene.report(pilot, &["--json"]);
    let states = report["ledger"].as_array().expect("rows").iter();
    let states: Vec<&str> = states
        .filter_map(|entry| entry["rows"][0]["state"].as_str())
        .collect();
    assert_eq!(states, ["effect seen"; 2], "{report:#}");
}

#[test]
fn an_airframe_changes_how_the_embedded_vehicle_flies() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let frame = folder.path().join("frame.json");
    let run = |frame: Option<&Path>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sortie"));
        command.args([
            "run",
            "01",
            "--pilot",
            "01-air-sample",
            "--json",
            "--no-timing",
            "--no-record",
        ]);
        if let Some(frame) = frame {
            command.arg("--frame").arg(frame);
        }
        command.output().expect("it runs")
    };
    fs::write(&frame, "{\"refCurrent\": 60}").expect("written");
    let energy = |output: &Output| {
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        report["energy_wh"].as_f64().expect("measured")
    };
    let (plain, heavy) = (run(None), run(Some(&frame)));
    assert!(
        energy(&heavy) > energy(&plain) * 1.1,
        "{} {}",
        energy(&heavy),
        energy(&plain)
    );
    fs::write(&frame, "{\"mass\": -1}").expect("written");
    let faulty = run(Some(&frame));
    assert_eq!(faulty.status.code(), Some(2));
    assert!(said(&faulty).contains("frame.json:1:"), "{}", said(&faulty));
}

#[test]
#[ignore = "needs SORTIE_ARDUCOPTER"]
fn the_reference_pilot_scores_on_a_real_arducopter_as_on_the_embedded_simulator() {
    let scene = Scene::on_the_real_one();
    let embedded = Command::new(env!("CARGO_BIN_EXE_sortie"))
        .args([
            "run",
            "01",
            "--pilot",
            "01-air-sample",
            "--json",
            "--no-record",
        ])
        .output()
        .expect("it runs");
    let embedded: serde_json::Value = serde_json::from_slice(&embedded.stdout).expect("JSON");
    // No faster, so that the pilot reacts soon enough even on a busy machine.
    let real = scene.report("01-air-sample", &["--json", "--speedup", "5"]);
    assert_eq!(real["passed"], true, "{real:#}");
    let score = |report: &serde_json::Value| report["score"].as_i64().expect("a number");
    assert!(
        (score(&real) - score(&embedded)).abs() <= 30,
        "{} {}",
        score(&real),
        score(&embedded)
    );
    scene.assert_nothing_is_left();
}

/// Missions whose scores on both simulators must agree: the basics, three drones that fly together,
/// detectors over a lane, and a map with a time limit.
const SAME_ON_BOTH: [&str; 4] = [
    "00-first-flight",
    "02-formation",
    "06-lane-survey",
    "08-fire-watch",
];

#[test]
#[ignore = "needs SORTIE_ARDUCOPTER"]
fn missions_score_on_real_arducopters_within_a_tenth_of_the_embedded_simulator() {
    for name in SAME_ON_BOTH {
        let mut scene = Scene::on_the_real_one();
        scene.mission = name.into();
        let embedded = Command::new(env!("CARGO_BIN_EXE_sortie"))
            .args(["run", name, "--pilot", name, "--json", "--no-record"])
            .output()
            .expect("it runs");
        let embedded: serde_json::Value = serde_json::from_slice(&embedded.stdout).expect("JSON");
        let real = scene.report(name, &["--json", "--speedup", "5"]);
        let score = |report: &serde_json::Value| report["score"].as_f64().expect("a number");
        let (real_score, wanted) = (score(&real), score(&embedded));
        eprintln!("{name}: {wanted} embedded, {real_score} on ArduPilot");
        assert!(
            (real_score - wanted).abs() <= 0.1 * wanted,
            "{name}: {wanted} embedded, but {real:#}"
        );
        scene.assert_nothing_is_left();
    }
}

#[test]
#[ignore = "needs SORTIE_ARDUCOPTER"]
fn a_real_arducopter_lands_in_a_strong_wind() {
    let mut scene = Scene::on_the_real_one();
    let text = include_str!("../../missions/01-air-sample.toml");
    let windy = text
        .replace("wind = { speed = 3.0", "wind = { speed = 9.0")
        .replace("time_limit = 480", "time_limit = 80")
        .replace("time = 210", "time = 60");
    scene.mission = scene.folder.path().join("windy.toml");
    fs::write(&scene.mission, windy).expect("written");
    let pilot = scene.pilot(
        "wait all ready timeout 60s\nall guided\nall arm\nall takeoff 10\nwait all altitude > 9 timeout 40s\n\
         all land\nwait all disarmed timeout 40s\nall param get WPNAV_SPEED\n",
    );
    let report = scene.report(pilot, &["--json", "--speedup", "5"]);
    let lines = report["ledger"].as_array().expect("rows").iter();
    let last = lines.last().expect("some");
    assert_eq!(last["line"], "all param get WPNAV_SPEED", "{report:#}");
    let at_s = last["at_s"].as_f64().expect("a time");
    assert!(at_s < 55.0, "it stood there armed until {at_s} s");
}

#[test]
#[ignore = "needs SORTIE_ARDUCOPTER"]
fn a_real_arducopter_loses_its_gps_by_the_newer_firmware_s_name() {
    let scene = Scene::on_the_real_one().limited_to(60);
    let pilot = scene.pilot(
        "wait all ready timeout 60s\nall guided\nall arm\nall takeoff 20\nwait all altitude > 19 timeout 40s\n\
         all param set SIM_GPS1_ENABLE 0\nwait all disarmed timeout 200s\n",
    );
    let output = scene.output(pilot, &[]);
    let (said, debrief) = (said(&output), String::from_utf8_lossy(&output.stdout));
    assert!(said.contains("EKF"), "{said}\n{debrief}");
    assert!(
        said.to_lowercase().contains("failsafe"),
        "{said}\n{debrief}"
    );
    assert!(
        debrief.contains("all param set SIM_GPS1_ENABLE 0: effect seen"),
        "{debrief}"
    );
}
