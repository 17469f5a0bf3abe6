//! A flight as conditions and threats see it.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::mover::Mover;
use crate::geo::maths;
use crate::mission::contact::Contact;
use crate::mission::craft::Craft;
use crate::mission::objective::ObjectiveStanding;
use crate::mission::report::{Mark, distance_m};
use crate::mission::zone::Zone;
use crate::scoring::AlertLevel;
use crate::vehicle::{VehicleId, Vehicles};

/// A vehicle slower than this counts as hovering.
const PAUSED_M_S: f64 = 0.7;

/// The parts of a flight's state that conditions can read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sight<'a> {
    pub now: Duration,
    pub crafts: &'a [Craft],
    pub vehicles: &'a Vehicles,
    pub standings: &'a [ObjectiveStanding],
    pub contacts: &'a [Contact],
    pub marks: &'a [Mark],
    /// Mission time of the last command.
    pub last_command: Option<Duration>,
    /// The number of refused commands.
    pub refused: u32,
}

/// The state of a flight at one time, with its threats.
#[derive(Debug, Clone)]
pub(crate) struct Scope<'a> {
    pub sight: Sight<'a>,
    pub zones: &'a [Zone],
    /// Which zones are active, in file order.
    pub active: &'a [bool],
    pub movers: &'a [Mover],
    /// Levels of the unanswered alerts.
    pub alerts: BTreeSet<AlertLevel>,
    /// Which events have happened, in file order.
    pub fired: &'a [bool],
    /// Each vehicle's link margin in dB; empty if the mission does not model the radio.
    pub margins_db: &'a BTreeMap<VehicleId, f64>,
    pub wind_m_s: f64,
    /// The seed and the random stream for conditions with chance: each evaluation draws a new number.
    pub chance: (u64, u64),
}

/// The zone or the movers to keep away from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Spot {
    /// The zone with this index in the file.
    Zone(usize),
    /// The movers with this id.
    Mover(String),
}

impl<'a> Scope<'a> {
    /// The vehicles in the air.
    pub fn flying(&self) -> impl Iterator<Item = &'a Craft> {
        let crafts = self.sight.crafts.iter();
        crafts.filter(|craft| craft.under_way && !craft.lost)
    }

    /// The state of an objective.
    pub fn standing(&self, objective: usize) -> Option<&'a ObjectiveStanding> {
        self.sight.standings.get(objective)
    }

    /// The number of a hazard's objects among the contacts.
    pub fn found(&self, hazard: usize) -> f64 {
        let objects = self
            .sight
            .contacts
            .iter()
            .filter_map(|contact| contact.object)
            .filter(|object| object.hazard == hazard);
        objects.collect::<BTreeSet<_>>().len() as f64
    }

    /// The minimum height of the vehicles in the air, in metres; infinite if there are none.
    pub fn lowest_height_m(&self) -> f64 {
        let heights = self.flying().map(|craft| craft.height_m);
        heights.fold(f64::INFINITY, f64::min)
    }

    /// The minimum battery of the vehicles in the air, in percent; 100 if there are none.
    pub fn lowest_battery_percent(&self) -> f64 {
        let charges = self.flying().filter_map(|craft| craft.battery_percent);
        charges.fold(100.0, f64::min)
    }

    /// The highest speed of the vehicles in the air that carry a sensor, in m/s; 0 if there are
    /// none.
    pub fn speed_m_s(&self, sensor: &str) -> f64 {
        let carries = |craft: &&Craft| craft.carries(sensor);
        let speeds = self.flying().filter(carries).map(|craft| craft.speed_m_s);
        speeds.fold(0.0, f64::max)
    }

    /// The minimum distance between two vehicles in the air, in metres; infinite with fewer than
    /// two.
    pub fn separation_m(&self) -> f64 {
        let flying: Vec<_> = self.flying().filter_map(Craft::place_m).collect();
        let pairs = flying.iter().enumerate().flat_map(|(index, a)| {
            let others = flying[index + 1..].iter();
            others.map(|b| maths::hypot(maths::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]))
        });
        pairs.fold(f64::INFINITY, f64::min)
    }

    /// The number of vehicles in the air above a zone.
    pub fn inside(&self, zone: usize) -> usize {
        let Some(zone) = self.zones.get(zone) else {
            return 0;
        };
        let above = |craft: &&Craft| craft.truly_at().is_some_and(|at| zone.shape.contains(at));
        self.flying().filter(above).count()
    }

    /// Whether a zone is active.
    pub fn is_active(&self, zone: usize) -> bool {
        self.active.get(zone) == Some(&true)
    }

    /// The time since the last command.
    pub fn since_command(&self) -> Duration {
        self.sight
            .now
            .saturating_sub(self.sight.last_command.unwrap_or(Duration::ZERO))
    }

    /// The name of a vehicle's mode; `None` if it is unknown.
    pub fn mode(&self, id: VehicleId) -> Option<&'static str> {
        self.sight
            .vehicles
            .get(&id)?
            .heartbeat
            .as_ref()?
            .mode
            .name()
    }

    /// The modes of the vehicles in the air.
    pub fn modes(&self) -> impl Iterator<Item = &'static str> {
        self.flying().filter_map(|craft| self.mode(craft.id))
    }

    /// Whether every vehicle in the air either hovers or is farther than this from the spot, in
    /// metres.
    pub fn is_paused_or_clear(&self, spot: &Spot, metres: f64) -> bool {
        self.flying().all(|craft| {
            let near = craft.truly_at().is_some_and(|at| match spot {
                Spot::Zone(zone) => {
                    let zone = self.zones.get(*zone);
                    zone.is_some_and(|zone| zone.shape.distance_m(at) <= metres)
                }
                Spot::Mover(id) => {
                    let mut movers = self.movers.iter().filter(|mover| mover.id == *id);
                    movers.any(|mover| distance_m(mover.at, at) <= metres)
                }
            });
            !near || craft.speed_m_s < PAUSED_M_S
        })
    }

    /// The distance of the nearest vehicle in the air, in metres: horizontal from a zone or a
    /// person, in three dimensions from an aircraft or a drone; infinite without a vehicle in the
    /// air or without the spot.
    pub fn clearance_m(&self, spot: &Spot) -> f64 {
        let places = self.flying().filter_map(Craft::place_m);
        let distances = places.map(|place| match spot {
            Spot::Zone(zone) => {
                let zone = self.zones.get(*zone);
                zone.map_or(f64::INFINITY, |zone| {
                    zone.shape.distance_m([place[0], place[1]])
                })
            }
            Spot::Mover(id) => {
                let movers = self.movers.iter().filter(|mover| mover.id == *id);
                movers
                    .map(|mover| mover.distance_m(place))
                    .fold(f64::INFINITY, f64::min)
            }
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// A vehicle's link margin in dB; infinite if the mission does not model the radio.
    pub fn margin_db(&self, id: VehicleId) -> f64 {
        self.margins_db.get(&id).copied().unwrap_or(f64::INFINITY)
    }

    /// A random number from 0 to 1, the same for every call at this time.
    pub fn draw(&self) -> f64 {
        let (seed, stream) = self.chance;
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ self.sight.now.as_millis() as u64);
        random.set_stream(stream);
        random.random()
    }
}
