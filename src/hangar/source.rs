//! The source of a session's simulated vehicles: the simulator and where it runs.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::client::RemoteHangar;
use super::{HangarSetup, Hangars, Launch};
use crate::scoring::FlightBackend;
use crate::sim::{Airframe, Chassis, Start, VehicleKind, WorldConfig};
use crate::sitl::{FormationShape, SitlKind, StartFormation, gear_parameters};
use crate::text;
use crate::text::Text;

/// The distance between planes at the start: they need more room to take off than copters.
const PLANE_SPACING_M: f64 = 30.0;

/// Where ArduPilot's SITL runs.
#[derive(Debug, Clone)]
pub enum SitlSource {
    Own(Box<HangarSetup>),
    /// Services on this host or others.
    Far(Vec<RemoteHangar>),
}

impl SitlSource {
    /// Opens the hangars. Must be called inside a tokio runtime.
    ///
    /// # Errors
    /// A text if they cannot be opened.
    pub fn open(&self) -> Result<Hangars, Text> {
        match self {
            Self::Own(config) => {
                let folder = config.folder.display().to_string();
                let opened = super::Hangar::open((**config).clone());
                opened.map(Hangars::own).map_err(|error| {
                    text!(
                        "hangar-cannot-open",
                        folder = folder,
                        error = error.to_string()
                    )
                })
            }
            Self::Far(services) => Ok(Hangars::far(services.clone())),
        }
    }
}

/// What flies in free flight, apart from the number of vehicles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FreeFlight {
    /// The kind of vehicle; planes and submarines need ArduPilot's SITL.
    pub kind: SitlKind,
    /// SITL's name for the model; by default, the one that suits the kind and the parameters.
    pub model: Option<String>,
    /// Parameters to start with, with SITL only.
    pub parameters: BTreeMap<String, f64>,
    /// Where the first vehicle stands; by default, the usual place of free flight.
    pub start: Option<Start>,
}

impl FreeFlight {
    /// The kind of vehicle in the embedded simulator; `None` if it does not have it.
    pub fn embedded(&self) -> Option<VehicleKind> {
        match (self.kind, self.model.as_deref()) {
            (SitlKind::Copter, None) => Some(VehicleKind::Copter),
            (SitlKind::Rover, None) => Some(VehicleKind::Rover(Chassis::Ackermann)),
            (SitlKind::Rover, Some(model)) => VehicleKind::named(model),
            (SitlKind::Copter | SitlKind::Plane | SitlKind::Sub, _) => None,
        }
    }

    /// A world with the vehicles side by side.
    pub fn world(&self, vehicles: usize, first: Start) -> WorldConfig {
        let world = WorldConfig::row(vehicles, first);
        if self.kind != SitlKind::Plane {
            return world;
        }
        let row = StartFormation {
            shape: FormationShape::Row,
            spacing_m: PLANE_SPACING_M,
        };
        WorldConfig {
            starts: row.starts(vehicles, first),
            ..world
        }
    }

    /// A launch with the kind, the model and the parameters of this flight.
    pub fn of(&self, launch: Launch) -> Launch {
        let mut parameters = launch.parameters;
        parameters.extend(self.parameters.clone());
        Launch {
            kind: self.kind,
            model: self.model.clone(),
            parameters,
            ..launch
        }
    }
}

#[derive(Debug, Clone, Default)]
pub struct VehicleBackend {
    /// ArduPilot's SITL; `None` for the embedded simulator.
    pub ardupilot: Option<SitlSource>,
    /// The chosen airframes: one for all vehicles, or one for each; the last one also applies to
    /// all further vehicles.
    pub airframes: Vec<Arc<Airframe>>,
    /// What flies outside of missions.
    pub free: FreeFlight,
}

impl VehicleBackend {
    /// The name of the simulator in the debrief and in `--json`.
    pub fn kind(&self) -> FlightBackend {
        match self.ardupilot {
            Some(_) => FlightBackend::ArduPilot,
            None => FlightBackend::Embedded,
        }
    }

    /// A world with the chosen airframes, if any, in place of its own.
    #[must_use]
    pub fn of(&self, world: WorldConfig) -> WorldConfig {
        if self.airframes.is_empty() {
            return world;
        }
        WorldConfig {
            airframes: self.airframes.clone(),
            ..world
        }
    }

    /// The launches for a world: a vehicle at each place, with system ids from 1.
    pub fn launches(&self, world: WorldConfig, speedup: f64) -> Vec<Launch> {
        let world = self.of(world);
        let systems = 1..=crate::wire::SystemId::MAX;
        let launch = |(at, (&start, system)): (usize, (&Start, u8))| {
            let kind = world.kind(at);
            let airframe = world.airframes.get(at).or(world.airframes.last());
            // A vehicle that drives has only an airframe that was built for it.
            let airframe =
                airframe.filter(|it| it.gear().is_some() == (kind != VehicleKind::Copter));
            let parameters = airframe.map_or(&[][..], |it| it.parameters());
            let gear = airframe.and_then(|it| it.gear());
            let of_gear = gear.map_or_else(Vec::new, |gear| gear_parameters(kind, gear));
            Launch {
                kind: kind.into(),
                model: (kind != VehicleKind::Copter).then(|| kind.name().to_owned()),
                frame: airframe.and_then(|it| it.file().cloned()),
                parameters: parameters
                    .iter()
                    .chain(&of_gear)
                    .map(|&(name, value)| (name.to_owned(), value))
                    .collect(),
                home: start.into(),
                system: Some(system),
                speedup,
                ..Launch::default()
            }
        };
        let starts = world.starts.iter().zip(systems).enumerate();
        starts.map(launch).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_flight_adds_its_kind_and_parameters_to_a_launch() {
        let free = FreeFlight {
            kind: SitlKind::Rover,
            model: Some("motorboat".to_owned()),
            parameters: [("WP_SPEED".to_owned(), 3.0)].into(),
            start: None,
        };
        let backend = VehicleBackend::default();
        let place = Start {
            at: crate::geo::LatLon::new(50.45, 30.52),
            altitude_amsl_m: 180.0,
            heading_deg: 90.0,
        };
        let launches = backend.launches(WorldConfig::row(2, place), 4.0);
        let launches: Vec<Launch> = launches.into_iter().map(|it| free.of(it)).collect();
        for (launch, system) in launches.iter().zip([1, 2]) {
            assert_eq!(
                (launch.kind, launch.system),
                (SitlKind::Rover, Some(system))
            );
            assert_eq!(launch.model.as_deref(), Some("motorboat"));
            assert_eq!(launch.parameters.get("WP_SPEED"), Some(&3.0));
            assert!(launch.check().is_ok() && launch.frame.is_none());
        }
    }

    #[test]
    fn planes_start_farther_apart() {
        let place = Start {
            at: crate::geo::LatLon::new(50.45, 30.52),
            altitude_amsl_m: 180.0,
            heading_deg: 90.0,
        };
        for (kind, apart_m) in [(SitlKind::Copter, 5.0), (SitlKind::Plane, 30.0)] {
            let free = FreeFlight {
                kind,
                ..FreeFlight::default()
            };
            let starts = free.world(2, place).starts;
            let between_m = starts[0].at.distance_m(starts[1].at);
            assert!((between_m - apart_m).abs() < 0.1, "{kind:?}: {between_m}");
        }
    }
}
