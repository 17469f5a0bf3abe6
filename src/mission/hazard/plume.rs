//! A steady Gaussian plume over flat ground (Pasquill-Gifford; spreads by Briggs 1973).

use std::f64::consts::TAU;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;
use toml::Spanned;

use super::{Field, Hazard, Quantity};
use crate::mission::Point;
use crate::mission::file::{Draft, Faults, POINT_RANGE, Section};
use crate::mission::weather::{Weather, Wind};

/// The formula divides by the wind's speed and means nothing in calm air.
const SLOWEST_WIND_M_S: f64 = 0.5;
const UG_PER_G: f64 = 1e6;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlumeFile {
    source: Spanned<Point>,
    height: Spanned<f64>,
    rate: Spanned<f64>,
    stability: Stability,
    #[serde(default)]
    terrain: Terrain,
    jitter: Option<JitterFile>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct JitterFile {
    position: Spanned<f64>,
    rate: Spanned<f64>,
}

/// Pasquill's stability class of the air, very unstable to stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(crate) enum Stability {
    A,
    B,
    C,
    D,
    E,
    F,
}

/// What the ground is like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Terrain {
    /// Open country.
    #[default]
    Open,
    /// Built over.
    Urban,
}

#[derive(Debug)]
struct PlumeHazard {
    plume: Plume,
    position_jitter_m: f64,
    rate_jitter: f64,
}

/// A plume.
#[derive(Debug, Clone)]
pub(crate) struct Plume {
    pub source: Point,
    pub height_m: f64,
    pub rate_g_s: f64,
    pub stability: Stability,
    pub terrain: Terrain,
    pub wind: Wind,
}

/// Reads a `[[hazards]]` of kind `plume`.
pub(crate) fn read(
    section: Section<'_>,
    _: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Hazard>> {
    let file: PlumeFile = faults.read(section)?;
    let jitter = file.jitter.as_ref();
    Some(Box::new(PlumeHazard {
        plume: Plume {
            source: faults.point(&file.source, "source"),
            height_m: faults.number(&file.height, 0.0..=500.0, "height"),
            rate_g_s: faults.number(&file.rate, 1e-6..=1e6, "rate"),
            stability: file.stability,
            terrain: file.terrain,
            wind: Wind {
                speed_m_s: SLOWEST_WIND_M_S,
                from_deg: 0.0,
            },
        },
        position_jitter_m: jitter.map_or(0.0, |jitter| {
            faults.number(&jitter.position, 0.0..=POINT_RANGE, "jitter.position")
        }),
        rate_jitter: jitter.map_or(0.0, |jitter| {
            faults.number(&jitter.rate, 0.0..=0.9, "jitter.rate")
        }),
    }))
}

impl Hazard for PlumeHazard {
    fn release(&self, weather: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let mut sway = |by: f64| by * (2.0 * random.random::<f64>() - 1.0);
        let mut plume = self.plume.clone();
        plume.source[0] += sway(self.position_jitter_m);
        plume.source[1] += sway(self.position_jitter_m);
        plume.rate_g_s *= 1.0 + sway(self.rate_jitter);
        plume.wind = weather.wind;
        Box::new(plume)
    }
}

impl Field for Plume {
    fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        match quantity {
            Quantity::Vapour | Quantity::Particles => self.concentration_ug_m3(at, height_m),
            Quantity::DoseRate | Quantity::Heat => 0.0,
        }
    }
}

impl Plume {
    /// `Q / (2 pi u sy sz) exp(-y2/2sy2) [exp(-(z-H)2/2sz2) + exp(-(z+H)2/2sz2)]`, zero upwind of the source.
    fn concentration_ug_m3(&self, at: Point, height_m: f64) -> f64 {
        let (east, north) = (at[0] - self.source[0], at[1] - self.source[1]);
        let (sin, cos) = self.wind.from_deg.to_radians().sin_cos();
        // The wind blows away from where it comes from.
        let downwind = -(east * sin + north * cos);
        let crosswind = east * cos - north * sin;
        if downwind <= 0.0 {
            return 0.0;
        }
        let (sy, sz) = spreads_m(self.stability, self.terrain, downwind);
        let bell = |offset: f64, spread: f64| (-0.5 * (offset / spread).powi(2)).exp();
        let speed = self.wind.speed_m_s.max(SLOWEST_WIND_M_S);
        let vertical = bell(height_m - self.height_m, sz) + bell(height_m + self.height_m, sz);
        UG_PER_G * self.rate_g_s / (TAU * speed * sy * sz) * bell(crosswind, sy) * vertical
    }
}

/// Horizontal and vertical spread at a distance downwind (Briggs 1973; x in metres, 100 m to 10 km).
fn spreads_m(stability: Stability, terrain: Terrain, x: f64) -> (f64, f64) {
    use Stability::{A, B, C, D, E, F};
    let fall = |factor: f64, per_m: f64| factor * x / (1.0 + per_m * x).sqrt();
    let rise = |factor: f64, per_m: f64| factor * x * (1.0 + per_m * x).sqrt();
    let slow = |factor: f64| factor * x / (1.0 + 0.0003 * x);
    match (terrain, stability) {
        (Terrain::Open, A) => (fall(0.22, 1e-4), 0.20 * x),
        (Terrain::Open, B) => (fall(0.16, 1e-4), 0.12 * x),
        (Terrain::Open, C) => (fall(0.11, 1e-4), fall(0.08, 2e-4)),
        (Terrain::Open, D) => (fall(0.08, 1e-4), fall(0.06, 1.5e-3)),
        (Terrain::Open, E) => (fall(0.06, 1e-4), slow(0.03)),
        (Terrain::Open, F) => (fall(0.04, 1e-4), slow(0.016)),
        (Terrain::Urban, A | B) => (fall(0.32, 4e-4), rise(0.24, 1e-3)),
        (Terrain::Urban, C) => (fall(0.22, 4e-4), 0.20 * x),
        (Terrain::Urban, D) => (fall(0.16, 4e-4), fall(0.14, 3e-4)),
        (Terrain::Urban, E | F) => (fall(0.11, 4e-4), fall(0.08, 1.5e-3)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plume() -> Plume {
        Plume {
            source: [0.0, 0.0],
            height_m: 15.0,
            rate_g_s: 1.0,
            stability: Stability::D,
            terrain: Terrain::Open,
            wind: Wind {
                speed_m_s: 4.0,
                from_deg: 270.0,
            },
        }
    }

    #[test]
    fn the_centreline_has_the_published_concentrations() {
        for (x, expected) in [
            (50.0, 774.0),
            (100.0, 599.0),
            (200.0, 214.0),
            (400.0, 77.0),
            (800.0, 31.0),
        ] {
            let value = plume().concentration_ug_m3([x, 0.0], 20.0);
            assert!(
                (value - expected).abs() < 0.51,
                "{x} m: {value} instead of {expected}"
            );
        }
    }

    #[test]
    fn the_plume_lies_downwind_and_is_symmetric() {
        let plume = plume();
        assert!(plume.concentration_ug_m3([-1.0, 0.0], 15.0).abs() < 1e-12);
        let (left, right) = ([100.0, 12.0], [100.0, -12.0]);
        let difference =
            plume.concentration_ug_m3(left, 15.0) - plume.concentration_ug_m3(right, 15.0);
        assert!(difference.abs() < 1e-9);
        assert!(
            plume.concentration_ug_m3([100.0, 12.0], 15.0)
                < plume.concentration_ug_m3([100.0, 0.0], 15.0)
        );
    }

    #[test]
    fn a_north_wind_carries_it_south() {
        let mut plume = plume();
        plume.wind.from_deg = 0.0;
        assert!(plume.concentration_ug_m3([0.0, -100.0], 15.0) > 100.0);
        assert!(plume.concentration_ug_m3([0.0, 100.0], 15.0).abs() < 1e-12);
    }
}
