//! Terminals that are slow, stalled, limited or missing.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::terminal::{Terminal, program};

/// The start of a synchronised update: one per frame.
const FRAME: &str = "\u{1b}[?2026h";

/// Free flight with a log and all vehicles ready to arm.
fn logged_flight(log: &Path) -> Terminal {
    let log = log.to_str().expect("a plain path");
    let mut terminal = Terminal::start(&["--log", log, "fly", "--speedup", "5"], 120, 40);
    terminal.wait("four ready vehicles", |screen| {
        screen.matches("ready").count() >= 4
    });
    terminal
}

/// Memory of the program in kB, if the system reports it.
fn memory_kb(terminal: &Terminal) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", terminal.process_id())).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
fn a_terminal_that_stops_reading_holds_up_no_command_and_has_no_backlog_afterwards() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let log = folder.path().join("log");
    let mut terminal = logged_flight(&log);
    let before_kb = memory_kb(&terminal);
    terminal.stop_reading();
    for (line, verb) in [
        ("all guided", "guided"),
        ("all arm", "arm"),
        ("all takeoff 15", "takeoff"),
    ] {
        terminal.press(":").press(line).press("\r");
        let ended = format!("{line}: effect seen");
        Terminal::wait_for_log(&log, &format!("{verb} of four vehicles"), |log| {
            log.matches(&ended).count() == 4
        });
    }
    if let (Some(before), Some(after)) = (before_kb, memory_kb(&terminal)) {
        assert!(after < before + 20_000, "{before} kB became {after} kB");
    }
    let read_before = terminal.raw().len();
    terminal
        .go_on_reading()
        .see("all takeoff 15  4 vehicles: 4 effect seen");
    let backlog = terminal.raw().len() - read_before;
    assert!(
        backlog < 100_000,
        "{backlog} bytes until the screen was right"
    );
    terminal.command("quit").see("press y").press("y");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_terminal_that_reads_a_kilobyte_a_second_gets_the_newest_state_and_is_told_that_it_is_slow() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let log = folder.path().join("log");
    let mut terminal = logged_flight(&log);
    terminal.read_slowly(1000);
    // A new size needs a complete screen, which takes some seconds on such a line.
    terminal.resize(118, 38);
    terminal.press(":").press("all guided").press("\r");
    Terminal::wait_for_log(&log, "guided of four vehicles", |log| {
        log.matches("all guided: effect seen").count() == 4
    });
    terminal
        .see("slow line")
        .see("all guided  4 vehicles: 4 effect seen");
    terminal.press("\u{3}");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_stalled_terminal_can_be_left() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut terminal = logged_flight(&folder.path().join("log"));
    terminal.stop_reading().press("\u{3}");
    assert_eq!(terminal.end_unread(), 0);
}

#[test]
fn a_flood_of_keys_is_no_flood_of_frames() {
    let mut terminal = Terminal::start(&["fly", "--fps", "2"], 80, 24);
    terminal.see("4 vehicles");
    let before = terminal.raw().matches(FRAME).count();
    terminal.press(&"jk".repeat(300)).press("j?");
    terminal.see("in the room");
    terminal.press("\u{1b}").see_no_more("in the room");
    let frames = terminal.raw().matches(FRAME).count() - before;
    // Keys that arrive together are drawn together, however long that takes.
    assert!(frames <= 100, "{frames} frames for 600 keys");
    terminal.press("\u{3}");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn poor_terminals_are_sent_nothing_that_they_do_not_know() {
    let cases = [
        ("xterm", "", &["38;2;", "48;2;", "38;5;", "48;5;"][..]),
        ("linux", "truecolor", &["38;2;", "48;2;"][..]),
        ("screen", "", &["38;2;", "48;2;"][..]),
        ("tmux-256color", "", &["38;2;", "48;2;"][..]),
    ];
    for (term, colorterm, unknown) in cases {
        let variables = [("TERM", term), ("COLORTERM", colorterm)];
        let mut terminal = Terminal::start_with(&["fly"], 80, 24, &variables);
        terminal.see("4 vehicles").press("\u{3}");
        assert_eq!(terminal.end(), 0);
        for sequence in unknown {
            assert!(!terminal.raw().contains(sequence), "{term}: {sequence}");
        }
    }
}

#[test]
fn a_locale_without_utf8_is_sent_ascii_alone() {
    let mut terminal = Terminal::start_with(&["fly", "01"], 120, 40, &[("LC_ALL", "C")]);
    terminal.see("1 vehicle,").press("\u{3}");
    assert_eq!(terminal.end(), 0);
    assert!(terminal.raw().is_ascii());
}

#[test]
fn where_no_screen_can_be_the_way_out_is_named() {
    for term in ["dumb", ""] {
        let mut terminal = Terminal::start_with(&["fly"], 80, 24, &[("TERM", term)]);
        assert_eq!(terminal.end(), 1);
        let said = terminal.raw();
        assert!(said.contains("TERM") && said.contains("--plain"), "{said}");
    }
    let program = program();
    let piped = Command::new(&program[0])
        .args(&program[1..])
        .arg("fly")
        .stdin(Stdio::null())
        .output()
        .expect("it runs");
    assert_eq!(piped.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&piped.stderr).contains("--plain"));
}

#[test]
fn ctrl_z_gives_the_terminal_to_the_shell_and_fg_brings_the_screen_back() {
    let mut terminal = Terminal::run(
        &["bash", "--norc", "--noprofile"],
        80,
        24,
        &[("PS1", "shell> ")],
    );
    let command = format!("{} fly\r", program().join(" "));
    terminal.see("shell>").press(&command).see("4 vehicles");
    terminal.press("\u{1a}").see("Stopped");
    assert!(!terminal.in_alternate_screen() && !terminal.cursor_is_hidden());
    terminal.press("fg\r").see("4 vehicles");
    // The frame may arrive in pieces.
    terminal.until("the screen of the program", |terminal| {
        terminal.in_alternate_screen() && terminal.cursor_is_hidden()
    });
    terminal.press("\u{3}").wait("the prompt again", |screen| {
        screen.trim_end().ends_with("shell>")
    });
    terminal.press("exit\r");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_mission_that_was_suspended_and_stopped_stood_still_and_can_be_verified() {
    let mut terminal = Terminal::run(
        &["bash", "--norc", "--noprofile"],
        120,
        40,
        &[("PS1", "shell> ")],
    );
    let sortie = program().join(" ");
    terminal.see("shell>").press(&format!("{sortie} fly 00\r"));
    terminal.see("MISSION").press("\r").see("STABILIZE");
    // Before its clock has started, the mission would end without a question.
    terminal.wait("the mission's clock", |screen| {
        let head = screen.lines().find(|line| line.contains("First flight"));
        head.is_some_and(|head| !head.trim_end().ends_with("00:00"))
    });
    // The sleep is longer than a vehicle may be silent.
    terminal.press("\u{1a}").see("Stopped");
    terminal
        .press("sleep 4; echo 'it '\"slept\"\r")
        .see("it slept");
    terminal.press("fg\r").see("suspended for");
    let contents = terminal.contents();
    assert!(!contents.contains("link lost"), "{contents}");
    terminal.command("quit").see("press y").press("y");
    terminal.wait("the prompt again", |screen| {
        screen.trim_end().ends_with("shell>")
    });
    terminal
        .press(&format!("clear; {sortie} verify; echo \"code \"$?\r"))
        .see("code 0")
        .see("verified");
    terminal.press("exit\r");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn where_no_shell_could_bring_it_back_it_is_not_suspended() {
    let mut terminal = Terminal::start(&["fly"], 80, 24);
    terminal
        .see("4 vehicles")
        .press("\u{1a}")
        .see("not suspended");
    terminal.press("\u{3}");
    assert_eq!(terminal.end(), 0);
}

/// Runs the plain console on some lines; returns its output and its exit code.
fn plain(arguments: &[&str], lines: &str) -> (String, Option<i32>) {
    let program = program();
    // The developer's own files are neither read nor written.
    let home = tempfile::tempdir().expect("a folder");
    let mut child = Command::new(&program[0])
        .args(&program[1..])
        .args(arguments)
        .env("LC_ALL", "C.UTF-8")
        .env("XDG_CONFIG_HOME", home.path().join("config"))
        .env("XDG_DATA_HOME", home.path().join("data"))
        .env("XDG_STATE_HOME", home.path().join("state"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it runs");
    let mut input = child.stdin.take().expect("a pipe");
    input.write_all(lines.as_bytes()).expect("it reads");
    drop(input);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8(output.stdout).expect("text");
    (said, output.status.code())
}

#[test]
fn a_pipe_flies_line_by_line_and_its_end_ends_the_flight() {
    let lines = "wait all ready\nall guided\nall arm\nall takeoff 10\nstatus 2\nall takeof 3\n2 kill\nno\n2 kill\n1\nall land\n";
    let (said, code) = plain(
        &["fly", "--plain", "--vehicles", "2", "--speedup", "5"],
        lines,
    );
    assert_eq!(code, Some(1), "one line was misspelt:\n{said}");
    for expected in [
        "all arm: 1-2 effect seen",
        "all takeoff 10: 1-2 effect seen",
        "vehicle 2: GUIDED, armed",
        "did you mean",
        "KILL vehicle 2",
        "cancelled",
        "2 kill: 2 effect seen",
        "all land: ",
    ] {
        assert!(said.contains(expected), "{expected:?} in:\n{said}");
    }
    assert_eq!(said.matches("2 kill: 2 effect seen").count(), 1, "{said}");
    assert!(!said.contains('\u{1b}'), "{said}");
    let places = [
        "all arm: 1-2",
        "> all takeoff 10",
        "all takeoff 10: 1-2",
        "> status 2",
    ]
    .map(|text| said.find(text));
    assert!(
        places.is_sorted(),
        "a line waits for those before it:\n{said}"
    );
}

/// The lines of the pipe example in the documents, and the arguments of its program.
fn documented_example() -> (Vec<String>, String) {
    let document = include_str!("../../docs/console.md");
    let example = document.split("<<'END'\n").nth(1).expect("an example");
    let (lines, _) = example.split_once("\nEND\n").expect("its end");
    let (before, _) = document.split_once(" <<'END'").expect("an example");
    let command = before.lines().next_back().expect("a command");
    let words = command.split(' ').skip(1).map(str::to_owned);
    (words.collect(), format!("{lines}\n"))
}

#[test]
fn the_documented_example_of_a_pipe_flies_and_comes_back() {
    let (arguments, lines) = documented_example();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (said, code) = plain(&arguments, &lines);
    assert_eq!(code, Some(0), "{said}");
    for expected in [
        "all arm: 1-4 effect seen",
        "all takeoff 20: 1-4 effect seen",
        "vehicle 4: GUIDED, armed",
        "all rtl: 1-4 effect seen",
    ] {
        assert!(said.contains(expected), "{expected:?} in:\n{said}");
    }
    assert!(!said.contains("timed out"), "{said}");
}

#[test]
fn what_is_refused_in_a_pipe_makes_its_exit_code_1() {
    let vehicles = ["fly", "--plain", "--vehicles", "1", "--speedup", "10"];
    let cases = [
        ("1 guided\n1 goto pad up 10\n", "refused", 1),
        ("1 guided\n", "1 guided: 1 effect seen", 0),
        ("wait 1 armed timeout 1s\n", "timed out", 1),
    ];
    for (lines, expected, exit) in cases {
        let (said, code) = plain(&vehicles, lines);
        assert_eq!(code, Some(exit), "{lines}: {said}");
        assert!(said.contains(expected), "{expected:?} in:\n{said}");
    }
}

/// A question does not consume a line: without an answer, the action in question is not carried
/// out, but the next line is.
#[test]
fn a_question_that_a_pipe_does_not_answer_is_an_error() {
    let vehicles = ["fly", "--plain", "--vehicles", "1", "--speedup", "10"];
    for (answer, exit, is_done) in [
        ("1 mode loiter\n", 1, false),
        ("", 1, false),
        ("no\n1 mode loiter\n", 0, false),
        ("\n# really\n1\n", 0, true),
    ] {
        let lines = format!("1 guided\n1 arm\n1 kill\n{answer}");
        let (said, code) = plain(&vehicles, &lines);
        assert_eq!(code, Some(exit), "{lines}: {said}");
        assert_eq!(said.contains("not confirmed"), exit == 1, "{lines}: {said}");
        assert_eq!(said.matches("KILL vehicle 1: ").count(), 1, "{said}");
        let next = answer.contains("loiter");
        assert_eq!(
            said.contains("1 mode loiter: 1 effect seen"),
            next,
            "{said}"
        );
        assert_eq!(said.contains("1 kill: 1 effect seen"), is_done, "{said}");
    }
}

#[test]
fn a_mission_whose_input_ends_early_has_its_debrief_and_is_not_passed() {
    let (said, code) = plain(&["fly", "01", "--plain", "--speedup", "5"], "objectives\n");
    assert_eq!(code, Some(1), "{said}");
    assert!(
        said.contains("objective open") && said.contains("ABANDONED"),
        "{said}"
    );
}

#[test]
fn a_mission_that_ends_with_the_landing_has_its_verdict_although_the_input_has_ended() {
    let basics = include_str!("../data/basics_mission.toml");
    let (armed, rest) = basics.split_once("id = \"hover\"").expect("it is there");
    let (others, landed) = rest.split_once("id = \"landed\"").expect("it is there");
    let others = others.replace("mandatory = true\n", "");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("landing.toml");
    let source = format!("{armed}id = \"hover\"{others}id = \"landed\"{landed}");
    std::fs::write(&file, source).expect("room");
    let file = file.to_str().expect("a plain path");
    let lines = "all guided\nall arm\nall takeoff 5\nwait all arrived timeout 20s\nall land\n\
                 wait all disarmed timeout 60s\n";
    let (said, code) = plain(&["fly", file, "--plain", "--speedup", "20"], lines);
    assert!(
        said.contains("objective missed") && said.contains("PASSED"),
        "{said}"
    );
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn a_wait_in_a_pipe_takes_flight_time() {
    // By the wall clock, 30 s would be five minutes of the mission, which would then be over.
    let lines = "wait 30s\nall guided\nall arm\n";
    let (said, _) = plain(&["fly", "00", "--plain", "--speedup", "10"], lines);
    let met = "objective met: armed within a minute";
    assert!(said.contains(met), "{met:?} in:\n{said}");
}

#[test]
fn a_person_is_prompted_and_sees_no_escape_sequence() {
    let mut terminal = Terminal::start_with(&["fly", "--plain"], 80, 24, &[("TERM", "dumb")]);
    terminal.see("plain console").see("EKF3 IMU0 is using GPS");
    terminal.press("1-2 select\r").see("select");
    terminal
        .press("3 kill\r")
        .see("type 1")
        .press("2\r")
        .see("cancelled");
    terminal
        .press("help\r")
        .see_in_scrollback("objectives: show");
    terminal.press("quit\r");
    assert_eq!(terminal.end(), 0);
    assert!(!terminal.raw().contains('\u{1b}'), "{:?}", terminal.raw());
}

#[test]
fn without_utf_8_in_the_locale_a_debrief_is_english_too() {
    let printed = |locale: &str| {
        let program = program();
        let output = Command::new(&program[0])
            .args(&program[1..])
            .args(["run", "missions/01-air-sample.toml", "--lang", "uk"])
            .args([
                "--pilot",
                "missions/pilots/01-air-sample.pilot",
                "--no-record",
            ])
            .env("LC_ALL", locale)
            .output()
            .expect("the program runs");
        String::from_utf8(output.stdout).expect("text")
    };
    let is_cyrillic = |c: char| ('а'..='я').contains(&c);
    let plain = printed("C");
    assert!(
        plain.contains("DEBRIEF") && !plain.contains(is_cyrillic),
        "{plain}"
    );
    assert!(printed("C.UTF-8").contains(is_cyrillic));
}
