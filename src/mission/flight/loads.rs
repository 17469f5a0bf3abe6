//! Payloads: balls, kits and nodes, counted in pieces; spray, counted in seconds; and their effects.

use std::collections::BTreeMap;
use std::time::Duration;

use super::deeds::Done;
use super::journal::{FlightJournal, JournalEntry};
use crate::mission::craft::Craft;
use crate::mission::fit::Fit;
use crate::mission::ground_truth::{Load, LoadEffect, Release};
use crate::mission::sensor::Probe;
use crate::mission::world::World;
use crate::mission::{LoadLeft, Point, TICK};
use crate::scoring::EventKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

const ON_PAD_M: f64 = 3.0;
/// How long a vehicle must stay disarmed on a pad before its loads are replaced.
const TURN_AROUND: Duration = Duration::from_secs(20);
const SAMPLE_UP_TO_M_S: f64 = 1.0;

#[derive(Debug, Clone)]
struct CraftLoads {
    full: BTreeMap<Load, u32>,
    left: BTreeMap<Load, u32>,
    /// How much of the current second of spray has been used; `None` while the sprayer is shut.
    spraying: Option<Duration>,
    /// How long the vehicle has been serviced on a pad.
    served: Duration,
}

impl CraftLoads {
    pub fn new(fit: &Fit) -> Self {
        Self {
            full: fit.loads.clone(),
            left: fit.loads.clone(),
            spraying: None,
            served: Duration::ZERO,
        }
    }

    fn left(&self, load: Load) -> u32 {
        self.left.get(&load).copied().unwrap_or(0)
    }

    /// Removes one piece; false if none is left.
    fn take(&mut self, load: Load) -> bool {
        let left = self.left.get_mut(&load).filter(|left| **left > 0);
        left.map(|left| *left -= 1).is_some()
    }

    /// The kind of piece that the vehicle releases: one with pieces left, otherwise any that it was
    /// loaded with; `None` without pieces.
    fn piece(&self) -> Option<Load> {
        let mut pieces = self.full.keys().filter(|load| **load != Load::Spray);
        let with_some = pieces.clone().find(|load| self.left(**load) > 0);
        with_some.or_else(|| pieces.next()).copied()
    }

    /// Advances the service on a pad by a tick; returns true when that refills the loads.
    fn serve(&mut self, craft: &Craft) -> bool {
        let on_pad = craft.pad_distance_m.is_some_and(|far| far <= ON_PAD_M);
        let stands = on_pad && !craft.armed && !craft.under_way && !craft.lost;
        if !stands || self.left == self.full {
            self.served = Duration::ZERO;
            return false;
        }
        self.served += TICK;
        let done = self.served >= TURN_AROUND;
        if done {
            self.left = self.full.clone();
        }
        done
    }

    /// Advances the sprayer by a tick; returns true when that uses up a second of its load.
    fn spray(&mut self) -> bool {
        let Some(open) = self.spraying.as_mut() else {
            return false;
        };
        *open += TICK;
        let used = *open >= Duration::from_secs(1);
        if used {
            *open = Duration::ZERO;
        }
        used && self.take(Load::Spray)
    }
}

/// The loads on board, in the order of the vehicles, and the releases.
#[derive(Debug, Clone, Default)]
pub(super) struct Loads {
    holds: Vec<CraftLoads>,
    releases: Vec<Release>,
}

/// The parts of a flight that releases depend on and change.
pub(super) struct LoadsScene<'a> {
    pub crafts: &'a [Craft],
    pub world: &'a mut World,
    pub journal: &'a mut FlightJournal,
}

/// A vehicle that is able to use its loads in the air.
struct Able {
    /// Its index among the vehicles.
    seat: usize,
    at: Point,
}

impl Loads {
    pub fn add(&mut self, fit: &Fit) {
        self.holds.push(CraftLoads::new(fit));
    }

    /// All releases so far.
    pub fn releases(&self) -> &[Release] {
        &self.releases
    }

    pub fn drop_piece(&mut self, vehicle: VehicleId, scene: &mut LoadsScene<'_>) -> Done {
        let piece = self.holds[scene.seat(vehicle)?].piece();
        let load = piece.ok_or_else(|| text!("deed-no-load"))?;
        let Able { seat, at } = scene.able(vehicle, load)?;
        let hold = &mut self.holds[seat];
        if !hold.take(load) {
            return Err(text!("load-empty", load = load.name()));
        }
        let left = hold.left(load);
        let effect = self.release(vehicle, load, at, scene);
        let what = effect.map_or_else(|| text!("load-nothing"), |effect| effect.text);
        Ok(Some(text!("load-dropped", what = what, left = left)))
    }

    /// Opens or shuts the sprayer.
    pub fn set_sprayer(&mut self, vehicle: VehicleId, on: bool, scene: &LoadsScene<'_>) -> Done {
        if !on {
            let hold = &mut self.holds[scene.seat(vehicle)?];
            let shut = hold.spraying.take().map(|_| hold.left(Load::Spray));
            let left = shut.ok_or_else(|| text!("load-shut"))?;
            return Ok(Some(text!("load-spray-left", left = left)));
        }
        let able = scene.able(vehicle, Load::Spray)?;
        let hold = &mut self.holds[able.seat];
        if !hold.full.contains_key(&Load::Spray) {
            return Err(text!("deed-no-load"));
        }
        let left = hold.left(Load::Spray);
        if left == 0 {
            return Err(text!("load-empty", load = Load::Spray.name()));
        }
        hold.spraying.get_or_insert(Duration::ZERO);
        Ok(Some(text!("load-spray-left", left = left)))
    }

    /// Advances the sprayers and the service on the pads by a tick.
    pub fn step(&mut self, scene: &mut LoadsScene<'_>) {
        for (index, craft) in scene.crafts.iter().enumerate() {
            if !craft.under_way || craft.lost {
                self.holds[index].spraying = None;
            }
            if self.holds[index].serve(craft) {
                let text = text!("load-served");
                scene.journal.say(JournalEntry {
                    vehicle: Some(craft.id),
                    ..JournalEntry::new(EventKind::Load, Severity::Info, text)
                });
            }
            if self.holds[index].spray() {
                if let Some(at) = craft
                    .at
                    .filter(|_| craft.height_m <= Load::Spray.highest_m())
                {
                    self.release(craft.id, Load::Spray, at, scene);
                }
                if self.holds[index].left(Load::Spray) == 0 {
                    self.holds[index].spraying = None;
                    let text = text!("load-empty", load = Load::Spray.name());
                    scene.journal.say(JournalEntry {
                        vehicle: Some(craft.id),
                        ..JournalEntry::new(EventKind::Load, Severity::Notice, text)
                    });
                }
            }
        }
    }

    /// The loads left on board.
    pub fn left(&self, crafts: &[Craft]) -> Vec<LoadLeft> {
        let mut loads = Vec::new();
        for (craft, hold) in crafts.iter().zip(&self.holds) {
            loads.extend(hold.left.iter().map(|(load, left)| LoadLeft {
                vehicle: craft.id,
                load: load.name(),
                left: *left,
                unit: if *load == Load::Spray { "s" } else { "" },
            }));
        }
        loads
    }

    fn release(
        &mut self,
        by: VehicleId,
        load: Load,
        at: Point,
        scene: &mut LoadsScene<'_>,
    ) -> Option<LoadEffect> {
        let effects = scene.world.affect(load, at);
        let good = effects.iter().find(|effect| effect.good);
        let effect = good.or(effects.first()).cloned();
        self.releases.push(Release {
            load,
            at,
            by,
            when: scene.journal.now(),
            good: effect.as_ref().is_some_and(|effect| effect.good),
        });
        if let Some(effect) = &effect {
            let text = effect.text.clone();
            scene.journal.record(JournalEntry {
                vehicle: Some(by),
                ..JournalEntry::new(EventKind::Load, Severity::Info, text)
            });
        }
        effect
    }
}

impl LoadsScene<'_> {
    /// Takes a sample: records and returns the readings of a vehicle's sensors. The vehicle must be
    /// in the air, and no faster than 1 m/s.
    pub fn take_sample(&mut self, vehicle: VehicleId) -> Done {
        let able = self.under_way(vehicle)?;
        let craft = &self.crafts[able.seat];
        if craft.probes.is_empty() {
            return Err(text!("deed-no-load"));
        }
        if craft.speed_m_s > SAMPLE_UP_TO_M_S {
            let limit = format!("{SAMPLE_UP_TO_M_S:.0}");
            return Err(text!("load-sample-speed", limit = limit));
        }
        let reading = |probe: &Probe| {
            text!(
                "load-sample",
                sensor = Text::new(probe.sensor.name, Vec::new()),
                value = format!("{:.2}", probe.shown),
                unit = probe.spec.unit
            )
        };
        let readings: Vec<Text> = craft.probes.iter().map(reading).collect();
        let remark = Text::joined(", ", readings);
        self.journal.record(JournalEntry {
            vehicle: Some(vehicle),
            ..JournalEntry::new(EventKind::Sample, Severity::Info, remark.clone())
        });
        Ok(Some(remark))
    }

    /// The index of one of the mission's vehicles; an error if the vehicle is not among them.
    fn seat(&self, vehicle: VehicleId) -> Result<usize, Text> {
        let index = self.crafts.iter().position(|craft| craft.id == vehicle);
        index.ok_or_else(|| text!("deed-no-position"))
    }

    /// Checks that a vehicle is in the air, no higher than `up_to_m`.
    fn able(&self, vehicle: VehicleId, load: Load) -> Result<Able, Text> {
        let able = self.under_way(vehicle)?;
        let (height_m, up_to_m) = (self.crafts[able.seat].height_m, load.highest_m());
        if height_m > up_to_m {
            let (height, limit) = (format!("{height_m:.0}"), format!("{up_to_m:.0}"));
            return Err(text!("load-too-high", height = height, limit = limit));
        }
        Ok(able)
    }

    /// A vehicle that is under way and heard.
    fn under_way(&self, vehicle: VehicleId) -> Result<Able, Text> {
        let seat = self.seat(vehicle)?;
        let craft = &self.crafts[seat];
        let heard = craft.at.filter(|_| craft.heard && !craft.lost);
        let at = heard.ok_or_else(|| text!("deed-no-position"))?;
        if !craft.under_way {
            return Err(text!("load-on-ground"));
        }
        Ok(Able { seat, at })
    }
}

#[cfg(test)]
mod tests;
