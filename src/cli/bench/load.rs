//! `sortie bench load`: the total cost of flying embedded vehicles.

use std::fs;
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use ratatui::layout::Size;
use serde::Serialize;

use super::super::{Failure, runtime};
use crate::scoring::FlownBy;
use crate::shell::{self, ConsoleOptions, Opening, Preferences};
use crate::ui::Look;

/// The time within which the vehicles take off.
const WARM_UP: Duration = Duration::from_secs(25);
/// The size of the drawn screen, in columns and rows.
const SIZE: Size = Size::new(120, 40);

/// Options of `sortie bench load`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench load --vehicles 32 --seconds 20")]
pub(in crate::cli) struct LoadArguments {
    /// Fly this many vehicles.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u8).range(1..=250))]
    vehicles: u8,
    /// Measure for this many seconds, after 25 s in which the vehicles take off.
    #[arg(long, default_value_t = 20)]
    seconds: u64,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct LoadCost {
    vehicles: u8,
    window_s: f64,
    core_percent: f64,
    core_percent_per_vehicle: f64,
    bytes_per_s: f64,
}

/// The counters at the beginning or the end of a measurement.
struct LoadMark {
    at: Duration,
    cpu: Duration,
    bytes: u64,
}

pub(in crate::cli) fn load(options: &LoadArguments) -> Result<ExitCode, Failure> {
    let console = ConsoleOptions {
        typed_by: FlownBy::Hand,
        api: None,
        class: None,
        crew: None,
        backend: crate::hangar::VehicleBackend::default(),
        ardupilot: None,
        opening: Opening::Free,
        vehicles: options.vehicles,
        seed: Some(1),
        speedup: 1.0,
        forwards: Vec::new(),
        look: Look::default(),
        preferences: Preferences::default(),
    };
    let seconds = |seconds| Duration::from_secs(seconds);
    // A kilometre at 10 m/s takes longer than the measurement.
    let lines = [
        (seconds(3), "all guided"),
        (seconds(4), "all arm"),
        (seconds(6), "all takeoff 20"),
        (seconds(20), "all goto n 1000 e 0 up 30"),
    ];
    let until = WARM_UP + seconds(options.seconds);
    let mut marks: Vec<LoadMark> = Vec::new();
    let mut unreadable = None;
    runtime()?.block_on(shell::drive(console, SIZE, &lines, |now, bytes| {
        if now >= WARM_UP && marks.is_empty() || now >= until {
            match processor_time() {
                Ok(cpu) => marks.push(LoadMark {
                    at: now,
                    cpu,
                    bytes,
                }),
                Err(error) => unreadable = Some(error),
            }
        }
        if marks.len() == 2 || unreadable.is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }))?;
    let [start, end] = marks.as_slice() else {
        return Err(Failure::Failed(anyhow::anyhow!(
            "this system does not show the processor time of a process in /proc/self/task: {}",
            unreadable.map_or(String::new(), |error| error.to_string())
        )));
    };
    print(options, start, end)?;
    Ok(ExitCode::SUCCESS)
}

fn print(options: &LoadArguments, start: &LoadMark, end: &LoadMark) -> Result<(), Failure> {
    let window_s = end.at.saturating_sub(start.at).as_secs_f64();
    let core_percent = end.cpu.saturating_sub(start.cpu).as_secs_f64() / window_s * 100.0;
    let measured = LoadCost {
        vehicles: options.vehicles,
        window_s,
        core_percent,
        core_percent_per_vehicle: core_percent / f64::from(options.vehicles),
        bytes_per_s: (end.bytes - start.bytes) as f64 / window_s,
    };
    if options.json {
        say!("{}", serde_json::to_string(&measured)?)?;
        return Ok(());
    }
    say!("vehicles flying      {:>8}", measured.vehicles)?;
    say!("measured for         {:>8.1} s", measured.window_s)?;
    say!(
        "whole process        {:>8.2} % of a core",
        measured.core_percent
    )?;
    say!(
        "per vehicle          {:>8.3} % of a core",
        measured.core_percent_per_vehicle
    )?;
    say!(
        "to the terminal      {:>8.0} bytes per second",
        measured.bytes_per_s
    )?;
    Ok(())
}

/// Processor time of all threads of this process (Linux: the first number of each `schedstat`, nanoseconds).
fn processor_time() -> std::io::Result<Duration> {
    let mut total = Duration::ZERO;
    for task in fs::read_dir("/proc/self/task")? {
        let text = fs::read_to_string(task?.path().join("schedstat"))?;
        let nanoseconds = text.split(' ').next().and_then(|first| first.parse().ok());
        total += Duration::from_nanos(nanoseconds.unwrap_or(0));
    }
    Ok(total)
}
