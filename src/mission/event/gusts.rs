//! The gusts at the site: how the wind varies about its mean.
//!
//! The mission draws them, not the simulators: so they are the same for one seed on every backend. ArduPilot's SITL has
//! gusts of its own (`SIM_WIND_TURB`), but they last hundredths of a second and hardly move a vehicle.

use std::time::Duration;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::geo::maths;
use crate::mission::weather::{Weather, Wind};

/// The random stream of the gusts.
const STREAM: u64 = (1 << 40) - 2;
/// The length of gusts as they drift past, in metres: that of Dryden's model about 20 m above the ground
/// (MIL-F-8785C, low altitude).
const LENGTH_M: f64 = 100.0;
/// The minimum speed at which gusts drift past, in m/s.
const DRIFT_MIN_M_S: f64 = 5.0;

/// The gusts of one flight.
#[derive(Debug, Clone)]
pub(super) struct Gusts {
    random: ChaCha8Rng,
    /// Along and across the mean wind, in standard deviations.
    now: [f64; 2],
}

impl Gusts {
    pub fn new(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(STREAM);
        Self {
            now: [normal(&mut random), normal(&mut random)],
            random,
        }
    }

    /// Lets time pass. The gusts follow a Gauss-Markov process, whose correlation falls with the air that has passed.
    pub fn step(&mut self, weather: &Weather, time: Duration) {
        let passed_m = weather.wind.speed_m_s.max(DRIFT_MIN_M_S) * time.as_secs_f64();
        let kept = maths::exp(-passed_m / LENGTH_M);
        let new = (1.0 - kept * kept).sqrt();
        for gust in &mut self.now {
            *gust = kept * *gust + new * normal(&mut self.random);
        }
    }

    /// The wind at this moment.
    pub fn wind(&self, weather: &Weather) -> Wind {
        if weather.gust_m_s <= 0.0 {
            return weather.wind;
        }
        let [along_m_s, across_m_s] = self.now.map(|gust| gust * weather.gust_m_s);
        let mean = Wind {
            speed_m_s: weather.wind.speed_m_s + along_m_s,
            ..weather.wind
        };
        let across = Wind {
            speed_m_s: across_m_s,
            from_deg: weather.wind.from_deg + 90.0,
        };
        let [[east, north], [more_east, more_north]] = [mean, across].map(Wind::drift_m_s);
        let wind = Wind::of_drift([east + more_east, north + more_north]);
        Wind {
            from_deg: wind.from_deg.rem_euclid(360.0),
            ..wind
        }
    }
}

/// A random number of the standard normal distribution (Box and Muller).
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let [u, v]: [f64; 2] = [random.random(), random.random()];
    let radius = (-2.0 * maths::ln(1.0 - u)).sqrt();
    radius * maths::cos(std::f64::consts::TAU * v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::weather::Light;

    const STEP: Duration = Duration::from_millis(500);

    fn weather(gust_m_s: f64) -> Weather {
        Weather {
            wind: Wind {
                speed_m_s: 4.0,
                from_deg: 270.0,
            },
            gust_m_s,
            temperature_c: 20.0,
            light: Light::Day,
        }
    }

    #[test]
    fn the_wind_varies_about_its_mean_by_the_standard_deviation() {
        let weather = weather(2.0);
        let mut gusts = Gusts::new(7);
        let winds: Vec<[f64; 2]> = (0..200_000)
            .map(|_| {
                gusts.step(&weather, STEP);
                gusts.wind(&weather).drift_m_s()
            })
            .collect();
        let count = winds.len() as f64;
        for (axis, mean_m_s) in [(0, 4.0), (1, 0.0)] {
            let mean = winds.iter().map(|it| it[axis]).sum::<f64>() / count;
            let squares = winds.iter().map(|it| (it[axis] - mean) * (it[axis] - mean));
            let deviation = (squares.sum::<f64>() / count).sqrt();
            assert!((mean - mean_m_s).abs() < 0.1, "{mean}");
            assert!((deviation - 2.0).abs() < 0.1, "{deviation}");
        }
    }

    #[test]
    fn gusts_last_for_seconds_and_differ_by_seed_only() {
        let weather = weather(2.0);
        let mut all = [Gusts::new(1), Gusts::new(1), Gusts::new(2)];
        let mut most_m_s: f64 = 0.0;
        for _ in 0..100 {
            let before = all[0].wind(&weather).drift_m_s();
            for gusts in &mut all {
                gusts.step(&weather, STEP);
            }
            let after = all[0].wind(&weather).drift_m_s();
            most_m_s = most_m_s.max(maths::hypot(after[0] - before[0], after[1] - before[1]));
        }
        assert!(most_m_s < 2.5, "{most_m_s} m/s within half a second");
        let [one, same, other] = all.map(|it| it.wind(&weather));
        assert_eq!(one, same);
        assert_ne!(one, other);
    }

    #[test]
    fn without_gusts_the_wind_is_the_mean() {
        let weather = weather(0.0);
        let mut gusts = Gusts::new(7);
        gusts.step(&weather, STEP);
        assert_eq!(gusts.wind(&weather), weather.wind);
    }
}
