//! `sortie class report`: the results of a class.

use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::results::ReadClass;
use super::tables;
use crate::class_results::{ClassResults, ClassTrainee, TryWithoutRecord};
use crate::cli::Failure;
use crate::cli::settings::CliSettings;
use crate::cli::table::TextTable;
use crate::exam_seal::SealCheck;
use crate::record::InstructorAct;
use crate::text;
use crate::text::{Locale, Text};

/// Options of `sortie class report`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
                        sortie class report 9-A\n  \
                        sortie class report 9-A --json > 9-A.json")]
pub(super) struct ReportArguments {
    /// The name of the class, or the path of its folder; by default your user name.
    #[arg(value_name = "NAME|PATH")]
    name: Option<String>,
    /// Print one JSON document instead of tables.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct ClassDocument<'a> {
    class: &'a str,
    #[serde(flatten)]
    results: &'a ClassResults,
    /// The flights in which an instructor flew vehicles, or recalled a situation.
    instructed: Vec<InstructedFlight<'a>>,
    /// The tries of exams.
    exams: Vec<&'a SealCheck>,
    /// The tries of exams of which no record was handed in.
    missing: &'a [TryWithoutRecord],
}

/// A flight of a trainee, and what an instructor did in it.
#[derive(Serialize)]
struct InstructedFlight<'a> {
    user: &'a str,
    mission: &'a str,
    record: &'a str,
    acts: &'a [InstructorAct],
}

fn instructed(trainees: &[ClassTrainee]) -> Vec<InstructedFlight<'_>> {
    let flights = trainees
        .iter()
        .flat_map(|trainee| trainee.instructed().map(move |flight| (trainee, flight)));
    flights
        .map(|(trainee, flight)| InstructedFlight {
            user: &trainee.user,
            mission: &flight.flight.mission,
            record: &flight.record,
            acts: flight.instructor.acts(),
        })
        .collect()
}

pub(super) fn report(
    arguments: &ReportArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let class = ReadClass::read(arguments.name.as_deref(), settings)?;
    let results = class.results();
    if arguments.json {
        let document = ClassDocument {
            class: &class.name,
            results: &results,
            instructed: instructed(&class.trainees),
            exams: class
                .trainees
                .iter()
                .flat_map(|it| it.flights.iter().filter_map(|flight| flight.seal.as_ref()))
                .collect(),
            missing: &class.missing,
        };
        say!("{}", serde_json::to_string_pretty(&document)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let locale = &class.locale;
    let count = results.trainees.len();
    let title = text!("class-report-title", class = class.name, count = count);
    say!("{}", locale.text(&title))?;
    if results.missions.is_empty() {
        say!("\n{}", locale.text(&text!("class-report-none")))?;
    }
    let exams = (
        text!("class-report-exams"),
        tables::exams(&class.trainees, &class.missing, locale),
    );
    let instructed = (
        text!("class-report-instructed"),
        tables::instructed(&class.trainees, locale),
    );
    let sections = sections(&results, locale).into_iter();
    for (heading, table) in sections.chain([instructed, exams]) {
        if !table.is_empty() {
            let heading = locale.text(&heading);
            say!("\n{heading}\n{}", table.plain().trim_end())?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The tables with their headings.
fn sections(results: &ClassResults, locale: &Locale) -> [(Text, TextTable); 5] {
    [
        (
            text!("class-report-missions"),
            tables::by_mission(results, locale),
        ),
        (
            text!("class-report-skills"),
            tables::by_skill(results, locale),
        ),
        (
            text!("class-report-spread"),
            tables::missions(results, locale),
        ),
        (
            text!("class-report-objectives"),
            tables::objectives(results, locale),
        ),
        (
            text!("class-report-skill-spread"),
            tables::skills(results, locale),
        ),
    ]
}
