//! The concentration that a steady source causes in a steady wind.

use std::f64::consts::TAU;

use super::dispersion::{CALM_BELOW_M_S, Stability, Terrain, calm_growth_m_s, spreads_m};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::weather::Wind;

pub(super) const UG_PER_G: f64 = 1e6;
/// The concentration is capped at its value at this distance from the source, in metres.
const NEAREST_M: f64 = 1.0;

/// A source in the wind.
#[derive(Debug, Clone)]
pub(crate) struct Plume {
    pub source: Point,
    pub height_m: f64,
    pub rate_g_s: f64,
    pub stability: Stability,
    pub terrain: Terrain,
}

/// How far a point lies downwind of a source, and how far across the wind, in metres.
pub(super) fn along_and_across(wind: Wind, source: Point, at: Point) -> (f64, f64) {
    let (east, north) = (at[0] - source[0], at[1] - source[1]);
    let (sin, cos) = maths::sin_cos(wind.from_deg.to_radians());
    // `from` is the direction the wind comes from.
    (-(east * sin + north * cos), east * cos - north * sin)
}

impl Plume {
    /// The mean concentration; between calm air and the lowest wind for which the plume formula is
    /// valid, it is a mixture of the concentrations in calm air and in wind.
    pub fn concentration_ug_m3(&self, wind: Wind, at: Point, height_m: f64) -> f64 {
        let windy = (wind.speed_m_s / CALM_BELOW_M_S).clamp(0.0, 1.0);
        let mut concentration = 0.0;
        if windy > 0.0 {
            concentration += windy * self.in_wind_ug_m3(wind, at, height_m);
        }
        if windy < 1.0 {
            concentration += (1.0 - windy) * self.in_calm_ug_m3(at, height_m);
        }
        concentration
    }

    /// `Q / (2 pi u sy sz) exp(-y2/2sy2) [exp(-(z-H)2/2sz2) + exp(-(z+H)2/2sz2)]`, zero upwind of the source.
    fn in_wind_ug_m3(&self, wind: Wind, at: Point, height_m: f64) -> f64 {
        let (downwind, crosswind) = along_and_across(wind, self.source, at);
        if downwind <= 0.0 {
            return 0.0;
        }
        let (sy, sz) = spreads_m(self.stability, self.terrain, downwind.max(NEAREST_M));
        let bell = |offset: f64, spread: f64| maths::exp(-0.5 * maths::powi(offset / spread, 2));
        let speed = wind.speed_m_s.max(CALM_BELOW_M_S);
        let vertical = bell(height_m - self.height_m, sz) + bell(height_m + self.height_m, sz);
        UG_PER_G * self.rate_g_s / (TAU * speed * sy * sz) * bell(crosswind, sy) * vertical
    }

    /// The integral over puffs that grow in proportion to their age: `Q / ((2 pi)^1.5 g) [1 / (R2 + a2/g2 (z-H)2) + 1
    /// / (R2 + a2/g2 (z+H)2)]`.
    fn in_calm_ug_m3(&self, at: Point, height_m: f64) -> f64 {
        let (a, g) = calm_growth_m_s(self.stability);
        let r2 = maths::powi(at[0] - self.source[0], 2) + maths::powi(at[1] - self.source[1], 2);
        let term =
            |rise: f64| 1.0 / (r2 + maths::powi(a / g * rise, 2)).max(maths::powi(NEAREST_M, 2));
        let both = term(height_m - self.height_m) + term(height_m + self.height_m);
        UG_PER_G * self.rate_g_s / (maths::powf(TAU, 1.5) * g) * both
    }
}
