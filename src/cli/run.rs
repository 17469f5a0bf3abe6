//! `sortie run`: a pilot script flies a mission.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use clap::Args;

use super::backend::BackendArguments;
use super::settings::Settings;
use super::{Failure, parse_speedup};
use crate::debrief;
use crate::diagnostic::Diagnostic;
use crate::hangar::Backend;
use crate::headless::{Exercise, Live};
use crate::language::{Context, Script};
use crate::mission::{Mission, Report};
use crate::store::{self, Source, StoreError};
use crate::text;
use crate::text::Locale;
use crate::vehicle::VehicleId;

mod ardupilot;
mod witness;

use witness::Witness;

/// Options of `sortie run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie run 01 --pilot 01-air-sample\n  \
    sortie run my.toml --pilot my.pilot --json --no-timing\n  \
    sortie run 01 --pilot my.pilot --seed 3 --speedup 10\n  \
    sortie run 01 --pilot 01-air-sample --backend ardupilot")]
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
    /// Simulated seconds per second, or `max`: as fast as the embedded simulator can, as fast as all of ArduPilot's
    /// SITL processes keep together (20 on a processor of its own).
    #[arg(long, default_value = "max", value_parser = speedup_or_max)]
    speedup: Speedup,
    #[command(flatten)]
    backend: BackendArguments,
    /// Which try at the mission it is: on the first one, hints are free.
    #[arg(long = "try", value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=9999))]
    attempt: u32,
    /// Record the run in this folder, for `sortie debrief`; what is in it stays.
    #[arg(long, value_name = "DIR")]
    record: Option<PathBuf>,
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

/// What one SITL process keeps up with on one processor, with room to spare.
const SITL_KEEPS: f64 = 20.0;

impl Speedup {
    /// What SITL is asked for. As fast as it can would let vehicles drift apart, so it is what all of them keep.
    fn of_sitl(self, vehicles: usize) -> f64 {
        match self {
            Self::Times(times) => times,
            Self::Max => {
                let processors = std::thread::available_parallelism().map_or(1, usize::from);
                let share = processors as f64 / vehicles.max(1) as f64;
                (SITL_KEEPS * share.min(1.0)).max(1.0)
            }
        }
    }
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
pub(super) fn run(options: &RunArguments, settings: &Settings) -> Result<ExitCode, Failure> {
    let mission = Arc::new(load_mission(&options.mission)?);
    let script = load_script(&options.pilot, &mission)?;
    let backend = options.backend.choose(settings)?;
    let locale = Locale::new(settings.language());
    let started = Instant::now();
    let mut witness = Witness::new(options, &locale, &mission.id);
    let mut report = match &backend.ardupilot {
        None => fly(options, &backend, mission, script, &mut witness),
        Some(source) => {
            let speedup = options.speedup.of_sitl(mission.vehicles);
            let launches = backend.launches(mission.world(options.seed), speedup);
            let mut live = Live::new(mission, options.seed, script, speedup);
            witness.prepare(live.flight_mut(), backend.name());
            ardupilot::fly(source, launches, live, &mut witness)?
        }
    };
    report.drill = store::drill_of(&report.mission);
    backend.name().clone_into(&mut report.backend);
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

/// Flies in the embedded simulator.
fn fly(
    options: &RunArguments,
    backend: &Backend,
    mission: Arc<Mission>,
    script: Script,
    witness: &mut Witness<'_>,
) -> Report {
    let started = Instant::now();
    let mut exercise = Exercise::new(mission, options.seed, script, backend.airframes.clone());
    witness.prepare(exercise.flight_mut(), backend.name());
    while !exercise.is_over() {
        exercise.step();
        if let Speedup::Times(times) = options.speedup {
            let due = exercise.now().div_f64(times);
            std::thread::sleep(due.saturating_sub(started.elapsed()));
        }
        exercise
            .take_notices()
            .into_iter()
            .for_each(|notice| witness.tell(notice));
        witness.keep(exercise.flight_mut());
    }
    let report = exercise.close();
    witness.keep(exercise.flight_mut());
    report
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

/// A pilot script by path, name or number, with its faults explained.
pub(in crate::cli) fn load_script(
    path_or_name: &str,
    mission: &Mission,
) -> Result<Script, Failure> {
    let source = store::pilot(path_or_name).map_err(|error| invalid(&error))?;
    read_script(&source.text, mission).map_err(|faults| explain(&source, &faults))
}

/// A pilot script for a mission: only its vehicles and its places are known.
///
/// # Errors
/// What is wrong with it.
pub(in crate::cli) fn read_script(
    text: &str,
    mission: &Mission,
) -> Result<Script, Vec<Diagnostic>> {
    let vehicles: Vec<VehicleId> = (1..=mission.vehicles as VehicleId).collect();
    let (places, areas) = (mission.places_to_name(), mission.named_areas());
    let context = Context {
        places: Some(&places),
        areas: Some(&areas),
        vehicles: &vehicles,
        ..Context::default()
    };
    Script::parse(text, &context)
}

fn invalid(error: &StoreError) -> Failure {
    Failure::Invalid(format!("sortie: {error}"))
}

fn explain(source: &Source, faults: &[Diagnostic]) -> Failure {
    use std::io::IsTerminal as _;
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let lines: Vec<String> = faults
        .iter()
        .map(|fault| fault.render(&source.name, &source.text, colour))
        .collect();
    Failure::Invalid(lines.join("\n\n"))
}
