//! The truth of a flight, which only an instructor sees while it is flown.

use std::sync::{Arc, OnceLock};

use tokio::sync::watch;

use super::RunningSession;
use super::mission_run::MissionRun;
use crate::app::state::{FlightTruth, TrueVehicle};
use crate::link::{TruePlace, TruePlaces};
use crate::mission::Flight;
use crate::vehicle::VehicleId;

/// The true places of simulated vehicles. The simulator publishes them from the first time on that they are asked for.
#[derive(Debug)]
pub(super) struct SimulatedTruth {
    places: TruePlaces,
    seen: OnceLock<watch::Receiver<Arc<[TruePlace]>>>,
}

impl SimulatedTruth {
    pub fn new(places: TruePlaces) -> Self {
        Self {
            places,
            seen: OnceLock::new(),
        }
    }

    fn vehicles(&self) -> Vec<TrueVehicle> {
        let seen = self.seen.get_or_init(|| self.places.subscribe());
        let places = seen.borrow();
        let numbered = (1..).zip(places.iter());
        let vehicle = |(id, place): (VehicleId, &TruePlace)| TrueVehicle {
            id,
            at: place.at,
            height_m: place.height_m,
        };
        numbered.map(vehicle).collect()
    }
}

impl RunningSession {
    /// The truth of the flight, as far as this program knows it.
    pub fn truth(&self) -> FlightTruth {
        let flight = self.mission_run.as_ref().map(MissionRun::flight);
        FlightTruth {
            origin: flight.map(|flight| flight.mission().origin()),
            vehicles: self
                .truth
                .as_ref()
                .map_or_else(Vec::new, SimulatedTruth::vehicles),
            report: flight.map(Flight::truth_report),
        }
    }
}
