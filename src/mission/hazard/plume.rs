//! A Gaussian plume over flat ground (Pasquill-Gifford; spreads by Briggs 1973). It follows the wind, meanders about
//! its direction, and has gusts. In calm air, it is a cloud around its source.

use std::collections::VecDeque;
use std::time::Duration;

use rand_chacha::ChaCha8Rng;

use super::dispersion::CALM_BELOW_M_S;
use super::gaussian::along_and_across;
use super::source::{Leak, LeakPlan};
use super::wander::Wander;
use super::{Field, Hazard, Object, Quantity, TruthPiece, TruthShape};
use crate::geo::maths;
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::weather::{Weather, Wind};
use crate::mission::{Point, TICK};

/// The time constant with which the air over the whole site follows a change of the weather, in
/// seconds.
const FOLLOWS_IN_S: f64 = 20.0;
/// The correlation time of the meandering of the axis, in seconds.
const MEANDER_TAU_S: f64 = 120.0;
/// The correlation time of concentration gusts, in seconds.
const GUST_TAU_S: f64 = 3.0;
/// The number of ticks after which gusts have left the site.
const GUSTS_KEPT: usize = 3000;

/// The shading of a plume in the debrief. In this order: the side of the squares, their number to
/// each side of the source, the powers of ten covered, and the minimum strength.
const SHADE_SIDE_M: f64 = 12.0;
const SHADES_OUT: i32 = 25;
const DECADES: f64 = 3.0;
const FAINTEST: f64 = 0.1;

#[derive(Debug, Clone)]
struct PlumeHazard {
    leak: LeakPlan,
    /// The standard deviation of the axis's direction, in degrees.
    meander_deg: f64,
    /// The standard deviation of the logarithm of the concentration.
    intermittency: f64,
}

#[derive(Debug, Clone)]
struct PlumeField {
    leak: Leak,
    /// The wind at the site, east and north, before meandering.
    drift_m_s: [f64; 2],
    /// The wind that shapes the plume.
    wind: Wind,
    axis_deg: Wander,
    gust: Wander,
    intermittency: f64,
    /// The gusts that left the source, newest first, one per tick.
    gusts: VecDeque<f64>,
    random: ChaCha8Rng,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "plume",
    about: "a continuous leak: a Gaussian plume along the wind, and in calm air a cloud around its source",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let leak = LeakPlan::need(table);
    let meander_deg = table.or(
        "meander",
        number(0.0, 60.0, "degrees"),
        0.0,
        "swing of the plume's axis (standard deviation)",
    );
    let intermittency = table.or(
        "intermittency",
        number(0.0, 2.0, ""),
        0.0,
        "fluctuation of the readings: standard deviation of their logarithm; 0.5 is difficult",
    );
    Some(Box::new(PlumeHazard {
        leak: leak?,
        meander_deg,
        intermittency,
    }))
}

impl Hazard for PlumeHazard {
    fn release(&self, weather: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let leak = self.leak.drawn(&mut random);
        let axis_deg = Wander::new(self.meander_deg, MEANDER_TAU_S, &mut random);
        let mut field = PlumeField {
            leak,
            drift_m_s: weather.wind.drift_m_s(),
            wind: weather.wind,
            axis_deg,
            gust: Wander::new(self.intermittency, GUST_TAU_S, &mut random),
            intermittency: self.intermittency,
            gusts: VecDeque::new(),
            random,
        };
        field.lie_in_the_wind();
        Box::new(field)
    }
}

impl Field for PlumeField {
    fn step(&mut self, _: Duration, weather: &Weather) {
        let dt_s = TICK.as_secs_f64();
        let follows = 1.0 - maths::exp(-dt_s / FOLLOWS_IN_S);
        for (drift, now) in self.drift_m_s.iter_mut().zip(weather.wind.drift_m_s()) {
            *drift += (now - *drift) * follows;
        }
        self.axis_deg.step(dt_s, &mut self.random);
        self.lie_in_the_wind();
        if self.intermittency > 0.0 {
            self.gust.step(dt_s, &mut self.random);
            self.gusts.push_front(self.gust.value);
            self.gusts.truncate(GUSTS_KEPT);
        }
    }

    fn amount(&self, quantity: Quantity, at: Point, height_m: f64) -> f64 {
        if !self.leak.is_measured_in(quantity) {
            return 0.0;
        }
        self.leak
            .source
            .concentration_ug_m3(self.wind, at, height_m)
            * self.gust_at(at)
    }

    fn objects(&self) -> &[Object] {
        self.leak.objects()
    }

    fn truth(&self) -> Vec<TruthPiece> {
        let mut truth = self.shades();
        truth.push(self.leak.truth());
        truth
    }
}

impl PlumeField {
    /// The plume without gusts at the height of its source: the greatest strength is 1, and the
    /// strength falls to 0 over [`DECADES`] powers of ten.
    fn shades(&self) -> Vec<TruthPiece> {
        let [east_m, north_m] = self.leak.source.source;
        let middle = |at: i32| f64::from(at) * SHADE_SIDE_M;
        let places = (-SHADES_OUT..=SHADES_OUT)
            .flat_map(|row| (-SHADES_OUT..=SHADES_OUT).map(move |column| (column, row)));
        let amounts = places.map(|(column, row)| {
            let at = [east_m + middle(column), north_m + middle(row)];
            let source = &self.leak.source;
            let amount = source.concentration_ug_m3(self.wind, at, source.height_m);
            (at, amount)
        });
        let amounts: Vec<(Point, f64)> = amounts.collect();
        let most = amounts
            .iter()
            .map(|(_, amount)| *amount)
            .fold(f64::MIN_POSITIVE, f64::max);
        let shade = |(at, amount): (Point, f64)| {
            let strength = 1.0 + maths::log10(amount / most) / DECADES;
            (strength >= FAINTEST).then_some(TruthPiece {
                at,
                shape: TruthShape::Square(SHADE_SIDE_M, strength),
            })
        };
        amounts.into_iter().filter_map(shade).collect()
    }

    fn lie_in_the_wind(&mut self) {
        let mean = Wind::of_drift(self.drift_m_s);
        self.wind = Wind {
            from_deg: mean.from_deg + self.axis_deg.value,
            ..mean
        };
    }

    /// The concentration at a point as a multiple of its mean: the wind carries each gust to the point unchanged.
    /// Lognormal, with a mean of 1.
    fn gust_at(&self, at: Point) -> f64 {
        if self.intermittency <= 0.0 {
            return 1.0;
        }
        let (downwind, _) = along_and_across(self.wind, self.leak.source.source, at);
        let age_s = downwind.max(0.0) / self.wind.speed_m_s.max(CALM_BELOW_M_S);
        let age = ((age_s / TICK.as_secs_f64()) as usize).min(self.gusts.len().saturating_sub(1));
        let gust = self.gusts.get(age).copied().unwrap_or(self.gust.value);
        maths::exp(gust - 0.5 * maths::powi(self.intermittency, 2))
    }
}

#[cfg(test)]
mod tests;
