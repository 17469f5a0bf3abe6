//! `sortie bench scale`: what a growing number of flying vehicles costs the simulator and the console, as the paper
//! measured it.

use std::fs;
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;

use super::super::Failure;
use super::super::backend::{Simulator, missing_program};
use super::super::programs::ProgramOptions;
use super::super::settings::Settings;
use crate::sitl::Kind;
use crate::terminal::Environment;
use progress::Progress;
use sample::Row;
use swarm::Simulators;
use trial::{Plan, trial};

mod chart;
mod cost;
mod figure;
mod instances;
mod progress;
mod sample;
mod strain;
mod svg;
mod swarm;
mod table;
#[cfg(test)]
mod tests;
mod track;
mod trial;

/// With `--beyond`, no more vehicles than this are tried.
const MOST_EMBEDDED: u16 = 16_384;
const MOST_ARDUPILOT: u16 = 1024;

/// Options of `sortie bench scale`.
#[derive(Debug, Args)]
#[command(
    after_help = "What is measured: vehicles are started and, once all can be armed, stream GLOBAL_POSITION_INT and\n\
    ATTITUDE at 10 Hz each. They are switched to GUIDED, armed, take off, and are sent to a place 1 km away at\n\
    200 m. Then the processor time of the simulator and of the console's model update is taken. A repeat in which\n\
    a vehicle does not move does not count. Beyond 254 vehicles, the console has a fleet and a thread for each 254.\n\n\
    Examples:\n  \
    sortie bench scale\n  \
    sortie bench scale --backend ardupilot --svg scale.svg\n  \
    sortie bench scale --counts 32 --beyond --repeat 1"
)]
pub(in crate::cli) struct ScaleArguments {
    /// How many vehicles fly: one measurement for each number. 0 is what the programs cost without any.
    #[arg(long, value_delimiter = ',', default_value = "0,1,2,4,8,16,32",
        value_parser = clap::value_parser!(u16).range(0..=16384))]
    counts: Vec<u16>,
    /// How long to measure, in seconds.
    #[arg(long, default_value_t = 20.0, value_parser = parse_seconds)]
    seconds: f64,
    /// How often each number is measured, from the start of the vehicles on; the median counts.
    #[arg(long, default_value = "3")]
    repeat: NonZeroU16,
    /// The time between two kinds of commands, in seconds.
    #[arg(long, default_value_t = 4.0, value_parser = parse_seconds)]
    spacing: f64,
    /// Who simulates; embedded unless a program is named.
    #[arg(long, value_enum)]
    backend: Option<Simulator>,
    #[command(flatten)]
    programs: ProgramOptions,
    /// Afterwards, doubles the number until real time is no longer held, and says what gave way.
    #[arg(long)]
    beyond: bool,
    /// Draws the figures into this file too.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// One JSON document instead of the tables and the chart.
    #[arg(long)]
    json: bool,
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|seconds: &f64| (0.2..=3600.0).contains(seconds))
        .ok_or_else(|| "expected a number of seconds from 0.2 to 3600".to_owned())
}

/// Measures and prints.
pub(in crate::cli) fn scale(
    options: &ScaleArguments,
    settings: &Settings,
) -> Result<ExitCode, Failure> {
    let simulators = simulators(options, settings)?;
    if let Some(path) = &options.svg {
        // Better now than after half an hour.
        fs::write(path, "").map_err(|error| {
            Failure::Invalid(format!("sortie: cannot write {}: {error}", path.display()))
        })?;
    }
    let rows = Series::new(options, &simulators).run()?;
    let name = match &simulators {
        Simulators::Embedded => "embedded",
        Simulators::ArduPilot(_) => "ArduPilot SITL",
    };
    if let Some(path) = &options.svg {
        let heading = format!("Processor time against the number of drones; simulator: {name}");
        fs::write(path, svg::svg(&rows, &heading)?)?;
    }
    if options.json {
        say!("{}", serde_json::to_string(&rows)?)?;
    } else {
        let heading = table::Heading {
            backend: name,
            seconds: options.seconds,
            repeats: options.repeat.get(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            is_ardupilot: matches!(simulators, Simulators::ArduPilot(_)),
        };
        say!("{}", table::table(&rows, &heading))?;
        let is_ascii = !Environment::of_process().speaks_utf8();
        say!("{}", chart::chart(&rows, is_ascii))?;
    }
    let asked = rows
        .iter()
        .filter(|row| options.counts.contains(&row.vehicles));
    let all_good = asked.clone().all(Row::is_good);
    Ok(ExitCode::from(u8::from(!all_good)))
}

fn simulators(options: &ScaleArguments, settings: &Settings) -> Result<Simulators, Failure> {
    let is_named = options.programs.is_given();
    match options.backend {
        Some(Simulator::Embedded) => Ok(Simulators::Embedded),
        None if !is_named => Ok(Simulators::Embedded),
        _ => {
            let programs = options.programs.find(settings);
            let found = programs.of(Kind::Copter);
            let found = found.map_err(|missing| missing_program(&missing))?;
            Ok(Simulators::ArduPilot(found.file.clone()))
        }
    }
}

/// A series of measurements.
struct Series<'a> {
    options: &'a ScaleArguments,
    simulators: &'a Simulators,
    plan: Plan,
    progress: Progress,
}

impl<'a> Series<'a> {
    fn new(options: &'a ScaleArguments, simulators: &'a Simulators) -> Self {
        let plan = Plan {
            window: Duration::from_secs_f64(options.seconds),
            spacing: Duration::from_secs_f64(options.spacing),
        };
        let repeats = options.counts.len() * usize::from(options.repeat.get());
        Self {
            options,
            simulators,
            plan,
            progress: Progress::new(repeats, plan.lasts()),
        }
    }

    fn run(mut self) -> anyhow::Result<Vec<Row>> {
        let mut rows = Vec::new();
        for &vehicles in &self.options.counts {
            rows.push(self.count(vehicles)?);
        }
        if self.options.beyond {
            let most = match self.simulators {
                Simulators::Embedded => MOST_EMBEDDED,
                Simulators::ArduPilot(_) => MOST_ARDUPILOT,
            };
            let mut vehicles = self.options.counts.iter().copied().max().unwrap_or(0);
            let mut is_held = rows.iter().all(|row| row.gave_way.is_none());
            while is_held && vehicles < most {
                vehicles = (vehicles * 2).clamp(1, most);
                self.progress.add(usize::from(self.options.repeat.get()));
                let row = self.count(vehicles)?;
                is_held = row.gave_way.is_none() && row.is_good();
                rows.push(row);
            }
        }
        self.progress.clear();
        Ok(rows)
    }

    /// All repeats of one number of vehicles. More vehicles than come up are a result, not an error.
    fn count(&mut self, vehicles: u16) -> anyhow::Result<Row> {
        let repeats = usize::from(self.options.repeat.get());
        let mut samples = Vec::new();
        for repeat in 1..=repeats {
            self.progress.begin(vehicles, repeat, repeats);
            self.progress.say("starting");
            match trial(self.simulators, vehicles, self.plan, &mut self.progress) {
                Ok(sample) => samples.push(sample),
                Err(error) if vehicles <= 1 => {
                    self.progress.clear();
                    return Err(error);
                }
                Err(error) => {
                    self.progress.clear();
                    return Ok(Row::never_flown(vehicles, format!("{error:#}")));
                }
            }
        }
        Ok(Row::of(vehicles, &samples))
    }
}
