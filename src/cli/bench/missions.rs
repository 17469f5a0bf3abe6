//! `sortie bench missions`: the speed of the shipped missions, relative to real time.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use nix::time::{ClockId, clock_gettime};
use serde::Serialize;

use super::super::Failure;
use super::super::run::{load_mission, load_script};
use crate::exercise::Exercise;
use crate::mission::{Mission, Report};
use crate::store;

/// Options of `sortie bench missions`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench missions\n  \
    sortie bench missions 06 08 --vehicles 16 --json")]
pub(in crate::cli) struct MissionsArguments {
    /// Missions by name or number; by default all shipped ones.
    missions: Vec<String>,
    /// Also fly each mission with this many vehicles, if it is made for fewer.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u8).range(1..=100))]
    vehicles: u8,
    /// Use this seed for the missions' worlds.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

/// The cost of one flight of the reference pilot, in processor time, so that other load does not
/// change the result.
#[derive(Debug, Serialize)]
struct MissionCost {
    mission: String,
    vehicles: usize,
    sim_time_s: f64,
    cpu_ms: f64,
    realtime_factor: f64,
    score: u16,
}

pub(in crate::cli) fn missions(options: &MissionsArguments) -> Result<ExitCode, Failure> {
    let all = store::missions();
    let names = match &options.missions[..] {
        [] => all.iter().map(|source| source.stem().to_owned()).collect(),
        some => some.to_vec(),
    };
    let mut measured = Vec::new();
    for name in &names {
        let row = measure(load_mission(name)?, options.seed)?;
        let vehicles = usize::from(options.vehicles);
        let more = row.vehicles < vehicles;
        measured.push(row);
        if more {
            let mission = load_mission(name)?.enlarged(vehicles);
            measured.push(measure(mission, options.seed)?);
        }
    }
    if options.json {
        say!("{}", serde_json::to_string(&measured)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    say!("mission                 vehicles  flown s  processor ms  x real time  score")?;
    for row in measured {
        say!(
            "{:<22}  {:>8}  {:>7.1}  {:>12.1}  {:>11.0}  {:>5}",
            row.mission,
            row.vehicles,
            row.sim_time_s,
            row.cpu_ms,
            row.realtime_factor,
            row.score
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn measure(mission: Mission, seed: u64) -> Result<MissionCost, Failure> {
    let script = load_script(&mission.id, &mission)?;
    let mission = Arc::new(mission);
    let before = processor_time()?;
    let mut exercise = Exercise::new(Arc::clone(&mission), seed, script, Vec::new());
    while !exercise.is_over() {
        exercise.step();
        exercise.take_notices();
    }
    let report: Report = exercise.report();
    let cpu = processor_time()?.saturating_sub(before).as_secs_f64();
    Ok(MissionCost {
        mission: mission.id.clone(),
        vehicles: mission.seats.count,
        sim_time_s: report.sim_time_s,
        cpu_ms: cpu * 1e3,
        realtime_factor: report.sim_time_s / cpu,
        score: report.score,
    })
}

/// Processor time of this thread, which flies alone.
fn processor_time() -> Result<Duration, Failure> {
    let time = clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).map_err(anyhow::Error::from)?;
    Ok(Duration::from(time))
}
