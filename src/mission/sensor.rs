//! Virtual sensors: the readings of a sensor on a vehicle, from the true world. Probes measure a quantity at their
//! position; detectors find objects around them.

mod catalogue;
mod detector;
mod look;
mod probe;

pub(crate) use catalogue::SENSORS;
pub(crate) use detector::DetectorSpec;
use detector::{Band, Camera, Ground};
pub(crate) use look::{Look, View};
use probe::{Noise, Response};
pub(crate) use probe::{Probe, ProbeSpec};

/// A kind of sensor.
#[derive(Debug, PartialEq)]
pub(crate) struct Sensor {
    /// Its id in mission files and in the parts catalogue.
    pub id: &'static str,
    /// The message id of its name.
    pub name: &'static str,
    pub work: Work,
}

/// The function of a sensor.
#[derive(Debug, PartialEq)]
pub(crate) enum Work {
    /// The sensor measures a quantity at its position.
    Probe(ProbeSpec),
    Detector(DetectorSpec),
}

impl Sensor {
    /// The sensor's measuring properties, if it is a probe.
    pub fn probe(&self) -> Option<&ProbeSpec> {
        match &self.work {
            Work::Probe(spec) => Some(spec),
            Work::Detector(_) => None,
        }
    }

    /// The sensor's detection properties, if it is a detector.
    pub fn detector(&self) -> Option<&DetectorSpec> {
        match &self.work {
            Work::Probe(_) => None,
            Work::Detector(spec) => Some(spec),
        }
    }

    /// The width of the strip that the sensor covers at a height above the ground; `None` for a
    /// probe.
    pub fn swath_m(&self, height_m: f64) -> Option<f64> {
        self.detector().map(|spec| spec.swath_m(height_m))
    }

    /// Whether the sensor can replace another one. A camera can replace any camera of the same
    /// band; a finer one merely works from a greater height.
    pub fn stands_in_for(&self, other: &Self) -> bool {
        match (self.detector(), other.detector()) {
            (Some(DetectorSpec::Camera(one)), Some(DetectorSpec::Camera(other))) => {
                let inspects = one.inspects_to_m.is_some() || other.inspects_to_m.is_none();
                let finds_mines = one.mines.is_some() || other.mines.is_none();
                one.band == other.band && inspects && finds_mines
            }
            _ => self.id == other.id,
        }
    }

    /// The ids of all sensors, in catalogue order.
    pub fn ids() -> Vec<&'static str> {
        SENSORS.iter().map(|sensor| sensor.id).collect()
    }

    /// The sensor with an id.
    pub fn by_id(id: &str) -> Option<&'static Self> {
        SENSORS.iter().find(|sensor| sensor.id == id)
    }
}
