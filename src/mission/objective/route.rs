//! Gates: points in the air in their order, which the seed moves a little.

use std::f64::consts::TAU;

use rand::RngExt as _;
use serde::Deserialize;
use toml::Spanned;

use crate::mission::file::{Faults, POINT_RANGE};
use crate::mission::world::World;

/// Gates of one route.
const MOST_GATES: usize = 100;

/// The keys of a route.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RouteFile {
    pub gates: Spanned<Vec<Spanned<[f64; 3]>>>,
    pub radius: Spanned<f64>,
    pub jitter: Option<Spanned<f64>>,
}

/// Gates as the mission describes them: east, north and up from the origin.
#[derive(Debug, Clone)]
pub(super) struct Route {
    gates: Vec<[f64; 3]>,
    pub radius_m: f64,
    jitter_m: f64,
}

impl RouteFile {
    pub fn checked(&self, faults: &mut Faults) -> Route {
        let gates = self.gates.get_ref();
        if !(1..=MOST_GATES).contains(&gates.len()) {
            let fault = format!("`gates` must have 1 to {MOST_GATES} of them");
            faults.add(self.gates.span(), fault);
        }
        for gate in gates {
            let [east_m, north_m, up_m] = gate.get_ref();
            let near = |axis: &f64| (-POINT_RANGE..=POINT_RANGE).contains(axis);
            if !(near(east_m) && near(north_m) && (0.0..=1000.0).contains(up_m)) {
                let fault = format!(
                    "a gate is [east, north, up]: within {POINT_RANGE} m of the origin, 0 to 1000 m high"
                );
                faults.add(gate.span(), fault);
            }
        }
        Route {
            gates: gates.iter().map(|gate| *gate.get_ref()).collect(),
            radius_m: faults.number(&self.radius, 0.5..=1000.0, "radius"),
            jitter_m: self
                .jitter
                .as_ref()
                .map_or(0.0, |jitter| faults.number(jitter, 0.0..=1000.0, "jitter")),
        }
    }
}

impl Route {
    /// What a gate is called.
    pub fn name(index: usize) -> String {
        format!("gate{}", index + 1)
    }

    /// What its gates are called, and the one that comes next.
    pub fn names(&self) -> Vec<String> {
        let gates = (0..self.gates.len()).map(Self::name);
        gates.chain([super::NEXT_PLACE.to_owned()]).collect()
    }

    /// Where the gates are in one flight: each moved level, evenly over a disc.
    pub fn drawn(&self, world: &World, objective: &str) -> Vec<[f64; 3]> {
        let mut random = world.random(objective);
        let moved = |&[east_m, north_m, up_m]: &[f64; 3]| {
            let away_m = self.jitter_m * random.random::<f64>().sqrt();
            let angle = TAU * random.random::<f64>();
            [
                east_m + away_m * angle.sin(),
                north_m + away_m * angle.cos(),
                up_m,
            ]
        };
        self.gates.iter().map(moved).collect()
    }
}
