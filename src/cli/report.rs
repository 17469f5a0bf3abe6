//! `sortie report`: a profile's progress as a document. The tables and their columns, also those of the CSV, are in
//! `progress`; this module adds the column with the profile.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::SystemTime;

use clap::{Args, ValueEnum};
use serde::Serialize;

use super::settings::CliSettings;
use super::table::escaped;
use super::{Failure, progress, trainee};
use crate::campaign::CareerProgress;
use crate::store::{self, PastRun, Profile, day_of};
use crate::text;
use crate::text::Locale;

/// Options of `sortie report`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie report --profile anna\n  \
    sortie report --format json --output anna.json\n  \
    sortie report --format csv --table missions > missions.csv")]
pub(super) struct ReportArguments {
    /// Write the report in this format.
    #[arg(long, value_enum, default_value = "md")]
    format: ReportFormat,
    /// Write this table, if the format is CSV.
    #[arg(long, value_enum, default_value = "runs")]
    table: Which,
    /// Write to this file; `-` is standard output.
    #[arg(long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ReportFormat {
    /// Markdown: a table for each part of the progress.
    Md,
    /// Comma-separated values: one table.
    Csv,
    /// One JSON document with everything.
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// The state of each mission.
    Missions,
    /// The state of each skill.
    Skills,
    /// A row for every flight.
    Runs,
}

#[derive(Debug, Serialize)]
struct ReportDocument<'a> {
    profile: &'a str,
    since: &'a str,
    #[serde(flatten)]
    progress: &'a CareerProgress,
    runs: &'a [PastRun],
}

/// Writes the report of a profile.
pub(super) fn report(
    options: &ReportArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let profiles = trainee::open_to_read(settings, &locale)?;
    let profile = trainee::choose(&profiles, None, settings, &locale)?;
    let refused = |error| trainee::refused(&error, &locale);
    let history = profiles.history(&profile).map_err(refused)?;
    let runs = profiles.runs(&profile).map_err(refused)?;
    let progress = CareerProgress::of(&store::course(), &history, day_of(SystemTime::now()));
    let text = match options.format {
        ReportFormat::Md => markdown(&profile, &progress, &runs, &locale),
        ReportFormat::Csv => {
            let table = match options.table {
                Which::Missions => progress::missions(&progress, &locale),
                Which::Skills => progress::skills(&progress, &locale),
                Which::Runs => progress::runs(&runs, &locale),
            };
            let trainee = text!("progress-trainee");
            table.led_by(&trainee, &profile.name, &locale).csv()?
        }
        ReportFormat::Json => {
            let document = ReportDocument {
                profile: &profile.name,
                since: &profile.since,
                progress: &progress,
                runs: &runs,
            };
            serde_json::to_string_pretty(&document)? + "\n"
        }
    };
    let text = text.trim_end_matches('\n');
    store::write_output(
        &options.output,
        &format!("{text}\n"),
        settings.config.results.readers,
    )?;
    Ok(ExitCode::SUCCESS)
}

fn markdown(
    profile: &Profile,
    progress: &CareerProgress,
    runs: &[PastRun],
    locale: &Locale,
) -> String {
    let words = |text| locale.text(&text);
    let lines: Vec<String> = progress::heading(progress)
        .iter()
        .map(|line| locale.text(line))
        .collect();
    let day: String = profile.since.chars().take(10).collect();
    format!(
        "# {}\n\n{}\n\n{}\n\n## {}\n\n{}\n## {}\n\n{}\n## {}\n\n{}",
        words(text!("progress-title", name = escaped(&profile.name))),
        words(text!("progress-since", day = day)),
        lines.join("\n\n"),
        words(text!("progress-missions")),
        progress::missions(progress, locale).markdown(),
        words(text!("progress-skills")),
        progress::skills(progress, locale).markdown(),
        words(text!("progress-runs")),
        progress::runs(runs, locale).markdown(),
    )
}
