//! Gates: points in the air to pass in order; the seed moves them slightly.

use std::f64::consts::TAU;

use rand::RngExt as _;

use crate::geo::maths;
use crate::mission::format::{FileTable, gate, list, number};
use crate::mission::world::World;

const MOST_GATES: usize = 100;

/// Gates as the mission describes them: east, north and up from the origin.
#[derive(Debug, Clone)]
pub(crate) struct GateRoute {
    gates: Vec<[f64; 3]>,
    pub radius_m: f64,
    jitter_m: f64,
}

impl GateRoute {
    /// Reads the keys of a route.
    pub(super) fn need(table: &mut FileTable<'_>) -> Option<Self> {
        let gates = table.need("gates", list(gate(), 1, MOST_GATES), "gates, in order");
        let radius_m = table.need_radius();
        let jitter_m = table.or(
            "jitter",
            number(0.0, 1000.0, "m"),
            0.0,
            "the seed moves each gate by up to this distance",
        );
        Some(Self {
            gates: gates?,
            radius_m: radius_m?,
            jitter_m,
        })
    }

    /// The gates before the seed moves them.
    pub fn gates(&self) -> &[[f64; 3]] {
        &self.gates
    }

    /// How much shorter the path to a gate may be than the path to its position in the file: gates
    /// have a radius, and the seed moves them.
    pub fn slack_m(&self) -> f64 {
        self.radius_m + self.jitter_m
    }

    /// The name of a gate by its index from 0: the first is `gate1`.
    pub fn name(index: usize) -> String {
        format!("gate{}", index + 1)
    }

    /// The names of the route's gates, and that of the next one.
    pub fn names(&self) -> Vec<String> {
        let gates = (0..self.gates.len()).map(Self::name);
        gates.chain([super::NEXT_PLACE.to_owned()]).collect()
    }

    /// The positions of the gates in one flight: each is moved horizontally, with a uniform distribution over a disc.
    pub fn drawn(&self, world: &World, objective: &str) -> Vec<[f64; 3]> {
        let mut random = world.random(objective);
        let moved = |&[east_m, north_m, up_m]: &[f64; 3]| {
            let away_m = self.jitter_m * random.random::<f64>().sqrt();
            let angle = TAU * random.random::<f64>();
            [
                east_m + away_m * maths::sin(angle),
                north_m + away_m * maths::cos(angle),
                up_m,
            ]
        };
        self.gates.iter().map(moved).collect()
    }
}
