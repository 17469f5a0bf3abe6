//! The equipment of vehicles on a mission.

use std::collections::BTreeMap;

use super::ground_truth::Load;
use super::radio::Set;
use super::sensor::Sensor;

/// What one vehicle carries.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Fit {
    /// Its sensors: those of the whole fleet, then its own.
    pub sensors: Vec<&'static Sensor>,
    /// What it starts with and gets again when it is served on its pad; a load that is not here it never has.
    pub loads: BTreeMap<Load, u32>,
    /// Its own radio; without one it has that of the mission, if radio matters there.
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
