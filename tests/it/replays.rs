//! Flights recorded by the program itself, killed or not, and replayed.

use std::path::{Path, PathBuf};

use sortie::replay::Film;
use sortie::store::{RecordLimits, Records};

use crate::terminal::Terminal;

fn records(data: &Path) -> Records {
    Records::within(data, RecordLimits::default())
}

/// Flies a little in a terminal until a bookmark is set; returns the terminal.
fn flying(data: &Path) -> Terminal {
    let data = data.display().to_string();
    let arguments = ["fly", "--vehicles", "2", "--speedup", "4", "--data", &data];
    let mut terminal = Terminal::start(&arguments, 100, 30);
    terminal.see("FLY").see("EKF3 IMU0 is using GPS");
    terminal.command("all guided").see("effect seen");
    terminal.command("2 takeoff 10").see("refused");
    terminal.command("bookmark as planned").see("bookmark set");
    terminal
}

fn newest(data: &Path) -> PathBuf {
    records(data).newest().expect("a record")
}

#[test]
fn a_session_that_is_killed_leaves_its_record() {
    let data = tempfile::tempdir().expect("a folder");
    let mut terminal = flying(data.path());
    // Lines written before the last write are on the disk.
    let journal = records(data.path()).list()[0].journal.clone().expect("it");
    Terminal::wait_for_log(&journal, "the bookmark", |text| text.contains("as planned"));
    terminal.kill();
    let film = Film::open(&newest(data.path())).expect("a recording");
    let journal = film.journal().expect("a journal");
    assert_eq!(journal.damage, None);
    assert_eq!(journal.bookmarks().count(), 1);
    assert!(film.length().as_secs_f64() > 0.5);
    assert!(!records(data.path()).list()[0].is_written());
}

#[test]
fn what_was_flown_is_replayed_and_takes_no_commands() {
    let data = tempfile::tempdir().expect("a folder");
    let mut terminal = flying(data.path());
    terminal.press("q").see("leave").press("\r").see("HOME");
    drop(terminal);
    let frames = newest(data.path()).display().to_string();
    let mut replay = Terminal::start(&["replay", &frames], 100, 30);
    replay.see("REPLAY").see("free flight");
    replay
        .command("seek end")
        .see("2 takeoff 10")
        .see("refused");
    replay.press(":").see("command").press("all arm\r");
    replay.see("a replay accepts no commands").press("\u{1b}");
    replay.see_no_more("command to");
    replay.press("m").see("bookmark").see("as planned");
    replay.press("\u{1b}").see_no_more("Moments");
    replay
        .press(":")
        .see("command")
        .press("leave\r")
        .see("HOME");
    replay.press("v").see("nothing is recorded yet");
}
