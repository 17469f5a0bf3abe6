//! Journals that are damaged, or belong to another flight.

use std::fs;
use std::path::Path;

use super::{FLIGHT, run, runs, said};

/// The output of the program about the newest record, and its exit code.
fn printed(data: &Path, command: &[&str]) -> (Option<i32>, String) {
    let output = run(data, "", command);
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output);
    (output.status.code(), text)
}

#[test]
fn a_damaged_or_foreign_journal_is_named_by_every_command_that_reads_it() {
    let data = tempfile::tempdir().expect("a temporary folder");
    let data = data.path();
    run(data, "", &FLIGHT);
    let record = runs(&data.join("sortie/runs")).remove(0);
    let journal = record.to_string_lossy().replace(".run.", ".flight.");
    let own = fs::read_to_string(&journal).expect("text");
    let third = own.lines().nth(2).expect("a third line");
    let (_, rest) = third.split_once(',').expect("a time");
    let late = own.replacen(third, &format!("{{\"us\":1e308,{rest}"), 1);
    let edited = |from: &str, to: &str| own.replacen(from, to, 1);
    let show: &[&str] = &["records", "show", "1"];
    let (verify, debrief): (&[&str], &[&str]) = (&["verify"], &["debrief"]);
    for (text, named, commands) in [
        (
            edited("\"began_unix_us\":", "\"began_unix_us\":1e308,\"x\":"),
            "the first line is damaged",
            &[(show, 0), (verify, 0)][..],
        ),
        (
            edited("\"began_unix_us\":1", "\"began_unix_us\":5"),
            "does not fit the first frame",
            &[(show, 0), (verify, 0), (debrief, 0)],
        ),
        (
            late,
            "line 3 of the journal has an impossible time",
            &[(show, 0), (verify, 0)],
        ),
        (
            own[..own.len() - 9].to_owned(),
            "the journal ends in the middle of line",
            &[(show, 0), (verify, 0)],
        ),
        (
            edited(
                "\"mission\":\"01-air-sample\"",
                "\"mission\":\"03-plume-source\"",
            ),
            "the journal belongs to another flight (03-plume-source)",
            &[(show, 0), (verify, 1), (debrief, 0)],
        ),
    ] {
        fs::write(&journal, text).expect("it is written");
        for (command, code) in commands {
            let (ended, words) = printed(data, command);
            assert_eq!(ended, Some(*code), "{command:?}: {words}");
            assert!(words.contains(named), "{command:?}: {words}");
        }
    }
}
