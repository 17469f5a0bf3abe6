//! The detectors of a flying fleet.
//!
//! A look with detection probability `p` is an exposure of `-ln(1 - p)`. An object is found when the sum of the exposures
//! reaches a random threshold with the exponential distribution. A pass therefore detects with probability `p` (its best
//! one), and a dwell of `t` with `1 - (1 - p)^(t / look)`; a longer, closer or additional look never finds less. Passes
//! within 2 s count as one. Every vehicle, sensor and object has its own random stream, so nothing depends on the order
//! of the vehicles, and little on small differences of their ways. False alarms come in the same way: the ground is
//! divided into cells, and each cell gives one after a random exposure, which is the area of the cell that was swept.

use std::collections::BTreeMap;
use std::time::Duration;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal};

use super::contact::{Contact, Sighting};
use super::craft::Craft;
use super::sensor::{DetectorSpec, Look, Sensor, View};
use super::world::{ObjectId, World};
use super::{Point, TICK};
use crate::commands::FindKind;
use crate::geo::maths;
use crate::hash::fnv1a;
use crate::vehicle::VehicleId;

/// Passes closer together in time than this count as one.
const ONE_PASS: Duration = Duration::from_secs(2);
/// The share of mines that a kind of sensor never sees.
const NEVER_SEEN: f64 = 0.03;
/// The highest detection probability of a look, so no single look is certain to find an object.
const SUREST: f64 = 0.999;
/// The kinds of finds that detectors report where there is nothing.
const FALSE_ALARMS: [FalseAlarm; 2] = [
    FalseAlarm {
        kind: FindKind::Mine,
        cell_m: 1.0,
        merge_within_m: 1.5,
    },
    FalseAlarm {
        kind: FindKind::Person,
        cell_m: 10.0,
        merge_within_m: 10.0,
    },
];
/// The parts of a cell's width for which the position of a swept strip is computed.
const STRIPS_PER_CELL: f64 = 4.0;

/// All detectors of a fleet.
#[derive(Debug, Clone)]
pub(crate) struct Lookout {
    seed: u64,
    eyes: BTreeMap<(VehicleId, &'static str), Eye>,
}

/// One detector on one vehicle.
#[derive(Debug, Clone, Default)]
struct Eye {
    glances: BTreeMap<ObjectId, Glance>,
    /// For each cell of the ground, the chance of a false alarm.
    alarms: BTreeMap<(FindKind, Cell), Chance>,
    /// For each false contact, by name, the chance that a close look shows it to be harmless.
    phantoms: BTreeMap<String, Chance>,
}

/// A detector's history of looks at one object.
#[derive(Debug, Clone)]
struct Glance {
    chance: Chance,
    last: Duration,
    blind: bool,
    /// The greatest exposure of this pass so far.
    pass_exposure: f64,
    /// Whether this pass has detected the object.
    found: bool,
}

/// False alarms of one kind.
struct FalseAlarm {
    kind: FindKind,
    /// The side of a cell; within it, an alarm is as likely at any place.
    cell_m: f64,
    /// Alarms within this distance of a contact belong to it.
    merge_within_m: f64,
}

/// The number of a square of the ground, counted east and north of the origin.
type Cell = [i32; 2];

/// A recurring event, each time after a random exposure.
#[derive(Debug, Clone)]
struct Chance {
    random: ChaCha8Rng,
    exposure: f64,
    until: f64,
}

impl Lookout {
    /// Detectors that have seen nothing yet.
    pub fn new(seed: u64) -> Self {
        Self {
            seed,
            eyes: BTreeMap::new(),
        }
    }

    /// Advances a vehicle's detectors by a [`TICK`]; returns what they see, including objects found before. A vehicle
    /// that is on the ground or not heard sees nothing.
    pub fn step(
        &mut self,
        craft: &Craft,
        world: &World,
        contacts: &[Contact],
        now: Duration,
    ) -> Vec<Sighting> {
        let mut seen = Vec::new();
        let Some(at) = craft.at.filter(|_| craft.can_see()) else {
            return seen;
        };
        for &sensor in &craft.sensors {
            let Some(spec) = sensor.detector() else {
                continue;
            };
            let mut watch = DetectorWatch {
                seed: self.seed,
                craft,
                at,
                sensor,
                spec,
                world,
                now,
            };
            let eye = self.eyes.entry((craft.id, sensor.id)).or_default();
            watch.objects(&mut eye.glances, &mut seen);
            watch.alarms(&mut eye.alarms, &mut seen);
            watch.phantoms(&mut eye.phantoms, contacts, &mut seen);
        }
        seen
    }
}

struct DetectorWatch<'a> {
    seed: u64,
    craft: &'a Craft,
    at: Point,
    sensor: &'static Sensor,
    spec: &'static DetectorSpec,
    world: &'a World,
    now: Duration,
}

impl DetectorWatch<'_> {
    fn objects(&mut self, glances: &mut BTreeMap<ObjectId, Glance>, seen: &mut Vec<Sighting>) {
        let reach_m = self.spec.reach_m(self.craft.height_m);
        for (id, object) in self.world.objects() {
            let toward_m = [object.at[0] - self.at[0], object.at[1] - self.at[1]];
            if toward_m[0].abs() > reach_m || toward_m[1].abs() > reach_m || !object.present {
                continue;
            }
            let view = View {
                object,
                offset_m: self.craft.course.offset_m(toward_m),
                toward_m,
                height_m: self.craft.height_m,
                speed_m_s: self.craft.speed_m_s,
                light: self.world.weather.light,
                clarity: self.world.clear_view(object.at, self.craft.height_m),
            };
            let Some(look) = self.spec.look(&view) else {
                continue;
            };
            let glance = glances.entry(id).or_insert_with(|| self.glance(id, &look));
            if let Some(find) = glance.take(&look, self.now) {
                let at = [
                    object.at[0] + find.error_m[0],
                    object.at[1] + find.error_m[1],
                ];
                seen.push(Sighting {
                    harmless: find.told_apart && object.class.kind().is_none(),
                    ..self.sighting(at, &look, Some(id))
                });
            }
        }
    }

    /// Adds false alarms, in proportion to the area of each cell that the detector has passed over.
    fn alarms(&self, alarms: &mut BTreeMap<(FindKind, Cell), Chance>, seen: &mut Vec<Sighting>) {
        let (height_m, light) = (self.craft.height_m, self.world.weather.light);
        let swath_m = self.spec.swath_m(height_m);
        let way_m = self.craft.speed_m_s * TICK.as_secs_f64();
        for alarm in &FALSE_ALARMS {
            let per_m2 = self.spec.false_alarms_per_m2(alarm.kind, height_m, light);
            if per_m2 <= 0.0 {
                continue;
            }
            let strips = (STRIPS_PER_CELL * swath_m / alarm.cell_m).ceil();
            let strip_m = swath_m / strips;
            for strip in 0..strips as u32 {
                let aside_m = strip_m * (f64::from(strip) + 0.5) - swath_m / 2.0;
                let [east, north] = self.craft.course.aside(aside_m);
                let at = [self.at[0] + east, self.at[1] + north];
                if !self.world.seeks(alarm.kind, at) {
                    continue;
                }
                let cell = at.map(|axis_m| (axis_m / alarm.cell_m).floor() as i32);
                let chance = alarms
                    .entry((alarm.kind, cell))
                    .or_insert_with(|| Chance::new(self.random_of_cell(alarm.kind, cell)));
                if chance.expose(per_m2 * strip_m * way_m) {
                    let mut within = |axis: i32| {
                        alarm.cell_m * (f64::from(axis) + chance.random.random::<f64>())
                    };
                    seen.push(self.false_alarm(alarm, cell.map(&mut within)));
                }
            }
        }
    }

    fn false_alarm(&self, alarm: &FalseAlarm, at: Point) -> Sighting {
        Sighting {
            at,
            kind: alarm.kind,
            sensor: self.sensor.id,
            by: self.craft.id,
            object: None,
            harmless: false,
            merge_within_m: alarm.merge_within_m,
        }
    }

    /// Checks false contacts: a close look distinguishes them from real finds, as it does with animals.
    fn phantoms(
        &self,
        phantoms: &mut BTreeMap<String, Chance>,
        contacts: &[Contact],
        seen: &mut Vec<Sighting>,
    ) {
        let open = contacts
            .iter()
            .filter(|contact| contact.object.is_none() && !contact.harmless);
        for contact in open {
            let toward_m = [contact.at[0] - self.at[0], contact.at[1] - self.at[1]];
            let offset_m = self.craft.course.offset_m(toward_m);
            let (height_m, light) = (self.craft.height_m, self.world.weather.light);
            let spec = self.spec;
            let Some(look) = spec.look_at_nothing(contact.kind, offset_m, height_m, light) else {
                continue;
            };
            let name = contact.name.as_bytes();
            let chance = phantoms
                .entry(contact.name.clone())
                .or_insert_with(|| Chance::new(self.random(&[name])));
            let exposure = -maths::ln(1.0 - look.told_apart.min(SUREST));
            let every_s = look.every_s.unwrap_or(1.0);
            if chance.expose(exposure * TICK.as_secs_f64() / every_s) {
                seen.push(Sighting {
                    harmless: true,
                    ..self.sighting(contact.at, &look, None)
                });
            }
        }
    }

    fn glance(&self, id: ObjectId, look: &Look) -> Glance {
        let object = [id.hazard.to_le_bytes(), id.index.to_le_bytes()];
        // Sensors of one kind miss the same mines on all vehicles.
        let mut kind = stream(self.seed, &[self.sensor.id.as_bytes(), &object.concat()]);
        Glance {
            chance: Chance::new(self.random(&[&object.concat()])),
            last: self.now,
            blind: look.taken_for == FindKind::Mine && kind.random::<f64>() < NEVER_SEEN,
            pass_exposure: 0.0,
            found: false,
        }
    }

    fn random_of_cell(&self, kind: FindKind, cell: Cell) -> ChaCha8Rng {
        let [east, north] = cell.map(i32::to_le_bytes);
        self.random(&[kind.name().as_bytes(), &east, &north])
    }

    fn random(&self, of: &[&[u8]]) -> ChaCha8Rng {
        let vehicle = self.craft.id.to_le_bytes();
        let mut name = vec![self.sensor.id.as_bytes(), &vehicle];
        name.extend(of);
        stream(self.seed, &name)
    }

    fn sighting(&self, at: Point, look: &Look, object: Option<ObjectId>) -> Sighting {
        Sighting {
            at,
            kind: look.taken_for,
            sensor: self.sensor.id,
            by: self.craft.id,
            object,
            harmless: false,
            merge_within_m: look.merge_within_m,
        }
    }
}

struct Find {
    error_m: Point,
    /// Whether the look was good enough to recognise a harmless object.
    told_apart: bool,
}

impl Glance {
    /// Adds a tick of looking; returns a find if the detector detects the object now.
    fn take(&mut self, look: &Look, now: Duration) -> Option<Find> {
        let exposure = -maths::ln(1.0 - look.chance.min(SUREST));
        let away = now.saturating_sub(std::mem::replace(&mut self.last, now));
        if self.blind {
            return None;
        }
        let found = if let Some(every_s) = look.every_s {
            self.chance.expose(exposure * TICK.as_secs_f64() / every_s)
        } else {
            if away > ONE_PASS {
                self.pass_exposure = 0.0;
                self.found = false;
            }
            let best = exposure.max(self.pass_exposure);
            let gain = best - std::mem::replace(&mut self.pass_exposure, best);
            let is_new = !self.found && self.chance.expose(gain);
            self.found |= is_new;
            is_new
        };
        found.then(|| {
            let random = &mut self.chance.random;
            let mut error = || look.error_m * Distribution::<f64>::sample(&StandardNormal, random);
            Find {
                error_m: [error(), error()],
                told_apart: random.random::<f64>() < look.told_apart,
            }
        })
    }
}

impl Chance {
    fn new(mut random: ChaCha8Rng) -> Self {
        Self {
            until: Exp1.sample(&mut random),
            exposure: 0.0,
            random,
        }
    }

    /// Adds to the exposure; returns whether the event happens.
    fn expose(&mut self, by: f64) -> bool {
        self.exposure += by;
        let happens = self.exposure >= self.until;
        if happens {
            self.again();
        }
        happens
    }

    fn again(&mut self) {
        self.exposure = 0.0;
        self.until = Exp1.sample(&mut self.random);
    }
}

fn stream(seed: u64, name: &[&[u8]]) -> ChaCha8Rng {
    let bytes = name.iter().flat_map(|part| part.iter().chain(&[0xFF]));
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(fnv1a(bytes));
    random
}

#[cfg(test)]
mod tests;
