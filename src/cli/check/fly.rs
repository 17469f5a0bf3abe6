//! `sortie check --fly`: whether a mission can be passed with skill, and only with skill.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde::Serialize;

use crate::cli::Failure;
use crate::cli::run::{load_mission, load_script};
use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::{Mission, Report};
use crate::scoring::Medal;
use crate::store::{self, StoreError};

/// A pilot script that a mission is tested with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum CheckPilot {
    /// The model solution: must pass with at least a silver medal.
    Reference,
    /// A script that makes the mistakes of a beginner: must not earn a medal.
    Naive,
    /// No commands at all: must not pass or score.
    DoNothing,
}

/// One flight, and whether its result is as required.
#[derive(Debug, Serialize)]
struct CheckFlight {
    mission: String,
    pilot: CheckPilot,
    seed: u64,
    passed: bool,
    score: u16,
    medal: Option<Medal>,
    sim_time_s: f64,
    /// Simulated seconds per second of one flight, while one flight per processor runs at the same
    /// time.
    realtime_factor: f64,
    good: bool,
}

impl CheckPilot {
    fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::Naive => "naive",
            Self::DoNothing => "do-nothing",
        }
    }

    fn is_right(self, report: &Report) -> bool {
        match self {
            Self::Reference => report.passed && report.medal >= Some(Medal::Silver),
            Self::Naive => report.medal.is_none(),
            Self::DoNothing => !report.passed && report.score == 0,
        }
    }
}

/// Flies each mission with each pilot and each seed, counted from 1, and prints the results; exit code 1 if a result is
/// not as required.
pub(in crate::cli) fn fly(
    missions: &[String],
    seeds: u64,
    json: bool,
) -> Result<ExitCode, Failure> {
    let mut all = Vec::new();
    for name in missions {
        let flown = course(name, seeds)?;
        if !json {
            print(&flown)?;
        }
        all.extend(flown);
    }
    if json {
        say!("{}", serde_json::to_string_pretty(&all)?)?;
    }
    let good = all.iter().all(|flown| flown.good);
    Ok(ExitCode::from(u8::from(!good)))
}

/// All flights of one mission, pilot by pilot.
fn course(name: &str, seeds: u64) -> Result<Vec<CheckFlight>, Failure> {
    let mission = Arc::new(load_mission(name)?);
    let number = mission.id.split('-').next().unwrap_or_default();
    let reference = pilot_beside(name, &mission.id);
    let naive = pilot_beside(name, &format!("{number}-naive"));
    let mut pilots = vec![(CheckPilot::Reference, load_script(&reference, &mission)?)];
    match store::pilot(&naive) {
        Ok(_) => pilots.push((CheckPilot::Naive, load_script(&naive, &mission)?)),
        // A drill needs no naive pilot.
        Err(_) if mission.summary.drill_of.is_some() => {}
        Err(StoreError::Unknown { name, .. }) => {
            tell!("{}: no naive pilot `{name}`, so none was flown", mission.id);
        }
        Err(error) => tell!("{}: no naive pilot was flown: {error}", mission.id),
    }
    let nothing = Script::parse("", &Context::default());
    pilots.extend(nothing.ok().map(|script| (CheckPilot::DoNothing, script)));
    let tasks: Vec<(CheckPilot, &Script, u64)> = pilots
        .iter()
        .flat_map(|(who, script)| (1..=seeds).map(move |seed| (*who, script, seed)))
        .collect();
    Ok(flown_by_all_processors(&mission, &tasks))
}

/// The path of a pilot's script beside the mission's file, or in a folder `pilots` there or one level up; otherwise the
/// script's name.
fn pilot_beside(mission: &str, pilot: &str) -> String {
    let folder = Path::new(mission).parent().unwrap_or(Path::new(""));
    let file = format!("{pilot}.pilot");
    let paths = ["", "pilots", "../pilots"].map(|within| folder.join(within).join(&file));
    let found = paths.iter().find(|path| path.is_file());
    found.map_or_else(|| pilot.to_owned(), |path| path.display().to_string())
}

/// The flights in the order of the tasks, regardless of which ends first.
fn flown_by_all_processors(
    mission: &Arc<Mission>,
    tasks: &[(CheckPilot, &Script, u64)],
) -> Vec<CheckFlight> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(&(who, script, seed)) = tasks.get(index) else {
                return done;
            };
            done.push((index, flown(mission, who, script, seed)));
        }
    };
    let mut all: Vec<(usize, CheckFlight)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let done = workers.into_iter().filter_map(|worker| worker.join().ok());
        done.flatten().collect()
    });
    all.sort_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, flown)| flown).collect()
}

fn flown(mission: &Arc<Mission>, pilot: CheckPilot, script: &Script, seed: u64) -> CheckFlight {
    let started = Instant::now();
    let mut exercise = Exercise::new(Arc::clone(mission), seed, script.clone(), Vec::new());
    while !exercise.is_over() {
        exercise.step();
        // Notices are not read here and would only pile up.
        drop(exercise.take_notices());
    }
    let report = exercise.report();
    CheckFlight {
        mission: mission.id.clone(),
        pilot,
        seed,
        passed: report.passed,
        score: report.score,
        medal: report.medal,
        sim_time_s: report.sim_time_s,
        realtime_factor: (report.sim_time_s / started.elapsed().as_secs_f64().max(1e-6)).round(),
        good: pilot.is_right(&report),
    }
}

impl CheckFlight {
    /// The fault of the result, with a hint on how to fix it.
    fn wrong(&self) -> String {
        let score = self.score;
        match self.pilot {
            CheckPilot::Reference if !self.passed => {
                format!(
                    "the reference pilot did not pass and earned {score}: it has to earn silver"
                )
            }
            CheckPilot::Reference => {
                format!(
                    "the reference pilot earned {score}, less than silver: `medals` or `par` are too strict"
                )
            }
            CheckPilot::Naive => {
                format!("the naive pilot earned {score} and a medal: it must stay below bronze")
            }
            CheckPilot::DoNothing if self.passed => {
                format!(
                    "idle vehicles passed with {score}: a `mandatory` objective must require a flight"
                )
            }
            CheckPilot::DoNothing => {
                format!("idle vehicles earned {score}: an objective is partly met without a flight")
            }
        }
    }
}

/// Prints a line for each pilot of a mission, and one for each flight with a wrong result.
fn print(all: &[CheckFlight]) -> Result<(), Failure> {
    for who in [
        CheckPilot::Reference,
        CheckPilot::Naive,
        CheckPilot::DoNothing,
    ] {
        let flights: Vec<&CheckFlight> = all.iter().filter(|flown| flown.pilot == who).collect();
        let Some(first) = flights.first() else {
            continue;
        };
        let count = flights.len();
        let passed = flights.iter().filter(|flown| flown.passed).count();
        let scores = flights.iter().map(|flown| flown.score);
        let (low, high) = (scores.clone().min(), scores.max());
        let speed: f64 = flights.iter().map(|flown| flown.realtime_factor).sum();
        say!(
            "{:<22} {:<10}  passed {passed:>2}/{count:<2}  score {:>4} to {:<4}  {:>5.0} x real time",
            first.mission,
            who.name(),
            low.unwrap_or(0),
            high.unwrap_or(0),
            speed / count as f64
        )?;
        for flown in flights.iter().filter(|flown| !flown.good) {
            say!("  wrong: seed {}: {}", flown.seed, flown.wrong())?;
        }
    }
    Ok(())
}
