//! The wind of a rehearsal, and where it is known from.

use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{Vehicle, VehicleId, Wind};

/// The default of `SIM_WIND_DIR`.
const USUAL_FROM_DEG: f32 = 180.0;

/// The wind, from the best source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KnownAir {
    wind: Wind,
    source: AirSource,
}

/// Where the wind is known from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AirSource {
    /// The user gives it.
    Given,
    /// A vehicle estimates it.
    Estimated(VehicleId),
    /// The mission's weather.
    Mission,
    /// The parameters of simulated vehicles.
    Simulator,
    Unknown,
}

impl KnownAir {
    /// The wind given, otherwise that of the first vehicle that estimates one, otherwise the mission's.
    pub(super) fn of<'a>(
        given: Option<Wind>,
        of_mission: Option<Wind>,
        mut vehicles: impl Iterator<Item = &'a Vehicle>,
    ) -> Self {
        // A vehicle that cannot estimate the wind reports zeros.
        let estimated = || {
            vehicles.find_map(|vehicle| {
                let wind = vehicle.wind.filter(|wind| wind.speed_m_s > 0.0)?;
                Some((wind, AirSource::Estimated(vehicle.id)))
            })
        };
        let calm = Wind {
            from_deg: 0.0,
            speed_m_s: 0.0,
        };
        let known = given
            .map(|wind| (wind, AirSource::Given))
            .or_else(estimated)
            .or(of_mission.map(|wind| (wind, AirSource::Mission)));
        let (wind, source) = known.unwrap_or((calm, AirSource::Unknown));
        Self { wind, source }
    }

    /// Takes the wind from a simulated vehicle's parameters if it is not known otherwise.
    pub(super) fn note_parameters(&mut self, value: impl Fn(&str) -> Option<f32>) {
        if self.source != AirSource::Unknown {
            return;
        }
        if let Some(speed_m_s) = value("SIM_WIND_SPD") {
            self.wind = Wind {
                from_deg: value("SIM_WIND_DIR").unwrap_or(USUAL_FROM_DEG),
                speed_m_s,
            };
            self.source = AirSource::Simulator;
        }
    }

    pub(super) fn wind(&self) -> Wind {
        self.wind
    }

    /// The wind and its source in words.
    pub(super) fn words(&self) -> Text {
        let speed = figure(self.wind.speed_m_s, 1);
        let from = figure(self.wind.from_deg, 0);
        match self.source {
            AirSource::Given => text!("rehearse-wind-given", speed = speed, from = from),
            AirSource::Estimated(vehicle) => text!(
                "rehearse-wind-estimated",
                speed = speed,
                from = from,
                vehicle = vehicle
            ),
            AirSource::Mission => text!("rehearse-wind-mission", speed = speed, from = from),
            AirSource::Simulator => text!("rehearse-wind-simulator", speed = speed, from = from),
            AirSource::Unknown => text!("rehearse-wind-unknown"),
        }
    }
}
