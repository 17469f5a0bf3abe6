//! Radio between the ground and the vehicles: its strength over a distance, behind ridges, in noise and through
//! relays.
//!
//! The margin of a path is the received level above the receiver's sensitivity, in dB. It sets the quality of a link:
//! a share of `1 / (1 + exp((margin - 3) / 1.5))` of the frames is lost, and the delay grows with the repetitions.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Point;
use super::craft::Craft;
use super::zone::{Shadow, Shape, Zone, ZoneKind};
use crate::geo::maths;
use crate::session::RadioFault;
use crate::vehicle::VehicleId;
use crate::workshop::loss::{GROUND_ANTENNA_M, LOWEST_ANTENNA_M, free_space_db, two_ray_db};
use crate::workshop::{self, Part, PartSlot};

/// A kind of radio: a part of the workshop's catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Model {
    /// Its id in mission files and in the catalogue.
    pub id: &'static str,
    pub radio: &'static workshop::Radio,
}

impl Model {
    pub fn all() -> impl Iterator<Item = Self> {
        workshop::parts_for(PartSlot::Radio).filter_map(Self::of)
    }

    /// The model of a part, if the part is a radio.
    pub fn of(part: &'static Part) -> Option<Self> {
        let radio = part.radio()?;
        Some(Self { id: part.id, radio })
    }

    /// The model with an id.
    pub fn by_id(id: &str) -> Option<Self> {
        workshop::part(id).and_then(Self::of)
    }
}

/// The radio of one vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Set {
    pub model: Model,
    /// Gain of the vehicle's antenna.
    pub gain_dbi: f64,
    /// Whether it relays other radios of its model while in the air.
    pub relays: bool,
}

impl Set {
    /// A radio with its model's antenna and defaults.
    pub fn of(model: Model) -> Self {
        Self {
            model,
            gain_dbi: model.radio.air_dbi,
            relays: model.radio.relays,
        }
    }
}

/// The radio of a mission.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Radio {
    /// The radio of vehicles that have none of their own.
    pub own: Option<Set>,
    /// The ground station's position and antenna height. The station has a counterpart for every vehicle's radio.
    pub station: Point,
    pub antenna_m: f64,
}

/// One end of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RadioNode {
    pub model: Model,
    pub at: Point,
    pub height_m: f64,
    pub gain_dbi: f64,
    /// Whether it relays the frames that it receives.
    pub relays: bool,
}

/// The number of points at which a path is checked for ridges.
const PLACES: u32 = 64;
const LIGHT_M_US: f64 = 299.792_458;
const HALF_LOST_DB: f64 = 3.0;
const LOSS_SLOPE_DB: f64 = 1.5;
/// The delay of a frame that is not repeated.
const LATENCY: Duration = Duration::from_millis(20);
const LONGEST_DELAY: Duration = Duration::from_millis(400);
const NO_LOSS: f64 = 0.002;

/// The diffraction loss over one edge, in dB, for the parameter `v` of ITU-R P.526:
/// `6.9 + 20 lg(sqrt((v - 0.1)^2 + 1) + v - 0.1)` above -0.78.
pub(crate) fn knife_edge_db(v: f64) -> f64 {
    if v <= -0.78 {
        return 0.0;
    }
    (6.9 + 20.0 * maths::log10(maths::hypot(v - 0.1, 1.0) + v - 0.1)).max(0.0)
}

/// The share of frames lost at a margin.
pub(crate) fn loss(margin_db: f64) -> f64 {
    1.0 / (1.0 + maths::exp((margin_db - HALF_LOST_DB) / LOSS_SLOPE_DB))
}

impl Radio {
    /// The default height of the ground station's antenna above the ground, in metres.
    pub const USUAL_ANTENNA_M: f64 = GROUND_ANTENNA_M;

    /// Each vehicle's margin in dB, by its best path; the worst leg of a path determines its quality. Only radios of
    /// the same model connect. `own` is the radio that a vehicle was built with, if any.
    pub fn margins_db<'a>(
        &self,
        zones: impl Iterator<Item = &'a Zone>,
        crafts: &[Craft],
        own: impl Fn(usize) -> Option<Set>,
    ) -> BTreeMap<VehicleId, f64> {
        let zones: Vec<(&Shape, ZoneKind)> = zones.map(|zone| (&zone.shape, zone.kind)).collect();
        let mut nets: BTreeMap<&str, (Vec<VehicleId>, Vec<RadioNode>)> = BTreeMap::new();
        for (seat, craft) in crafts.iter().enumerate() {
            let fitted = own(seat).or(self.own);
            if let Some(set) = fitted
                && let Some(node) = set.node(craft)
            {
                let (ids, nodes) = nets.entry(set.model.id).or_default();
                ids.push(craft.id);
                nodes.push(node);
            }
        }
        let mut margins_db = BTreeMap::new();
        for (ids, mut nodes) in nets.into_values() {
            let model = nodes[0].model;
            nodes.push(self.ground(model));
            margins_db.extend(ids.into_iter().zip(best_db(&nodes, &zones)));
        }
        margins_db
    }

    fn ground(&self, model: Model) -> RadioNode {
        RadioNode {
            model,
            at: self.station,
            height_m: self.antenna_m,
            gain_dbi: model.radio.ground_dbi,
            relays: true,
        }
    }

    /// The loss and the delay of a link with a margin.
    pub fn fault(margin_db: f64) -> RadioFault {
        let loss = loss(margin_db);
        if loss < NO_LOSS {
            return RadioFault::default();
        }
        let tries = 1.0 / (1.0 - loss).max(0.01);
        RadioFault {
            loss,
            delay: LATENCY.mul_f64(tries).min(LONGEST_DELAY),
            seed: 0,
        }
    }
}

impl Set {
    fn node(self, craft: &Craft) -> Option<RadioNode> {
        let [east_m, north_m, up_m] = craft.place_m()?;
        Some(RadioNode {
            model: self.model,
            at: [east_m, north_m],
            height_m: up_m,
            gain_dbi: self.gain_dbi,
            relays: self.relays && craft.under_way && !craft.lost,
        })
    }
}

/// The margin from the last node to each of the others, by the path whose worst leg is best.
pub(crate) fn best_db(nodes: &[RadioNode], zones: &[(&Shape, ZoneKind)]) -> Vec<f64> {
    let mut best = vec![f64::NEG_INFINITY; nodes.len()];
    let mut open: Vec<usize> = (0..nodes.len()).collect();
    if let Some(ground) = best.last_mut() {
        *ground = f64::INFINITY;
    }
    while let Some(place) = (0..open.len()).max_by(|a, b| best[open[*a]].total_cmp(&best[open[*b]]))
    {
        let from = open.swap_remove(place);
        if !nodes[from].relays {
            continue;
        }
        for &to in &open {
            let leg_db = margin_db(&nodes[from], &nodes[to], zones);
            best[to] = best[to].max(best[from].min(leg_db));
        }
    }
    best.pop();
    best
}

/// The margin of the direct path between two nodes, in dB.
pub(crate) fn margin_db(a: &RadioNode, b: &RadioNode, zones: &[(&Shape, ZoneKind)]) -> f64 {
    let model = a.model.radio;
    let (low, high) = (
        a.height_m.max(LOWEST_ANTENNA_M),
        b.height_m.max(LOWEST_ANTENNA_M),
    );
    let flat_m = maths::hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]);
    let distance_m = maths::hypot(flat_m, low - high);
    let spread_db =
        free_space_db(distance_m, model.frequency_mhz).max(two_ray_db(distance_m, low, high));
    let budget_db = model.budget_db(a.gain_dbi, b.gain_dbi);
    let wave_m = LIGHT_M_US / model.frequency_mhz;
    let in_the_way = zones.iter().map(|(shape, kind)| match kind {
        ZoneKind::CommShadow(Shadow::Ridge { height_m }) => {
            let ridge = Ridge {
                shape,
                height_m: *height_m,
            };
            ridge_db(&ridge, [a.at, b.at], [low, high], wave_m)
        }
        ZoneKind::CommShadow(Shadow::Inside { loss_db }) => {
            let ends = [a, b].iter().filter(|node| shape.contains(node.at)).count();
            loss_db * ends as f64
        }
        ZoneKind::RadioJam { noise_db, edge_m } => {
            // Noise at either end affects the link; both ends must receive.
            let at = |node: &RadioNode| noise_db * nearness(shape.distance_m(node.at), *edge_m);
            at(a).max(at(b))
        }
        ZoneKind::Task
        | ZoneKind::Geofence { .. }
        | ZoneKind::NoFly { .. }
        | ZoneKind::GnssJam { .. }
        | ZoneKind::GnssGlitch { .. }
        | ZoneKind::People { .. } => 0.0,
    });
    budget_db - spread_db - in_the_way.sum::<f64>()
}

/// The effect of a zone: 1 inside, falling to 0 across its edge.
fn nearness(distance_m: f64, edge_m: f64) -> f64 {
    if distance_m <= 0.0 {
        1.0
    } else if distance_m < edge_m {
        1.0 - distance_m / edge_m
    } else {
        0.0
    }
}

struct Ridge<'a> {
    shape: &'a Shape,
    height_m: f64,
}

/// The loss that a ridge causes between two antennas, by its highest edge relative to the direct path.
fn ridge_db(ridge: &Ridge<'_>, [a, b]: [Point; 2], heights_m: [f64; 2], wave_m: f64) -> f64 {
    let [low_m, high_m] = heights_m;
    let flat_m = maths::hypot(a[0] - b[0], a[1] - b[1]);
    let mut worst = f64::NEG_INFINITY;
    for place in 1..PLACES {
        let share = f64::from(place) / f64::from(PLACES);
        let at = [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
        if !ridge.shape.contains(at) {
            continue;
        }
        let above_m = ridge.height_m - (low_m + (high_m - low_m) * share);
        let (before_m, after_m) = (flat_m * share, flat_m * (1.0 - share));
        let v = above_m * (2.0 * flat_m / (wave_m * before_m * after_m)).sqrt();
        worst = worst.max(v);
    }
    if worst.is_finite() {
        knife_edge_db(worst)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
