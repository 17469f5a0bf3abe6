//! The equipment of vehicles on a mission.

use std::collections::BTreeMap;

use super::ground_truth::Load;
use super::radio::Set;
use super::sensor::Sensor;

/// Seconds of spray in a sprayer's tank.
pub(super) const TANK_S: u32 = 15;
/// The part that releases pieces.
pub(super) const DROPPER: &str = "s_drop";
/// The part that clears mines ahead of a ground robot.
pub(super) const FLAIL: &str = "s_flail";

/// The equipment of one vehicle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Fit {
    /// Its sensors: those of the whole fleet, then its own.
    pub sensors: Vec<&'static Sensor>,
    /// The loads that the vehicle starts with and that a pad restores; loads that are not listed
    /// here are never on board.
    pub loads: BTreeMap<Load, u32>,
    /// Whether it carries a flail, which clears mines ahead of a ground robot.
    pub flail: bool,
    /// Its own radio; `None` for that of the mission, if the mission models the radio.
    pub radio: Option<Set>,
}

impl Fit {
    /// Adds a sensor, unless it is on board already.
    pub fn add(&mut self, sensor: &'static Sensor) {
        if self.sensors.iter().all(|fitted| fitted.id != sensor.id) {
            self.sensors.push(sensor);
        }
    }

    /// The parts for its loads, with the dropper that loads counted in pieces need, and its flail, by id and count.
    pub fn tools(&self) -> Vec<(&'static str, u32)> {
        let drops = self.loads.keys().any(|load| *load != Load::Spray);
        let loads = self.loads.iter().map(|(load, count)| {
            let pieces = match load {
                Load::Spray => count.div_ceil(TANK_S),
                Load::Ball | Load::Kit | Load::Node => *count,
            };
            (load.part(), pieces)
        });
        let dropper = drops.then_some((DROPPER, 1));
        let flail = self.flail.then_some((FLAIL, 1));
        dropper.into_iter().chain(loads).chain(flail).collect()
    }
}
