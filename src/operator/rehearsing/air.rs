//! The wind of a rehearsal, and its source.

use crate::mission::WIND_FULL_FROM_M;
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{Vehicle, VehicleId, Wind};

/// The default of `SIM_WIND_DIR`.
const USUAL_FROM_DEG: f32 = 180.0;

/// The profile of the mean wind with height: with 0, it grows with the square root of the height up
/// to [`FULL_FROM`].
const PROFILE: &str = "SIM_WIND_T";
const FULL_FROM: &str = "SIM_WIND_T_ALT";
/// The values of [`PROFILE`] for a growing and for a constant wind.
const GROWING: f32 = 0.0;
const CONSTANT: f32 = 1.0;
/// The default of [`FULL_FROM`], in metres.
const USUAL_FULL_FROM_M: f32 = 60.0;
/// The maximum factor by which an estimate is raised: an estimate from near the ground is a poor
/// guide to the wind above.
const MOST_GROWTH: f32 = 3.0;

/// The wind, from the best source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KnownAir {
    wind: Wind,
    source: AirSource,
    /// The profile of the vehicle that estimates the wind.
    profile: WindProfile,
    /// Whether a mission is flown, which sets the profile of its vehicles.
    is_mission: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct WindProfile {
    /// The value of [`PROFILE`].
    kind: f32,
    /// The value of [`FULL_FROM`], in metres.
    full_from_m: f32,
}

impl WindProfile {
    const USUAL: Self = Self {
        kind: GROWING,
        full_from_m: USUAL_FULL_FROM_M,
    };

    /// The share of the full wind at a height above home, from 0 to 1.
    fn share(self, height_m: f32) -> f32 {
        if (self.kind - GROWING).abs() < 0.5 {
            let share = height_m / self.full_from_m.max(1.0);
            share.clamp(0.0, 1.0).sqrt()
        } else {
            1.0
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum AirSource {
    /// The user gives the wind.
    Given,
    /// A vehicle estimates the wind, at this height above home in metres, if the height is known.
    Estimated(VehicleId, Option<f32>),
    Mission,
    /// The wind is set by the parameters of simulated vehicles.
    Simulator,
    Unknown,
}

impl KnownAir {
    /// The wind given, otherwise that of the first vehicle that estimates one, otherwise the
    /// mission's, otherwise calm air.
    pub(super) fn of<'a>(
        given: Option<Wind>,
        of_mission: Option<Wind>,
        mut vehicles: impl Iterator<Item = &'a Vehicle>,
    ) -> Self {
        // A vehicle that cannot estimate the wind reports zeros.
        let estimated = || {
            vehicles.find_map(|vehicle| {
                let wind = vehicle.wind.filter(|wind| wind.speed_m_s > 0.0)?;
                let source = AirSource::Estimated(vehicle.id, vehicle.wind_height_m);
                Some((wind, source))
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
        Self {
            wind,
            source,
            profile: WindProfile::USUAL,
            is_mission: of_mission.is_some(),
        }
    }

    /// Takes the wind from a simulated vehicle's parameters if no better source is known, and the
    /// profile if that vehicle estimates the wind.
    pub(super) fn note_parameters(
        &mut self,
        vehicle: VehicleId,
        value: impl Fn(&str) -> Option<f32>,
    ) {
        if matches!(self.source, AirSource::Estimated(by, _) if by == vehicle) {
            self.profile = WindProfile {
                kind: value(PROFILE).unwrap_or(self.profile.kind),
                full_from_m: value(FULL_FROM).unwrap_or(self.profile.full_from_m),
            };
        }
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

    /// The wind as the simulator expects it: at the height above which it no longer grows.
    pub(super) fn wind(&self) -> Wind {
        let AirSource::Estimated(_, Some(height_m)) = self.source else {
            return self.wind;
        };
        let growth = (1.0 / self.profile.share(height_m)).min(MOST_GROWTH);
        Wind {
            speed_m_s: self.wind.speed_m_s * growth,
            ..self.wind
        }
    }

    /// The parameters that set the profile; empty if the vehicles' own parameters apply.
    pub(super) fn parameters(&self) -> Vec<(String, f32)> {
        let named = |values: &[(&str, f32)]| -> Vec<(String, f32)> {
            let values = values.iter();
            values
                .map(|(name, value)| ((*name).to_owned(), *value))
                .collect()
        };
        let of_mission = [(PROFILE, GROWING), (FULL_FROM, WIND_FULL_FROM_M as f32)];
        match self.source {
            AirSource::Estimated(_, None) => named(&[(PROFILE, CONSTANT)]),
            AirSource::Given | AirSource::Mission if self.is_mission => named(&of_mission),
            AirSource::Given
            | AirSource::Mission
            | AirSource::Estimated(_, Some(_))
            | AirSource::Simulator
            | AirSource::Unknown => Vec::new(),
        }
    }

    /// The wind and its source in words.
    pub(super) fn words(&self) -> Text {
        let speed = figure(self.wind.speed_m_s, 1);
        let from = figure(self.wind.from_deg, 0);
        match self.source {
            AirSource::Given => text!("rehearse-wind-given", speed = speed, from = from),
            AirSource::Estimated(vehicle, None) => text!(
                "rehearse-wind-estimated",
                speed = speed,
                from = from,
                vehicle = vehicle
            ),
            AirSource::Estimated(vehicle, Some(height_m)) => text!(
                "rehearse-wind-estimated-at",
                speed = speed,
                from = from,
                vehicle = vehicle,
                height = figure(height_m, 0)
            ),
            AirSource::Mission => text!("rehearse-wind-mission", speed = speed, from = from),
            AirSource::Simulator => text!("rehearse-wind-simulator", speed = speed, from = from),
            AirSource::Unknown => text!("rehearse-wind-unknown"),
        }
    }
}
