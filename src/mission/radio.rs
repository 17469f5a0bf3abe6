//! Radio between the ground and the vehicles: how strong it is over a distance, past ridges, in noise, and by way of
//! other vehicles.
//!
//! The margin of a path is what is received above what the receiver needs. What it means for a link: a share of
//! `1 / (1 + exp((margin - 3) / 1.5))` of the frames is lost, and what comes through has been sent so often that it comes
//! later.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Point;
use super::craft::Craft;
use super::zone::{Shadow, Shape, Zone, ZoneKind};
use crate::session::RadioFault;
use crate::vehicle::VehicleId;

/// A kind of radio, the same on every vehicle.
#[derive(Debug, PartialEq)]
pub(crate) struct Model {
    /// Its id in mission files and in the parts catalogue.
    pub id: &'static str,
    pub power_dbm: f64,
    pub frequency_mhz: f64,
    /// The weakest signal that it can read.
    pub sensitivity_dbm: f64,
    /// Gain of the antenna on a vehicle and on the ground.
    pub air_dbi: f64,
    pub ground_dbi: f64,
    /// Cables, bodies in the way, antennas that point elsewhere.
    pub losses_db: f64,
    /// Whether every vehicle passes on what others send.
    pub relays: bool,
}

macro_rules! model {
    ($id:literal, $power:literal, $mhz:literal, $sensitivity:literal, $air:literal, $ground:literal, $losses:literal, $relays:literal) => {
        Model {
            id: $id,
            power_dbm: $power,
            frequency_mhz: $mhz,
            sensitivity_dbm: $sensitivity,
            air_dbi: $air,
            ground_dbi: $ground,
            losses_db: $losses,
            relays: $relays,
        }
    };
}

/// The radios of the parts catalogue.
pub(crate) static MODELS: [Model; 7] = [
    model!("r_wifi24", 20.0, 2437.0, -88.0, 2.0, 5.0, 6.0, false),
    model!("r_sik433", 20.0, 433.0, -112.0, 2.0, 2.0, 12.0, false),
    model!("r_sik915", 20.0, 915.0, -112.0, 2.0, 2.0, 12.0, false),
    model!("r_rfd900", 30.0, 915.0, -112.0, 3.0, 2.0, 8.0, false),
    model!("r_elrs24", 20.0, 2440.0, -108.0, 2.0, 5.0, 8.0, false),
    model!("r_lora868", 22.0, 868.0, -126.0, 2.0, 2.0, 10.0, false),
    model!("r_mesh24", 30.0, 2450.0, -96.0, 3.0, 5.0, 6.0, true),
];

/// The radio of a mission.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Radio {
    pub model: &'static Model,
    /// Where the ground station is, and how high its antenna.
    pub station: Point,
    pub antenna_m: f64,
    /// Whether vehicles in the air pass on what others send.
    pub relays: bool,
}

/// One end of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    pub at: Point,
    pub height_m: f64,
    pub gain_dbi: f64,
    /// Whether it passes on what it hears.
    pub relays: bool,
}

/// Antennas are never lower than this.
const LOWEST_ANTENNA_M: f64 = 0.3;
/// Nearer than this, nothing gets stronger.
const NEAREST_M: f64 = 1.0;
/// A path is looked at in so many places for what stands in its way.
const PLACES: u32 = 64;
/// Light, in metres a microsecond.
const LIGHT_M_US: f64 = 299.792_458;
/// From this margin down, half of all frames is lost.
const HALF_LOST_DB: f64 = 3.0;
const LOSS_SLOPE_DB: f64 = 1.5;
/// The time on the way of a frame that comes through at once.
const LATENCY: Duration = Duration::from_millis(20);
const LONGEST_DELAY: Duration = Duration::from_millis(400);
/// A link this good is as good as perfect.
const NO_LOSS: f64 = 0.002;

/// Loss over a distance in free space, in dB: `32.44 + 20 lg(km) + 20 lg(MHz)` (ITU-R P.525).
pub(crate) fn free_space_db(distance_m: f64, frequency_mhz: f64) -> f64 {
    32.44 + 20.0 * (distance_m.max(NEAREST_M) * 1e-3).log10() + 20.0 * frequency_mhz.log10()
}

/// Loss with the wave that the ground reflects, far from the transmitter, in dB: `40 lg(m) - 20 lg(h h')`.
pub(crate) fn two_ray_db(distance_m: f64, height_m: f64, other_m: f64) -> f64 {
    40.0 * distance_m.max(NEAREST_M).log10() - 20.0 * (height_m * other_m).log10()
}

/// Loss by bending over one edge, in dB, for the parameter `v` of ITU-R P.526:
/// `6.9 + 20 lg(sqrt((v - 0.1)^2 + 1) + v - 0.1)` above -0.78.
pub(crate) fn knife_edge_db(v: f64) -> f64 {
    if v <= -0.78 {
        return 0.0;
    }
    (6.9 + 20.0 * ((v - 0.1).hypot(1.0) + v - 0.1).log10()).max(0.0)
}

/// The share of frames that is lost at a margin.
pub(crate) fn loss(margin_db: f64) -> f64 {
    1.0 / (1.0 + ((margin_db - HALF_LOST_DB) / LOSS_SLOPE_DB).exp())
}

impl Radio {
    /// The ground station's antenna in metres above the ground, unless the mission says otherwise.
    pub const USUAL_ANTENNA_M: f64 = 2.0;

    /// How well each vehicle is heard, in dB: by the best path, which is as good as its worst leg.
    pub fn margins_db<'a>(
        &self,
        zones: impl Iterator<Item = &'a Zone>,
        crafts: &[Craft],
    ) -> BTreeMap<VehicleId, f64> {
        let zones: Vec<(&Shape, ZoneKind)> = zones.map(|zone| (&zone.shape, zone.kind)).collect();
        let placed = crafts
            .iter()
            .filter_map(|craft| Some((craft.id, self.node(craft)?)));
        let (ids, mut nodes): (Vec<VehicleId>, Vec<Node>) = placed.unzip();
        nodes.push(self.ground());
        let best = self.best_db(&nodes, &zones);
        ids.into_iter().zip(best).collect()
    }

    fn ground(&self) -> Node {
        Node {
            at: self.station,
            height_m: self.antenna_m,
            gain_dbi: self.model.ground_dbi,
            relays: true,
        }
    }

    fn node(&self, craft: &Craft) -> Option<Node> {
        let [east_m, north_m, up_m] = craft.place_m()?;
        Some(Node {
            at: [east_m, north_m],
            height_m: up_m,
            gain_dbi: self.model.air_dbi,
            relays: self.relays && craft.airborne && !craft.lost,
        })
    }

    /// The margin from the last node to each of the others, by the path whose worst leg is best.
    pub(crate) fn best_db(&self, nodes: &[Node], zones: &[(&Shape, ZoneKind)]) -> Vec<f64> {
        let mut best = vec![f64::NEG_INFINITY; nodes.len()];
        let mut open: Vec<usize> = (0..nodes.len()).collect();
        if let Some(ground) = best.last_mut() {
            *ground = f64::INFINITY;
        }
        while let Some(place) =
            (0..open.len()).max_by(|a, b| best[open[*a]].total_cmp(&best[open[*b]]))
        {
            let from = open.swap_remove(place);
            if !nodes[from].relays {
                continue;
            }
            for &to in &open {
                let leg_db = self.margin_db(&nodes[from], &nodes[to], zones);
                best[to] = best[to].max(best[from].min(leg_db));
            }
        }
        best.pop();
        best
    }

    /// The margin of the direct path between two nodes, in dB.
    pub(crate) fn margin_db(&self, a: &Node, b: &Node, zones: &[(&Shape, ZoneKind)]) -> f64 {
        let model = self.model;
        let (low, high) = (
            a.height_m.max(LOWEST_ANTENNA_M),
            b.height_m.max(LOWEST_ANTENNA_M),
        );
        let flat_m = (a.at[0] - b.at[0]).hypot(a.at[1] - b.at[1]);
        let distance_m = flat_m.hypot(low - high);
        let spread_db =
            free_space_db(distance_m, model.frequency_mhz).max(two_ray_db(distance_m, low, high));
        let budget_db =
            model.power_dbm + a.gain_dbi + b.gain_dbi - model.losses_db - model.sensitivity_dbm;
        let wave_m = LIGHT_M_US / model.frequency_mhz;
        let in_the_way = zones.iter().map(|(shape, kind)| match kind {
            ZoneKind::CommShadow(Shadow::Ridge { height_m }) => {
                ridge_db((a.at, low), (b.at, high), (shape, *height_m), wave_m)
            }
            ZoneKind::CommShadow(Shadow::Inside { loss_db }) => {
                let ends = [a, b].iter().filter(|node| shape.contains(node.at)).count();
                loss_db * ends as f64
            }
            ZoneKind::RadioJam { noise_db, edge_m } => {
                // Whoever listens in it hears less; both ends have to.
                let at = |node: &Node| noise_db * nearness(shape.distance_m(node.at), *edge_m);
                at(a).max(at(b))
            }
            _ => 0.0,
        });
        budget_db - spread_db - in_the_way.sum::<f64>()
    }

    /// What a margin means for a link.
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

/// 1 in a zone, less and less over its edge.
fn nearness(distance_m: f64, edge_m: f64) -> f64 {
    if distance_m <= 0.0 {
        1.0
    } else if distance_m < edge_m {
        1.0 - distance_m / edge_m
    } else {
        0.0
    }
}

/// What a ridge takes from a path: that of its highest edge above it.
fn ridge_db(
    (a, low_m): (Point, f64),
    (b, high_m): (Point, f64),
    (shape, height_m): (&Shape, f64),
    wave_m: f64,
) -> f64 {
    let flat_m = (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut worst = f64::NEG_INFINITY;
    for place in 1..PLACES {
        let share = f64::from(place) / f64::from(PLACES);
        let at = [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
        if !shape.contains(at) {
            continue;
        }
        let above_m = height_m - (low_m + (high_m - low_m) * share);
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
