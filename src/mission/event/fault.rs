//! What breaks on board.

use std::time::Duration;

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
