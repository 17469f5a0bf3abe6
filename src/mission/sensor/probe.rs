//! Sensors that measure a quantity at their position, or along a beam below: gain, lag, noise, range; and radiation
//! counters.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Poisson, StandardNormal};

use super::Sensor;
use crate::geo::maths;
use crate::mission::ground_truth::Quantity;

/// The measuring properties of a sensor.
#[derive(Debug, PartialEq)]
pub(crate) struct ProbeSpec {
    pub quantity: Quantity,
    pub unit: &'static str,
    /// Reading per unit of the quantity.
    pub gain: f64,
    /// Time constant in seconds.
    pub tau_s: f64,
    /// The method of measurement.
    pub response: Response,
    /// Largest reading, in its unit.
    pub ceiling: f64,
}

/// The method of measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Response {
    /// The sensor samples the air around it.
    Inlet(Noise),
    /// The sensor measures along a beam down to the ground; the reading is the integral along it.
    Beam(Noise),
    /// The sensor counts pulses, so its readings scatter as counts do.
    Counter {
        /// Counts per second, per unit of the reading.
        per_unit_s: f64,
        /// The dead time after each count.
        dead_time_s: f64,
    },
}

/// The noise of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Noise {
    /// The noise as a share of the reading.
    pub share: f64,
    /// The noise floor, in the sensor's unit.
    pub floor: f64,
}

/// The speed above which rotor wash reaches the inlet.
const WASH_FROM_M_S: f64 = 5.0;
/// The lowest reading that cannot be noise, as a multiple of the noise floor.
const SIGNAL_FROM_FLOORS: f64 = 5.0;
/// The share of a reading left under rotor wash.
const WASH_SHARE: f64 = 0.7;
/// The additional lag from rotor wash, in seconds.
const WASH_TAU_S: f64 = 2.0;

/// A sensor on one vehicle.
#[derive(Debug, Clone)]
pub(crate) struct Probe {
    pub sensor: &'static Sensor,
    pub spec: &'static ProbeSpec,
    /// Its reading, in its unit.
    pub shown: f64,
    settled: f64,
    random: ChaCha8Rng,
}

impl Probe {
    /// A sensor in clean air; its noise is drawn from `stream` of `seed`. `None` if the sensor does
    /// not measure a quantity.
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

    /// Whether it measures along a beam down to the ground.
    pub fn looks_down(&self) -> bool {
        matches!(self.spec.response, Response::Beam(_))
    }

    /// Whether the sensor has measured something: its reading stands out from its noise. Each count of a counter is real.
    pub fn has_signal(&self) -> bool {
        let least = match self.spec.response {
            Response::Inlet(noise) | Response::Beam(noise) => SIGNAL_FROM_FLOORS * noise.floor,
            Response::Counter { .. } => 0.0,
        };
        self.shown > least
    }

    /// Advances by `dt_s` with the given amount of its quantity.
    pub fn step(&mut self, amount: f64, speed_m_s: f64, dt_s: f64) {
        let reading = amount * self.spec.gain;
        let shown = match self.spec.response {
            Response::Inlet(noise) => {
                let washed = speed_m_s >= WASH_FROM_M_S;
                let share = if washed { WASH_SHARE } else { 1.0 };
                let smear_s = if washed { WASH_TAU_S } else { 0.0 };
                self.settle(reading * share, self.spec.tau_s + smear_s, dt_s);
                self.noisy(noise)
            }
            Response::Beam(noise) => {
                self.settle(reading, self.spec.tau_s, dt_s);
                self.noisy(noise)
            }
            Response::Counter {
                per_unit_s,
                dead_time_s,
            } => {
                let counted = counted_per_s(reading * per_unit_s, dead_time_s);
                let counts = self.counts(counted * dt_s);
                self.settle(counts / dt_s / per_unit_s, self.spec.tau_s, dt_s);
                self.settled
            }
        };
        self.shown = shown.clamp(0.0, self.spec.ceiling);
    }

    fn settle(&mut self, reading: f64, tau_s: f64, dt_s: f64) {
        self.settled += (reading - self.settled) * (1.0 - maths::exp(-dt_s / tau_s));
    }

    /// The reading with Gaussian noise of `sqrt((share * reading)^2 + floor^2)`.
    fn noisy(&mut self, noise: Noise) -> f64 {
        let draw: f64 = StandardNormal.sample(&mut self.random);
        self.settled + draw * maths::hypot(noise.share * self.settled, noise.floor)
    }

    fn counts(&mut self, mean: f64) -> f64 {
        Poisson::new(mean).map_or(0.0, |counts| counts.sample(&mut self.random))
    }
}

/// The count rate of a counter with a dead time: `n / (1 + n tau)`.
fn counted_per_s(events_per_s: f64, dead_time_s: f64) -> f64 {
    events_per_s / (1.0 + events_per_s * dead_time_s)
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

    /// Settled readings of a sensor in a constant amount, one per tick.
    fn readings(id: &str, amount: f64, ticks: usize) -> Vec<f64> {
        let sensor = Sensor::by_id(id).expect("it is in the catalogue");
        let mut probe = Probe::new(sensor, 7, 0).expect("it measures");
        let mut step = || {
            probe.step(amount, 0.0, 0.1);
            probe.shown
        };
        for _ in 0..600 {
            step();
        }
        (0..ticks).map(|_| step()).collect()
    }

    fn mean_and_variance(values: &[f64]) -> (f64, f64) {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values
            .iter()
            .map(|value| maths::powi(value - mean, 2))
            .sum();
        (mean, squares / count)
    }

    #[test]
    fn a_counter_that_is_blind_after_each_count_misses_what_the_formula_says() {
        for (events, dead_time_s, expected) in [
            (100.0, 190e-6, 98.14),
            (1000.0, 190e-6, 840.3),
            (10_000.0, 190e-6, 3448.3),
        ] {
            let counted = counted_per_s(events, dead_time_s);
            assert!((counted - expected).abs() < 0.06, "{events}: {counted}");
        }
    }

    #[test]
    fn counters_show_the_dose_rate_until_they_saturate() {
        // 1.5 counts a second in 1 uSv/h; 2000 uSv/h are 3000 events, of which 1911 are counted.
        for (id, dose_rate, expected) in [
            ("s_geiger", 20.0, 19.89),
            ("s_geiger", 2000.0, 1274.0),
            ("s_csi", 20.0, 18.78),
            ("s_csi", 0.1, 0.1),
        ] {
            let (mean, _) = mean_and_variance(&readings(id, dose_rate, 20_000));
            assert!((mean / expected - 1.0).abs() < 0.02, "{id}: {mean}");
        }
    }

    /// A lag of `tau` averages over `2 tau`: the variance of a rate of n counts a second becomes n / (2 tau).
    #[test]
    fn counts_scatter_as_a_poisson_process_does() {
        let (mean, variance) = mean_and_variance(&readings("s_geiger", 20.0, 100_000));
        let expected = mean / 1.5 / (2.0 * 3.0);
        assert!(
            (variance / expected - 1.0).abs() < 0.1,
            "{variance} {expected}"
        );
    }

    #[test]
    fn the_rotor_wash_thins_readings_of_a_fast_vehicle() {
        assert!((after_a_step(60.0, 6.0) - WASH_SHARE).abs() < 1e-6);
        assert!((after_a_step(60.0, 4.9) - 1.0).abs() < 1e-6);
    }
}
