//! The objectives' demands on their mission, for the check whether it can be flown at all.

use std::time::Duration;

use super::route::GateRoute;
use crate::mission::fit::Fit;
use crate::mission::format::NamedPlace;
use crate::mission::ground_truth::Load;
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;

/// What one objective demands. Its parts are named by the keys of the file that ask for them, so that a fault can be
/// shown where it was written.
#[derive(Debug, Default)]
pub(crate) struct Demands<'o> {
    /// What some vehicle has to carry.
    pub equipment: Option<DemandedEquipment>,
    /// Where vehicles have to fly, by the key `zone`.
    pub zone: Option<&'o Zone>,
    /// Where vehicles have to fly or land, in any order.
    pub places: Option<DemandedPlaces<'o>>,
    /// What vehicles have to fly through, by the key `gates`.
    pub route: Option<&'o GateRoute>,
    /// The lowest and the highest height that count, in metres, by the key `heights`.
    pub heights_m: Option<[f64; 2]>,
    /// Times that must pass within the mission.
    pub times: Vec<DemandedTime>,
    /// Time that the vehicles have to stay in the zone or at the places, of all vehicles together.
    pub staying: Duration,
}

/// Equipment that a key asks for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DemandedEquipment {
    pub key: &'static str,
    pub equipment: Equipment,
}

/// What has to be on board of some vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Equipment {
    /// One of these loads.
    AnyOf(&'static [Load]),
    AnySensor,
    /// A sensor that finds objects.
    Detector,
}

/// Places that a key names.
#[derive(Debug)]
pub(crate) struct DemandedPlaces<'o> {
    pub key: &'static str,
    pub all: &'o [NamedPlace],
}

/// A time that a key asks for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DemandedTime {
    pub key: &'static str,
    pub time: Duration,
}

impl DemandedTime {
    /// A time of a file in seconds, which cannot be negative.
    pub fn seconds(key: &'static str, seconds: f64) -> Self {
        let time = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
        Self { key, time }
    }
}

impl Equipment {
    /// Whether some vehicle of a fleet carries it.
    pub fn is_carried(self, fleet: &[Fit]) -> bool {
        let has_sensor = |wanted: fn(&Sensor) -> bool| {
            let mut sensors = fleet.iter().flat_map(|fit| &fit.sensors);
            sensors.any(|sensor| wanted(sensor))
        };
        match self {
            Self::AnyOf(loads) => {
                let mut carried = fleet.iter().flat_map(|fit| fit.loads.keys());
                carried.any(|load| loads.contains(load))
            }
            Self::AnySensor => has_sensor(|_| true),
            Self::Detector => has_sensor(|sensor| sensor.detector().is_some()),
        }
    }

    /// What it is, for people who write missions: "no vehicle carries ..".
    pub fn words(self) -> String {
        match self {
            Self::AnyOf(loads) => {
                let names = loads.iter().map(|load| format!("`{}`", load.id()));
                format!("a {}", names.collect::<Vec<_>>().join(" or "))
            }
            Self::AnySensor => "a sensor".to_owned(),
            Self::Detector => "a sensor that finds things".to_owned(),
        }
    }
}
