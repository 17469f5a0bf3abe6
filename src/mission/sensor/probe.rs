//! Sensors that measure a quantity where they are: gain, lag, noise, range.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::Sensor;
use crate::mission::hazard::Quantity;

/// How a sensor measures.
#[derive(Debug, PartialEq)]
pub(crate) struct ProbeSpec {
    /// What it measures.
    pub quantity: Quantity,
    /// What it shows.
    pub unit: &'static str,
    /// Reading per unit of the quantity.
    pub gain: f64,
    /// Time constant in seconds.
    pub tau_s: f64,
    /// Noise as a share of the reading.
    pub noise: f64,
    /// Smallest reading that stands out of the noise, in its unit.
    pub floor: f64,
    /// Largest reading, in its unit.
    pub ceiling: f64,
}

/// From this speed on the rotors' wash reaches the inlet.
const WASH_FROM_M_S: f64 = 5.0;
/// The share of a reading that the wash leaves.
const WASH_SHARE: f64 = 0.7;
/// By how much the wash smears readings, in seconds.
const WASH_TAU_S: f64 = 2.0;

/// One such sensor on one vehicle.
#[derive(Debug, Clone)]
pub(crate) struct Probe {
    pub sensor: &'static Sensor,
    pub spec: &'static ProbeSpec,
    /// What it shows, in its unit.
    pub shown: f64,
    settled: f64,
    random: ChaCha8Rng,
}

impl Probe {
    /// A sensor in clean air; its noise is drawn from `stream` of `seed`. `None` for one that does not measure.
    pub fn new(sensor: &'static Sensor, seed: u64, stream: u64) -> Option<Self> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Some(Self {
            sensor,
            spec: sensor.probe()?,
            shown: 0.0,
            settled: 0.0,
            random,
        })
    }

    /// A step of `dt_s` in so much of its quantity: a first-order lag, then noise of
    /// `sqrt((noise * reading)^2 + floor^2)`.
    pub fn step(&mut self, amount: f64, speed_m_s: f64, dt_s: f64) {
        let washed = speed_m_s >= WASH_FROM_M_S;
        let share = if washed { WASH_SHARE } else { 1.0 };
        let tau_s = self.spec.tau_s + if washed { WASH_TAU_S } else { 0.0 };
        let input = amount * self.spec.gain * share;
        self.settled += (input - self.settled) * (1.0 - (-dt_s / tau_s).exp());
        let noise: f64 = StandardNormal.sample(&mut self.random);
        let spread = (self.spec.noise * self.settled).hypot(self.spec.floor);
        self.shown = (self.settled + noise * spread).clamp(0.0, self.spec.ceiling);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after_a_step(seconds: f64, speed_m_s: f64) -> f64 {
        let sensor = Sensor::by_id("s_voc").expect("it is in the catalogue");
        let mut probe = Probe::new(sensor, 1, 0).expect("it measures");
        let one_ppm = 1.0 / probe.spec.gain;
        for _ in 0..(seconds * 10.0) as u32 {
            probe.step(one_ppm, speed_m_s, 0.1);
        }
        probe.settled
    }

    #[test]
    fn the_gas_sensor_reaches_ninety_percent_in_three_seconds() {
        let value = after_a_step(3.0, 0.0);
        assert!((value - 0.90).abs() < 0.01, "{value}");
    }

    #[test]
    fn the_rotor_wash_thins_readings_of_a_fast_vehicle() {
        assert!((after_a_step(60.0, 6.0) - WASH_SHARE).abs() < 1e-6);
        assert!((after_a_step(60.0, 4.9) - 1.0).abs() < 1e-6);
    }
}
