//! The console with processes that simulate its vehicles: stand-ins for ArduPilot's SITL.

use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::stand_in::{Behaviour, StandIn};
use crate::terminal::{Terminal, home_variables, program};

/// How long the end of a process may take.
const PATIENCE: Duration = Duration::from_secs(30);

/// The processes of the console's vehicles: its children that are not zombies.
fn children(console: u32) -> Vec<u32> {
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").expect("Linux").flatten() {
        let Some(pid) = entry
            .file_name()
            .to_str()
            .and_then(|name| name.parse().ok())
        else {
            continue;
        };
        // A process may end during this check.
        let stat = fs::read_to_string(entry.path().join("stat")).unwrap_or_default();
        let mut fields = stat
            .rsplit(')')
            .next()
            .unwrap_or_default()
            .split_whitespace();
        let (state, parent) = (fields.next(), fields.next());
        if state != Some("Z") && parent == Some(&console.to_string()) {
            found.push(pid);
        }
    }
    found.sort_unstable();
    found
}

fn lives(pid: u32) -> bool {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let state = stat
        .rsplit(')')
        .next()
        .and_then(|rest| rest.split_whitespace().next());
    !matches!(state, None | Some("Z"))
}

fn wait_until_gone(pids: &[u32]) {
    let deadline = Instant::now() + PATIENCE;
    while pids.iter().any(|&pid| lives(pid)) {
        assert!(Instant::now() < deadline, "{pids:?} live on");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// The processes of a console, once this many exist: they are started one after the other.
fn all_children(console: u32, count: usize) -> Vec<u32> {
    let deadline = Instant::now() + PATIENCE;
    loop {
        let pids = children(console);
        if pids.len() == count {
            return pids;
        }
        assert!(Instant::now() < deadline, "{pids:?} instead of {count}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn kill(pid: u32) {
    let sent = Command::new("kill").args(["-9", &pid.to_string()]).status();
    assert!(sent.expect("kill is there").success());
}

fn fly(stand_in: &StandIn, more: &[&str], (columns, rows): (u16, u16)) -> Terminal {
    let program = stand_in.program();
    let program = program.to_str().expect("a path of ours");
    let mut arguments = vec!["fly"];
    arguments.extend(more);
    arguments.extend(["--backend", "ardupilot", "--arducopter", program]);
    Terminal::start(&arguments, columns, rows)
}

#[test]
fn a_vehicle_whose_process_is_killed_in_flight_is_started_again_and_flies() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let mut terminal = fly(&stand_in, &["--vehicles", "2", "--speedup", "5"], (120, 40));
    terminal.see("2 vehicles are ready to arm").see("FLY");
    let pids = children(terminal.process_id());
    assert_eq!(pids.len(), 2);
    terminal
        .command("all guided")
        .see("2 vehicles: 2 effect seen");
    terminal.command("all arm").see("2 armed");
    terminal
        .command("all takeoff 15")
        .see("all takeoff 15  2 vehicles: 2 effect seen");
    kill(pids[1]);
    terminal.see("SITL DOWN").see("process is gone");
    terminal
        .press("G")
        .see("CRASHED")
        .see("r restarts the vehicle");
    terminal
        .press("r")
        .see("2 of 2 ready")
        .see_no_more("CRASHED");
    terminal.press("F").see_no_more("SITL DOWN");
    let again = children(terminal.process_id());
    let new: Vec<u32> = again
        .iter()
        .copied()
        .filter(|pid| !pids.contains(pid))
        .collect();
    assert_eq!((again.len(), new.len()), (2, 1));
    terminal.see("ready to arm again");
    terminal.command("all guided").see("effect seen");
    terminal.command("all arm").see("2 armed");
    terminal
        .command("all land")
        .wait("both down", |screen| screen.contains("0 armed"));
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
    wait_until_gone(&again);
}

#[test]
fn nothing_outlives_a_console_that_is_killed() {
    let stand_in = StandIn::new(Behaviour::NeverReady);
    let mut terminal = fly(&stand_in, &["--vehicles", "3"], (80, 24));
    terminal.see("0 of 3 ready").see("needs a position");
    let pids = all_children(terminal.process_id(), 3);
    kill(terminal.process_id());
    wait_until_gone(&pids);
}

#[test]
fn a_start_that_never_ends_can_be_looked_at_and_cancelled() {
    let stand_in = StandIn::new(Behaviour::NeverConnects);
    let mut terminal = fly(&stand_in, &["01"], (80, 24));
    terminal.see("HANGAR").see("runs");
    terminal.press("?").see("every").press("\u{1b}");
    let pids = children(terminal.process_id());
    assert!(!pids.is_empty());
    terminal.press("\u{1b}").see("HOME");
    wait_until_gone(&pids);
    terminal.press("q");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_mission_is_flown_and_begun_again_with_new_processes() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let mut terminal = fly(&stand_in, &["01"], (80, 24));
    // The brief comes first; a restart skips it.
    terminal.see("MISSION").see("before takeoff");
    terminal.press("\r").see("FLY").see("ready");
    let pids = children(terminal.process_id());
    // No attempt was made yet, so no question is asked.
    terminal.command("restart");
    terminal.see("HANGAR").see("FLY").see("ready");
    wait_until_gone(&pids);
    let again = children(terminal.process_id());
    assert_eq!(again.len(), pids.len());
    terminal.command("quit");
    // On a slow machine the mission has begun by now, and giving it up requires an answer.
    terminal.until("the end or a question", |terminal| {
        !terminal.in_alternate_screen() || terminal.contents().contains("are you sure")
    });
    if terminal.in_alternate_screen() {
        terminal.press("y");
    }
    assert_eq!(terminal.end(), 0);
    wait_until_gone(&again);
}

/// Runs the program without a terminal; returns its exit code and its output.
fn plain(arguments: &[&str], input: &str) -> (Option<i32>, String, String) {
    use std::io::Write as _;
    let home = tempfile::tempdir().expect("a temporary folder");
    let words = program();
    let mut child = Command::new(&words[0])
        .args(&words[1..])
        .args(arguments)
        .envs(home_variables(home.path()))
        .env("PATH", "/nowhere")
        .env_remove("SORTIE_ARDUCOPTER")
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    // A program that refuses its arguments reads no input.
    drop(stdin.write_all(input.as_bytes()));
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn without_a_program_one_is_told_where_it_was_looked_for_and_how_to_get_one() {
    let (code, _, said) = plain(
        &["fly", "--plain", "--arducopter", "/nowhere/arducopter"],
        "",
    );
    assert_eq!(code, Some(2));
    assert!(
        said.contains("/nowhere/arducopter") && said.contains("waf"),
        "{said}"
    );
}

#[test]
fn a_frame_that_does_not_fit_is_told_before_anything_starts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let frame = folder.path().join("heavy.json");
    fs::write(&frame, "{ \"mass\": -3 }\n").expect("written");
    let frame = frame.to_str().expect("a path of ours");
    for backend in ["embedded", "ardupilot"] {
        let stand_in = StandIn::new(Behaviour::Normal);
        let program = stand_in.program();
        let program = program.to_str().expect("a path of ours");
        let arguments = [
            "fly",
            "--plain",
            "--backend",
            backend,
            "--frame",
            frame,
            "--arducopter",
            program,
        ];
        let (code, _, said) = plain(&arguments, "");
        assert_eq!(code, Some(2), "{said}");
        assert!(
            said.contains("heavy.json:1:3") && said.contains("mass"),
            "{said}"
        );
    }
}

#[test]
fn the_links_of_four_processes_are_told_apart_by_their_vehicles() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let program = stand_in.program();
    let program = program.to_str().expect("a path of ours");
    let four = ["fly", "--plain", "--vehicles", "4", "--speedup", "5"];
    let arguments = [
        &four[..],
        &["--backend", "ardupilot", "--arducopter", program],
    ]
    .concat();
    let (code, said, wrong) = plain(&arguments, "links\n");
    assert_eq!(code, Some(0), "{said}{wrong}");
    let lines = said
        .lines()
        .filter(|line| line.contains(" messages a second in"));
    let names: Vec<_> = lines
        .filter_map(|line| line.split_once(": "))
        .map(|(name, _)| name)
        .collect();
    let expected = (1..=4).map(|at| format!("link {at}, SITL {at}"));
    assert_eq!(names, expected.collect::<Vec<_>>(), "{said}");
}

#[test]
fn without_a_screen_the_stages_are_lines_and_the_flight_waits_for_them() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let program = stand_in.program();
    let program = program.to_str().expect("a path of ours");
    let arguments = [
        "fly",
        "--plain",
        "--vehicles",
        "2",
        "--speedup",
        "5",
        "--backend",
        "ardupilot",
        "--arducopter",
        program,
    ];
    // The stand-in's script calls its shell by an absolute path, so it does not need the `PATH`
    // that `plain` hides.
    let (code, said, wrong) = plain(&arguments, "all guided\nall arm\nhangar\nall disarm\n");
    assert_eq!(code, Some(0), "{said}{wrong}");
    for words in ["2 vehicles are ready to arm", "all arm", "1-2 ready"] {
        assert!(said.contains(words), "{words}: {said}");
    }
}
