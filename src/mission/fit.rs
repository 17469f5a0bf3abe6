//! The equipment of vehicles on a mission.

use std::collections::BTreeMap;

use super::ground_truth::Load;
use super::radio::Set;
use super::sensor::Sensor;

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
}
