//! `sortie plan check`: prints the faults of plan files.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::ground::{Ground, GroundArguments};
use super::{Failure, ShapeArguments, load};
use crate::cli::fault::FileFault;
use crate::plan::check::{CheckOptions, Severity, VehicleKind, check as findings};
use crate::plan::{Document, Loaded, ReadOptions};
use crate::preflight::{self, Remark};
use crate::text;
use crate::text::{Locale, figure};

/// Options of `sortie plan check`.
#[derive(Debug, Args)]
pub(in crate::cli) struct CheckArguments {
    /// Plan files of any format.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Check for this kind of vehicle; by default the kind that the file names, or a copter.
    #[arg(long, value_enum, value_name = "KIND")]
    vehicle: Option<Vehicle>,
    /// Report heights above this limit (`FENCE_ALT_MAX`), in metres above home.
    #[arg(long, value_name = "M")]
    ceiling: Option<f32>,
    /// Report places farther from home than this (`FENCE_RADIUS`), in metres.
    #[arg(long, value_name = "M")]
    radius: Option<f32>,
    /// The vehicle has terrain data for the area.
    #[arg(long)]
    has_terrain: bool,
    #[command(flatten)]
    ground: GroundArguments,
    #[command(flatten)]
    shapes: ShapeArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Vehicle {
    Copter,
    Plane,
    Rover,
}

impl From<Vehicle> for VehicleKind {
    fn from(vehicle: Vehicle) -> Self {
        match vehicle {
            Vehicle::Copter => Self::Copter,
            Vehicle::Plane => Self::Plane,
            Vehicle::Rover => Self::Rover,
        }
    }
}

pub(super) fn check(options: &CheckArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let rules = CheckOptions {
        vehicle: options.vehicle.map(VehicleKind::from),
        ceiling_m: options.ceiling,
        radius_m: options.radius,
        has_terrain: options.has_terrain,
        may_slope: options.ground.is_known(),
    };
    let checking = Checking {
        reading: options.shapes.options(),
        rules,
        ground: Some(options.ground.clone()),
    };
    let mut faulty = false;
    for path in &options.files {
        faulty |= report(path, &checking, locale)?;
    }
    Ok(ExitCode::from(u8::from(faulty)))
}

/// The options of a check.
#[derive(Debug, Default)]
pub(in crate::cli) struct Checking {
    reading: ReadOptions,
    rules: CheckOptions,
    ground: Option<GroundArguments>,
}

/// Prints the faults of a plan file; returns whether one of them is an error.
pub(in crate::cli) fn report(
    path: &Path,
    checking: &Checking,
    locale: &Locale,
) -> Result<bool, Failure> {
    let name = path.display().to_string();
    let loaded = match load(path, checking.reading) {
        Ok(loaded) => loaded,
        Err(FileFault::Inside(source, faults)) => {
            for fault in faults {
                say!("{}", locale.text(&fault.text(&source.name, &source.text)))?;
            }
            return Ok(true);
        }
        Err(FileFault::Whole(text) | FileFault::Closed { text, .. }) => {
            tell!("sortie: {}", locale.text(&text));
            return Ok(true);
        }
    };
    let ground = match &checking.ground {
        Some(ground) => ground.below(&loaded.document, locale)?,
        None => None,
    };
    let mut found = findings(&loaded.document, &checking.rules);
    found.extend(ground.iter().flat_map(|it| it.findings(&loaded.document)));
    let remarks = preflight::remarks(&loaded, &found);
    print_remarks(&name, &loaded, &remarks, locale)?;
    let faulty = remarks
        .iter()
        .any(|remark| remark.severity == Severity::Error);
    let content = locale.text(&preflight::summary(&loaded.document));
    if let Some(ground) = &ground {
        print_lowest(&name, &loaded.document, ground, locale)?;
    }
    if faulty {
        say!("{name}: {content}")?;
    } else {
        say!("{name}: {}: {content}", locale.text(&text!("plan-good")))?;
    }
    Ok(faulty)
}

fn print_remarks(
    name: &str,
    loaded: &Loaded,
    remarks: &[Remark],
    locale: &Locale,
) -> Result<(), Failure> {
    for remark in remarks {
        let line = locale.text(&remark.diagnostic.text(name, &loaded.text));
        match remark.severity {
            Severity::Error => say!("{line}")?,
            Severity::Warning => say!("{line} {}", locale.text(&text!("plan-warning")))?,
        }
    }
    Ok(())
}

/// Prints where the plan is nearest to the ground.
fn print_lowest(
    name: &str,
    document: &Document,
    ground: &Ground,
    locale: &Locale,
) -> Result<(), Failure> {
    if let Some((height_m, item)) = ground.lowest(document) {
        let height = figure(height_m, 0);
        let lowest = text!("plan-terrain-lowest", height = height, number = item + 1);
        say!("{name}: {}", locale.text(&lowest))?;
    }
    Ok(())
}
