//! A fire that spreads over a grid of cells with the wind, until roads, water or extinguishing
//! loads stop it.

use std::time::Duration;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::dispersion::{Stability, Terrain};
use super::gaussian::Plume;
use super::{
    Field, Hazard, Load, LoadEffect, Object, ObjectClass, Quantity, TruthPiece, TruthShape,
};
use crate::mission::format::{
    FileTable, KindOf, POINT_RANGE, area, list, number, point, table as table_of, time, word,
};
use crate::mission::weather::{Weather, Wind};
use crate::mission::{Point, TICK};
use crate::text;

mod fuel;
mod grid;

use fuel::Fuel;
pub(crate) use grid::FireGrid;
use grid::{CellState, FireCell, STEP_S};

/// The maximum number of cells; more would slow a step down.
const MOST_CELLS: f64 = 10_000.0;
/// Cells along each side of a block that detectors see as one fire.
const BLOCK: usize = 3;
/// The probability that an extinguishing ball, or a second of spray, puts out a burning cell where it lands.
const BALL_PUTS_OUT: f64 = 0.9;
const SPRAY_PUTS_OUT: f64 = 0.6;
/// Smoke rises to about this height before it drifts.
const SMOKE_RISES_M: f64 = 12.0;

#[derive(Debug, Clone, Copy)]
struct FuelPatch {
    /// West, south, east, north.
    area: [f64; 4],
    fuel: Fuel,
}

#[derive(Debug, Clone, Copy)]
struct Ignition {
    at: Point,
    time: Duration,
    radius_m: f64,
}

#[derive(Debug, Clone)]
struct FireHazard {
    grid: FireGrid,
    ignitions: Vec<Ignition>,
    jitter_m: f64,
}

#[derive(Debug, Clone)]
struct Blaze {
    grid: FireGrid,
    random: ChaCha8Rng,
}

/// The fire of one flight.
#[derive(Debug, Clone)]
pub(crate) struct Fire {
    blaze: Blaze,
    /// The same fire without intervention.
    untouched: Blaze,
    ignitions: Vec<Ignition>,
    since_step: Duration,
    now: Duration,
    wind: Wind,
    /// The fires that detectors see, one for each block of cells.
    objects: Vec<Object>,
    smoke: Vec<Plume>,
    /// The random stream of the loads' effects, used by nothing else.
    luck: ChaCha8Rng,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "fire",
    about: "a fire that spreads over a grid of cells, driven by the wind",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let area = table.need("area", area(), "burnable area, at most 10000 cells");
    let side_m = table.need("cell", number(1.0, 100.0, "m"), "side of a cell");
    let fuel = table.or(
        "fuel",
        word(&Fuel::WORDS),
        Fuel::Grass,
        "fuel on the ground; in a wind of 5 m/s, fire spreads at 0.55 m/s in grass, 0.33 in shrub, 0.08 in timber; `bare` stops it",
    );
    let patches_form = list(table_of(read_patch), 0, usize::MAX);
    let patches = table.may(
        "patches",
        patches_form,
        "areas with other fuel; later ones cover earlier ones",
    );
    let moisture = table.or(
        "moisture",
        number(0.0, 1.0, ""),
        0.05,
        "share of water in the fuel; 0.15 halves the speed of the fire",
    );
    let embers = table.or(
        "embers",
        number(0.0, 1000.0, ""),
        1.0,
        "number of embers, as a multiple of the usual number",
    );
    let ignitions_form = list(table_of(read_ignition), 1, usize::MAX);
    let ignitions = table.need("ignitions", ignitions_form, "places where the fire starts");
    let jitter = number(0.0, POINT_RANGE, "m");
    let jitter_m = table.or(
        "jitter",
        jitter,
        0.0,
        "the seed moves each ignition by up to this distance",
    );
    let mut grid = ground(table, area?, side_m?, fuel)?;
    (grid.moisture, grid.embers) = (moisture, embers);
    grid.cover(&patches.unwrap_or_default());
    Some(Box::new(FireHazard {
        grid,
        ignitions: ignitions?,
        jitter_m,
    }))
}

fn read_patch(table: &mut FileTable<'_>) -> Option<FuelPatch> {
    let area = table.need("area", area(), "area of the patch");
    let fuel = table.need("fuel", word(&Fuel::WORDS), "fuel of the patch");
    Some(FuelPatch {
        area: area?,
        fuel: fuel?,
    })
}

fn read_ignition(table: &mut FileTable<'_>) -> Option<Ignition> {
    let at = table.need("at", point(), "position");
    let time = table.or(
        "time",
        time(),
        Duration::ZERO,
        "mission time of the ignition",
    );
    let radius_m = table.or(
        "radius",
        number(0.0, 1000.0, "m"),
        0.0,
        "radius of the ground that burns at once",
    );
    Some(Ignition {
        at: at?,
        time,
        radius_m,
    })
}

/// The ground before the fire; `None` if the area is invalid.
fn ground(
    table: &mut FileTable<'_>,
    [west, south, east, north]: [f64; 4],
    side_m: f64,
    fuel: Fuel,
) -> Option<FireGrid> {
    let (columns, rows) = ((east - west) / side_m, (north - south) / side_m);
    if columns < 1.0 || rows < 1.0 || columns * rows > MOST_CELLS {
        let message = text!("fault-fire-area", most = MOST_CELLS.to_string());
        table.fault_of("area", message);
        return None;
    }
    let fresh = FireCell {
        fuel,
        state: CellState::Unburnt(0.0),
        pace: 1.0,
    };
    let (columns, rows) = (columns.round() as usize, rows.round() as usize);
    Some(FireGrid {
        corner: [west, south],
        columns,
        rows,
        side_m,
        moisture: 0.0,
        embers: 0.0,
        cells: vec![fresh; columns * rows],
    })
}

impl FireGrid {
    /// Covers areas with other fuels; later areas replace earlier ones.
    fn cover(&mut self, patches: &[FuelPatch]) {
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
            CellState::Burning(_) if self.luck.random::<f64>() < chance => {
                cell.state = CellState::Burnt;
                (true, text!("fire-put-out"))
            }
            CellState::Burning(_) => (false, text!("fire-goes-on")),
            CellState::Unburnt(_) if load == Load::Spray && cell.fuel.burns() => {
                cell.state = CellState::Wet;
                (true, text!("fire-wetted"))
            }
            CellState::Unburnt(_) | CellState::Burnt | CellState::Wet => {
                (false, text!("fire-none-there"))
            }
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
            shape: TruthShape::Fire(grid.side_m, grid.burns(index)),
        };
        burnt.map(square).collect()
    }

    fn fire(&self) -> Option<&Fire> {
        Some(self)
    }
}

impl Fire {
    pub fn grid(&self) -> &FireGrid {
        &self.blaze.grid
    }

    /// The ground as it would burn without intervention.
    pub fn untouched(&self) -> &FireGrid {
        &self.untouched.grid
    }

    /// Whether nothing burns and no ignition is to come.
    pub fn is_out(&self) -> bool {
        let more_to_come = self
            .ignitions
            .iter()
            .any(|ignition| ignition.time > self.now);
        !more_to_come && self.blaze.grid.burning().next().is_none()
    }

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

    /// Updates the objects that detectors see from above, and the sources of smoke.
    fn look(&mut self) {
        let grid = &self.blaze.grid;
        let (across, up) = (grid.columns.div_ceil(BLOCK), grid.rows.div_ceil(BLOCK));
        // East, north, number of cells and smoke of the fire in each block.
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
