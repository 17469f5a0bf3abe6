//! Virtual sensors: what a sensor on a vehicle would show of a world's truth. Probes measure a quantity where they
//! are; detectors find objects around them.

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
    /// The message with its name for people.
    pub name: &'static str,
    pub work: Work,
}

/// What a sensor does.
#[derive(Debug, PartialEq)]
pub(crate) enum Work {
    /// It measures where it is.
    Probe(ProbeSpec),
    Detector(DetectorSpec),
}

impl Sensor {
    /// How it measures, if it does.
    pub fn probe(&self) -> Option<&ProbeSpec> {
        match &self.work {
            Work::Probe(spec) => Some(spec),
            Work::Detector(_) => None,
        }
    }

    /// How it finds things, if it does.
    pub fn detector(&self) -> Option<&DetectorSpec> {
        match &self.work {
            Work::Probe(_) => None,
            Work::Detector(spec) => Some(spec),
        }
    }

    /// How wide a strip it covers on a pass at a height above the ground; `None` for what measures at one point.
    pub fn swath_m(&self, height_m: f64) -> Option<f64> {
        self.detector().map(|spec| spec.swath_m(height_m))
    }

    /// Whether it does what another one is for. Cameras that see the same light do, whatever they resolve: with a finer
    /// one things are seen from higher up.
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

    /// The ids of all sensors, in the order of the catalogue.
    pub fn ids() -> Vec<&'static str> {
        SENSORS.iter().map(|sensor| sensor.id).collect()
    }

    /// The sensor of an id.
    pub fn by_id(id: &str) -> Option<&'static Self> {
        SENSORS.iter().find(|sensor| sensor.id == id)
    }
}
