//! A leak that emits puffs. Each puff drifts with the current wind and grows on its way, so the cloud bends where the
//! wind has turned.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;

use super::dispersion::{CALM_BELOW_M_S, calm_growth_m_s, spreads_m};
use super::gaussian::{Plume, UG_PER_G};
use super::source::{Leak, LeakPlan};
use super::{Field, Hazard, Object, Quantity, TruthPiece};
use crate::geo::maths;
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::weather::Weather;
use crate::mission::{Point, TICK};

/// The maximum number of puffs: one every two seconds for five minutes.
const MOST_PUFFS: usize = 150;
const FIRST_SPREAD_M: f64 = 0.5;
/// A puff is ignored at more than this many spreads from its centre.
const FELT_SPREADS: f64 = 5.0;

#[derive(Debug, Clone)]
struct PuffsHazard {
    leak: LeakPlan,
    every_s: f64,
}

#[derive(Debug, Clone, Copy)]
struct Puff {
    at: Point,
    mass_g: f64,
    travelled_m: f64,
    /// Its horizontal and vertical spread, in metres.
    spread_m: (f64, f64),
}

#[derive(Debug, Clone)]
struct PuffsField {
    leak: Leak,
    every_s: f64,
    /// The puffs, oldest first.
    puffs: VecDeque<Puff>,
    since_last_s: f64,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "puffs",
    about: "a leak like `plume`, made of separate puffs that drift apart, so that the cloud bends where the wind has turned",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let leak = LeakPlan::need(table);
    let every_s = table.or("every", number(0.2, 60.0, "s"), 2.0, "time between puffs");
    Some(Box::new(PuffsHazard {
        leak: leak?,
        every_s,
    }))
}

impl Hazard for PuffsHazard {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        Box::new(PuffsField {
            leak: self.leak.drawn(&mut random),
            every_s: self.every_s,
            puffs: VecDeque::new(),
            since_last_s: 0.0,
        })
    }
}

impl Field for PuffsField {
    fn step(&mut self, _: Duration, weather: &Weather) {
        let dt_s = TICK.as_secs_f64();
        let drift = weather.wind.drift_m_s();
        let source = &self.leak.source;
        for puff in &mut self.puffs {
            puff.drift(drift, dt_s, source);
        }
        self.since_last_s += dt_s;
        if self.since_last_s >= self.every_s - 1e-9 {
            self.since_last_s = 0.0;
            self.puffs.push_back(Puff {
                at: source.source,
                mass_g: source.rate_g_s * self.every_s,
                travelled_m: 0.0,
                spread_m: (FIRST_SPREAD_M, FIRST_SPREAD_M),
            });
            if self.puffs.len() > MOST_PUFFS {
                self.puffs.pop_front();
            }
        }
    }

    fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        if !self.leak.is_measured_in(quantity) {
            return 0.0;
        }
        let source_m = self.leak.source.height_m;
        let of = |puff: &Puff| puff.concentration_ug_m3(at, height_m, source_m);
        self.puffs.iter().map(of).sum()
    }

    fn objects(&self) -> &[Object] {
        self.leak.objects()
    }

    fn truth(&self) -> Vec<TruthPiece> {
        vec![self.leak.truth()]
    }
}

impl Puff {
    /// Moves a puff. In wind it grows with the distance travelled, as a plume does; in calm air, it grows with time.
    fn drift(&mut self, drift_m_s: [f64; 2], dt_s: f64, source: &Plume) {
        let speed_m_s = maths::hypot(drift_m_s[0], drift_m_s[1]);
        self.at[0] += drift_m_s[0] * dt_s;
        self.at[1] += drift_m_s[1] * dt_s;
        let before = spreads_m(source.stability, source.terrain, self.travelled_m);
        self.travelled_m += speed_m_s * dt_s;
        let after = spreads_m(source.stability, source.terrain, self.travelled_m);
        let growth = if speed_m_s < CALM_BELOW_M_S {
            let (a, g) = calm_growth_m_s(source.stability);
            (a * dt_s, g * dt_s)
        } else {
            (after.0 - before.0, after.1 - before.1)
        };
        self.spread_m.0 += growth.0;
        self.spread_m.1 += growth.1;
    }

    /// `M / ((2 pi)^1.5 sy2 sz) exp(-r2/2sy2) [exp(-(z-H)2/2sz2) + exp(-(z+H)2/2sz2)]`
    fn concentration_ug_m3(&self, at: Point, height_m: f64, source_m: f64) -> f64 {
        let (sy, sz) = self.spread_m;
        let r2 = maths::powi(at[0] - self.at[0], 2) + maths::powi(at[1] - self.at[1], 2);
        if r2 > maths::powi(FELT_SPREADS * sy, 2) {
            return 0.0;
        }
        let bell = |rise: f64| maths::exp(-0.5 * maths::powi(rise / sz, 2));
        let vertical = bell(height_m - source_m) + bell(height_m + source_m);
        let middle = UG_PER_G * self.mass_g / (maths::powf(TAU, 1.5) * sy * sy * sz);
        middle * maths::exp(-0.5 * r2 / (sy * sy)) * vertical
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::hazard::dispersion::{Stability, Terrain};
    use crate::mission::hazard::source::Substance;
    use crate::mission::weather::Wind;

    fn puffs() -> PuffsField {
        let source = Plume {
            source: [0.0, 0.0],
            height_m: 5.0,
            rate_g_s: 3.0,
            stability: Stability::C,
            terrain: Terrain::Open,
        };
        PuffsField {
            leak: Leak::new(source, Substance::Vapour),
            every_s: 2.0,
            puffs: VecDeque::new(),
            since_last_s: 0.0,
        }
    }

    fn wind(speed_m_s: f64, from_deg: f64) -> Weather {
        Weather {
            wind: Wind {
                speed_m_s,
                from_deg,
            },
            ..Weather::CALM
        }
    }

    fn run(field: &mut PuffsField, seconds: u32, weather: &Weather) {
        for tick in 1..=seconds * 10 {
            field.step(TICK * tick, weather);
        }
    }

    #[test]
    fn all_that_came_out_is_in_the_air() {
        let mut field = puffs();
        run(&mut field, 40, &wind(3.0, 270.0));
        // The last puff is still only half a metre wide: it is left out of both the grid and the sum.
        field.puffs.pop_back();
        let mut mass_g = 0.0;
        for east in -40..180 {
            for north in -60..60 {
                for up in 0..80 {
                    let at = [f64::from(east) + 0.5, f64::from(north) + 0.5];
                    let value = field.amount(Quantity::Vapour, at, f64::from(up) + 0.5);
                    mass_g += value / UG_PER_G;
                }
            }
        }
        assert!((mass_g / (19.0 * 6.0) - 1.0).abs() < 0.01, "{mass_g}");
    }

    #[test]
    fn the_cloud_bends_where_the_wind_has_turned() {
        let mut field = puffs();
        run(&mut field, 20, &wind(3.0, 270.0));
        run(&mut field, 20, &wind(3.0, 180.0));
        let at = |at| field.amount(Quantity::Vapour, at, 5.0);
        // The old part lies east and has moved north; the new one lies north of the source.
        assert!(at([40.0, 60.0]) > 100.0);
        assert!(at([0.0, 30.0]) > 100.0);
        assert!(at([40.0, 0.0]) < 1.0);
    }

    #[test]
    fn calm_air_keeps_the_puffs_where_they_are_and_they_grow() {
        let mut field = puffs();
        run(&mut field, 10, &wind(0.0, 0.0));
        let oldest = field.puffs[0];
        assert!(maths::hypot(oldest.at[0], oldest.at[1]) < 1e-9);
        assert!((oldest.spread_m.0 - (0.5 + 0.635 * 8.0)).abs() < 1e-6);
    }
}
