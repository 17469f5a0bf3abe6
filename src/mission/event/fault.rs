//! Faults on board.

use std::time::Duration;

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use super::scope::Sight;
use crate::mission::craft::Craft;
use crate::vehicle::VehicleId;

/// A fault that an event causes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fault {
    pub kind: FaultKind,
    pub victim: Victim,
    /// Its strength, in the unit of its kind.
    pub to: f64,
    /// How long it lasts; `None` for the rest of the flight.
    pub lasts: Option<Duration>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FaultKind {
    /// A motor gives only this share of its thrust.
    Motor,
    /// The battery falls to this share of its voltage.
    Battery,
    /// Satellite navigation stops; the number does not matter.
    Gps,
    /// Satellite navigation is off by this many metres to the north.
    GpsGlitch,
    /// The compass is off by this many milligauss.
    Compass,
    /// The barometer drifts by this many metres per second.
    Barometer,
    /// Hazard sensors keep the reading that they had when the fault began.
    SensorStuck,
    /// Hazard sensors drift upwards, by this much of their unit each second.
    SensorDrift,
    /// This share of the radio messages is lost; 1 is all.
    Link,
}

impl FaultKind {
    /// All kinds by their names in files, with the default value and the valid range.
    pub const ALL: [(&str, Self, f64, std::ops::RangeInclusive<f64>); 9] = [
        ("motor", Self::Motor, 0.7, 0.0..=1.0),
        ("battery", Self::Battery, 0.8, 0.3..=1.0),
        ("gps", Self::Gps, 1.0, 0.0..=1.0),
        ("gps_glitch", Self::GpsGlitch, 30.0, -1000.0..=1000.0),
        ("compass", Self::Compass, 300.0, -1000.0..=1000.0),
        ("barometer", Self::Barometer, 0.3, -10.0..=10.0),
        ("sensor_stuck", Self::SensorStuck, 1.0, 0.0..=1.0),
        ("sensor_drift", Self::SensorDrift, 0.1, -1e6..=1e6),
        ("link", Self::Link, 1.0, 0.0..=1.0),
    ];
}

/// The vehicle that a fault hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Victim {
    /// The vehicle with this index, from 0.
    One(usize),
    All,
    /// A random vehicle in the air or, if none is, any vehicle.
    Chance,
}

/// A fault that a vehicle has now.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Broken {
    pub kind: FaultKind,
    pub vehicle: VehicleId,
    pub to: f64,
    pub since: Duration,
    pub until: Option<Duration>,
    /// The reading of each sensor when the fault began, and the voltage.
    pub held: Vec<f64>,
}

/// The faults that vehicles have now.
#[derive(Debug, Clone, Default)]
pub(crate) struct Breakdowns(Vec<Broken>);

impl Breakdowns {
    /// Ends the faults whose time is over.
    pub fn mend(&mut self, now: Duration) {
        self.0
            .retain(|broken| broken.until.is_none_or(|until| until > now));
    }

    /// Causes a fault on the vehicles that it hits, and returns them.
    pub fn add(
        &mut self,
        fault: &Fault,
        sight: &Sight<'_>,
        random: &mut ChaCha8Rng,
    ) -> Vec<VehicleId> {
        let hit = fault.victim.among(sight.crafts, random);
        for craft in &hit {
            let vehicle = sight.vehicles.get(&craft.id);
            let voltage = vehicle.and_then(|vehicle| vehicle.battery()?.voltage_v);
            let mut held = craft.shown();
            held.extend(voltage.map(f64::from));
            self.0
                .retain(|broken| (broken.kind, broken.vehicle) != (fault.kind, craft.id));
            self.0.push(Broken {
                kind: fault.kind,
                vehicle: craft.id,
                to: fault.to,
                since: sight.now,
                until: fault.lasts.map(|lasts| sight.now + lasts),
                held,
            });
        }
        hit.into_iter().map(|craft| craft.id).collect()
    }

    /// The faults of one vehicle.
    pub fn of(&self, vehicle: VehicleId) -> impl Iterator<Item = &Broken> {
        self.0
            .iter()
            .filter(move |broken| broken.vehicle == vehicle)
    }

    /// The reading of a vehicle's sensor under its faults, instead of the true value.
    pub fn shown(&self, vehicle: VehicleId, sensor: usize, shown: f64, now: Duration) -> f64 {
        let broken = self.of(vehicle);
        broken.fold(shown, |shown, broken| broken.shown(sensor, shown, now))
    }
}

impl Victim {
    fn among<'a>(self, crafts: &'a [Craft], random: &mut ChaCha8Rng) -> Vec<&'a Craft> {
        match self {
            Self::One(index) => crafts.get(index).into_iter().collect(),
            Self::All => crafts.iter().collect(),
            Self::Chance => {
                let flies = |craft: &&Craft| craft.under_way && !craft.lost;
                let flying: Vec<&Craft> = crafts.iter().filter(flies).collect();
                let among = if flying.is_empty() {
                    crafts.iter().collect()
                } else {
                    flying
                };
                let chosen = random.random_range(0..among.len().max(1));
                among.get(chosen).copied().into_iter().collect()
            }
        }
    }
}

impl Broken {
    /// The reading of a hazard sensor under this fault, instead of the true value.
    pub fn shown(&self, sensor: usize, shown: f64, now: Duration) -> f64 {
        match self.kind {
            FaultKind::SensorStuck => self.held.get(sensor).copied().unwrap_or(shown),
            FaultKind::SensorDrift => {
                let passed_s = now.saturating_sub(self.since).as_secs_f64();
                (shown + self.to * passed_s).max(0.0)
            }
            FaultKind::Motor
            | FaultKind::Battery
            | FaultKind::Gps
            | FaultKind::GpsGlitch
            | FaultKind::Compass
            | FaultKind::Barometer
            | FaultKind::Link => shown,
        }
    }
}
