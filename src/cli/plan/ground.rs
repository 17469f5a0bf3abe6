//! The ground below plans, from files.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, invalid};
use crate::draft::squares;
use crate::geo::Terrain;
use crate::plan::Document;
use crate::plan::check::{Finding, USUAL_CLEARANCE_M, check_terrain, legs};
use crate::store;
use crate::text;
use crate::text::Locale;

/// Options about the ground.
#[derive(Debug, Clone, Args)]
pub(super) struct GroundArguments {
    /// Compare heights with the ground: a folder of SRTM files such as N50E030.hgt.
    #[arg(long, value_name = "DIR")]
    terrain: Option<PathBuf>,
    /// Fly at least this far above the ground, in metres.
    #[arg(long, value_name = "M", default_value_t = USUAL_CLEARANCE_M, requires = "terrain", value_parser = parse_clearance)]
    clearance: f64,
}

fn parse_clearance(text: &str) -> Result<f64, String> {
    let metres = text.parse().ok();
    metres
        .filter(|metres: &f64| (0.0..=1000.0).contains(metres))
        .ok_or_else(|| "expected a number of metres from 0 to 1000".to_owned())
}

/// The ground below a plan, and the minimum height above it.
pub(super) struct Ground {
    terrain: Terrain,
    clearance_m: f64,
}

impl Ground {
    /// The faults in the heights of a plan.
    pub(super) fn findings(&self, document: &Document) -> Vec<Finding> {
        let height = |place| self.terrain.height_m(place);
        check_terrain(document, &height, self.clearance_m)
    }

    /// The minimum height of a plan above the ground, in metres, and the index, from 0, of the item
    /// that ends the leg with this height; `None` if no leg has known ground.
    pub(super) fn lowest(&self, document: &Document) -> Option<(f64, usize)> {
        let height = |place| self.terrain.height_m(place);
        let legs = legs(document, &height).into_iter();
        let heights = legs.filter_map(|leg| Some((leg.lowest?[0], leg.item)));
        heights.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl GroundArguments {
    /// Whether heights are compared with the ground.
    pub(super) fn is_known(&self) -> bool {
        self.terrain.is_some()
    }

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
            store::add_square(&mut terrain, folder, square)
                .map_err(|reason| invalid(&reason, locale))?;
        }
        Ok(Some(Ground {
            terrain,
            clearance_m: self.clearance,
        }))
    }
}
