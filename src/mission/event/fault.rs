//! Faults on board.

use std::time::Duration;

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use super::scope::Sight;
use crate::mission::craft::Craft;
use crate::vehicle::VehicleId;

/// A fault as an event makes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fault {
    pub kind: FaultKind,
    pub victim: Victim,
    /// How bad it is, in the unit of its kind.
    pub to: f64,
    /// After how long it is mended; `None`: never.
    pub lasts: Option<Duration>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FaultKind {
    /// A motor gives this share of its thrust.
    Motor,
    /// The battery falls to this share of its voltage.
    Battery,
    /// Satellite navigation stops; the number does not matter.
    Gps,
    /// Satellite navigation is off by so many metres to the north.
    GpsGlitch,
    /// The compass is off by so many milligauss.
    Compass,
    /// The barometer drifts by so many metres a second.
    Barometer,
    /// Hazard sensors show what they showed when it began.
    SensorStuck,
    /// Hazard sensors show more and more: by so much in their unit, each second.
    SensorDrift,
    /// This share of what is sent by radio is lost; 1 is silence.
    Link,
}

impl FaultKind {
    /// All kinds by the names that they have in files, with the usual number and the range that makes sense.
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

/// Whom a fault hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Victim {
    /// The vehicle of this place, from 0.
    One(usize),
    All,
    /// One of those that fly, by chance.
    Chance,
}

/// A fault that a vehicle has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Broken {
    pub kind: FaultKind,
    pub vehicle: VehicleId,
    pub to: f64,
    pub since: Duration,
    pub until: Option<Duration>,
    /// What each sensor showed when it began, and the voltage.
    pub held: Vec<f64>,
}

/// The faults that vehicles have now.
#[derive(Debug, Default)]
pub(crate) struct Breakdowns(Vec<Broken>);

impl Breakdowns {
    /// Ends those whose time is over.
    pub fn mend(&mut self, now: Duration) {
        self.0
            .retain(|broken| broken.until.is_none_or(|until| until > now));
    }

    /// Breaks something on board of those whom a fault hits.
    pub fn add(&mut self, fault: &Fault, sight: &Sight<'_>, random: &mut ChaCha8Rng) {
        for craft in fault.victim.among(sight.crafts, random) {
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
    }

    /// Those of one vehicle.
    pub fn of(&self, vehicle: VehicleId) -> impl Iterator<Item = &Broken> {
        self.0
            .iter()
            .filter(move |broken| broken.vehicle == vehicle)
    }

    /// What sensors of a vehicle show instead of the truth.
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
                let flies = |craft: &&Craft| craft.airborne && !craft.lost;
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
    /// What a hazard sensor shows instead of the truth.
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
