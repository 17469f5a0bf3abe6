//! Missions: training tasks with a hazard world, virtual sensors and objectives.
//!
//! A mission is a TOML file; [`Mission::parse`] reads it and names every fault in it. A [`Flight`] is one try at
//! it: it watches telemetry and the ledger in steps of [`TICK`], knows when the try is over, and writes the
//! [`Report`]. Everything is a function of the file, the seed, and what was flown.
//!
//! # The file
//! Units are m, s, m/s, deg, Wh unless a key says otherwise. A point `[east, north]` is metres from the origin, as
//! on a map (the grammar's `goto n .. e ..` names its axes); heights are above the origin. Keys without a default
//! are required, unknown keys are faults.
//!
//! | key | meaning |
//! | --- | --- |
//! | `schema` | 1 |
//! | `title_uk`, `brief_uk`, `text_uk` | each beside its English text, the same in Ukrainian; where one is missing, English is shown |
//! | `id`, `rev`, `title`, `brief` | name for files and results; revision; for people |
//! | `tier`, `tags`, `authors` | difficulty 0-3 (0); for lists |
//! | `drill_of` | id of the mission that this one is a short exercise for |
//! | `[sim]` `time_limit`, `origin = { lat, lon, alt, heading }` | seconds; where [0, 0] is, height above sea level, heading of the parked vehicles (0) |
//! | `[weather]` `wind = { speed, dir }` | `dir` is where it comes from (calm) |
//! | `[[places]]` `id`, `at` | a point that lines and objectives may name |
//! | `[[zones]]` `id`, `kind` | `task` (an area) or `geofence` (must not be left; optional `ceiling`) |
//! | `polygon` or `center`, `radius` | its shape |
//! | `[[hazards]]` `id`, `kind` | see below |
//! | `[fleet]` `max_vehicles`, `pads`, `sensors`, `loads` | one pad per vehicle; what every vehicle carries; loads: `ball`, `kit`, `node` in pieces, `spray` in seconds |
//! | `vehicles = [{ sensors, loads }, ..]` | one per pad: more sensors, and loads in the place of the fleet's |
//! | `[rules]` `max_agl`, `land_reserve_pct` | highest height (120), battery to land with (20) |
//! | `[[objectives]]` `id`, `title`, `kind`, `value`, `mandatory` | share of points; whether the mission fails without it (false) |
//! | `[[hints]]` `phase`, `text` | shown while on the `ground`, `armed`, in the `air`, or when everything but the landing is `done`; `{next_cell}` in the text becomes the next cell to sample |
//! | `[[hints]]` `level`, `text`, `phase`, `objective` | instead of being shown, it is given when it is asked for and costs by its level, 1 to 3; where named, only in that phase and until that objective is met |
//! | `[scoring]` `weights`, `par = { time, energy_wh }`, `medals`, `gold_requires` | see [`crate::scoring`]; weights sum to 1 |
//!
//! Hazard kind `plume`: a Gaussian plume. `source`, `height`, `rate` (g/s), `stability` (`A`-`F`), `terrain` (`open` or
//! `urban`, `open`), `substance` (`vapour`, `monoxide`, `methane`, `smoke`; `vapour`), `meander` (how much its axis
//! swings, standard deviation in degrees, 0), `intermittency` (standard deviation of the logarithm of its gusts, 0),
//! `jitter = { position, rate }`: by how much at most the seed moves the source (m) and changes its rate (share of it).
//!
//! Hazard kind `puffs`: a leak that comes in puffs, `every` so many seconds (2); else as `plume`, without `meander` and
//! `intermittency`.
//!
//! Hazard kind `radiation`: `sources = [{ at, height, isotope, activity_gbq }, ..]` (`Cs-137` or `Co-60`, height 0),
//! `walls = [{ from, to, height, passes }, ..]` (`passes`: the share that gets through), `background` (uSv/h, 0.1),
//! `jitter` (m, for each source).
//!
//! Hazard kind `fire`: `area = [west, south, east, north]` in square cells of `cell` m, `fuel` (`grass`, `shrub`,
//! `timber`, `bare`; `grass`), `patches = [{ area, fuel }, ..]` on top of it, `moisture` (share of water, 0.05), `embers`
//! (how many times more than usual, 1), `ignitions = [{ at, time, radius }, ..]`, `jitter` (m, for each ignition).
//!
//! Hazard kind `minefield`: `zone`, `count = { metal, min_metal, surface }`, `clutter` (pieces of scrap, 0), `min_gap` (m).
//!
//! Hazard kind `survivors`: `zone`, `count`, `animals` (0), `cover = [low, high]` (share of them that trees hide, 0),
//! `min_gap` (m), `lasts` (s; how long they last is Weibull's with shape 2 and this scale; for ever).
//!
//! Hazard kind `flood`: `zone`, `houses`, `people` and `animals` (0) on their roofs, `min_gap` (m), `roofs = [low, high]`
//! (m), `level` (m) and `rise` (m a minute) of the water, `nodes = [point, ..]`: where gauges belong.
//!
//! Hazard kind `line`: `pylons = [point, ..]`, `height`, `sag` (m, of a span of mean length), `defects`, `stains` (0; what
//! looks like defects from far), `min_gap` (m).
//!
//! Objective kinds: `sample_cells` (`zone`, `sensor`, `cell`, `dwell`, `max_speed`, `heights = [low, high]`,
//! `target`, `partial_from`), `map_error` (`of`: a `sample_cells` objective, `height`, `target`, `partial_from`),
//! `arm_time` (`within` s of being ready), `hover` (`heights`, `radius`, `time`,
//! `place`: anywhere); `gates` (`gates = [[east, north, up], ..]` in their order, `radius`, `jitter`: by how much at most
//! the seed moves each); `visit` (`places`, `radius`, `dwell` (0), `heights`); `formation` (the middle of all through
//! `gates`, `radius`, `jitter`, with `spacing = [least, most]` to the nearest other for a share `target`,
//! `partial_from`); `land_on` (`place`, `radius`, `count` (1)),
//! `recover` (`radius`, `battery_pct`), `locate` (`of`: a hazard, `within`, `partial_to`), `perimeter` (`of`: a fire,
//! `sensor`, `times`, `target`, `partial_from`), `protect` (`of`: a fire, `zone`), `contain` (`of`: a fire, `target`,
//! `partial_from`: shares of what would burn untouched), `dose` (`limit_usv`), `detect` (`hazard`, `beta`, `radius`, `budget` (3, reports that
//! count for each object), `target`, `partial_from`), `coverage` (`zone`, `sensors`, `cell`, `target`, `partial_from`),
//! `deliver` (`hazard`, `load`: `kit` or `node`, `target`, `partial_from` (0)), `standoff` (`hazard`: a line,
//! `range = [nearest, farthest]`, `near`, `time` (s to spend near it), `target`, `partial_from`). Cells are named like chess squares: `A1` is the south-west one, letters go
//! east, numbers go north.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::diagnostic::Diagnostic;
use crate::geo::LatLon;
use crate::scoring;
use crate::sim::{Start, WorldConfig};
use crate::text::Text;

mod area;
mod clock;
mod contact;
mod craft;
mod event;
mod feedback;
mod file;
mod fit;
mod flight;
mod hazard;
mod hint;
mod listing;
mod lookout;
mod objective;
mod progress;
mod radio;
pub mod record;
mod report;
mod schema;
mod sensor;
mod survey;
mod together;
mod usage;
mod weather;
mod world;
mod zone;

pub use crate::scoring::Report;
pub use area::{Area, AreaKind};
pub use clock::Clock;
pub use event::alert::OpenAlert;
pub use event::demand::Demand;
pub use event::mover::MoverKind;
pub use flight::{Flight, Inject, Outcome, Pledge};
pub use hint::{Clue, Hint, Phase};
pub use listing::{Listing, ObjectiveListing};
pub use progress::{
    Cell, ClueProgress, MovingThing, ObjectiveProgress, ObjectiveState, Progress, Reading,
    ShownContact, ShownMark, Trust,
};
pub use schema::schema;

/// The step of missions and scoring.
pub const TICK: Duration = Duration::from_millis(100);

/// How far apart the pads of an enlarged mission lie.
const ROW_SPACING_M: f64 = 6.0;

/// What stands in a hint for the name of the next cell to sample.
pub(crate) const NEXT_CELL: &str = "{next_cell}";

/// A mission, read and checked.
#[derive(Debug)]
pub struct Mission {
    /// Its name for files and results.
    pub id: String,
    /// Its revision; results compare only within one.
    pub rev: u32,
    /// The file that it was read from.
    pub source: String,
    /// Its name for people.
    pub title: Text,
    /// What the trainee is told.
    pub brief: Text,
    /// Where a text has no translation; not a fault.
    pub untranslated: Vec<Diagnostic>,
    /// Difficulty, 0 (first steps) to 3.
    pub tier: u8,
    /// Subjects, for lists.
    pub tags: Vec<String>,
    /// Who wrote it.
    pub authors: Vec<String>,
    /// The id of the mission that it is a short exercise for.
    pub drill_of: Option<String>,
    /// How many vehicles fly it.
    pub vehicles: usize,
    /// Mission time allowed.
    pub time_limit: Duration,
    /// Advice by phase of the flight.
    pub hints: Vec<Hint>,
    /// Advice that can be asked for, at a price.
    pub clues: Vec<Clue>,
    /// How it is scored.
    pub scoring: scoring::Rules,
    pub(crate) origin: Origin,
    pub(crate) weather: weather::Weather,
    pub(crate) pads: Vec<Point>,
    /// Every sensor that some vehicle carries.
    pub(crate) sensors: Vec<&'static sensor::Sensor>,
    /// What each vehicle carries, in the order of the pads.
    pub(crate) fits: Vec<fit::Fit>,
    pub(crate) zones: Vec<zone::Zone>,
    /// Named points.
    pub(crate) places: Vec<(String, Point)>,
    pub(crate) hazards: Vec<Box<dyn hazard::Hazard>>,
    pub(crate) objectives: Vec<objective::Objective>,
    pub(crate) max_height_m: f64,
    pub(crate) land_reserve_percent: f64,
    /// Vehicles in the air have to be this far apart.
    pub(crate) min_separation_m: f64,
    pub(crate) events: Vec<event::Event>,
    /// `None` where radio does not matter.
    pub(crate) radio: Option<radio::Radio>,
    /// Threats that an instructor may have happen, besides the mission's own.
    pub(crate) may_inject: Vec<String>,
}

/// Metres east and north of the origin.
pub(crate) type Point = [f64; 2];

/// Where [0, 0] is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Origin {
    pub at: LatLon,
    pub altitude_amsl_m: f64,
    pub heading_deg: f64,
}

impl Origin {
    /// The place of a point.
    pub fn place(&self, [east_m, north_m]: Point) -> LatLon {
        self.at.moved(north_m, east_m)
    }

    /// The point at a place.
    pub fn point(&self, place: LatLon) -> Point {
        let (north_m, east_m) = self.at.offset_to(place);
        [east_m, north_m]
    }
}

impl Mission {
    /// Reads a mission file.
    ///
    /// # Errors
    /// Every fault that was found, each with its place; at least one.
    pub fn parse(source: &str) -> Result<Self, Vec<Diagnostic>> {
        file::read(source)
    }

    /// Where the vehicles start, in the order of their system ids.
    pub fn starts(&self) -> Vec<Start> {
        let pad = |&point: &Point| Start {
            at: self.origin.place(point),
            altitude_amsl_m: self.origin.altitude_amsl_m,
            heading_deg: self.origin.heading_deg,
        };
        self.pads.iter().map(pad).collect()
    }

    /// The same with more vehicles than it is made for, for measurements: their pads lie in a row to the south of the
    /// last one, and they carry what that one does.
    #[must_use]
    pub fn enlarged(mut self, vehicles: usize) -> Self {
        if let Some(&[east_m, north_m]) = self.pads.last() {
            let more = vehicles.saturating_sub(self.pads.len());
            let pad = |place| [east_m, north_m - ROW_SPACING_M * place as f64];
            self.pads.extend((1..=more).map(pad));
            self.vehicles = self.pads.len();
            let fit = self.fits.last().cloned().unwrap_or_default();
            self.fits.resize(self.vehicles, fit);
        }
        self
    }

    /// The simulator's world for it: its vehicles on their pads.
    pub fn world(&self, seed: u64) -> WorldConfig {
        WorldConfig {
            starts: self.starts(),
            airframes: Vec::new(),
            seed,
            obstacles: Vec::new(),
            realistic_boot: false,
        }
    }

    /// Places that the grammar may name: those of the file, the cells (`A1`), `pad` for the first pad and `pad1`, `pad2` for each.
    pub fn places(&self) -> BTreeMap<String, LatLon> {
        let named = self.places.iter();
        let mut places: BTreeMap<String, LatLon> = named
            .map(|(name, at)| (name.clone(), self.origin.place(*at)))
            .collect();
        for (index, &pad) in self.pads.iter().enumerate() {
            let place = self.origin.place(pad);
            places.entry("pad".to_owned()).or_insert(place);
            places.insert(format!("pad{}", index + 1), place);
        }
        for survey in self
            .objectives
            .iter()
            .filter_map(|objective| objective.kind.survey())
        {
            for cell in &survey.cells {
                places
                    .entry(cell.name.clone())
                    .or_insert(self.origin.place(cell.centre));
            }
        }
        places
    }
}

/// Which of the missions, by name, somebody means: the one that is called so, else the first of that number, else the
/// only one that begins so.
pub fn meant<'a>(written: &str, names: &[&'a str]) -> Option<&'a str> {
    let by_number = format!("{written}-");
    let mut beginning = names
        .iter()
        .filter(|name| !written.is_empty() && name.starts_with(written));
    let only = beginning.next().filter(|_| beginning.next().is_none());
    let called = names.iter().find(|name| **name == written);
    let numbered = names.iter().find(|name| name.starts_with(&by_number));
    called.or(numbered).or(only).copied()
}

#[cfg(test)]
pub(crate) mod fake;
#[cfg(test)]
mod tests;
