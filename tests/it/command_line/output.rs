//! The program's output, and outputs that cannot be written.

use std::fs;

use super::*;

#[test]
fn names_with_escape_sequences_reach_no_terminal() {
    let folder = folder_with(&[("a\u{1b}[31mb.toml", "schema = ")]);
    for arguments in [
        &["check", "a\u{1b}[31mb.toml"][..],
        &["check", "no\u{1b}[31msuch.toml"],
        &["run", "no\u{1b}[31msuch", "--pilot", "00"],
        &["run", "a\u{1b}[31mb.toml", "--pilot", "00"],
    ] {
        let output = sortie_in(folder.path(), arguments);
        assert_ne!(output.status.code(), Some(0));
        let said = text(&output.stdout) + &text(&output.stderr);
        assert!(said.contains("?[31m"), "{said}");
        assert!(!said.contains('\u{1b}'), "{said:?}");
    }
}

#[test]
fn the_simulator_is_measured_in_one_document() {
    let output = sortie(&[
        "bench",
        "sim",
        "--vehicles",
        "1,3",
        "--seconds",
        "1",
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let rows: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one document");
    assert_eq!(rows.as_array().map(Vec::len), Some(2));
    assert_eq!(rows[1]["vehicles"], 3);
    for field in [
        "us_per_vehicle_step",
        "core_percent",
        "core_percent_per_vehicle",
        "realtime_factor",
    ] {
        assert!(rows[1][field].as_f64().is_some_and(|x| x > 0.0), "{field}");
    }
}

#[test]
fn a_port_in_use_is_named() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = taken.local_addr().expect("it is bound").to_string();
    let output = sortie(&["sim", "--tcp", &address]);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said.contains("in use")
            && said.contains(&taken.local_addr().expect("bound").port().to_string()),
        "{said}"
    );
}

#[test]
#[cfg(target_os = "linux")]
fn output_goes_to_standard_output_by_both_of_its_names() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let created = sortie_in(folder.path(), &["profile", "create", "anna"]);
    assert!(created.status.success(), "{}", text(&created.stderr));
    let report = |output: &str| {
        let arguments = [
            "report",
            "--profile",
            "anna",
            "--format",
            "csv",
            "--output",
            output,
        ];
        let written = sortie_in(folder.path(), &arguments);
        assert!(written.status.success(), "{}", text(&written.stderr));
        text(&written.stdout)
    };
    let printed = report("-");
    assert!(!printed.is_empty());
    assert_eq!(report("/dev/stdout"), printed);
}

/// Help and version are output like any other.
#[test]
fn help_that_cannot_be_written_is_an_error() {
    let program = program();
    for arguments in [
        &["--help"][..],
        &["--version"],
        &["fly", "--help"],
        &["help"],
    ] {
        let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") else {
            eprintln!("skipped: this system has no /dev/full");
            return;
        };
        let output = Command::new(&program[0])
            .args(&program[1..])
            .args(arguments)
            .stdout(full)
            .output()
            .expect("the program runs");
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
        assert!(said.starts_with("sortie: "), "{arguments:?}: {said}");
    }
}

#[test]
fn a_full_disk_is_an_error_and_no_panic() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full");
    let Ok(full) = full else {
        eprintln!("skipped: this system has no /dev/full");
        return;
    };
    let program = program();
    let output = Command::new(&program[0])
        .args(&program[1..])
        .args([
            "run",
            "01",
            "--pilot",
            "01-air-sample",
            "--json",
            "--no-record",
        ])
        .stdout(full)
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        !text(&output.stderr).contains("panicked"),
        "{}",
        text(&output.stderr)
    );
}
