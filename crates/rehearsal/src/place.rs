//! Positions and times of vehicles: their starts, and the samples of their tracks.

use sortie_geo::LatLon;
use sortie_plan::Home;
use sortie_sim::{STEP, Start};

use crate::{Conditions, Participant, RehearsalError};

/// Steps between two samples: two vehicles that approach each other at 30 m/s come 0.6 m closer in that time.
pub(crate) const STEPS: u32 = 2;
/// Samples between two points of a track.
pub(crate) const TRACK_EVERY: u32 = 10;
/// Vehicles whose homes are closer together than this, in metres, start side by side.
const SAME_PLACE_M: f64 = 2.0;
/// The distance between vehicles that start side by side, in metres; it is large enough to avoid a
/// conflict.
const SIDE_BY_SIDE_M: f64 = 8.0;

/// The positions of a vehicle at regular times since the start of the rehearsal, `None` on the ground: metres north and
/// east of the first vehicle's start, and metres above sea level.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Track {
    pub(crate) points: Vec<Option<[f64; 3]>>,
}

/// The time between two samples, in seconds.
pub(crate) fn sample_s() -> f64 {
    STEP.as_secs_f64() * f64::from(STEPS)
}

/// Where a vehicle starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// The vehicle's number, from 0.
    pub(crate) vehicle: usize,
    pub(crate) start: Start,
    /// How far the start is east of the vehicle's home, in metres.
    pub(crate) moved_east_m: f64,
}

/// Where the vehicles start.
///
/// # Errors
/// A vehicle has no plan or no home.
pub(crate) fn places(
    participants: &[Participant],
    conditions: &Conditions,
) -> Result<Vec<Place>, RehearsalError> {
    let mut places: Vec<Place> = Vec::new();
    for (vehicle, participant) in participants.iter().enumerate() {
        if participant.document.plan.is_empty() {
            return Err(RehearsalError::NoPlan(vehicle));
        }
        let own = participant.document.home.map(|Home { x, y, z }| Start {
            at: LatLon::from_e7(x, y),
            altitude_amsl_m: f64::from(z),
            heading_deg: 0.0,
        });
        let home = own
            .or(conditions.home)
            .ok_or(RehearsalError::NoHome(vehicle))?;
        let mut moved_east_m = 0.0;
        let at = |moved_m| home.at.moved(0.0, moved_m);
        let is_taken = |moved_m| {
            let near = |it: &Place| it.start.at.distance_m(at(moved_m)) < SAME_PLACE_M;
            places.iter().any(near)
        };
        while is_taken(moved_east_m) {
            moved_east_m += SIDE_BY_SIDE_M;
        }
        let start = Start {
            at: at(moved_east_m),
            ..home
        };
        places.push(Place {
            vehicle,
            start,
            moved_east_m,
        });
    }
    Ok(places)
}

/// The origin of all points: the first start.
pub(crate) fn origin(places: &[Place]) -> LatLon {
    places
        .first()
        .map_or(LatLon::new(0.0, 0.0), |place| place.start.at)
}
