//! The ground below plans, from files.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Failure, invalid};
use crate::geo::{Extent, LatLon, Square, Terrain};
use crate::plan::check::{Finding, check_terrain, legs};
use crate::plan::{Document, Item};
use crate::store::{self, StoreError};
use crate::text;
use crate::text::{Locale, Text};

/// More than the largest file: 3601 by 3601 points of two bytes.
const MOST_BYTES: u64 = 26_000_000;
/// The most squares that are read for one plan.
const MOST_SQUARES: usize = 36;

/// Options about the ground.
#[derive(Debug, Clone, Args)]
pub(super) struct GroundArguments {
    /// Compare heights with the ground: a folder of SRTM files such as N50E030.hgt.
    #[arg(long, value_name = "DIR")]
    terrain: Option<PathBuf>,
    /// Fly at least this far above the ground, in metres.
    #[arg(long, value_name = "M", default_value_t = 10.0, requires = "terrain", value_parser = parse_clearance)]
    clearance: f64,
}

fn parse_clearance(text: &str) -> Result<f64, String> {
    let metres = text.parse().ok();
    metres
        .filter(|metres: &f64| (0.0..=1000.0).contains(metres))
        .ok_or_else(|| "expected a number of metres from 0 to 1000".to_owned())
}

/// The ground below a plan, and the least height above it.
pub(super) struct Ground {
    terrain: Terrain,
    clearance_m: f64,
}

impl Ground {
    /// What is wrong with the heights of a plan.
    pub(super) fn findings(&self, document: &Document) -> Vec<Finding> {
        let height = |place| self.terrain.height_m(place);
        check_terrain(document, &height, self.clearance_m)
    }

    /// The least height of a plan above the ground, in metres, and the item to which that leg leads, counted from 0.
    pub(super) fn lowest(&self, document: &Document) -> Option<(f64, usize)> {
        let height = |place| self.terrain.height_m(place);
        let legs = legs(document, &height).into_iter();
        let heights = legs.filter_map(|leg| Some((leg.lowest?[0], leg.item)));
        heights.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl GroundArguments {
    /// The ground below a plan; `None` if no folder was given.
    pub(super) fn below(
        &self,
        document: &Document,
        locale: &Locale,
    ) -> Result<Option<Ground>, Failure> {
        let Some(folder) = &self.terrain else {
            return Ok(None);
        };
        if !folder.is_dir() {
            let text = text!(
                "plan-terrain-no-folder",
                path = folder.display().to_string()
            );
            return Err(invalid(&text, locale));
        }
        let mut terrain = Terrain::default();
        for square in squares(document) {
            read_square(&mut terrain, folder, square, locale)?;
        }
        Ok(Some(Ground {
            terrain,
            clearance_m: self.clearance,
        }))
    }
}

/// The squares over which a plan leads.
fn squares(document: &Document) -> Vec<Square> {
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let places = document.plan.iter().filter_map(Item::place);
    let Some(extent) = Extent::around(places.chain(home)) else {
        return Vec::new();
    };
    let [south_west, _, north_east, _] = extent.corners().map(Square::of);
    let squares = (south_west.lat..=north_east.lat)
        .flat_map(|lat| (south_west.lon..=north_east.lon).map(move |lon| Square { lat, lon }));
    squares.take(MOST_SQUARES).collect()
}

/// Reads the file of a square, if there is one.
fn read_square(
    terrain: &mut Terrain,
    folder: &Path,
    square: Square,
    locale: &Locale,
) -> Result<(), Failure> {
    let path = folder.join(square.file_name());
    let bytes = match store::read_start(&path, MOST_BYTES) {
        Ok(bytes) => bytes,
        Err(StoreError::Unreadable { error, .. }) if error.kind() == ErrorKind::NotFound => {
            return Ok(());
        }
        Err(error) => return Err(invalid(&Text::from(&error), locale)),
    };
    terrain.add(square, &bytes).map_err(|wrong| {
        let path = path.display().to_string();
        invalid(
            &text!("plan-terrain-size", path = path, bytes = wrong.0),
            locale,
        )
    })
}
