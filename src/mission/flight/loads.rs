//! What vehicles carry to let go of: balls, kits and nodes in pieces, the sprayer in seconds; and what becomes of it.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Flight;
use super::deeds::Done;
use crate::mission::craft::Craft;
use crate::mission::fit::Fit;
use crate::mission::ground_truth::{Load, LoadEffect, Release};
use crate::mission::sensor::Probe;
use crate::mission::{LoadLeft, Point, TICK};
use crate::notice::Notice;
use crate::scoring::EventKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// A piece that falls from higher lands anywhere.
const DROP_UP_TO_M: f64 = 40.0;
/// Higher up, the wind takes the spray.
const SPRAY_UP_TO_M: f64 = 20.0;
/// What lies on a pad is there for a vehicle that stands this near.
const ON_PAD_M: f64 = 3.0;
/// A vehicle that stands disarmed on a pad for so long has its loads again.
const TURN_AROUND: Duration = Duration::from_secs(20);
/// A sample is taken at no more than this speed.
const SAMPLE_UP_TO_M_S: f64 = 1.0;

/// What one vehicle has on board.
#[derive(Debug, Clone)]
pub(super) struct Hold {
    full: BTreeMap<Load, u32>,
    left: BTreeMap<Load, u32>,
    /// For how long the sprayer has been open in this second of the load; `None` while it is shut.
    spraying: Option<Duration>,
    /// For how long it has been served on a pad.
    served: Duration,
}

impl Hold {
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

    /// Takes one away; false where none is left.
    fn take(&mut self, load: Load) -> bool {
        let left = self.left.get_mut(&load).filter(|left| **left > 0);
        left.map(|left| *left -= 1).is_some()
    }

    /// The pieces that it carries, whether any are left or not.
    fn piece(&self) -> Option<Load> {
        let mut pieces = self.full.keys().filter(|load| **load != Load::Spray);
        let with_some = pieces.clone().find(|load| self.left(**load) > 0);
        with_some.or_else(|| pieces.next()).copied()
    }

    /// A tick of the vehicle's stay on a pad; true when its loads are full again by it.
    fn serve(&mut self, craft: &Craft) -> bool {
        let on_pad = craft.pad_distance_m.is_some_and(|far| far <= ON_PAD_M);
        let stands = on_pad && !craft.armed && !craft.airborne && !craft.lost;
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

    /// A tick of the sprayer; true when it has used up a second of its load.
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

impl Flight {
    /// Lets go of one piece.
    pub(super) fn drop_piece(&mut self, vehicle: VehicleId) -> Done {
        let (index, at) = self.able(vehicle, DROP_UP_TO_M)?;
        let hold = &mut self.holds[index];
        let load = hold.piece().ok_or_else(|| text!("deed-no-load"))?;
        if !hold.take(load) {
            return Err(text!("load-empty", load = load.name()));
        }
        let left = hold.left(load);
        let effect = self.release(vehicle, load, at);
        let what = effect.map_or_else(|| text!("load-nothing"), |effect| effect.text);
        Ok(Some(text!("load-dropped", what = what, left = left)))
    }

    /// Opens or shuts the sprayer.
    pub(super) fn set_sprayer(&mut self, vehicle: VehicleId, on: bool) -> Done {
        if !on {
            let index = self.seat(vehicle)?;
            let hold = &mut self.holds[index];
            let shut = hold.spraying.take().map(|_| hold.left(Load::Spray));
            let left = shut.ok_or_else(|| text!("load-shut"))?;
            return Ok(Some(text!("load-spray-left", left = left)));
        }
        let (index, _) = self.able(vehicle, SPRAY_UP_TO_M)?;
        let hold = &mut self.holds[index];
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

    /// Says what the vehicle's sensors show where it hovers.
    pub(super) fn take_sample(&mut self, vehicle: VehicleId) -> Done {
        let (index, _) = self.able(vehicle, f64::INFINITY)?;
        let craft = &self.crafts[index];
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
        self.record(EventKind::Sample, Some(vehicle), remark.clone());
        Ok(Some(remark))
    }

    /// A tick of sprayers and of the service on the pads.
    pub(super) fn step_loads(&mut self, notices: &mut Vec<Notice>) {
        for index in 0..self.holds.len() {
            let craft = &self.crafts[index];
            let (id, at, height_m) = (craft.id, craft.at, craft.height_m);
            if !craft.airborne || craft.lost {
                self.holds[index].spraying = None;
            }
            if self.holds[index].serve(&self.crafts[index]) {
                let text = text!("load-served");
                self.say(EventKind::Load, Some(id), Severity::Info, text, notices);
            }
            if self.holds[index].spray() {
                if let Some(at) = at.filter(|_| height_m <= SPRAY_UP_TO_M) {
                    self.release(id, Load::Spray, at);
                }
                if self.holds[index].left(Load::Spray) == 0 {
                    self.holds[index].spraying = None;
                    let text = text!("load-empty", load = Load::Spray.name());
                    self.say(EventKind::Load, Some(id), Severity::Notice, text, notices);
                }
            }
        }
    }

    /// What is left on board.
    pub(super) fn loads_left(&self) -> Vec<LoadLeft> {
        let mut loads = Vec::new();
        for (craft, hold) in self.crafts.iter().zip(&self.holds) {
            loads.extend(hold.left.iter().map(|(load, left)| LoadLeft {
                vehicle: craft.id,
                load: load.name(),
                left: *left,
                unit: if *load == Load::Spray { "s" } else { "" },
            }));
        }
        loads
    }

    /// Where a vehicle stands among those of the mission.
    fn seat(&self, vehicle: VehicleId) -> Result<usize, Text> {
        let index = self.crafts.iter().position(|craft| craft.id == vehicle);
        index.ok_or_else(|| text!("deed-no-position"))
    }

    /// Whether a vehicle can do something from the air, at most so high: its seat, and where it is.
    fn able(&self, vehicle: VehicleId, up_to_m: f64) -> Result<(usize, Point), Text> {
        let index = self.seat(vehicle)?;
        let craft = &self.crafts[index];
        let heard = craft.at.filter(|_| craft.heard && !craft.lost);
        let at = heard.ok_or_else(|| text!("deed-no-position"))?;
        if !craft.airborne {
            return Err(text!("load-on-ground"));
        }
        if craft.height_m > up_to_m {
            let (height, limit) = (format!("{:.0}", craft.height_m), format!("{up_to_m:.0}"));
            return Err(text!("load-too-high", height = height, limit = limit));
        }
        Ok((index, at))
    }

    fn release(&mut self, by: VehicleId, load: Load, at: Point) -> Option<LoadEffect> {
        let effects = self.world.affect(load, at);
        let effect = effects
            .iter()
            .find(|effect| effect.good)
            .or(effects.first());
        let release = Release {
            load,
            at,
            by,
            when: self.elapsed,
            good: effect.is_some_and(|effect| effect.good),
        };
        self.releases.push(release);
        let effect = effect.cloned();
        if let Some(effect) = &effect {
            self.record(EventKind::Load, Some(by), effect.text.clone());
        }
        effect
    }
}

#[cfg(test)]
mod tests;
