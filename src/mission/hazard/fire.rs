//! A fire that runs over the ground with the wind, in cells, until roads, water or people stop it.

use std::time::Duration;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;
use toml::Spanned;

use super::dispersion::{Stability, Terrain};
use super::plume::Plume;
use super::{
    Field, Hazard, Load, LoadEffect, Object, ObjectClass, Quantity, TruthPiece, TruthShape,
};
use crate::mission::file::{Draft, Faults, POINT_RANGE, Section};
use crate::mission::weather::{Weather, Wind};
use crate::mission::{Point, TICK};
use crate::text;

mod fuel;
mod grid;

use fuel::Fuel;
pub(crate) use grid::Grid;
use grid::{Cell, STEP_S, State};

/// More cells than this would slow a step down.
const MOST_CELLS: f64 = 10_000.0;
/// Cells along each side of a block that detectors take for one fire.
const BLOCK: usize = 3;
/// How well an extinguishing ball, and a second of spray, put out what burns where they come down.
const BALL_PUTS_OUT: f64 = 0.9;
const SPRAY_PUTS_OUT: f64 = 0.6;
/// Smoke rises about so far before it drifts.
const SMOKE_RISES_M: f64 = 12.0;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FireFile {
    /// West, south, east, north.
    area: Spanned<[f64; 4]>,
    cell: Spanned<f64>,
    #[serde(default)]
    fuel: Fuel,
    #[serde(default)]
    patches: Vec<PatchFile>,
    moisture: Option<Spanned<f64>>,
    embers: Option<Spanned<f64>>,
    ignitions: Spanned<Vec<IgnitionFile>>,
    jitter: Option<Spanned<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PatchFile {
    area: [f64; 4],
    fuel: Fuel,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct IgnitionFile {
    at: Spanned<Point>,
    time: Option<Spanned<f64>>,
    radius: Option<Spanned<f64>>,
}

/// Where and when something catches fire.
#[derive(Debug, Clone, Copy)]
struct Ignition {
    at: Point,
    time: Duration,
    radius_m: f64,
}

#[derive(Debug)]
struct FireHazard {
    grid: Grid,
    ignitions: Vec<Ignition>,
    jitter_m: f64,
}

/// A fire, with what chance still has in store for it.
#[derive(Debug, Clone)]
struct Blaze {
    grid: Grid,
    random: ChaCha8Rng,
}

/// The fire of one flight.
#[derive(Debug)]
pub(crate) struct Fire {
    blaze: Blaze,
    /// The same fire if nobody did anything about it.
    untouched: Blaze,
    ignitions: Vec<Ignition>,
    since_step: Duration,
    now: Duration,
    wind: Wind,
    /// What detectors see of it, one for each block of cells.
    objects: Vec<Object>,
    /// Where smoke rises.
    smoke: Vec<Plume>,
    /// Chance in what loads do; nothing else depends on it.
    luck: ChaCha8Rng,
}

/// Reads a `[[hazards]]` of kind `fire`.
pub(crate) fn read(
    section: Section<'_>,
    _: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Hazard>> {
    let file: FireFile = faults.read(section)?;
    let grid = grid(&file, faults);
    if file.ignitions.get_ref().is_empty() {
        faults.add(file.ignitions.span(), "a fire needs an ignition");
    }
    let ignitions = file.ignitions.get_ref().iter();
    let ignitions = ignitions.map(|file| ignition(file, faults)).collect();
    let jitter_m = faults.optional(file.jitter.as_ref(), 0.0, 0.0..=POINT_RANGE, "jitter");
    Some(Box::new(FireHazard {
        grid: grid?,
        ignitions,
        jitter_m,
    }))
}

/// The ground that can burn, before it does; `None` where it is none.
fn grid(file: &FireFile, faults: &mut Faults) -> Option<Grid> {
    let side_m = faults.number(&file.cell, 1.0..=100.0, "cell");
    let area @ [west, south, east, north] = *file.area.get_ref();
    let (columns, rows) = ((east - west) / side_m, (north - south) / side_m);
    let far = area.iter().any(|side| side.abs() > POINT_RANGE);
    let fits = columns >= 1.0 && rows >= 1.0 && columns * rows <= MOST_CELLS && !far;
    if !fits {
        let message = format!(
            "`area` is [west, south, east, north], at least one cell and at most {MOST_CELLS}"
        );
        faults.add(file.area.span(), message);
    }
    let moisture = faults.optional(file.moisture.as_ref(), 0.05, 0.0..=1.0, "moisture");
    let embers = faults.optional(file.embers.as_ref(), 1.0, 0.0..=1000.0, "embers");
    if !fits {
        return None;
    }
    let fresh = Cell {
        fuel: file.fuel,
        state: State::Unburnt(0.0),
        pace: 1.0,
    };
    let (columns, rows) = (columns.round() as usize, rows.round() as usize);
    let mut grid = Grid {
        corner: [west, south],
        columns,
        rows,
        side_m,
        moisture,
        embers,
        cells: vec![fresh; columns * rows],
    };
    grid.cover(&file.patches);
    Some(grid)
}

fn ignition(file: &IgnitionFile, faults: &mut Faults) -> Ignition {
    let time_s = faults.optional(file.time.as_ref(), 0.0, 0.0..=86_400.0, "time");
    Ignition {
        at: faults.point(&file.at, "at"),
        time: Duration::try_from_secs_f64(time_s).unwrap_or_default(),
        radius_m: faults.optional(file.radius.as_ref(), 0.0, 0.0..=1000.0, "radius"),
    }
}

impl Grid {
    /// Lays other fuels over the ground; later ones lie on top.
    fn cover(&mut self, patches: &[PatchFile]) {
        for patch in patches {
            let [west, south, east, north] = patch.area;
            for index in 0..self.cells.len() {
                let [x, y] = self.centre(index);
                if (west..=east).contains(&x) && (south..=north).contains(&y) {
                    self.cells[index].fuel = patch.fuel;
                }
            }
        }
    }
}

impl Hazard for FireHazard {
    fn release(&self, weather: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let mut sway = || self.jitter_m * (2.0 * random.random::<f64>() - 1.0);
        let mut ignitions = self.ignitions.clone();
        for ignition in &mut ignitions {
            ignition.at = [ignition.at[0] + sway(), ignition.at[1] + sway()];
        }
        let mut grid = self.grid.clone();
        grid.roughen(&mut random);
        let mut luck = random.clone();
        luck.set_stream(random.get_stream() ^ (1 << 63));
        let blaze = Blaze { grid, random };
        let mut fire = Fire {
            untouched: blaze.clone(),
            blaze,
            ignitions,
            since_step: Duration::ZERO,
            now: Duration::ZERO,
            wind: weather.wind,
            objects: Vec::new(),
            smoke: Vec::new(),
            luck,
        };
        fire.light();
        fire.look();
        Box::new(fire)
    }
}

impl Field for Fire {
    fn step(&mut self, now: Duration, weather: &Weather) {
        self.since_step += TICK;
        if self.since_step.as_secs_f64() < STEP_S - 1e-9 {
            return;
        }
        self.since_step = Duration::ZERO;
        self.now = now;
        self.wind = weather.wind;
        for blaze in [&mut self.blaze, &mut self.untouched] {
            blaze.grid.step(weather.wind, &mut blaze.random);
        }
        self.light();
        self.look();
    }

    fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        if quantity != Quantity::Particles {
            return 0.0;
        }
        let of = |plume: &Plume| plume.concentration_ug_m3(self.wind, at, height_m);
        self.smoke.iter().map(of).sum()
    }

    fn objects(&self) -> &[Object] {
        &self.objects
    }

    fn affect(&mut self, load: Load, at: Point) -> Option<LoadEffect> {
        let chance = match load {
            Load::Ball => BALL_PUTS_OUT,
            Load::Spray => SPRAY_PUTS_OUT,
            Load::Kit | Load::Node => return None,
        };
        let index = self.blaze.grid.index(at)?;
        let cell = &mut self.blaze.grid.cells[index];
        let (good, text) = match cell.state {
            State::Burning(_) if self.luck.random::<f64>() < chance => {
                cell.state = State::Burnt;
                (true, text!("fire-put-out"))
            }
            State::Burning(_) => (false, text!("fire-goes-on")),
            State::Unburnt(_) if load == Load::Spray && cell.fuel.burns() => {
                cell.state = State::Wet;
                (true, text!("fire-wetted"))
            }
            _ => (false, text!("fire-none-there")),
        };
        self.look();
        Some(LoadEffect {
            good,
            object: None,
            text,
        })
    }

    fn truth(&self) -> Vec<TruthPiece> {
        let grid = &self.blaze.grid;
        let burnt = (0..grid.len()).filter(|&index| grid.has_burnt(index));
        let square = |index: usize| TruthPiece {
            at: grid.centre(index),
            shape: TruthShape::Square(grid.side_m, if grid.burns(index) { 1.0 } else { 0.4 }),
        };
        burnt.map(square).collect()
    }

    fn fire(&self) -> Option<&Fire> {
        Some(self)
    }
}

impl Fire {
    /// The ground as it burns.
    pub fn grid(&self) -> &Grid {
        &self.blaze.grid
    }

    /// The ground as it would burn if nobody did anything.
    pub fn untouched(&self) -> &Grid {
        &self.untouched.grid
    }

    /// Whether nothing burns and nothing is going to.
    pub fn is_out(&self) -> bool {
        let more_to_come = self
            .ignitions
            .iter()
            .any(|ignition| ignition.time > self.now);
        !more_to_come && self.blaze.grid.burning().next().is_none()
    }

    /// Sets fire to what catches fire about now.
    fn light(&mut self) {
        let step = Duration::from_secs_f64(STEP_S);
        for ignition in &self.ignitions {
            let begun = ignition.time <= self.now && ignition.time + step > self.now;
            for blaze in [&mut self.blaze, &mut self.untouched] {
                if begun {
                    blaze.light(ignition);
                }
            }
        }
    }

    /// What it looks like from above, and where smoke rises.
    fn look(&mut self) {
        let grid = &self.blaze.grid;
        let (across, up) = (grid.columns.div_ceil(BLOCK), grid.rows.div_ceil(BLOCK));
        // East, north, number of cells and smoke of what burns in each block.
        let mut blocks = vec![[0.0_f64; 4]; across * up];
        for index in grid.burning() {
            let (column, row) = (index % grid.columns, index / grid.columns);
            let block = &mut blocks[row / BLOCK * across + column / BLOCK];
            let ([east, north], fuel) = (grid.centre(index), grid.cells[index].fuel);
            let smoke_g_s = fuel.smoke_g_s_m2() * grid.side_m * grid.side_m;
            for (sum, part) in block.iter_mut().zip([east, north, 1.0, smoke_g_s]) {
                *sum += part;
            }
        }
        let middle = |block: &[f64; 4]| {
            let cells = block[2].max(1.0);
            [block[0] / cells, block[1] / cells]
        };
        let object = |block: &[f64; 4]| Object {
            present: block[2] > 0.0,
            ..Object::new(ObjectClass::Fire, middle(block))
        };
        self.objects = blocks.iter().map(object).collect();
        let burning = blocks.iter().filter(|block| block[2] > 0.0);
        let plume = |block: &[f64; 4]| Plume {
            source: middle(block),
            height_m: SMOKE_RISES_M,
            rate_g_s: block[3],
            stability: Stability::C,
            terrain: Terrain::Open,
        };
        self.smoke = burning.map(plume).collect();
    }
}

impl Blaze {
    fn light(&mut self, ignition: &Ignition) {
        if let Some(index) = self.grid.index(ignition.at) {
            self.grid.ignite(index);
        }
        for index in 0..self.grid.len() {
            let centre = self.grid.centre(index);
            if crate::mission::report::distance_m(centre, ignition.at) <= ignition.radius_m {
                self.grid.ignite(index);
            }
        }
    }
}

#[cfg(test)]
mod tests;
