//! `land_on`: vehicles come down at a place and are disarmed there.

use serde::Deserialize;
use toml::Spanned;

use super::{DOWN_FOR, Kind, Scene, Standing, Tracker};
use crate::mission::Point;
use crate::mission::craft::Craft;
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::world::World;
use crate::text;
use crate::text::Text;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LandOnFile {
    place: Spanned<String>,
    radius: Spanned<f64>,
    count: Option<Spanned<usize>>,
}

#[derive(Debug, Clone)]
struct LandOn {
    place: String,
    at: Point,
    radius_m: f64,
    count: usize,
}

/// Reads a `[[objectives]]` of kind `land_on`.
pub(crate) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: LandOnFile = faults.read(section)?;
    let fleet = draft.pads.len();
    if let Some(count) = &file.count
        && fleet > 0
        && !(1..=fleet).contains(count.get_ref())
    {
        let fault = format!("`count` must lie between 1 and the {fleet} vehicles of the fleet");
        faults.add(count.span(), fault);
    }
    Some(Box::new(LandOn {
        radius_m: faults.number(&file.radius, 0.5..=1000.0, "radius"),
        count: file.count.map_or(1, Spanned::into_inner),
        at: draft.place(&file.place, faults)?,
        place: file.place.into_inner(),
    }))
}

impl Kind for LandOn {
    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl LandOn {
    fn is_there(&self, craft: &Craft) -> bool {
        let away_m = |at: Point| (at[0] - self.at[0]).hypot(at[1] - self.at[1]);
        craft.is_down() && craft.at.is_some_and(|at| away_m(at) <= self.radius_m)
    }
}

impl Tracker for LandOn {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let vehicles = scene.vehicles;
        let down = vehicles.iter().filter(|craft| self.is_there(craft)).count();
        let stopped = |craft: &Craft| craft.lost || craft.down_for >= DOWN_FOR;
        let met = down >= self.count;
        let radius = format!("{:.0}", self.radius_m);
        Standing {
            fraction: (down as f64 / self.count.max(1) as f64).min(1.0),
            measure: down as f64,
            met,
            settled: met || (!vehicles.is_empty() && vehicles.iter().all(stopped)),
            landing: true,
            quality: None,
            result: text!("mission-landed-of", down = down, count = self.count),
            outlook: None,
            quality_advice: Text::default(),
            target: text!("mission-land-within", radius = radius.as_str()),
            advice: text!("mission-land-advice", place = &self.place, radius = radius),
        }
    }
}
