//! `sortie bench campaign`: the whole course, flown by the reference pilots.

use std::process::ExitCode;

use clap::Args;

use super::super::Failure;
use super::super::run::{load_mission, load_script};
use crate::exercise::{Playthrough, PlaythroughFlight};
use crate::store;

/// The day of the first flight; the result does not depend on it.
const FIRST_DAY: i64 = 20_000;

/// Options of `sortie bench campaign`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench campaign\n  \
    sortie bench campaign --seed 7 --flights 20 --json")]
pub(in crate::cli) struct CampaignArguments {
    /// Use this seed for the first flight, and the next one for each further flight.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Fly at most this many flights.
    #[arg(long, default_value_t = 120)]
    flights: usize,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

/// Flies the course and prints the results; exit code 1 if it was not completed.
pub(in crate::cli) fn campaign(options: &CampaignArguments) -> Result<ExitCode, Failure> {
    let mut pilots = Vec::new();
    for offer in store::course().offers() {
        let mission = load_mission(&offer.id)?;
        let script = load_script(&mission.id, &mission)?;
        pilots.push((mission, script));
    }
    let mut career = Playthrough::new(pilots, FIRST_DAY, options.seed);
    let mut laps: Vec<PlaythroughFlight> = Vec::new();
    if !options.json {
        say!(
            "flight  day  mission                 score  medal   credits  level  licence  skill  bought"
        )?;
    }
    while !career.is_complete() && laps.len() < options.flights {
        let Some(lap) = career.fly() else { break };
        if !options.json {
            let medal = lap
                .medal
                .map_or_else(|| "-".to_owned(), |it| it.title().to_string());
            say!(
                "{:>6}  {:>3}  {:<22}  {:>5}  {:<6}  {:>7}  {:>5}  {:>7}  {:>3.0} %  {}",
                laps.len() + 1,
                lap.day - FIRST_DAY + 1,
                lap.mission,
                lap.score,
                if lap.passed { &medal } else { "failed" },
                lap.credits,
                lap.level,
                lap.licence,
                lap.mean_skill_percent,
                lap.bought.join(", ")
            )?;
        }
        laps.push(lap);
    }
    if options.json {
        say!("{}", serde_json::to_string_pretty(&laps)?)?;
    } else if career.is_complete() {
        say!("All missions were passed.")?;
    } else {
        say!("Some missions were not passed.")?;
    }
    Ok(ExitCode::from(u8::from(!career.is_complete())))
}
