//! `sortie plan`: plans, fences and rally points in files.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::Failure;
use super::fault::FileFault;
use super::settings::CliSettings;
use crate::plan::{FileFormat, Loaded, ReadOptions, read};
use crate::preflight;
use crate::store::{self, Source};
use crate::text::{Locale, Text};

mod check;
mod convert;
mod deconflict;
mod generate;
mod ground;
mod rehearse;

pub(super) use check::{Checking, report};

/// Options of `sortie plan`.
#[derive(Debug, Args)]
pub(super) struct PlanArguments {
    #[command(subcommand)]
    command: PlanCommand,
}

#[derive(Debug, Subcommand)]
enum PlanCommand {
    /// Checks plans by the rules of the vehicle that will fly them, and prints each fault with its line and column.
    #[command(after_help = "Examples:\n  \
                            sortie plan check survey.plan\n  \
                            sortie plan check --ceiling 120 --radius 500 *.waypoints\n  \
                            sortie plan check survey.plan --terrain srtm --clearance 20")]
    Check(check::CheckArguments),
    /// Converts a plan; the extension of OUT decides the format: .waypoints, .fence, .rally, .plan, .kml or .geojson.
    #[command(after_help = "Examples:\n  \
                            sortie plan convert survey.plan survey.waypoints --list plan\n  \
                            sortie plan convert field.kmz field.plan --height 40")]
    Convert(convert::ConvertArguments),
    /// Flies the plans of several vehicles at once in the embedded simulator, faster than real time.
    #[command(after_help = "Examples:\n  \
                            sortie plan rehearse one.plan two.plan three.plan\n  \
                            sortie plan rehearse *.waypoints --wind 8,270 --json")]
    Rehearse(rehearse::RehearseArguments),
    /// Covers an area with parallel lines, divided among vehicles: one plan each.
    #[command(after_help = "Examples:\n  \
                            sortie plan survey field.kml --home 50.45,30.52 --vehicles 4 --spacing 20 --write parts\n  \
                            sortie plan survey field.geojson --homes pads.kml --height 40 --course 30\n  \
                            sortie plan survey --points '50.45,30.52 50.46,30.52 50.46,30.54' --home 50.449,30.52")]
    Survey(generate::SurveyArguments),
    /// Makes a search pattern, divided among vehicles: expanding square or sectors around a datum, parallel or
    /// creeping lines over an area (IAMSAR).
    #[command(after_help = "Examples:\n  \
                            sortie plan search square --datum 50.45,30.52 --radius 200 --home 50.449,30.52 --vehicles 3\n  \
                            sortie plan search parallel field.kml --home 50.449,30.52 --vehicles 3 --write parts")]
    Search(generate::SearchArguments),
    /// Gives each vehicle its own lane along a line.
    #[command(after_help = "Examples:\n  \
                            sortie plan line road.geojson --home 50.449,30.52 --vehicles 3 --spacing 15 --write parts")]
    Line(generate::LineArguments),
    /// Circles a place with one or more vehicles, evenly spaced and at different heights.
    #[command(after_help = "Examples:\n  \
                            sortie plan orbit --datum 50.45,30.52 --radius 40 --turns 3 --home 50.449,30.52 --vehicles 2")]
    Orbit(generate::OrbitArguments),
    /// Proposes later starts or separate heights that keep the vehicles apart.
    #[command(after_help = "Examples:\n  \
                            sortie plan deconflict *.plan\n  \
                            sortie plan deconflict *.plan --write apart")]
    Deconflict(deconflict::DeconflictArguments),
}

/// Options for reading shapes that lack what a plan needs.
#[derive(Debug, Clone, Copy, Args)]
struct ShapeArguments {
    /// Use this height above home for lines and points of KML and `GeoJSON` that have none, in metres.
    #[arg(long, value_name = "M", default_value_t = ReadOptions::default().height_m, value_parser = parse_height)]
    height: f32,
    /// Make polygons of KML and `GeoJSON` exclusion areas instead of inclusion areas.
    #[arg(long)]
    exclude: bool,
}

impl ShapeArguments {
    fn options(self) -> ReadOptions {
        ReadOptions {
            height_m: self.height,
            polygons_keep_in: !self.exclude,
        }
    }
}

fn parse_height(text: &str) -> Result<f32, String> {
    let height = text.parse().ok();
    height
        .filter(|height: &f32| (-500.0..=10_000.0).contains(height))
        .ok_or_else(|| "expected a number of metres from -500 to 10000".to_owned())
}

pub(super) fn plan(options: &PlanArguments, settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    match &options.command {
        PlanCommand::Check(options) => check::check(options, &locale),
        PlanCommand::Convert(options) => convert::convert(options, &locale),
        PlanCommand::Rehearse(options) => rehearse::rehearse(options, &locale),
        PlanCommand::Survey(options) => generate::survey(options, &locale),
        PlanCommand::Search(options) => generate::search(options, &locale),
        PlanCommand::Line(options) => generate::line(options, &locale),
        PlanCommand::Orbit(options) => generate::orbit(options, &locale),
        PlanCommand::Deconflict(options) => deconflict::deconflict(options, &locale),
    }
}

/// Whether a file's extension is that of a plan file.
pub(super) fn is_plan_file(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| {
        ending.eq_ignore_ascii_case("kmz") || FileFormat::of_ending(ending).is_some()
    })
}

/// Reads a plan file.
///
/// # Errors
/// The file cannot be read, or has faults.
fn load(path: &Path, options: ReadOptions) -> Result<Loaded, FileFault> {
    let bytes = store::read_bytes(path, "file-plan").map_err(|error| FileFault::from(&error))?;
    read(&bytes, &options).map_err(|(text, faults)| {
        let name = path.display().to_string();
        let faults = faults.iter().map(preflight::fault).collect();
        FileFault::Inside(Source { name, text }, faults)
    })
}

/// Reads all files; returns each with its file name, without the folder.
fn load_all(paths: &[PathBuf], options: ReadOptions) -> Result<Vec<(String, Loaded)>, Failure> {
    let load = |path: &PathBuf| {
        let loaded = load(path, options).map_err(FileFault::failure)?;
        let name = path.file_name().unwrap_or(path.as_os_str());
        Ok((name.to_string_lossy().into_owned(), loaded))
    };
    paths.iter().map(load).collect()
}

fn invalid(text: &Text, locale: &Locale) -> Failure {
    Failure::Invalid(format!("sortie: {}", locale.text(text)))
}
