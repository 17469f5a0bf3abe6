//! The objectives' demands on their mission, for checking whether it can be flown.

use std::time::Duration;

use super::route::GateRoute;
use crate::mission::fit::Fit;
use crate::mission::format::NamedPlace;
use crate::mission::ground_truth::Load;
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;
use crate::text;
use crate::text::Text;

/// The demands of one objective. Fields are named after the keys of the file, so that a fault can be reported there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Demands<'o> {
    /// Equipment that some vehicle must carry.
    pub equipment: Option<DemandedEquipment>,
    /// The zone to fly in, by the key `zone`.
    pub zone: Option<&'o Zone>,
    /// The places to fly to or land at, in any order.
    pub places: Option<DemandedPlaces<'o>>,
    /// The gates to fly through, by the key `gates`.
    pub route: Option<&'o GateRoute>,
    /// The lowest and the highest height that count, in metres, by the key `heights`.
    pub heights_m: Option<[f64; 2]>,
    /// Times that must fit into the mission.
    pub times: Vec<DemandedTime>,
    /// The time that all vehicles together must spend in the zone or at the places.
    pub staying: Duration,
}

impl Demands<'_> {
    /// Demands only equipment, by the key `kind`.
    pub fn equipment(equipment: Equipment) -> Self {
        Self {
            equipment: Some(DemandedEquipment {
                key: "kind",
                equipment,
            }),
            ..Self::default()
        }
    }
}

/// Equipment required by a key of the mission file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DemandedEquipment {
    pub key: &'static str,
    pub equipment: Equipment,
}

/// Equipment that a vehicle must have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Equipment {
    /// Any of these loads.
    AnyOf(&'static [Load]),
    AnySensor,
    /// A sensor that finds objects.
    Detector,
    /// A sensor that measures a quantity.
    Probe,
}

/// Places listed under a key of the mission file.
#[derive(Debug, Clone)]
pub(crate) struct DemandedPlaces<'o> {
    pub key: &'static str,
    pub all: &'o [NamedPlace],
}

/// A time set by a key of the mission file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DemandedTime {
    pub key: &'static str,
    pub time: Duration,
}

impl DemandedTime {
    /// A time from a file in seconds, never negative.
    pub fn seconds(key: &'static str, seconds: f64) -> Self {
        let time = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
        Self { key, time }
    }
}

impl Equipment {
    /// Whether any vehicle of a fleet carries this equipment.
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
            Self::Probe => has_sensor(|sensor| sensor.probe().is_some()),
        }
    }

    /// The fault that no vehicle carries the equipment.
    pub fn missing(self) -> Text {
        match self {
            Self::AnyOf(loads) => {
                let names: Vec<_> = loads
                    .iter()
                    .map(|load| format!("`{}`", load.id()))
                    .collect();
                text!(
                    "check-no-load",
                    count = names.len(),
                    loads = names.join(", ")
                )
            }
            Self::AnySensor => text!("check-no-sensor"),
            Self::Detector => text!("check-no-detector"),
            Self::Probe => text!("check-no-probe"),
        }
    }
}
