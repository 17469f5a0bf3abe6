//! The vehicles of a task, and how they fly.

use std::path::{Path, PathBuf};

use clap::Args;

use super::super::rehearse::AirArguments;
use super::super::{Failure, invalid, load, parse_height};
use super::place::{Degrees, parse_degrees, parse_places};
use crate::cli::fault::FileFault;
use crate::plan::generate::{USUAL_HEIGHT_M, source};
use crate::plan::{Home, Item, ReadOptions};
use crate::text;
use crate::text::Locale;

/// The distance between vehicles of one home, in metres.
const SIDE_BY_SIDE_M: f64 = 8.0;

/// Options of all tasks.
#[derive(Debug, Args)]
pub(super) struct TeamArguments {
    /// Make plans for this many vehicles, which stand 8 m apart in a row from the home to the east.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=250))]
    vehicles: u16,
    /// The home of the first vehicle: latitude, longitude, and height above sea level in metres.
    #[arg(long, allow_hyphen_values = true, value_name = "LAT,LON[,ALT]", value_parser = parse_degrees)]
    home: Option<Degrees>,
    /// The home of each vehicle: `LAT,LON[,ALT] LAT,LON[,ALT] ..`, or a file with points.
    #[arg(long, allow_hyphen_values = true, value_name = "PLACES|FILE", conflicts_with_all = ["vehicles", "home"])]
    homes: Option<String>,
    /// Work at this height above the first home, in metres.
    #[arg(long, value_name = "M", default_value_t = USUAL_HEIGHT_M as f32, value_parser = parse_height)]
    pub(super) height: f32,
    /// Keep the heights at which vehicles cross this far apart, in metres.
    #[arg(long, value_name = "M", default_value_t = 6.0, value_parser = super::super::deconflict::parse_layer)]
    pub(super) layer: f32,
    /// Fly at this speed, in m/s; by default at the vehicle's own speed.
    #[arg(long, value_name = "M/S", value_parser = parse_speed)]
    pub(super) speed: Option<f64>,
    /// Stay inside the fence of this file; the plans contain it.
    #[arg(long, value_name = "FILE")]
    fence: Option<PathBuf>,
    /// Write the plans to `part-1.plan` and so on in this folder, or to files with this name, in which `{id}` is the
    /// vehicle's number and the extension decides the format.
    #[arg(long, value_name = "DIR|NAME")]
    pub(super) write: Option<PathBuf>,
    /// Replace files that exist.
    #[arg(long)]
    pub(super) force: bool,
    #[command(flatten)]
    pub(super) air: AirArguments,
}

fn parse_speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok();
    speed
        .filter(|speed: &f64| (0.5..=50.0).contains(speed))
        .ok_or_else(|| "expected a speed from 0.5 to 50 m/s".to_owned())
}

fn home(place: Degrees) -> Home {
    let (x, y) = place.at.to_e7();
    Home {
        x,
        y,
        z: place.amsl_m.unwrap_or_default() as f32,
    }
}

impl TeamArguments {
    /// The home of each vehicle.
    pub(super) fn homes(&self, locale: &Locale) -> Result<Vec<Home>, Failure> {
        if let Some(given) = &self.homes {
            let places = match parse_places(given) {
                Ok(places) => places.0,
                Err(error) if !Path::new(given).is_file() => {
                    let text = text!("plan-generate-homes", error = error);
                    return Err(invalid(&text, locale));
                }
                Err(_) => points_of(Path::new(given))?,
            };
            if places.is_empty() {
                return Err(invalid(&text!("plan-generate-no-homes"), locale));
            }
            return Ok(places.into_iter().map(home).collect());
        }
        let missing = || invalid(&text!("plan-generate-no-home"), locale);
        let first = self.home.ok_or_else(missing)?;
        let beside = |index: u16| Degrees {
            at: first.at.moved(0.0, SIDE_BY_SIDE_M * f64::from(index)),
            ..first
        };
        Ok((0..self.vehicles)
            .map(|index| home(beside(index)))
            .collect())
    }

    /// The fence in which the vehicles stay.
    pub(super) fn fence(&self, locale: &Locale) -> Result<Vec<Item>, Failure> {
        let Some(path) = &self.fence else {
            return Ok(Vec::new());
        };
        let loaded = load(path, ReadOptions::default()).map_err(FileFault::failure)?;
        if loaded.document.fence.is_empty() {
            let file = path.display().to_string();
            return Err(invalid(
                &text!("plan-generate-no-fence", file = file),
                locale,
            ));
        }
        Ok(loaded.document.fence)
    }
}

/// The points of a file, or its home.
fn points_of(path: &Path) -> Result<Vec<Degrees>, Failure> {
    let loaded = load(path, ReadOptions::default()).map_err(FileFault::failure)?;
    let places = source::places(&loaded.document);
    Ok(places
        .into_iter()
        .map(|at| Degrees { at, amsl_m: None })
        .collect())
}
