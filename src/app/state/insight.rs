//! What the desk of a class sees of a watched flight beside the screen.

use super::State;
use crate::class::{
    Insight, InsightPlace, ObjectiveInsight, ObjectiveStanding, TargetInsight, VehicleInsight,
    VehiclePlace, Words,
};
use crate::geo::LatLon;
use crate::mission::{ObjectiveProgress, ObjectiveState};
use crate::scoring::TruthReport;
use crate::text;
use crate::text::Locale;
use crate::vehicle::{Vehicle, VehicleId};

/// The truth of a flight, as far as the program knows it: simulated vehicles may be elsewhere than their telemetry says.
#[derive(Debug, Clone, Default)]
pub struct FlightTruth {
    /// The origin of the mission's places.
    pub origin: Option<LatLon>,
    pub vehicles: Vec<TrueVehicle>,
    /// What is to be found; `None` without a mission.
    pub report: Option<TruthReport>,
}

/// Where a vehicle is in truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueVehicle {
    pub id: VehicleId,
    pub at: LatLon,
    /// Metres above its start.
    pub height_m: f64,
}

impl<R> State<R> {
    /// What the desk sees of the flight while it watches; `None` without a flight.
    pub fn insight(&self, truth: &FlightTruth) -> Option<Insight> {
        let session = &self.session;
        if session.activity.is_none() || self.replay.is_some() {
            return None;
        }
        let locale = self.locale();
        let objectives = session.task.progress.iter().flat_map(|it| &it.objectives);
        let alerts = session.alerts.open().map(|(vehicle, standing)| {
            let cause = standing.alert.text.clone();
            let text = text!("class-alert-of", vehicle = vehicle, cause = cause);
            locale.text(&text).into()
        });
        let report = truth.report.as_ref();
        let fences = report.iter().flat_map(|it| &it.fences);
        let objects = report.iter().flat_map(|it| &it.objects);
        let targets = objects.filter(|it| it.present && it.sought);
        Some(Insight {
            objectives: objectives.map(|it| objective(it, locale)).collect(),
            alerts: alerts.collect(),
            vehicles: self.vehicle_insights(truth),
            fences: fences
                .map(|fence| fence.iter().copied().map(decimetres).collect())
                .collect(),
            targets: targets
                .map(|it| TargetInsight {
                    at: decimetres(it.at),
                    is_found: it.found,
                })
                .collect(),
        })
    }

    fn vehicle_insights(&self, truth: &FlightTruth) -> Vec<VehicleInsight> {
        let session = &self.session;
        let vehicles = session.vehicles.values();
        let own = vehicles.filter(|it| session.expects(it.id));
        let Some(origin) = truth.origin.or_else(|| {
            let mut homes = own.clone().filter_map(|it| it.home);
            homes.next().map(|home| home.at_point)
        }) else {
            return Vec::new();
        };
        own.map(|vehicle| {
            let mut known = truth.vehicles.iter();
            let true_vehicle = known.find(|it| it.id == vehicle.id);
            VehicleInsight {
                id: vehicle.id,
                mode: mode(vehicle),
                battery: vehicle.battery().and_then(|it| it.remaining_percent),
                shown: vehicle
                    .global
                    .map(|it| place(origin, it.at_point, it.altitude_m)),
                truth: true_vehicle.map(|it| place(origin, it.at, it.height_m)),
            }
        })
        .collect()
    }
}

fn mode(vehicle: &Vehicle) -> Words {
    vehicle.short_mode_name().unwrap_or_default().into()
}

fn objective(progress: &ObjectiveProgress, locale: &Locale) -> ObjectiveInsight {
    ObjectiveInsight {
        title: locale.text(&progress.title).into(),
        detail: locale.text(&progress.detail).into(),
        standing: match progress.state {
            ObjectiveState::Open => ObjectiveStanding::Open,
            ObjectiveState::Met => ObjectiveStanding::Met,
            ObjectiveState::Missed => ObjectiveStanding::Missed,
        },
    }
}

fn place(origin: LatLon, at: LatLon, height_m: f64) -> VehiclePlace {
    let (north_m, east_m) = origin.offset_to(at);
    VehiclePlace {
        at: decimetres([east_m, north_m]),
        height: (height_m * 10.0).round() as i32,
    }
}

/// A place in decimetres; a number that is too large becomes the largest one.
fn decimetres(at: [f64; 2]) -> InsightPlace {
    at.map(|metres| (metres * 10.0).round() as i32)
}
