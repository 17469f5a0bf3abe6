//! Radio loss over a distance, and the range for a loss budget: inverse functions of each other.

use super::part::Radio;
use crate::geo::maths;

/// The minimum height of an antenna in the formulas, in metres.
pub(crate) const LOWEST_ANTENNA_M: f64 = 0.3;
/// The height of the ground antenna in metres, unless a mission sets another.
pub(crate) const GROUND_ANTENNA_M: f64 = 2.0;
/// The distance within which the signal does not get stronger, in metres.
const NEAREST_M: f64 = 1.0;
/// The loss in free space over 1 km at 1 MHz, in dB (ITU-R P.525).
const FREE_SPACE_DB: f64 = 32.44;

/// Loss over a distance in free space, in dB: `32.44 + 20 lg(km) + 20 lg(MHz)` (ITU-R P.525).
pub(crate) fn free_space_db(distance_m: f64, frequency_mhz: f64) -> f64 {
    FREE_SPACE_DB
        + 20.0 * maths::log10(distance_m.max(NEAREST_M) * 1e-3)
        + 20.0 * maths::log10(frequency_mhz)
}

/// Loss with the ground reflection, far from the transmitter, in dB: `40 lg(m) - 20 lg(h h')`.
pub(crate) fn two_ray_db(distance_m: f64, height_m: f64, other_m: f64) -> f64 {
    40.0 * maths::log10(distance_m.max(NEAREST_M)) - 20.0 * maths::log10(height_m * other_m)
}

/// The distance over which [`free_space_db`] and [`two_ray_db`] both stay within a budget, in metres.
pub(super) fn reach_m(budget_db: f64, frequency_mhz: f64, height_m: f64, other_m: f64) -> f64 {
    let free_m = maths::powf(
        10f64,
        (budget_db - FREE_SPACE_DB - 20.0 * maths::log10(frequency_mhz)) / 20.0,
    ) * 1e3;
    let heights = maths::log10(height_m * other_m);
    let two_ray_m = maths::powf(10f64, (budget_db + 20.0 * heights) / 40.0);
    free_m.min(two_ray_m)
}

impl Radio {
    /// The loss budget between two antennas in dB.
    pub(crate) fn budget_db(&self, gain_dbi: f64, other_dbi: f64) -> f64 {
        self.power_dbm + gain_dbi + other_dbi - self.losses_db - self.sensitivity_dbm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signal_reaches_as_far_as_its_loss_says() {
        for frequency_mhz in [433.0, 915.0, 2400.0, 5800.0] {
            for height_m in [0.3, 2.0, 30.0, 120.0] {
                for budget_db in (70..160).step_by(5).map(f64::from) {
                    let far_m = reach_m(budget_db, frequency_mhz, height_m, GROUND_ANTENNA_M);
                    if far_m < NEAREST_M {
                        continue;
                    }
                    let lost_db = free_space_db(far_m, frequency_mhz).max(two_ray_db(
                        far_m,
                        height_m,
                        GROUND_ANTENNA_M,
                    ));
                    assert!(
                        (lost_db - budget_db).abs() < 1e-9,
                        "{lost_db} of {budget_db} dB"
                    );
                }
            }
        }
    }
}
