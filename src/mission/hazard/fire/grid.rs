//! The ground as a grid of cells, and their state.
//!
//! The front of a cell advances on each neighbour that can burn, at the speed for that direction. The neighbour catches
//! fire when the fastest front has covered the distance between their centres. A front therefore moves at the formula's
//! speed along the axes; an independent chance per second for each neighbour would make it faster.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::fuel::{Fuel, share_of_rate};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::weather::Wind;

/// The time step of a fire, in seconds.
pub(super) const STEP_S: f64 = 1.0;
/// The unevenness of fuel: standard deviation of the logarithm of a cell's speed.
const ROUGHNESS: f64 = 0.2;
/// The number of embers from a burning cell that start a fire elsewhere, per second and m/s of wind.
const EMBERS_PER_S: f64 = 2e-5;
const EMBERS_FLY_M: [f64; 2] = [20.0, 120.0];
/// The maximum deviation of embers from the wind's direction, in degrees.
const EMBERS_SPREAD_DEG: f64 = 20.0;

/// The neighbours of a cell, in columns and rows.
const NEIGHBOUR_CELLS: [(isize, isize); 8] = [
    (-1, -1),
    (0, -1),
    (1, -1),
    (-1, 0),
    (1, 0),
    (-1, 1),
    (0, 1),
    (1, 1),
];

/// The state of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CellState {
    /// Not burning; the front has covered this share of the distance to it, 0 to 1.
    Unburnt(f64),
    /// Burning, for this many seconds.
    Burning(f64),
    Burnt,
    /// Wet: it will not burn.
    Wet,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FireCell {
    pub fuel: Fuel,
    pub state: CellState,
    /// The speed of a front in this cell, as a multiple of the speed that the formula gives.
    pub pace: f64,
}

/// A rectangle of ground in square cells, row by row from the south-west.
#[derive(Debug, Clone)]
pub(crate) struct FireGrid {
    pub corner: Point,
    pub columns: usize,
    pub rows: usize,
    pub side_m: f64,
    /// The share of water in the fuel.
    pub moisture: f64,
    /// A multiplier for the number of embers.
    pub embers: f64,
    pub(super) cells: Vec<FireCell>,
}

impl FireGrid {
    /// The index of the cell that a point lies in; `None` outside the grid.
    pub fn index(&self, at: Point) -> Option<usize> {
        let column = ((at[0] - self.corner[0]) / self.side_m).floor();
        let row = ((at[1] - self.corner[1]) / self.side_m).floor();
        let inside =
            column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// The indices of the cells in the square that reaches `reach_m` to each side of a point.
    pub fn around(&self, at: Point, reach_m: f64) -> impl Iterator<Item = usize> + use<> {
        let low = |axis: usize| {
            ((at[axis] - reach_m - self.corner[axis]) / self.side_m)
                .floor()
                .max(0.0) as usize
        };
        let high = |axis: usize| {
            ((at[axis] + reach_m - self.corner[axis]) / self.side_m)
                .ceil()
                .max(0.0) as usize
        };
        let columns = low(0)..high(0).min(self.columns);
        let across = self.columns;
        let rows = low(1)..high(1).min(self.rows);
        rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }

    /// The centre of a cell.
    pub fn centre(&self, index: usize) -> Point {
        let (column, row) = (index % self.columns, index / self.columns);
        [
            self.corner[0] + (column as f64 + 0.5) * self.side_m,
            self.corner[1] + (row as f64 + 0.5) * self.side_m,
        ]
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether a cell burns now.
    pub fn burns(&self, index: usize) -> bool {
        matches!(self.cells[index].state, CellState::Burning(_))
    }

    /// Whether a cell burns or has burnt.
    pub fn has_burnt(&self, index: usize) -> bool {
        matches!(
            self.cells[index].state,
            CellState::Burning(_) | CellState::Burnt
        )
    }

    /// The indices of the cells that burn now.
    pub fn burning(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.cells.len()).filter(|&index| self.burns(index))
    }

    /// The number of cells that burn or have burnt.
    pub fn burnt(&self) -> usize {
        let all = 0..self.cells.len();
        all.filter(|&index| self.has_burnt(index)).count()
    }

    /// Sets fire to a cell, if it can burn.
    pub fn ignite(&mut self, index: usize) {
        let cell = &mut self.cells[index];
        if cell.fuel.burns() && matches!(cell.state, CellState::Unburnt(_)) {
            cell.state = CellState::Burning(0.0);
        }
    }

    /// Makes the fuel uneven.
    pub fn roughen(&mut self, random: &mut ChaCha8Rng) {
        for cell in &mut self.cells {
            let draw: f64 = StandardNormal.sample(random);
            cell.pace = maths::exp(ROUGHNESS * draw);
        }
    }

    /// Advances the fire by [`STEP_S`].
    pub fn step(&mut self, wind: Wind, random: &mut ChaCha8Rng) {
        let burning: Vec<usize> = self.burning().collect();
        let reached = self.reach(&burning, wind);
        let embers = self.embers(&burning, wind, random);
        for &index in &burning {
            let cell = &mut self.cells[index];
            if let CellState::Burning(for_s) = cell.state {
                let for_s = for_s + STEP_S;
                let rate = cell.fuel.rate_m_s(wind.speed_m_s, self.moisture) * cell.pace;
                // The front takes time to cross the cell; then the flames remain.
                let lasts_s = 2.0 * self.side_m / rate.max(1e-3) + cell.fuel.stays_s();
                cell.state = if for_s < lasts_s {
                    CellState::Burning(for_s)
                } else {
                    CellState::Burnt
                };
            }
        }
        for (index, gain) in reached {
            if let CellState::Unburnt(through) = &mut self.cells[index].state {
                *through += gain;
                if *through >= 1.0 {
                    self.ignite(index);
                }
            }
        }
        for index in embers {
            self.ignite(index);
        }
    }

    /// For each unburnt cell that a front can reach, by index: the advance of the fastest front in
    /// one step, as a share of the distance between the cells.
    fn reach(&self, burning: &[usize], wind: Wind) -> std::collections::BTreeMap<usize, f64> {
        let ways = NEIGHBOUR_CELLS.map(|(column, row)| [column as f64, row as f64]);
        let shares =
            ways.map(|way| share_of_rate(wind, way) / (maths::hypot(way[0], way[1]) * self.side_m));
        let mut reached = std::collections::BTreeMap::new();
        for &from in burning {
            for ((column, row), share) in NEIGHBOUR_CELLS.into_iter().zip(shares) {
                let Some(to) = self.neighbour(from, column, row) else {
                    continue;
                };
                let cell = &self.cells[to];
                if !matches!(cell.state, CellState::Unburnt(_)) || self.is_cut(from, column, row) {
                    continue;
                }
                let rate = cell.fuel.rate_m_s(wind.speed_m_s, self.moisture) * cell.pace;
                let gain: &mut f64 = reached.entry(to).or_insert(0.0);
                *gain = gain.max(rate * share * STEP_S);
            }
        }
        reached
    }

    fn neighbour(&self, index: usize, column: isize, row: isize) -> Option<usize> {
        let to_column = (index % self.columns).checked_add_signed(column)?;
        let to_row = (index / self.columns).checked_add_signed(row)?;
        (to_column < self.columns && to_row < self.rows).then(|| to_row * self.columns + to_column)
    }

    /// Whether the cells on both sides of a diagonal stop a front, so that a diagonal road is also a barrier.
    fn is_cut(&self, from: usize, column: isize, row: isize) -> bool {
        let holds = |index: Option<usize>| {
            let cell = index.map(|index| self.cells[index]);
            cell.is_some_and(|cell| !cell.fuel.burns() || cell.state == CellState::Wet)
        };
        column != 0
            && row != 0
            && holds(self.neighbour(from, column, 0))
            && holds(self.neighbour(from, 0, row))
    }

    fn embers(&self, burning: &[usize], wind: Wind, random: &mut ChaCha8Rng) -> Vec<usize> {
        let chance = EMBERS_PER_S * self.embers * wind.speed_m_s * STEP_S;
        let mut down = Vec::new();
        for &from in burning
            .iter()
            .filter(|&&from| self.cells[from].fuel.throws_embers())
        {
            if random.random::<f64>() >= chance {
                continue;
            }
            let [near, far] = EMBERS_FLY_M;
            let flown_m = near + (far - near) * random.random::<f64>();
            let aside_deg = EMBERS_SPREAD_DEG * (2.0 * random.random::<f64>() - 1.0);
            let (sin, cos) = maths::sin_cos((wind.from_deg + aside_deg).to_radians());
            let at = self.centre(from);
            down.extend(self.index([at[0] - flown_m * sin, at[1] - flown_m * cos]));
        }
        down
    }
}
