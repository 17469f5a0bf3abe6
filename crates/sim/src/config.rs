//! The configuration of a world: vehicles, their places, obstacles.

use std::sync::Arc;

use super::airframe::Airframe;
use super::collision::Obstacle;
use super::kind::VehicleKind;
use sortie_geo::LatLon;

const ROW_SPACING_M: f64 = 5.0;

/// The content of a world.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldConfig {
    /// One start per vehicle; the first has system id 1.
    pub starts: Vec<Start>,
    /// The airframe of each vehicle, in the order of the starts; the last one applies to all further vehicles; if there
    /// are none, the vehicles are [`Airframe::standard`] quadcopters.
    pub airframes: Vec<Arc<Airframe>>,
    /// The kind of each vehicle, in the order of the starts; the last one applies to all further vehicles; if there are
    /// none, the vehicles are copters.
    pub kinds: Vec<VehicleKind>,
    /// Seed of everything random (gusts).
    pub seed: u64,
    /// The obstacles that vehicles can hit.
    pub obstacles: Vec<Obstacle>,
    /// How long the vehicles take to boot.
    pub boot: BootPace,
}

/// How long vehicles take from being switched on to being ready.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BootPace {
    /// They were switched on long ago, and are ready. A reboot takes about a second.
    Over,
    /// They are ready after about a second.
    #[default]
    Quick,
    /// They take as long as real ones: half a minute or more until they can be armed in GUIDED.
    Realistic,
}

impl WorldConfig {
    /// Vehicles side by side to the east, 5 m apart, seed 0.
    pub fn row(vehicles: usize, first: Start) -> Self {
        let starts = (0..vehicles)
            .map(|place| Start {
                at: first.at.moved(0.0, ROW_SPACING_M * place as f64),
                ..first
            })
            .collect();
        Self {
            starts,
            airframes: Vec::new(),
            kinds: Vec::new(),
            seed: 0,
            boot: BootPace::Quick,
            obstacles: Vec::new(),
        }
    }

    /// The kind of a vehicle.
    pub fn kind(&self, vehicle: usize) -> VehicleKind {
        let own = self.kinds.get(vehicle).or(self.kinds.last());
        own.copied().unwrap_or_default()
    }

    /// The airframe of a vehicle; `usual` if none was configured.
    pub(super) fn airframe(&self, vehicle: usize, usual: &Arc<Airframe>) -> Arc<Airframe> {
        let own = self.airframes.get(vehicle).or(self.airframes.last());
        Arc::clone(own.unwrap_or(usual))
    }
}

/// The start position of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Latitude and longitude in degrees.
    pub at: LatLon,
    /// Height of the ground there, metres above mean sea level.
    pub altitude_amsl_m: f64,
    /// The heading, degrees clockwise from north.
    pub heading_deg: f64,
}

/// A serial port of a vehicle. Each has its own rates of telemetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Serial {
    /// The USB port: it also accepts unsigned packets.
    Zero,
    /// The first radio: it refuses unsigned packets once a signing key is set.
    One,
    /// The second radio, with the same rules as the first.
    Two,
}

impl Serial {
    /// All ports of a vehicle.
    pub const ALL: [Self; 3] = [Self::Zero, Self::One, Self::Two];

    /// The port's number, from 0.
    pub fn index(self) -> usize {
        self as usize
    }
}
