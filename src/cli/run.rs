//! `sortie run`: flies a mission with a pilot script.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

use clap::Args;
use rand::TryRng as _;
use rand::rngs::SysRng;
use serde::Serialize;

use super::backend::BackendArguments;
use super::designs::DesignArguments;
use super::fault::FileFault;
use super::settings::CliSettings;
use super::{Failure, parse_speedup, trainee};
use crate::campaign::{Attempt, AttemptMeans, AttemptRefusal, AttemptTerms, Stake, script_stake};
use crate::debrief;
use crate::exercise::{Exercise, read_script};
use crate::hangar::{FreeFlight, VehicleBackend};
use crate::language::Script;
use crate::mission::record::Occasion;
use crate::mission::{Mission, Report};
use crate::scoring::{FlownBy, TruthReport};
use crate::store::{self, Records, Runs, Source, StoreError, day_of, utc};
use crate::text;
use crate::text::{Locale, Text};

mod ardupilot;
mod career;
mod recorder;

use career::{CareerDocument, CareerOutcome, RunTrainee};
use recorder::{RecordingPlan, RunRecorder};

/// Options of `sortie run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie run 01 --pilot 01-air-sample\n  \
    sortie run my.toml --pilot my.pilot --json --no-timing\n  \
    sortie run 01 --pilot my.pilot --seed 3 --speedup 10\n  \
    sortie run 01 --pilot 01-air-sample --design starter\n  \
    sortie run 00 --pilot 00-first-flight --profile anna\n  \
    sortie run 01 --pilot 01-air-sample --backend ardupilot")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command line"
)]
pub(super) struct RunArguments {
    /// A mission file, or the name or number of a mission.
    mission: String,
    /// Fly with this pilot script: a file, or the name of a shipped one.
    #[arg(long, value_name = "FILE")]
    pilot: String,
    /// Print one JSON document instead of the debrief.
    #[arg(long)]
    json: bool,
    /// Use this seed for the mission's world; by default 1, or a new one for each attempt with --profile. With
    /// --profile, a flight with a chosen seed counts as practice.
    #[arg(long)]
    seed: Option<u64>,
    /// Fly the seed of the day: always refused, because only flights by hand may use it.
    #[arg(long, hide = true)]
    daily: bool,
    /// Fly an exam: always refused, because exams are flown by hand.
    #[arg(long, hide = true)]
    exam: bool,
    /// Run this many times as fast as real time, or at `max`: as fast as the embedded simulator can run, or as fast as
    /// all SITL processes of ArduPilot can run together (20 times with a processor for each).
    #[arg(long, default_value = "max", value_parser = speedup_or_max)]
    speedup: Speedup,
    #[command(flatten)]
    designs: DesignArguments,
    #[command(flatten)]
    backend: BackendArguments,
    /// Set the number of this attempt at the mission, from 1: on the first, only the third hint costs points, and none
    /// in 00 and 01. With --profile, the profile counts the attempts, and this option is refused.
    #[arg(long = "try", value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=9999))]
    attempt: Option<u32>,
    /// Record the run in this folder instead of the data folder, and never delete its files automatically. Refused
    /// with --profile: such runs are recorded in the data folder.
    #[arg(long, value_name = "DIR")]
    record: Option<PathBuf>,
    /// Leave out the duration of the run, so that identical runs print identical output.
    #[arg(long)]
    no_timing: bool,
}

impl RunArguments {
    /// How the flight should count.
    fn wanted(&self, has_profile: bool) -> Stake {
        if self.exam {
            Stake::Exam
        } else if self.daily {
            Stake::Daily
        } else {
            script_stake(self.seed, has_profile)
        }
    }
}

/// How fast simulated time passes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Speedup {
    /// As fast as the machine can run.
    Max,
    /// Simulated seconds per second.
    Times(f64),
}

/// The speed-up that one SITL process can hold on one processor, with a margin.
const SITL_KEEPS: f64 = 20.0;

impl Speedup {
    /// The speed-up, with 1 for `max`.
    fn least(self) -> f64 {
        match self {
            Self::Max => 1.0,
            Self::Times(times) => times,
        }
    }

    /// The speed-up for SITL: one that all vehicles can hold, because at full speed their clocks would drift apart.
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

/// The result of a run, as `--json` prints it.
#[derive(Debug, Serialize)]
struct RunResultDocument<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    career: Option<CareerDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_time_s: Option<f64>,
}

/// Flies the mission and prints the debrief. The exit code shows whether the mission was passed.
pub(super) fn run(options: &RunArguments, settings: &CliSettings) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    let locale = Locale::new(settings.language());
    let loaded = load_mission(&options.mission)?;
    let mission = options.designs.equip(loaded, settings)?;
    for misfit in mission.misfits() {
        tell!("sortie: {}", locale.text(&misfit));
    }
    let pilot = store::pilot(&options.pilot).map_err(|error| invalid(&error))?;
    let flown_by = store::script_kind(&pilot);
    let script = script_of(&pilot, &mission)?;
    let backend = options.backend.choose(&FreeFlight::default(), settings)?;
    let mut trainee = RunTrainee::named(settings, &locale)?;
    let request = RunRequest {
        options,
        backend: &backend,
        flown_by,
        trainee: trainee.as_ref(),
        settings,
        locale: &locale,
    };
    let (flown, attempt) = request.agree(mission)?;
    let runs = settings.data.runs();
    let is_flown_now = runs.is_some_and(|runs| runs.is_flown_now(&flown.id, attempt.seed));
    let mut recorder = request.recorder(&flown, attempt)?;
    let flight = RunFlight {
        mission: Arc::clone(&flown),
        seed: attempt.seed,
        script,
    };
    let mut report = flight.fly(&backend, options.speedup, &mut recorder)?;
    store::complete(&mut report, &flown);
    report.backend = backend.kind();
    let outcome = trainee
        .as_mut()
        .map(|trainee| trainee.store(&flown, &mut report, recorder.landing()));
    if is_flown_now {
        report.truth = TruthReport::default();
    }
    let is_done = report.passed && outcome.as_ref().is_none_or(|outcome| outcome.is_stored);
    if options.json {
        // Whole seconds, because finer values would differ between identical runs.
        let wall_time_s = (!options.no_timing).then(|| started.elapsed().as_secs_f64().floor());
        let document = RunResultDocument {
            report: &report,
            career: outcome.map(CareerOutcome::document),
            wall_time_s,
        };
        say!("{}", serde_json::to_string_pretty(&document)?)?;
    } else {
        say!("{}", debrief::text(&report, &locale).trim_end())?;
        if let Some(outcome) = outcome {
            say!("\n{}", outcome.text(&locale))?;
        }
    }
    Ok(ExitCode::from(u8::from(!is_done)))
}

/// The circumstances that decide how a run counts and where it is recorded.
struct RunRequest<'a, 'l> {
    options: &'a RunArguments,
    backend: &'a VehicleBackend,
    flown_by: FlownBy,
    trainee: Option<&'a RunTrainee<'l>>,
    settings: &'a CliSettings,
    locale: &'l Locale,
}

impl<'l> RunRequest<'_, 'l> {
    /// The mission as it is flown, and how it counts.
    fn agree(&self, mission: Mission) -> Result<(Arc<Mission>, Attempt), Failure> {
        let options = self.options;
        let wanted = options.wanted(self.trainee.is_some());
        let mission = mission.flown_for(wanted);
        let terms = AttemptTerms {
            drawn: None,
            mission: &mission,
            wanted,
            seed: options.seed,
            trainee: self.trainee.map(RunTrainee::of_attempt),
            means: AttemptMeans {
                mission_file: store::mission_file(&mission),
                flown_by: self.flown_by,
                has_own_airframes: !self.backend.airframes.is_empty(),
                speedup: options.speedup.least(),
                has_crew: false,
            },
            day: day_of(SystemTime::now()),
            random: SysRng.try_next_u64().ok(),
        };
        if let Some(refusal) = AttemptRefusal::of(wanted, &terms.means) {
            return Err(trainee::invalid(&refusal.text(), self.locale));
        }
        let attempt = terms.decide();
        if let Some(trainee) = self.trainee {
            if options.record.is_some() || options.attempt.is_some() {
                return Err(trainee::invalid(&text!("profile-record"), self.locale));
            }
            let reasons = terms.practice_reasons();
            trainee.admit(&mission, &reasons)?;
            if attempt.is_reduced() {
                trainee.tell_practice(&reasons);
            }
        }
        Ok((Arc::new(mission), attempt))
    }

    /// The recorder that reports and records the run, for an attempt.
    fn recorder(&self, mission: &Mission, attempt: Attempt) -> Result<RunRecorder<'l>, Failure> {
        let number = match self.trainee {
            Some(trainee) => trainee.attempt(mission)?,
            None => self.options.attempt.unwrap_or(1),
        };
        let is_recorded = self.settings.config.records.enabled;
        let (runs, records) = match (&self.options.record, self.trainee) {
            (Some(folder), _) => (Some(Runs::at(folder)), Some(Records::at(folder))),
            (None, Some(trainee)) => (Some(trainee.runs().clone()), self.settings.records()),
            (None, None) => {
                let runs = self.settings.data.runs().filter(|_| is_recorded);
                (runs, self.settings.records())
            }
        };
        let plan = RecordingPlan {
            is_heard: !self.options.json,
            attempt: number,
            runs,
            records: records.filter(|_| is_recorded),
            occasion: Occasion {
                when: utc(SystemTime::now()),
                backend: self.backend.kind(),
                flown_by: self.flown_by,
                profile: self.trainee.map(|trainee| trainee.name().to_owned()),
                stake: attempt.stake,
            },
        };
        Ok(RunRecorder::new(plan, &mission.id, self.locale))
    }
}

struct RunFlight {
    mission: Arc<Mission>,
    seed: u64,
    script: Script,
}

impl RunFlight {
    fn fly(
        self,
        backend: &VehicleBackend,
        speedup: Speedup,
        recorder: &mut RunRecorder<'_>,
    ) -> Result<Report, Failure> {
        let Self {
            mission,
            seed,
            script,
        } = self;
        let Some(source) = &backend.ardupilot else {
            let exercise = Exercise::new(mission, seed, script, backend.airframes.clone());
            return Ok(fly_embedded(exercise, speedup, recorder));
        };
        let speedup = speedup.of_sitl(mission.seats.count);
        let launches = backend.launches(mission.world(seed), speedup);
        let mut live = Exercise::live(mission, seed, script, speedup);
        recorder.prepare(&mut live);
        ardupilot::fly(source, launches, live, recorder)
    }
}

fn fly_embedded(
    mut exercise: Exercise,
    speedup: Speedup,
    recorder: &mut RunRecorder<'_>,
) -> Report {
    let started = Instant::now();
    recorder.prepare_embedded(&mut exercise);
    while !exercise.is_over() {
        exercise.step();
        if let Speedup::Times(times) = speedup {
            let due = exercise.now().div_f64(times);
            std::thread::sleep(due.saturating_sub(started.elapsed()));
        }
        for notice in exercise.take_notices() {
            recorder.tell(notice);
        }
        recorder.take_inputs(&mut exercise);
        recorder.keep(&mut exercise);
    }
    exercise.close_inputs();
    let report = exercise.close();
    recorder.take_inputs(&mut exercise);
    recorder.finish(&mut exercise);
    report
}

/// A mission by path, name or number, with its faults explained.
pub(super) fn load_mission(path_or_name: &str) -> Result<Mission, Failure> {
    let mission = store::mission(path_or_name).map_err(|error| match error {
        StoreError::Faulty { file, faults } => FileFault::Inside(file, faults).failure(),
        error => invalid(&error),
    })?;
    let is_path = Path::new(path_or_name).is_file();
    if let ([flown, others @ ..], false) = (&store::missions_with_id(&mission.id)[..], is_path) {
        for other in others {
            let id = &mission.id;
            let text = text!("mission-twice", id = id, flown = flown, other = other);
            tell!("sortie: {text}");
        }
    }
    Ok(mission)
}

/// A pilot script by path, name or number, with its faults explained.
pub(in crate::cli) fn load_script(
    path_or_name: &str,
    mission: &Mission,
) -> Result<Script, Failure> {
    let pilot = store::pilot(path_or_name).map_err(|error| invalid(&error))?;
    script_of(&pilot, mission)
}

fn script_of(pilot: &Source, mission: &Mission) -> Result<Script, Failure> {
    read_script(&pilot.text, mission)
        .map_err(|faults| FileFault::Inside(pilot.clone(), faults).failure())
}

fn invalid(error: &StoreError) -> Failure {
    Failure::Wrong(vec![Text::from(error)])
}
