//! `sortie bench scale`: the cost of a growing number of flying vehicles for the simulator and the console, as
//! measured in the paper.
//!
//! # How the parts fit
//! - A measurement: `trial` flies one repeat, `swarm` is what it measures, `instances` are its SITL processes; `sample`
//!   holds the figures of a repeat; `strain` says which part was overloaded.
//! - The result: `row` combines the repeats with one number of vehicles; `figure` decides what is compared with the
//!   paper, and `table`, `chart` and `svg` show it.

use std::fs::{self, OpenOptions};
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;

use super::super::Failure;
use super::super::backend::{SimulatorChoice, own};
use super::super::programs::ProgramOptions;
use super::super::settings::CliSettings;
use super::cost;
use crate::sitl::SitlKind;
use crate::terminal::Environment;
use instances::SitlBench;
use progress::ScaleProgress;
use row::ScaleRow;
use trial::{TrialPlan, trial};

mod chart;
mod figure;
mod instances;
mod progress;
mod row;
mod sample;
mod strain;
mod svg;
mod swarm;
mod table;
#[cfg(test)]
mod tests;
mod trial;

/// The maximum number of vehicles that `--beyond` tries.
const MOST_EMBEDDED: u16 = 16_384;
const MOST_ARDUPILOT: u16 = 1024;

/// Options of `sortie bench scale`.
#[derive(Debug, Args)]
#[command(
    after_help = "The measurement: vehicles are started and, once all can be armed, stream GLOBAL_POSITION_INT and\n\
    ATTITUDE at 10 Hz each. They switch to GUIDED, arm, take off, and fly to a place 1 km away at a height of\n\
    200 m. Then the processor time of the simulator and of the console's model update is measured. A repeat in\n\
    which a vehicle does not move does not count. The console has one fleet and one thread for each 254 vehicles.\n\n\
    Examples:\n  \
    sortie bench scale\n  \
    sortie bench scale --backend ardupilot --svg scale.svg\n  \
    sortie bench scale --counts 32 --beyond --repeat 1"
)]
pub(in crate::cli) struct ScaleArguments {
    /// Fly this many vehicles, with one measurement for each number; 0 measures the cost without vehicles.
    #[arg(long, value_delimiter = ',', default_value = "0,1,2,4,8,16,32",
        value_parser = clap::value_parser!(u16).range(0..=16384))]
    counts: Vec<u16>,
    /// Measure for this many seconds.
    #[arg(long, default_value_t = 20.0, value_parser = parse_seconds)]
    seconds: f64,
    /// Measure each number this many times, each time with newly started vehicles, and take the median.
    #[arg(long, default_value = "3")]
    repeat: NonZeroU16,
    /// Wait at least this many seconds between two kinds of commands, and always until the first has taken effect.
    #[arg(long, default_value_t = 4.0, value_parser = parse_seconds)]
    spacing: f64,
    /// Use this simulator; by default the embedded one, unless a program is named.
    #[arg(long, value_enum)]
    backend: Option<SimulatorChoice>,
    #[command(flatten)]
    programs: ProgramOptions,
    /// Afterwards, double the number until the simulation falls behind real time, and name the overloaded part.
    #[arg(long)]
    beyond: bool,
    /// Also draw the figures into this SVG file.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print one JSON document instead of the tables and the chart.
    #[arg(long)]
    json: bool,
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|seconds: &f64| (0.2..=3600.0).contains(seconds))
        .ok_or_else(|| "expected a number of seconds from 0.2 to 3600".to_owned())
}

pub(in crate::cli) fn scale(
    options: &ScaleArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    if let Some(path) = &options.svg {
        // A file that cannot be written is reported now, not after half an hour; an existing drawing stays until it is
        // replaced.
        let writable = OpenOptions::new().create(true).append(true).open(path);
        writable.map_err(|error| {
            Failure::Invalid(format!("sortie: cannot write {}: {error}", path.display()))
        })?;
    }
    let bench = sitl_bench(options, settings)?;
    let rows = ScaleSeries::new(options, bench.as_ref()).run()?;
    let simulator = bench
        .as_ref()
        .map_or("embedded", |bench| bench.name.as_str());
    if let Some(path) = &options.svg {
        let heading =
            format!("Processor time against the number of drones; simulator: {simulator}");
        fs::write(path, svg::svg(&rows, &heading))?;
    }
    if options.json {
        say!("{}", serde_json::to_string(&rows)?)?;
    } else {
        let heading = table::ScaleHeading {
            simulator,
            seconds: options.seconds,
            repeats: options.repeat.get(),
            cores: cost::cores(),
            is_ardupilot: bench.is_some(),
        };
        say!("{}", table::table(&rows, &heading))?;
        let is_ascii = !Environment::of_process().speaks_utf8();
        say!("{}", chart::chart(&rows, is_ascii))?;
    }
    let mut asked = rows
        .iter()
        .filter(|row| options.counts.contains(&row.vehicles));
    let all_good = asked.all(|row| row.repeats > 0);
    Ok(ExitCode::from(u8::from(!all_good)))
}

/// The hangar of ArduPilot's processes; none for the embedded simulator.
fn sitl_bench(
    options: &ScaleArguments,
    settings: &CliSettings,
) -> Result<Option<SitlBench>, Failure> {
    let is_embedded = match options.backend {
        Some(simulator) => simulator == SimulatorChoice::Embedded,
        None => !options.programs.is_given(),
    };
    if is_embedded {
        return Ok(None);
    }
    let mut config = own(SitlKind::Copter, &options.programs, settings)?;
    config.limits.instances = MOST_ARDUPILOT;
    let bench = SitlBench::open(config);
    bench
        .map(Some)
        .map_err(|error| Failure::Invalid(format!("sortie: {error:#}")))
}

struct ScaleSeries<'a> {
    options: &'a ScaleArguments,
    bench: Option<&'a SitlBench>,
    plan: TrialPlan,
    progress: ScaleProgress,
}

impl<'a> ScaleSeries<'a> {
    fn new(options: &'a ScaleArguments, bench: Option<&'a SitlBench>) -> Self {
        let plan = TrialPlan {
            window: Duration::from_secs_f64(options.seconds),
            spacing: Duration::from_secs_f64(options.spacing),
        };
        let repeats = options.counts.len() * usize::from(options.repeat.get());
        Self {
            options,
            bench,
            plan,
            progress: ScaleProgress::new(repeats, plan.lasts()),
        }
    }

    fn run(mut self) -> anyhow::Result<Vec<ScaleRow>> {
        let mut rows = Vec::new();
        for &vehicles in &self.options.counts {
            rows.push(self.count(vehicles)?);
        }
        let most = self.bench.map_or(MOST_EMBEDDED, |_| MOST_ARDUPILOT);
        let mut vehicles = self.options.counts.iter().copied().max().unwrap_or(0);
        let is_held = |row: &ScaleRow| row.gave_way.is_none() && row.repeats > 0;
        while self.options.beyond && rows.iter().all(is_held) && vehicles < most {
            vehicles = (vehicles * 2).clamp(1, most);
            self.progress.left += usize::from(self.options.repeat.get());
            rows.push(self.count(vehicles)?);
        }
        Ok(rows)
    }

    /// Measures all repeats of one number of vehicles. If several vehicles do not start, that is a
    /// result, not an error.
    fn count(&mut self, vehicles: u16) -> anyhow::Result<ScaleRow> {
        let repeats = usize::from(self.options.repeat.get());
        let mut samples = Vec::new();
        let s = if vehicles == 1 { "" } else { "s" };
        for repeat in 1..=repeats {
            self.progress.begin(format!(
                "{vehicles} vehicle{s}, repeat {repeat} of {repeats}"
            ));
            let trial = trial(self.bench, vehicles, self.plan, &mut self.progress);
            self.progress.clear();
            self.progress.left -= 1;
            match trial {
                Ok(sample) => samples.push(sample),
                Err(error) if vehicles <= 1 => return Err(error),
                Err(error) => {
                    self.progress.left -= repeats - repeat;
                    return Ok(ScaleRow::never_flown(vehicles, format!("{error:#}")));
                }
            }
        }
        Ok(ScaleRow::of(vehicles, &samples))
    }
}
