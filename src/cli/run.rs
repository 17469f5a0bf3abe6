//! `sortie run`: a pilot script flies a mission.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;

use super::{Failure, parse_speedup};
use crate::debrief;
use crate::headless::Exercise;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::store::{self, Source, StoreError};
use crate::text;
use crate::text::{Language, Locale};
use crate::vehicle::VehicleId;

/// Options of `sortie run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie run 01 --pilot 01-air-sample\n  \
    sortie run my.toml --pilot my.pilot --json --no-timing\n  \
    sortie run 01 --pilot my.pilot --seed 3 --speedup 10")]
pub(super) struct RunArguments {
    /// A mission file, or the name or number of an embedded mission.
    mission: String,
    /// A pilot script, or the name of an embedded one.
    #[arg(long, value_name = "FILE")]
    pilot: String,
    /// One JSON document instead of the debrief.
    #[arg(long)]
    json: bool,
    /// What varies the mission's world.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Simulated seconds per second, or `max`.
    #[arg(long, default_value = "max", value_parser = speedup_or_max)]
    speedup: Speedup,
    /// Leave out how long it took, so that equal runs print equal bytes.
    #[arg(long)]
    no_timing: bool,
}

/// How fast simulated time passes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Speedup {
    /// As fast as the machine can.
    Max,
    /// Simulated seconds per second.
    Times(f64),
}

fn speedup_or_max(text: &str) -> Result<Speedup, String> {
    if text == "max" {
        return Ok(Speedup::Max);
    }
    parse_speedup(text)
        .map(Speedup::Times)
        .map_err(|expected| format!("{expected}, or `max`"))
}

/// Flies and prints. The exit code tells whether the mission was passed.
pub(super) fn run(options: &RunArguments, language: Language) -> Result<ExitCode, Failure> {
    let mission = Arc::new(load_mission(&options.mission)?);
    let script = load_script(&options.pilot, &mission)?;
    let locale = Locale::new(language);
    let started = Instant::now();
    let mut exercise = Exercise::new(mission, options.seed, script);
    while !exercise.is_over() {
        exercise.step();
        if let Speedup::Times(times) = options.speedup {
            let due = exercise.now().div_f64(times);
            std::thread::sleep(due.saturating_sub(started.elapsed()));
        }
        for notice in exercise.take_notices() {
            let words = match notice.vehicle {
                Some(id) => text!("debrief-vehicle", vehicle = id, what = &notice.text),
                None => notice.text,
            };
            let at = clock(notice.at);
            tracing::info!("{at} {words}");
            if !options.json {
                eprintln!("{at} {}", locale.text(&words));
            }
        }
    }
    let mut report = exercise.report();
    if options.json {
        // Whole seconds: anything finer would differ between equal runs.
        report.wall_time_s = (!options.no_timing).then(|| started.elapsed().as_secs_f64().floor());
        say!("{}", serde_json::to_string_pretty(&report)?)?;
    } else {
        say!("{}", debrief::text(&report, &locale).trim_end())?;
    }
    Ok(if report.passed {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(1)
    })
}

fn clock(at: Duration) -> String {
    let seconds = at.as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}

/// A mission by path, name or number, with its faults explained.
pub(super) fn load_mission(path_or_name: &str) -> Result<Mission, Failure> {
    let mission = store::mission(path_or_name).map_err(|error| match error {
        StoreError::Faulty { file, faults } => explain(&file, &faults),
        error => invalid(&error),
    })?;
    let is_path = Path::new(path_or_name).is_file();
    if let ([flown, others @ ..], false) = (&store::missions_with_id(&mission.id)[..], is_path) {
        for other in others {
            let id = &mission.id;
            let text = text!("mission-twice", id = id, flown = flown, other = other);
            eprintln!("sortie: {text}");
        }
    }
    Ok(mission)
}

fn load_script(path_or_name: &str, mission: &Mission) -> Result<Script, Failure> {
    let source = store::pilot(path_or_name).map_err(|error| invalid(&error))?;
    let vehicles: Vec<VehicleId> = (1..=mission.vehicles as VehicleId).collect();
    let places = mission.places();
    let context = Context {
        places: Some(&places),
        vehicles: &vehicles,
        ..Context::default()
    };
    Script::parse(&source.text, &context).map_err(|faults| explain(&source, &faults))
}

fn invalid(error: &StoreError) -> Failure {
    Failure::Invalid(format!("sortie: {error}"))
}

fn explain(source: &Source, faults: &[crate::diagnostic::Diagnostic]) -> Failure {
    use std::io::IsTerminal as _;
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let lines: Vec<String> = faults
        .iter()
        .map(|fault| fault.render(&source.name, &source.text, colour))
        .collect();
    Failure::Invalid(lines.join("\n\n"))
}
