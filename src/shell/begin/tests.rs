use std::sync::Arc;

use crossterm::event::KeyCode;

use super::*;
use crate::app::event::TerminalEvent;
use crate::mission::record::{Stored, WithoutEnd};
use crate::scoring::TryReport;
use crate::shell::pace::TICK;
use crate::shell::{ApiOptions, ConsoleOptions, Opening, key};
use crate::store::{RecordLimits, Records, Runs};
use crate::text;

const FIRST: &str = include_str!("../../../missions/00-first-flight.toml");

fn first() -> Arc<Mission> {
    Arc::new(Mission::parse(FIRST).expect("it is good"))
}

/// A console that shows the brief of a mission, with its attempts stored in a folder.
async fn reading(runs: &Runs) -> Console {
    let mut options = ConsoleOptions::for_test(Opening::Mission(first()));
    options.seed = None;
    options.preferences.runs = Some(runs.clone());
    let mut console = Console::new(options, true);
    let (columns, rows) = (120, 40);
    console.feed(TerminalEvent::Resize { columns, rows }).await;
    console.begin().await;
    console
}

async fn run(console: &mut Console, seconds: u32) {
    for _ in 0..seconds * 10 {
        tokio::time::sleep(TICK).await;
        console.tick().await;
    }
}

fn tries(runs: &Runs) -> Vec<TryReport> {
    let mission = first();
    runs.tries_at(None, &mission.id, mission.rev)
}

async fn say(console: &mut Console, line: &str) {
    console.feed(TerminalEvent::Line(line.to_owned())).await;
}

#[tokio::test(start_paused = true)]
async fn a_flight_that_is_left_after_its_clock_has_started_is_a_try() {
    for leave in ["leave", "restart", "quit"] {
        let folder = tempfile::tempdir().expect("a folder");
        let runs = Runs::at(folder.path());
        let mut console = Box::pin(reading(&runs)).await;
        run(&mut console, 3).await;
        console.feed(key(KeyCode::Enter)).await;
        run(&mut console, 5).await;
        say(&mut console, leave).await;
        console.feed(key(KeyCode::Char('y'))).await;
        Box::pin(console.close()).await;
        let scores: Vec<Option<u16>> = tries(&runs).iter().map(|one| one.score).collect();
        assert_eq!(scores, [Some(0)], "{leave}");
    }
}

#[tokio::test(start_paused = true)]
async fn a_brief_that_was_only_read_leaves_no_try() {
    let folder = tempfile::tempdir().expect("a folder");
    let runs = Runs::at(folder.path());
    let mut console = Box::pin(reading(&runs)).await;
    run(&mut console, 3).await;
    say(&mut console, "abandon").await;
    assert!(console.running.is_none());
    assert_eq!(tries(&runs), []);
}

#[tokio::test(start_paused = true)]
async fn a_flight_that_is_cut_off_is_not_given_up() {
    let folder = tempfile::tempdir().expect("a folder");
    let runs = Runs::at(folder.path());
    let mut console = Box::pin(reading(&runs)).await;
    run(&mut console, 3).await;
    console.feed(key(KeyCode::Enter)).await;
    run(&mut console, 5).await;
    console.is_cut_off = true;
    Box::pin(console.close()).await;
    drop(console);
    assert!(tries(&runs).iter().all(|one| one.score.is_none()));
}

#[tokio::test(start_paused = true)]
async fn the_record_of_a_flight_that_is_left_is_written_to_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let runs = Runs::at(folder.path());
    let mut console = Box::pin(reading(&runs)).await;
    run(&mut console, 3).await;
    console.feed(key(KeyCode::Enter)).await;
    run(&mut console, 5).await;
    // The drone takes off between two writes of the record.
    for line in ["all guided", "all arm", "all takeoff 20"] {
        say(&mut console, line).await;
        run(&mut console, 3).await;
    }
    for _ in 0..7 {
        tokio::time::sleep(TICK).await;
        console.tick().await;
    }
    let mission = console.app.state().session().mission();
    let elapsed = mission.expect("it is flown").elapsed;
    console.is_cut_off = true;
    Box::pin(console.close()).await;
    let file = runs.newest().expect("a record");
    let text = std::fs::read_to_string(file).expect("text");
    let stored = Stored::read(&text).expect("a record");
    let report = stored
        .rescore(WithoutEnd::Over)
        .expect("a good mission")
        .report;
    let missing_s = elapsed.as_secs_f64() - report.sim_time_s;
    assert!(missing_s.abs() < 0.05, "{missing_s} s are missing");
}

#[tokio::test(start_paused = true)]
async fn no_exam_begins_in_a_console_that_accepts_commands_of_programs() {
    for (commands, expected) in [(true, Err(text!("exam-by-hand"))), (false, Ok(()))] {
        let mut options = ConsoleOptions::for_test(Opening::Home);
        let socket = "api".into();
        options.api = Some(ApiOptions { socket, commands });
        let mut console = Console::new(options, true);
        let begun = Box::pin(console.launch(first(), Stake::Exam, SeedSources::default())).await;
        assert_eq!(begun, expected);
    }
}

#[tokio::test(start_paused = true)]
async fn an_exam_runs_in_real_time() {
    let mut options = ConsoleOptions::for_test(Opening::Home);
    options.speedup = 4.0;
    let mut console = Console::new(options, true);
    let refused = Box::pin(console.launch(first(), Stake::Exam, SeedSources::default())).await;
    assert_eq!(refused, Err(text!("exam-real-time")));
    console.options.speedup = 1.0;
    let mission = Mission::parse(FIRST)
        .expect("it is good")
        .flown_for(Stake::Exam);
    let begun =
        Box::pin(console.launch(Arc::new(mission), Stake::Exam, SeedSources::default())).await;
    assert_eq!(begun, Ok(()));
    console.take_in().await;
    run(&mut console, 3).await;
    console.feed(key(KeyCode::Enter)).await;
    run(&mut console, 1).await;
    say(&mut console, "speedup 2").await;
    let said = console.app.state().message().map(|it| it.text.clone());
    assert_eq!(said, Some(text!("speedup-not-in-exams")));
}

#[tokio::test(start_paused = true)]
async fn a_try_that_would_be_practice_or_has_no_record_is_not_begun() {
    let folder = tempfile::tempdir().expect("a folder");
    let launch = Launch {
        stake: Stake::Exam,
        drawn: Some(7),
        ..Launch::graded("00-first-flight")
    };
    for (speedup, is_kept) in [(1.0, true), (0.5, true), (1.0, false)] {
        let is_begun = speedup >= 1.0 && is_kept;
        let mut options = ConsoleOptions::for_test(Opening::Home);
        options.speedup = speedup;
        if is_kept {
            let limits = RecordLimits::default();
            options.preferences.runs = Some(Runs::within(folder.path()));
            options.preferences.records = Some(Records::within(folder.path(), limits));
        }
        let mut console = Console::new(options, true);
        console.begin().await;
        let started = Box::pin(console.start_mission(&launch)).await;
        assert_eq!(started.is_ok(), is_begun);
        assert_eq!(console.running.is_some(), is_begun);
        if is_begun {
            assert_eq!(
                (console.attempt.stake, console.attempt.seed),
                (Stake::Exam, 7)
            );
        }
    }
}
