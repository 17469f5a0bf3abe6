//! `sortie plan survey`, `search`, `line` and `orbit`: one plan for each vehicle from a task.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::{Failure, invalid};
use crate::plan::generate::source::with_areas;
use crate::plan::generate::{
    Course, GenerateError, Manner, Task, USUAL_SECTOR_M, USUAL_SPACING_M, USUAL_TURNS, generate,
};
use crate::preflight::ungenerated;
use crate::text::Locale;

mod place;
mod report;
mod team;

use place::{Degrees, Places, ShapeSource, parse_degrees, parse_places};
use team::TeamArguments;

/// Options of `sortie plan survey`.
#[derive(Debug, Args)]
pub(super) struct SurveyArguments {
    #[command(flatten)]
    area: ShapeArguments,
    /// Fly lines at most this far apart, in metres.
    #[arg(long, value_name = "M", default_value_t = USUAL_SPACING_M, value_parser = parse_gap)]
    spacing: f64,
    /// Fly the lines in this direction: degrees, `best` (the least energy), `long` or `short` (along that side).
    #[arg(long, value_name = "DEG|WORD", default_value = "best", value_parser = parse_course)]
    course: Course,
    #[command(flatten)]
    team: TeamArguments,
}

/// Options of `sortie plan search`.
#[derive(Debug, Args)]
pub(super) struct SearchArguments {
    /// The pattern: `square` and `sector` around a datum, `parallel` and `creeping` lines over an area.
    #[arg(value_enum)]
    pattern: SearchPattern,
    #[command(flatten)]
    area: ShapeArguments,
    /// The most likely place, for `square` and `sector`; without it, the first point of FILE.
    #[arg(long, allow_hyphen_values = true, value_name = "LAT,LON", value_parser = parse_degrees)]
    datum: Option<Degrees>,
    /// Search within this distance of the datum, in metres; for `sector`, the length of a leg.
    #[arg(long, value_name = "M", default_value_t = USUAL_SECTOR_M, value_parser = parse_gap)]
    radius: f64,
    /// Fly tracks at most this far apart, in metres.
    #[arg(long, value_name = "M", default_value_t = USUAL_SPACING_M, value_parser = parse_gap)]
    spacing: f64,
    #[command(flatten)]
    team: TeamArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SearchPattern {
    /// An expanding square, divided among the vehicles.
    Square,
    /// Sectors through the datum, flown by each vehicle at its own height.
    Sector,
    /// Lines along the longer side of an area.
    Parallel,
    /// Lines along the shorter side of an area.
    Creeping,
}

/// Options of `sortie plan line`.
#[derive(Debug, Args)]
pub(super) struct LineArguments {
    #[command(flatten)]
    line: ShapeArguments,
    /// Fly lanes this far apart, in metres.
    #[arg(long, value_name = "M", default_value_t = 15.0, value_parser = parse_gap)]
    spacing: f64,
    #[command(flatten)]
    team: TeamArguments,
}

/// Options of `sortie plan orbit`.
#[derive(Debug, Args)]
pub(super) struct OrbitArguments {
    #[command(flatten)]
    place: ShapeArguments,
    /// The place; without it, the first point of FILE.
    #[arg(long, allow_hyphen_values = true, value_name = "LAT,LON", value_parser = parse_degrees)]
    datum: Option<Degrees>,
    /// Fly circles of this radius, in metres.
    #[arg(long, value_name = "M", default_value_t = 40.0, value_parser = parse_gap)]
    radius: f64,
    /// Fly this many turns.
    #[arg(long, value_name = "N", default_value_t = USUAL_TURNS, value_parser = clap::value_parser!(u8).range(1..))]
    turns: u8,
    #[command(flatten)]
    team: TeamArguments,
}

/// Options that give the shape.
#[derive(Debug, Args)]
struct ShapeArguments {
    /// A file with the shape: KML, KMZ, `GeoJSON`, the fence or the places of a plan.
    #[arg(value_name = "FILE", conflicts_with = "points")]
    file: Option<PathBuf>,
    /// The places of the shape instead of a file: `LAT,LON LAT,LON ..`.
    #[arg(long, allow_hyphen_values = true, value_name = "PLACES", value_parser = parse_places)]
    points: Option<Places>,
    /// Use this area of FILE, counted from 1.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    area: Option<u16>,
}

impl ShapeArguments {
    fn source(&self) -> ShapeSource<'_> {
        ShapeSource {
            file: self.file.as_deref(),
            points: self.points.as_ref(),
            area: self.area,
        }
    }
}

fn parse_gap(text: &str) -> Result<f64, String> {
    let metres = text.parse().ok();
    metres
        .filter(|metres: &f64| (1.0..=10_000.0).contains(metres))
        .ok_or_else(|| "expected a number of metres from 1 to 10000".to_owned())
}

fn parse_course(text: &str) -> Result<Course, String> {
    let degrees = || text.parse().ok().filter(|it: &f64| it.is_finite());
    match text {
        "best" => Ok(Course::Best),
        "long" => Ok(Course::Long),
        "short" => Ok(Course::Short),
        _ => degrees()
            .map(Course::Degrees)
            .ok_or_else(|| "expected degrees, `best`, `long` or `short`".to_owned()),
    }
}

pub(super) fn survey(options: &SurveyArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let source = options.area.source();
    let task = Task::Survey {
        rings: source.rings(locale)?,
        spacing_m: options.spacing,
        course: options.course,
    };
    run(&task, source, &options.team, locale)
}

pub(super) fn search(options: &SearchArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let source = options.area.source();
    let (spacing_m, radius_m) = (options.spacing, options.radius);
    let datum = || source.place(options.datum, locale);
    let lines = |course| {
        Ok::<Task, Failure>(Task::Survey {
            rings: source.rings(locale)?,
            spacing_m,
            course,
        })
    };
    let task = match options.pattern {
        SearchPattern::Square => Task::Square {
            datum: datum()?,
            spacing_m,
            radius_m,
        },
        SearchPattern::Sector => Task::Sector {
            datum: datum()?,
            radius_m,
        },
        SearchPattern::Parallel => lines(Course::Long)?,
        SearchPattern::Creeping => lines(Course::Short)?,
    };
    run(&task, source, &options.team, locale)
}

pub(super) fn line(options: &LineArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let source = options.line.source();
    let task = Task::Line {
        points: source.line(locale)?,
        spacing_m: options.spacing,
    };
    run(&task, source, &options.team, locale)
}

pub(super) fn orbit(options: &OrbitArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let source = options.place.source();
    let task = Task::Orbit {
        centre: source.place(options.datum, locale)?,
        radius_m: options.radius,
        turns: options.turns,
    };
    run(&task, source, &options.team, locale)
}

fn run(
    task: &Task,
    shape: ShapeSource<'_>,
    team: &TeamArguments,
    locale: &Locale,
) -> Result<ExitCode, Failure> {
    let homes = team.homes(locale)?;
    let manner = Manner {
        height_m: f64::from(team.height),
        layer_m: f64::from(team.layer),
        speed_m_s: team.speed,
        fence: with_areas(team.fence(locale)?, &shape.keep_out(locale)?),
    };
    let plans = generate(task, &homes, &manner);
    let plans = plans.map_err(|error| {
        let vehicle = match error {
            GenerateError::NoWay(vehicle) => vehicle + 1,
            GenerateError::NoVehicle
            | GenerateError::Empty
            | GenerateError::TooMany(_)
            | GenerateError::TooNarrow(_)
            | GenerateError::Fence
            | GenerateError::OutsideFence => 0,
        };
        invalid(&ungenerated(error, vehicle), locale)
    })?;
    report::report(&plans, team, locale)
}
