//! Other aircraft as programs see them.

use std::time::Duration;

use serde::Serialize;
use utoipa::ToSchema;

use crate::app::state::{TrackedAircraft, VehicleApproach};
use crate::vehicle::{TrafficThreat, VehicleId};

/// Another aircraft, from a vehicle's ADS-B receiver or from the mission.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct AircraftView {
    /// The aircraft's callsign, or its ICAO address in hexadecimal.
    pub name: String,
    /// The aircraft's ICAO address; `null` for an aircraft of a mission.
    pub icao: Option<u32>,
    pub lat_deg: f64,
    pub lon_deg: f64,
    pub altitude_amsl_m: f64,
    pub course_deg: Option<f64>,
    pub speed_m_s: Option<f64>,
    /// The rate of climb; negative in a descent.
    pub climb_m_s: Option<f64>,
    /// The age of the aircraft's position.
    pub age_s: f64,
    /// The approaches to vehicles in the air, the most urgent first, if the aircraft and the
    /// vehicle keep their velocity.
    pub approaches: Vec<ApproachView>,
}

/// The approach of an aircraft to one vehicle; heights are those of the aircraft above the vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ApproachView {
    pub vehicle: VehicleId,
    /// The current horizontal distance.
    pub distance_m: f64,
    pub height_m: f64,
    /// The time until the aircraft and the vehicle are closest; 0 if they move apart.
    pub in_s: f64,
    /// The horizontal distance at the closest approach.
    pub closest_m: f64,
    pub closest_height_m: f64,
    /// `critical` (100 m within 30 s), `warning` (300 m) or `none`.
    #[schema(value_type = String)]
    pub threat: &'static str,
}

impl AircraftView {
    pub(super) fn new(tracked: &TrackedAircraft, now: Duration) -> Self {
        let aircraft = &tracked.aircraft;
        Self {
            name: aircraft.name(),
            icao: aircraft.icao,
            lat_deg: aircraft.at_point.lat_deg,
            lon_deg: aircraft.at_point.lon_deg,
            altitude_amsl_m: aircraft.altitude_amsl_m,
            course_deg: aircraft.course_deg(),
            speed_m_s: aircraft.speed_m_s(),
            climb_m_s: aircraft.climb_m_s,
            age_s: aircraft.age(now).as_secs_f64(),
            approaches: tracked.approaches.iter().map(ApproachView::from).collect(),
        }
    }
}

impl From<&VehicleApproach> for ApproachView {
    fn from(one: &VehicleApproach) -> Self {
        let approach = &one.approach;
        Self {
            vehicle: one.vehicle,
            distance_m: approach.distance_m,
            height_m: approach.height_m,
            in_s: approach.in_s,
            closest_m: approach.closest_m,
            closest_height_m: approach.closest_height_m,
            threat: match approach.threat {
                TrafficThreat::Critical => "critical",
                TrafficThreat::Warning => "warning",
                TrafficThreat::None => "none",
            },
        }
    }
}
