//! `sortie plan check`.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::{Failure, ShapeArguments, load};
use crate::cli::fault::FileFault;
use crate::plan::ReadOptions;
use crate::plan::check::{CheckOptions, Severity, VehicleKind, check as findings};
use crate::preflight;
use crate::text;
use crate::text::Locale;

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
    terrain: bool,
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
        has_terrain: options.terrain,
    };
    let mut faulty = false;
    for path in &options.files {
        faulty |= report(path, options.shapes.options(), &rules, locale)?;
    }
    Ok(ExitCode::from(u8::from(faulty)))
}

/// Prints the faults of a plan file; returns whether there is an error.
pub(in crate::cli) fn report(
    path: &Path,
    reading: ReadOptions,
    rules: &CheckOptions,
    locale: &Locale,
) -> Result<bool, io::Error> {
    let name = path.display().to_string();
    let loaded = match load(path, reading) {
        Ok(loaded) => loaded,
        Err(FileFault::Inside(source, faults)) => {
            for fault in faults {
                say!("{}", locale.text(&fault.text(&source.name, &source.text)))?;
            }
            return Ok(true);
        }
        Err(FileFault::Whole(text)) => {
            tell!("sortie: {}", locale.text(&text));
            return Ok(true);
        }
    };
    let remarks = preflight::remarks(&loaded, &findings(&loaded.document, rules));
    for remark in &remarks {
        let line = locale.text(&remark.diagnostic.text(&name, &loaded.text));
        match remark.severity {
            Severity::Error => say!("{line}")?,
            Severity::Warning => say!("{line} {}", locale.text(&text!("plan-warning")))?,
        }
    }
    let faulty = remarks
        .iter()
        .any(|remark| remark.severity == Severity::Error);
    let content = locale.text(&preflight::summary(&loaded.document));
    if faulty {
        say!("{name}: {content}")?;
    } else {
        say!("{name}: {}: {content}", locale.text(&text!("plan-good")))?;
    }
    Ok(faulty)
}
