//! `sortie hangar command`, `sortie hangar identify` and `sortie doctor`.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    fn file(&self, name: &str, text: &str, mode: u32) -> PathBuf {
        let path = self.0.path().join(name);
        fs::write(&path, text).expect("it is written");
        fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("it is ours");
        path
    }

    /// Runs the program with its own home folder, without any settings of this machine.
    fn sortie(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_sortie"))
            .args(arguments)
            .env_clear()
            .env("HOME", self.0.path())
            .env("LC_ALL", "C.UTF-8")
            .env("TERM", "xterm-256color")
            .current_dir(self.0.path())
            .stdin(Stdio::null())
            .output()
            .expect("it starts")
    }

    fn path(&self) -> &Path {
        self.0.path()
    }
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("it is text")
}

/// A stand-in for SITL: writes its arguments to a file in its folder, and ends.
const STAND_IN: &str = "#!/bin/sh\nfor word; do echo \"$word\"; done > arguments\necho started\n";

#[test]
fn the_script_makes_the_files_and_starts_the_program_in_its_folder() {
    let place = Place::new();
    let program = place.file("it's arducopter", STAND_IN, 0o755);
    let frame = "{\"num_motors\": 6} # a hexa's\n";
    place.file("hexa.json", frame, 0o644);
    place.file("my.parm", "RTL_ALT 2000\nWPNAV_SPEED,500\n", 0o644);
    let program = program.display().to_string();
    let options = [
        "hangar",
        "command",
        "--arducopter",
        &program,
        "--vehicles",
        "2",
        "--formation",
        "column",
        "--system",
        "5",
        "--frame",
        "hexa.json",
        "--params",
        "my.parm",
        "--param",
        "RTL_ALT=3000",
        "--home",
        "50,30,100,0",
    ];
    let printed = place.sortie(&options);
    assert!(printed.status.success(), "{}", text(&printed.stderr));
    let script = text(&printed.stdout);
    assert!(
        script.contains("sortie connect tcp:127.0.0.1:5760 tcp:127.0.0.1:5770"),
        "{script}"
    );
    assert!(script.contains("on all interfaces"), "{script}");
    let run = Command::new("sh")
        .args(["-c", script])
        .current_dir(place.path())
        .output();
    let run = run.expect("there is a shell");
    assert!(run.status.success(), "{run:?}");
    let json = place.sortie(&[&options[..], &["--json"]].concat());
    let orders: Value = serde_json::from_slice(&json.stdout).expect("it is JSON");
    for (order, system) in orders.as_array().expect("a list").iter().zip([5, 6]) {
        assert_eq!(order["system"], system);
        let folder = place.path().join(format!("sitl-{system}"));
        let read = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
        let expected: Vec<_> = order["arguments"]
            .as_array()
            .expect("a list")
            .iter()
            .collect();
        let got: Vec<Value> = read("arguments").lines().map(Value::from).collect();
        assert_eq!(got.iter().collect::<Vec<_>>(), expected);
        assert_eq!(read("frame.json"), frame);
        assert_eq!(order["files"]["vehicle.parm"], read("vehicle.parm"));
        assert!(read("vehicle.parm").contains("RTL_ALT 3000\n"));
        assert!(read("vehicle.parm").contains("WPNAV_SPEED 500\n"));
        assert_eq!(read("output.log"), "started\n");
    }
    // The second vehicle stands 5 m south of the first.
    let home = orders[1]["arguments"][9].as_str().expect("a home");
    assert!(home.starts_with("49.999955"), "{home}");
}

#[test]
fn connecting_out_opens_no_port() {
    let place = Place::new();
    let printed = place.sortie(&[
        "hangar",
        "command",
        "--kind",
        "rover",
        "--connect-out",
        "127.0.0.1:4711",
    ]);
    let script = text(&printed.stdout);
    assert!(script.contains("ardurover --model rover"), "{script}");
    assert!(
        script.contains("--serial0 tcpclient:127.0.0.1:4711 --serial1 none:"),
        "{script}"
    );
    assert!(
        script.contains("sortie connect tcpin:127.0.0.1:4711"),
        "{script}"
    );
    assert!(!script.contains("TCP ports"), "{script}");
    let told = text(&printed.stderr);
    assert!(told.contains("no ardurover on the PATH"), "{told}");
}

#[test]
fn a_boat_is_a_rover_with_another_model() {
    let place = Place::new();
    let said = place.sortie(&["hangar", "command", "--kind", "boat", "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&said.stdout).expect("JSON");
    let arguments = told[0]["arguments"].to_string();
    assert!(arguments.contains("motorboat"), "{arguments}");
    assert_eq!(told[0]["program"], "ardurover");
    let files = told[0]["files"].to_string();
    assert!(files.contains("FRAME_CLASS 2"), "{files}");
}

#[test]
fn another_kind_flies_with_its_own_program_only() {
    let place = Place::new();
    place.file("frame.json", "{}\n", 0o644);
    let program = place.file("ardurover", STAND_IN, 0o755);
    let rover = program.to_str().expect("text");
    let cases: [(&[&str], &str); 10] = [
        (
            &["--kind", "rover", "--backend", "ardupilot"],
            "name it with --ardurover FILE",
        ),
        (
            &["--kind", "rover", "--model", "sailboat"],
            "name it with --ardurover FILE",
        ),
        // Without the option, it is a rover of the embedded simulator.
        (
            &["--kind", "rover", "--param", "WP_SPEED=3"],
            "`param set` in the console",
        ),
        (&["--kind", "plane"], "./waf plane"),
        (
            &["--kind", "plane", "--backend", "embedded"],
            "the embedded simulator has copters, rovers",
        ),
        (&["--param", "WP_SPEED=3"], "`param set` in the console"),
        (&["--model", "hexa"], "--model is for ArduPilot's SITL"),
        (
            &["--kind", "rover", "--frame", "frame.json"],
            "only multirotors use a frame file",
        ),
        (
            &["--kind", "rover", "--model", "hexa", "--ardurover", rover],
            "a rover has no model `hexa`",
        ),
        (&["01", "--kind", "rover"], "cannot be used with"),
    ];
    for (options, expected) in cases {
        let said = place.sortie(&[&["fly", "--plain"], options].concat());
        let told = text(&said.stderr);
        assert_eq!(said.status.code(), Some(2), "{options:?}: {told}");
        assert!(told.contains(expected), "{options:?}: {told}");
    }
}

#[test]
fn what_cannot_be_started_is_wrong_usage() {
    let place = Place::new();
    place.file("quad.json", "{\"mass\": -3}\n", 0o644);
    place.file("bad.parm", "RTL_ALT\n", 0o644);
    let cases: [(&[&str], &str); 7] = [
        (&["--frame", "quad.json"], "the frame file, line 1"),
        (&["--frame", "nowhere.json"], "nowhere.json"),
        (&["--params", "bad.parm"], "bad.parm:1:8"),
        (
            &["--model", "hexa", "--param", "FRAME_CLASS=1"],
            "use the model y6",
        ),
        (&["--system", "250", "--vehicles", "10"], "end at 259"),
        (&["--param", "RTL_ALT"], "expected NAME=VALUE"),
        (&["--listen-instance", "256"], "use 0 to 255"),
    ];
    for (options, expected) in cases {
        let said = place.sortie(&[&["hangar", "command"], options].concat());
        let told = text(&said.stderr);
        assert_eq!(said.status.code(), Some(2), "{options:?}: {told}");
        // A command without a model is valid as well.
        assert!(
            told.contains(expected) || expected == "use the model y6",
            "{told}"
        );
        assert!(said.stdout.is_empty());
    }
}

#[test]
fn a_program_that_is_no_sitl_is_a_fault_of_identify_and_of_the_doctor() {
    let place = Place::new();
    let program = place.file(
        "arducopter",
        "#!/bin/sh\necho no such option\nexit 2\n",
        0o755,
    );
    let program = program.display().to_string();
    let said = place.sortie(&["hangar", "identify", &program]);
    assert_eq!(said.status.code(), Some(1));
    let line = text(&said.stdout);
    assert!(
        line.contains(
            "is not a SITL program: it has ended (exit status: 2); it printed: no such option"
        ),
        "{line}"
    );
    let said = place.sortie(&["doctor", "--json", "--arducopter", &program]);
    assert_eq!(said.status.code(), Some(1), "{}", text(&said.stderr));
    let findings: Value = serde_json::from_slice(&said.stdout).expect("it is JSON");
    let about = |name: &str| {
        let mut all = findings.as_array().expect("a list").iter();
        all.find(|finding| finding["about"] == name)
            .unwrap_or_else(|| panic!("{name} in {findings}"))
    };
    assert_eq!(about("arducopter")["verdict"], "fault");
    assert!(
        about("arducopter")["mend"]
            .as_str()
            .expect("what to do")
            .contains("--arducopter")
    );
    for name in [
        "terminal",
        "locale",
        "config",
        "data",
        "state",
        "processors",
        "leftovers",
        "hangar token",
    ] {
        assert_eq!(about(name)["verdict"], "ok", "{name}");
    }
    // A relative path in the configuration is relative to the configuration file.
    let config = place.file(
        "config.toml",
        "hangar.arducopter = \"nowhere/arducopter\"\n",
        0o644,
    );
    let said = place.sortie(&[
        "hangar",
        "identify",
        "--config",
        &config.display().to_string(),
    ]);
    let line = text(&said.stdout);
    assert!(
        line.contains("config.toml:1 names ") && line.contains("/nowhere/arducopter: No such file"),
        "{line}"
    );
}

#[test]
fn a_token_that_others_can_read_is_a_fault() {
    let place = Place::new();
    let token = place.file("token", "secret\n", 0o644);
    let config = place.file("config.toml", "hangar.token_file = \"token\"\n", 0o644);
    let config = config.display().to_string();
    let said = place.sortie(&["doctor", "--config", &config]);
    let told = text(&said.stdout);
    assert_eq!(said.status.code(), Some(1), "{told}");
    assert!(told.contains("FAULT hangar token"), "{told}");
    fs::set_permissions(&token, fs::Permissions::from_mode(0o600)).expect("it is ours");
    let said = place.sortie(&["doctor", "--config", &config]);
    assert_eq!(said.status.code(), Some(0), "{}", text(&said.stdout));
}
