//! The whole program in a pseudo-terminal: sessions that read like scripts.

use std::process::Command;

use crate::terminal::Terminal;

mod sticks;
mod workshop;

/// Free flight from the home screen, with all vehicles ready to arm.
fn free_flight(columns: u16, rows: u16) -> Terminal {
    let mut terminal = Terminal::start(&["fly", "--speedup", "5"], columns, rows);
    terminal
        .see("4 vehicles")
        .wait("four ready vehicles", |screen| {
            screen.matches("ready").count() >= 4
        });
    terminal
}

fn signal(terminal: &Terminal, name: &str) {
    let process_id = terminal.process_id().to_string();
    let sent = Command::new("kill").args([name, &process_id]).status();
    assert!(sent.expect("kill is there").success());
}

/// Checks that the terminal is restored: the shell's screen, its cursor, no bracketed paste.
fn is_given_back(terminal: &Terminal) {
    assert!(!terminal.in_alternate_screen());
    assert!(!terminal.cursor_is_hidden());
    assert!(
        terminal.raw().contains("\u{1b}[?2004l"),
        "bracketed paste is off"
    );
}

#[test]
fn four_drones_take_off_move_and_come_home() {
    let mut terminal = free_flight(120, 40);
    terminal
        .command("all guided")
        .see("4 vehicles: 4 effect seen");
    terminal
        .command("all arm")
        .wait("four armed", |screen| screen.contains("4 armed"));
    terminal
        .command("all takeoff 15")
        .see("all takeoff 15  4 vehicles: 4 effect seen");
    terminal
        .command("1-2 goto n 30 e 10 up 20")
        .see("1-2 goto n 30 e 10 up 20  2 vehicles: 2 effect seen");
    terminal
        .command("all rtl")
        .see("all rtl  4 vehicles: 4 effect seen");
    terminal.wait("all landed", |screen| screen.contains("0 armed"));
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
    is_given_back(&terminal);
}

#[test]
fn free_flight_is_reached_from_the_home_screen() {
    let mut terminal = Terminal::start(&[], 80, 24);
    terminal.see("HOME").see("Air sample");
    // The list is longer than the screen: the entries after the missions are reached from its end.
    terminal.press("\u{1b}[F").see("Free flight").press("kk\r");
    terminal.see("FLY").see("4 vehicles");
    terminal.command("leave").see("HOME");
    terminal.press("q");
    assert_eq!(terminal.end(), 0);
    is_given_back(&terminal);
}

#[test]
fn a_kill_names_its_targets_and_wants_their_number() {
    let mut terminal = free_flight(80, 24);
    terminal
        .command("1,3,4 kill")
        .see("KILL vehicles 1 3 4")
        .press("x")
        .see("Enter or Esc: back")
        .press("\u{1b}");
    terminal.see_no_more("KILL vehicles 1 3 4");
    terminal
        .command("1,3,4 kill")
        .see("KILL vehicles 1 3 4")
        .press("3");
    terminal.see("3 effect seen");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn an_instructor_finds_selects_commands_looks_around_and_is_cut_off() {
    let mut terminal = free_flight(80, 24);
    terminal.press("/").see("show only");
    terminal.press("3\r").see("1 of 4");
    terminal.press("/").see("show only");
    terminal.press("\u{15}\r").see_no_more("1 of 4");
    terminal.press("2-4\r").command("guided");
    terminal.command("ledger").see("2-4 guided");
    terminal.press("F").command("all arm").see("4 armed");
    terminal.command("kill").see("KILL vehicles 2 3 4");
    terminal.press("3").see("1 armed");
    for (key, name) in [
        ("V", "VEHICLE"),
        ("M", "MAP"),
        ("C", "LEDGER"),
        ("I", "MESSAGES"),
        ("L", "LINKS"),
        ("P", "PARAMETERS"),
        ("B", "MISSION"),
        ("D", "DEBRIEF"),
        ("H", "HOME"),
        ("F", "FLY"),
    ] {
        terminal.press(key).wait(name, |screen| {
            screen.trim_start().starts_with(&format!("{name} "))
        });
    }
    terminal.resize(120, 40).see("── map");
    terminal.resize(60, 20).see("sortie needs 80x24");
    terminal.resize(80, 24).see("FLY");
    terminal.go_away();
}

#[test]
fn a_slip_is_marked_and_keeps_the_line() {
    let mut terminal = free_flight(80, 24);
    terminal
        .command("all takeof 20")
        .see("did you mean")
        .see("all takeof 20");
    terminal.press("\u{1b}").see_no_more("did you mean");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn ranges_select_and_commands_go_to_the_selection() {
    let mut terminal = free_flight(120, 40);
    terminal
        .press("2-3\r")
        .command("guided")
        .see("2-3 guided  2 vehicles: 2 effect seen");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn a_mission_that_is_abandoned_ends_in_its_debrief() {
    let mut terminal = Terminal::start(&["fly", "01", "--speedup", "5"], 80, 24);
    terminal.see("1 vehicle").see("before takeoff");
    // Before its clock has started, a mission has nothing to score.
    terminal.press("\r").see("FLY").see("ready");
    terminal.command("1 guided").see("GUIDED");
    terminal
        .command("abandon")
        .see("press y")
        .press("y")
        .see("DEBRIEF")
        .see("ABANDONED")
        .see("OBJECTIVES");
    // The debrief ignores keys for a second, so that it is not closed unread.
    signal(&terminal, "-TERM");
    terminal.end();
    is_given_back(&terminal);
}

#[test]
fn a_mission_is_read_predicted_flown_paused_and_debriefed() {
    let mut terminal = Terminal::start(&["fly", "01", "--speedup", "4"], 80, 24);
    terminal
        .see("MISSION")
        .see("before takeoff")
        .see("1 vehicle");
    terminal
        .press("s")
        .see("predict ")
        .press("800\r")
        .see("800 predicted");
    terminal
        .press("g")
        .see("goal ")
        .press("time 300s\r")
        .see("finish within 300 s");
    terminal.press("\r").see("FLY").see("ready");
    terminal.command("1 guided").see("GUIDED");
    terminal.command("1 arm").see("1 armed");
    terminal.command("1 takeoff 20").see("takeoff done");
    terminal.press("p").see("PAUSED");
    terminal
        .command("1 rtl")
        .see("the simulation is paused")
        .press("\u{1b}")
        .see_no_more("command to 1");
    terminal.command("continue").see_no_more("PAUSED");
    terminal
        .press("n")
        .see("Esc close")
        .see("paused ")
        .press("\u{1b}");
    terminal.see_no_more("Esc close");
    terminal.command("abandon").see("press y").press("y");
    terminal.see("DEBRIEF").see("ABANDONED");
    signal(&terminal, "-TERM");
    terminal.end();
    is_given_back(&terminal);
}

#[test]
fn a_terminal_that_is_too_small_is_told_so_until_it_grows() {
    let mut terminal = free_flight(80, 24);
    terminal
        .resize(60, 15)
        .see("80")
        .see("24")
        .see("60")
        .see("15");
    terminal.resize(120, 40).see("4 vehicles").see("ledger ──");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn keys_pressed_blindly_on_a_small_terminal_do_nothing_but_leave() {
    let mut terminal = free_flight(80, 24);
    terminal.resize(60, 15).see("sortie needs 80x24");
    // Keys are handled in order: those before Ctrl-C, which ends the program, come first.
    terminal.press("*tq:all arm\r\u{3}");
    assert_eq!(terminal.end(), 0);
    is_given_back(&terminal);
}

#[test]
fn being_terminated_gives_the_terminal_back() {
    for name in ["-TERM", "-HUP", "-INT", "-QUIT", "-USR1", "-ALRM"] {
        let mut terminal = free_flight(80, 24);
        signal(&terminal, name);
        terminal.end();
        is_given_back(&terminal);
    }
}

#[test]
fn an_address_where_nobody_listens_is_explained_on_the_screen() {
    // Only root can listen on port 1, and no program does.
    let mut terminal = Terminal::start(&["connect", "tcp:127.0.0.1:1"], 120, 40);
    terminal.see("tcp:127.0.0.1:1").see("refused");
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn without_colours_states_are_still_told_apart() {
    let mut terminal = Terminal::start_with(&["fly"], 80, 24, &[("NO_COLOR", "1")]);
    terminal.see("4 vehicles").see("STABILIZE");
    let raw = terminal.raw();
    for sequence in ["\u{1b}[38;", "\u{1b}[48;"] {
        assert!(!raw.contains(sequence), "a colour was sent");
    }
    assert!(
        raw.contains("\u{1b}[1m") || raw.contains("\u{1b}[7m"),
        "nothing stands out"
    );
    terminal.command("quit");
    assert_eq!(terminal.end(), 0);
}

#[test]
fn the_log_tells_of_links_and_a_missing_recording_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let log = folder.path().join("sortie.log");
    let log = log.to_str().expect("a plain path");
    let mut terminal = Terminal::start(&["--log", log, "connect", "tcp:127.0.0.1:1"], 120, 40);
    terminal.see("refused").command("quit");
    assert_eq!(terminal.end(), 0);
    let said = std::fs::read_to_string(log).expect("the log was written");
    assert!(
        said.contains("tcp:127.0.0.1:1") && said.contains("refused"),
        "{said}"
    );

    let mut terminal = Terminal::start(&["connect", "file:nowhere.tlog"], 120, 40);
    terminal.see("cannot read the recording nowhere.tlog");
    assert_eq!(terminal.end(), 2);
}

#[test]
fn an_instructor_sees_a_trainee_and_sends_a_message() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = folder.path().join("9-A").display().to_string();
    let mut desk = Terminal::start(&["class", "open", &class], 120, 40);
    desk.see("CLASS").see("No trainee has joined yet");
    let mut seat = Terminal::start(&["fly", "00", "--class", &class], 80, 24);
    seat.see("desk");
    desk.see("00-first-flight").see("reading");
    seat.press("F");
    desk.see("flying");
    desk.press("m")
        .see("class message")
        .press("look at the battery\r");
    seat.see("look at the battery");
    desk.see("done");
    desk.press("f").see("frozen");
    seat.see("FROZEN");
    desk.press("q").see("frozen flights").press("y");
    assert_eq!(desk.end(), 0);
    seat.command("continue").see_no_more("FROZEN");
}

#[test]
fn a_crew_of_two_flies_one_swarm_and_hands_a_vehicle_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let crew = folder.path().join("alpha").display().to_string();
    let mut host = Terminal::start(
        &["fly", "--vehicles", "2", "--speedup", "5", "--crew", &crew],
        120,
        40,
    );
    host.wait("two ready vehicles", |screen| {
        screen.matches("ready").count() >= 2
    });
    let mut member = Terminal::start(&["crew", "join", &crew], 80, 24);
    member.see("CREW").see("you fly no vehicle");
    host.see("joins the crew");
    // The tests run as one user, so the member has a number.
    let named = host.command("crew").see("host").contents();
    let name = named
        .split_whitespace()
        .filter(|word| word.starts_with(char::is_alphabetic))
        .find_map(|word| word.strip_suffix(':').filter(|it| it.ends_with("#2")))
        .expect("the name of the member")
        .to_owned();
    host.command(&format!("crew offer 2 to {name}"));
    member.see("crew accept").command("crew accept");
    member.see("you fly 2");
    member
        .command("2 guided")
        .see("2 guided  effect seen")
        .command("2 arm");
    host.see(&format!("{name}: 2 arm"));
    host.command("2 disarm").see(&format!("{name} flies 2"));
    member.command("1 arm").see("flies 1");
    member.command(&format!("crew offer 2 to {}", name.trim_end_matches("#2")));
    host.see("crew accept").command("crew accept");
    member.see("you fly no vehicle");
    member.command("quit");
    assert_eq!(member.end(), 0);
    host.see("has left the crew");
    host.command("2 disarm").see("0 armed");
    host.command("quit");
    assert_eq!(host.end(), 0);
}
