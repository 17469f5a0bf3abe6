//! The moving air.

use glam::DVec3;
use rand::{Rng as _, RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::body::STEP_S;
use super::parameters::Tuning;

/// How long a gust lasts.
const GUST_S: f64 = 2.0;

/// Mean wind and gusts at one vehicle.
#[derive(Debug, Clone)]
pub(super) struct Wind {
    rng: ChaCha8Rng,
    gust_m_s: DVec3,
}

impl Wind {
    /// Each vehicle has its own stream of random numbers, so that one more vehicle changes no other.
    pub(super) fn new(seed: u64, vehicle: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(vehicle);
        Self {
            rng,
            gust_m_s: DVec3::ZERO,
        }
    }

    /// The air's velocity at a height. Below `SIM_WIND_T_ALT` the wind grows with the root of the height.
    pub(super) fn step(&mut self, height_m: f64, tuning: &Tuning) -> DVec3 {
        if tuning.wind_speed_m_s <= 0.0 && tuning.wind_turbulence_m_s <= 0.0 {
            return DVec3::ZERO;
        }
        let profile = (height_m / tuning.wind_full_height_m)
            .clamp(0.0, 1.0)
            .sqrt();
        let (sin, cos) = tuning.wind_from_deg.to_radians().sin_cos();
        let mean = DVec3::new(-cos, -sin, 0.0) * (tuning.wind_speed_m_s * profile);
        if tuning.wind_turbulence_m_s > 0.0 {
            let keep = 1.0 - STEP_S / GUST_S;
            let kick = tuning.wind_turbulence_m_s * (3.0 * (1.0 - keep * keep)).sqrt();
            let noise = DVec3::new(self.symmetric(), self.symmetric(), self.symmetric());
            self.gust_m_s = self.gust_m_s * keep + noise * kick;
        }
        mean + self.gust_m_s
    }

    /// A number that identifies this vehicle's board.
    pub(super) fn board_id(&mut self) -> u64 {
        self.rng.next_u64()
    }

    fn symmetric(&mut self) -> f64 {
        self.rng.random_range(-1.0..1.0)
    }
}
