//! The program is killed in the middle of a run: the profiles open again, and every finished flight is stored.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

use super::{SHORT, command, flights, folder_of_anna, json, said, with};

/// The number of killed programs, unless `SORTIE_KILLS` sets another one.
const KILLS: u32 = 6;

fn records(data: &Path) -> BTreeSet<PathBuf> {
    let folder = fs::read_dir(data.join("runs")).into_iter().flatten();
    folder.flatten().map(|entry| entry.path()).collect()
}

/// Whether a record has its end line.
fn is_whole(record: &Path) -> bool {
    let record = fs::read_to_string(record).unwrap_or_default();
    let last = record.lines().last().unwrap_or_default();
    record.ends_with('\n') && last.starts_with("{\"end\"")
}

fn len(record: &Path) -> u64 {
    fs::metadata(record).map_or(0, |file| file.len())
}

/// The recorded flights that have an end.
fn finished(data: &Path) -> BTreeSet<String> {
    let records = records(data).into_iter().filter(|record| is_whole(record));
    let name = |record: PathBuf| Some(record.file_name()?.to_string_lossy().into_owned());
    records.filter_map(name).collect()
}

fn stored(data: &Path) -> Vec<String> {
    let report = json(&said(
        data,
        &["report", "--format", "json", "--profile", "Anna"],
    ));
    let runs = report["runs"].as_array().expect("a table").clone();
    let recording = |run: &serde_json::Value| run["recording"].as_str().map(str::to_owned);
    runs.iter().filter_map(recording).collect()
}

/// Runs the program and kills it at a moment of its record; returns whether it was still running.
fn is_killed(data: &Path, arguments: &[&str], until: Moment) -> bool {
    let before = records(data);
    let mut command = command(data, arguments);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut program = command.spawn().expect("the program runs");
    let mut moments = 0;
    while program.try_wait().expect("ours").is_none() {
        let record = records(data).difference(&before).next().cloned();
        moments += u32::from(record.as_deref().is_some_and(is_whole));
        let is_due = match until {
            Moment::Long(bytes) => record.is_some_and(|record| len(&record) >= bytes),
            Moment::Whole(wanted) => moments > wanted,
        };
        if is_due {
            program.kill().expect("ours");
            program.wait().expect("ours");
            return true;
        }
        std::thread::sleep(Duration::from_micros(300));
    }
    false
}

#[derive(Debug, Clone, Copy)]
enum Moment {
    /// When the record has this length in bytes.
    Long(u64),
    /// This many checks after the record is complete.
    Whole(u32),
}

#[test]
fn no_finished_flight_is_lost_when_the_program_is_killed() {
    let kills = std::env::var("SORTIE_KILLS").ok();
    let kills: u32 = kills.map_or(KILLS, |it| it.parse().expect("a number"));
    let data = folder_of_anna();
    let data = data.path();
    let run = with(&SHORT, &["--profile", "Anna", "--json"]);
    said(data, &run);
    let whole = records(data).first().map_or(0, |record| len(record));
    let mut killed = 0;
    for number in 0..kills {
        // Half of the programs are killed anywhere in the flight, the others while it is being
        // stored.
        let until = if number % 2 == 0 {
            Moment::Long(whole * u64::from(number * 37 % 100) / 100)
        } else {
            Moment::Whole(number / 2 % 50)
        };
        killed += u32::from(is_killed(data, &run, until));
    }
    let stored = stored(data);
    let finished = finished(data);
    let once: BTreeSet<String> = stored.iter().cloned().collect();
    println!(
        "killed {killed} of {kills}, finished {}, stored {}",
        finished.len(),
        stored.len()
    );
    assert!(killed > 0, "all of them were faster");
    assert_eq!(
        once, finished,
        "what was finished is stored, and nothing else"
    );
    assert_eq!(once.len(), stored.len(), "and only once");
    assert_eq!(flights(data), stored.len() as u64);
}
