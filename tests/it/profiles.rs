//! Profiles on the command line, with killed programs, full disks and damaged files.

mod kills;

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use nix::unistd::Uid;
use rusqlite::Connection;
use serde_json::Value;

use crate::terminal::program;

/// A mission of two minutes that the reference pilot passes, so that tests are short.
const SHORT: [&str; 4] = ["run", "d00-arm-and-hover", "--pilot", "d00-arm-and-hover"];

/// The program with a data folder, as a command that is still to be run.
fn command(data: &Path, arguments: &[&str]) -> Command {
    let program = program();
    let mut command = Command::new(&program[0]);
    command
        .args(&program[1..])
        .args(arguments)
        .arg("--data")
        .arg(data)
        .env("XDG_CONFIG_HOME", data.join("config"))
        .env("XDG_STATE_HOME", data.join("state"))
        .env("XDG_DATA_HOME", data.join("share"))
        .env_remove("SORTIE_PROFILE")
        .env("LC_ALL", "C.UTF-8")
        .env("NO_COLOR", "1")
        .stdin(Stdio::null());
    command
}

fn sortie(data: &Path, arguments: &[&str]) -> Output {
    command(data, arguments).output().expect("the program runs")
}

/// The output of a successful command.
fn said(data: &Path, arguments: &[&str]) -> String {
    let output = sortie(data, arguments);
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {out}{err}");
    out
}

/// The error output of a command that ends with this exit code.
fn refused(data: &Path, arguments: &[&str], code: i32) -> String {
    let output = sortie(data, arguments);
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(
        output.status.code(),
        Some(code),
        "{arguments:?}: {out}{err}"
    );
    err
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("one document")
}

fn folder_of_anna() -> tempfile::TempDir {
    let data = tempfile::tempdir().expect("a folder");
    said(data.path(), &["profile", "create", "Anna"]);
    data
}

/// The number of Anna's stored flights.
fn flights(data: &Path) -> u64 {
    let shown = json(&said(data, &["profile", "show", "Anna", "--json"]));
    shown["flights"].as_u64().expect("a number")
}

fn with<'a>(arguments: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [arguments, more].concat()
}

#[test]
fn a_run_of_a_script_is_stored_as_practice() {
    let data = folder_of_anna();
    let data = data.path();
    let run = with(&SHORT, &["--profile", "anna"]);
    let told = said(data, &run);
    assert!(told.contains("Career") && told.contains("script"), "{told}");
    // A flight with a chosen seed is practice.
    let practice = said(data, &with(&run, &["--seed", "1", "--json", "--no-timing"]));
    let practice = json(&practice);
    assert_eq!(practice["career"]["stake"], "practice");
    assert_eq!(practice["flown_by"], "bundled-pilot");
    assert_eq!(practice["career"]["experience"], 0);
    assert_eq!(practice["career"]["stored"], true);
    assert_eq!(
        (practice["seed"].as_u64(), practice["attempt"].as_u64()),
        (Some(1), Some(1)),
        "what a script has flown is no try"
    );
    let shown = json(&said(data, &["profile", "show", "--json"]));
    let missions = shown["missions"].as_array().expect("a table");
    let drill = missions.iter().find(|it| it["id"] == "d00-arm-and-hover");
    let drill = drill.expect("it is one of the course");
    assert_eq!(
        (&drill["tries"], &drill["state"]),
        (&Value::from(0), &Value::from("open"))
    );
    assert_eq!(shown["flights"], 2);
    let records = fs::read_dir(data.join("runs")).expect("recorded").flatten();
    let is_run = |entry: &fs::DirEntry| entry.path().to_string_lossy().ends_with(".run.jsonl");
    assert_eq!(records.filter(is_run).count(), 2);
}

#[test]
fn what_may_not_be_flown_is_refused_with_the_reason() {
    let data = folder_of_anna();
    let data = data.path();
    let of_anna = |mission, more: &[&str]| {
        let run = ["run", mission, "--pilot", mission, "--profile", "Anna"];
        refused(data, &[&run[..], more].concat(), 2)
    };
    let locked = of_anna("02-formation", &[]);
    assert!(locked.contains("licence for 3 drones"), "{locked}");
    let recorded = of_anna("00-first-flight", &["--record", "here"]);
    assert!(recorded.contains("--record"), "{recorded}");
    let exam = of_anna("00-first-flight", &["--exam"]);
    assert!(exam.contains("by hand"), "{exam}");
    let unknown = refused(data, &with(&SHORT, &["--profile", "Borys"]), 2);
    assert!(unknown.contains("profiles: Anna"), "{unknown}");
    let part = refused(data, &["profile", "buy", "s_gpr"], 1);
    assert!(part.contains("pass"), "{part}");
    assert_eq!(flights(data), 0);
}

#[test]
fn a_profile_is_made_listed_exported_imported_bought_for_and_deleted() {
    let data = folder_of_anna();
    let data = data.path();
    let twice = refused(data, &["profile", "create", "anna"], 2);
    assert!(twice.contains("anna"), "{twice}");
    let bought = said(data, &["profile", "buy", "r_rfd900", "--profile", "Anna"]);
    assert!(bought.contains("448 left"), "{bought}");
    let file = data.join("anna.json");
    let file = file.to_str().expect("a path of ours");
    said(data, &["profile", "export", "Anna", "--output", file]);
    let exported = said(data, &["profile", "export", "Anna"]);
    assert_eq!(exported, fs::read_to_string(file).expect("written"));
    let taken = refused(data, &["profile", "import", file], 2);
    assert!(taken.contains("Anna"), "{taken}");
    said(data, &["profile", "import", file, "--name", "Olha"]);
    let copy = said(data, &["profile", "export", "Olha"]);
    assert_eq!(copy, exported.replacen("\"Anna\"", "\"Olha\"", 1));
    let list = json(&said(data, &["profile", "list", "--json"]));
    assert_eq!(list[0]["credits"], list[1]["credits"]);
    let asked = refused(data, &["profile", "show"], 2);
    assert!(asked.contains("Anna, Olha"), "{asked}");
    let asked = refused(data, &["profile", "delete", "Olha"], 2);
    assert!(asked.contains("--yes"), "{asked}");
    said(data, &["profile", "delete", "Olha", "--yes"]);
    let list = json(&said(data, &["profile", "list", "--json"]));
    assert_eq!(list.as_array().map(Vec::len), Some(1));
    fs::write(file, "{\"sortie_profile\": 1").expect("writable");
    let broken = refused(data, &["profile", "import", file, "--name", "X"], 2);
    assert!(broken.contains("anna.json"), "{broken}");
}

#[test]
fn a_report_has_missions_skills_and_flights_in_every_format() {
    let data = folder_of_anna();
    let data = data.path();
    said(data, &with(&SHORT, &["--profile", "Anna"]));
    let markdown = said(data, &["report"]);
    for part in [
        "# Progress of Anna",
        "## Missions",
        "## Skills",
        "## Flights",
        "| d00-arm-and-hover |",
    ] {
        assert!(markdown.contains(part), "{part} in {markdown}");
    }
    let csv = said(data, &["report", "--format", "csv"]);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 2, "{csv}");
    assert_eq!(lines[0].split(',').count(), lines[1].split(',').count());
    assert!(lines[0].starts_with("trainee,"), "{csv}");
    assert!(lines[1].starts_with("Anna,"), "{csv}");
    assert!(!csv.contains("'-"), "{csv}");
    let shown = said(data, &["report", "--format", "json", "--output", "-"]);
    assert_eq!(json(&shown)["profile"], "Anna");
    let skills = said(data, &["report", "--format", "csv", "--table", "skills"]);
    assert_eq!(skills.lines().count(), 14, "{skills}");
    let file = data.join("report.json");
    let written = file.to_str().expect("a path of ours");
    said(data, &["report", "--format", "json", "--output", written]);
    let report = json(&fs::read_to_string(&file).expect("written"));
    assert_eq!(report["profile"], "Anna");
    assert_eq!(report["runs"][0]["flight"]["mission"], "d00-arm-and-hover");
    let empty = tempfile::tempdir().expect("a folder");
    let nobody = refused(empty.path(), &["report"], 2);
    assert!(nobody.contains("sortie profile create"), "{nobody}");
}

#[test]
fn two_programs_write_one_profile_at_the_same_time_and_nothing_is_lost() {
    let data = folder_of_anna();
    let data = data.path();
    let run = with(&SHORT, &["--profile", "Anna", "--json"]);
    let mut programs: Vec<_> = (0..3)
        .map(|_| {
            let mut command = command(data, &run);
            command.stdout(Stdio::null()).stderr(Stdio::null());
            command.spawn().expect("the program runs")
        })
        .collect();
    for program in &mut programs {
        assert!(program.wait().expect("it ends").success());
    }
    assert_eq!(flights(data), 3);
}

#[test]
fn a_folder_that_cannot_be_written_is_named_and_nothing_is_flown() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let refusal = refused(file.path(), &with(&SHORT, &["--profile", "Anna"]), 1);
    assert!(refusal.contains("profiles.sqlite"), "{refusal}");
    // Permissions do not restrict the superuser.
    if !Uid::effective().is_root() {
        use std::os::unix::fs::PermissionsExt as _;
        let data = tempfile::tempdir().expect("a folder");
        fs::set_permissions(data.path(), fs::Permissions::from_mode(0o500)).expect("ours");
        let refusal = refused(data.path(), &["profile", "list"], 1);
        assert!(refusal.contains("profiles.sqlite"), "{refusal}");
        // Profiles in such a folder can be read, but no flight begins whose result could not be
        // stored.
        let data = folder_of_anna();
        let mode = |mode| fs::set_permissions(data.path(), fs::Permissions::from_mode(mode));
        mode(0o500).expect("ours");
        assert!(said(data.path(), &["profile", "list"]).contains("Anna"));
        let refusal = refused(data.path(), &with(&SHORT, &["--profile", "Anna"]), 1);
        assert!(refusal.contains("can only be read"), "{refusal}");
        mode(0o700).expect("ours");
    }
}

#[test]
fn a_database_of_a_newer_version_is_left_as_it_is() {
    let data = folder_of_anna();
    let file = data.path().join("profiles.sqlite");
    let database = Connection::open(&file).expect("it is one");
    database
        .execute_batch("PRAGMA user_version = 99")
        .expect("writable");
    drop(database);
    let before = fs::read(&file).expect("readable");
    let refusal = refused(data.path(), &["profile", "list"], 1);
    assert!(refusal.contains("newer version"), "{refusal}");
    assert_eq!(fs::read(&file).expect("readable"), before);
}

#[test]
fn a_truncated_file_is_told_set_aside_and_restored_with_all_that_was_recorded() {
    let data = folder_of_anna();
    let data = data.path();
    said(data, &with(&SHORT, &["--profile", "Anna"]));
    said(data, &with(&SHORT, &["--profile", "Anna"]));
    // The copy is of the first flight; the second one is recovered from its record.
    let copies =
        ["backup", "backup-before"].map(|name| data.join(format!("profiles.sqlite.{name}")));
    fs::rename(&copies[1], &copies[0]).expect("there are two");
    let file = data.join("profiles.sqlite");
    let whole = fs::read(&file).expect("readable");
    for log in ["-wal", "-shm"] {
        drop(fs::remove_file(data.join(format!("profiles.sqlite{log}"))));
    }
    fs::write(&file, &whole[..whole.len() / 2 + 100]).expect("writable");
    let output = sortie(data, &["profile", "show", "Anna", "--json"]);
    let told = text(&output.stderr);
    assert!(
        told.contains("damaged") && told.contains("restored"),
        "{told}"
    );
    assert!(told.contains("was missing and is stored now"), "{told}");
    assert_eq!(json(&text(&output.stdout))["flights"], 2);
    assert_eq!(flights(data), 2, "and only once");
}

#[test]
fn what_a_hand_has_written_into_the_database_is_told() {
    let data = folder_of_anna();
    let data = data.path();
    said(data, &with(&SHORT, &["--profile", "Anna"]));
    let database = Connection::open(data.join("profiles.sqlite")).expect("it is one");
    let edited = database.execute("UPDATE entries SET entry = '{\"credits\": 1000000}'", []);
    assert_eq!(edited.expect("writable"), 1);
    drop(database);
    let refusal = refused(data, &["profile", "show", "Anna"], 1);
    assert!(refusal.contains("did not write"), "{refusal}");
    // Other profiles are not affected.
    said(data, &["profile", "create", "Olha"]);
    let listed = sortie(data, &["profile", "list"]);
    assert_eq!(listed.status.code(), Some(1));
    let (out, err) = (text(&listed.stdout), text(&listed.stderr));
    assert!(out.contains("Olha") && !out.contains("Anna"), "{out}");
    assert!(
        err.contains("Anna: ") && err.contains("did not write"),
        "{err}"
    );
}

#[test]
fn on_a_full_disk_the_score_is_said_and_the_flight_is_made_up_for() {
    let data = folder_of_anna();
    let data = data.path();
    let run = command(data, &with(&SHORT, &["--profile", "Anna"]));
    let quoted = std::iter::once(run.get_program())
        .chain(run.get_args())
        .map(|word| format!("'{}'", word.to_string_lossy()))
        .collect::<Vec<_>>();
    // Another console has the database open, and its log has nearly reached the size limit. The record still has room.
    let other = Connection::open(data.join("profiles.sqlite")).expect("it is one");
    let filled = other.execute_batch(
        "PRAGMA wal_autocheckpoint = 0; CREATE TABLE filler (x);
         INSERT INTO filler VALUES (zeroblob(8000)); BEGIN; SELECT count(*) FROM filler;",
    );
    filled.expect("writable");
    // The limit is in blocks of 512 bytes.
    let script = format!("trap '' XFSZ; ulimit -f 66; exec {}", quoted.join(" "));
    let output = Command::new("sh")
        .args(["-c", &script])
        .envs(
            run.get_envs()
                .filter_map(|(name, value)| Some((name, value?))),
        )
        .output()
        .expect("a shell");
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(1), "{out}{err}");
    assert!(
        out.contains("Career") && out.contains("experience +"),
        "{out}"
    );
    assert!(err.contains("the flight is not stored"), "{err}");
    drop(other);
    let told = sortie(data, &["profile", "list"]);
    let told = text(&told.stderr);
    assert!(told.contains("was missing and is stored now"), "{told}");
    assert_eq!(flights(data), 1);
}

/// A flight at the plain console of a profile whose database refuses flights, as on a full disk; returns the error
/// output.
fn flown_in_vain(data: &Path) -> String {
    let database = Connection::open(data.join("profiles.sqlite")).expect("it is one");
    let refused = database.execute_batch(
        "CREATE TRIGGER full BEFORE INSERT ON entries BEGIN SELECT RAISE(ABORT, 'full'); END;",
    );
    refused.expect("writable");
    let fly = [
        "fly",
        "d00",
        "--plain",
        "--speedup",
        "20",
        "--profile",
        "Anna",
    ];
    let mut child = command(data, &fly)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let lines = child
        .stdin
        .take()
        .map(|mut pipe| pipe.write_all(b"all guided\nwait 5s\n"));
    lines.expect("a pipe").expect("open");
    let output = child.wait_with_output().expect("it ends");
    database.execute_batch("DROP TRIGGER full").expect("there");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    text(&output.stderr)
}

#[test]
fn a_flight_that_the_plain_console_cannot_store_is_told_after_it_has_closed() {
    let data = folder_of_anna();
    let data = data.path();
    let told = flown_in_vain(data);
    assert!(
        told.contains("the next start of sortie stores it"),
        "{told}"
    );
    assert_eq!(flights(data), 1);
    // Without a record, nothing can be stored later.
    let data = folder_of_anna();
    let data = data.path();
    fs::write(data.join("runs"), "no folder").expect("writable");
    let told = flown_in_vain(data);
    assert!(told.contains("could not be stored, and is lost"), "{told}");
    assert_eq!(flights(data), 0);
}
