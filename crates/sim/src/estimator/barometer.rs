//! The height estimate from the barometers, and their faults.

use std::time::Duration;

use super::faults::{BarometerFault, Faults};
use crate::kinematics::STEP_S;

/// The time constant with which the estimate follows the barometer, in seconds.
const FOLLOWS_S: f64 = 4.0;
/// The greatest difference that passes the innovation test (10 m gave a ratio of 0.96).
const GATE_M: f64 = 10.4;
/// How long there may be no acceptable height before the estimate jumps to the barometer or reports the loss.
const PATIENCE: Duration = Duration::from_secs(10);

/// The barometer in use and its effects.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Barometer {
    drifted_m: f64,
    /// The height in metres above the start at which the barometer froze.
    frozen_at_m: Option<f64>,
    bad_since: Option<Duration>,
    /// Test ratio of the height.
    pub(super) ratio: f64,
    /// Whether the estimator has been without a height for too long.
    pub(super) lost: bool,
    /// A number from -1 to 1, new for every reading.
    pub(super) random: f64,
    /// The error of the barometer's reading, in metres up.
    pub(super) offset_m: f64,
}

impl Barometer {
    /// Corrects the height estimate's error (metres up); returns whether the correction was a jump.
    pub(super) fn step(
        &mut self,
        now: Duration,
        height_m: f64,
        error_up_m: &mut f64,
        faults: &Faults,
    ) -> bool {
        let Some(used) = faults.barometers.iter().find(|fault| !fault.disabled) else {
            let since = *self.bad_since.get_or_insert(now);
            self.lost = now >= since + PATIENCE;
            return false;
        };
        self.lost = false;
        self.offset_m = self.reading_m(used, height_m) - height_m;
        let innovation_m = self.offset_m - *error_up_m;
        self.ratio = innovation_m.abs() / GATE_M;
        if self.ratio < 1.0 {
            self.bad_since = None;
            *error_up_m += innovation_m * (STEP_S / FOLLOWS_S);
            return false;
        }
        let since = *self.bad_since.get_or_insert(now);
        if now < since + PATIENCE {
            return false;
        }
        self.bad_since = None;
        *error_up_m = self.offset_m;
        true
    }

    /// Whether no fault, drift or loss of height is under way.
    pub(super) fn is_settled(&self) -> bool {
        self.bad_since.is_none() && self.drifted_m == 0.0 && !self.lost
    }

    fn reading_m(&mut self, fault: &BarometerFault, height_m: f64) -> f64 {
        // The drift so far stays until a reboot.
        self.drifted_m += fault.drift_m_s * STEP_S;
        let noise_m = fault.noise_m * self.random;
        let reading_m = height_m + fault.glitch_m + self.drifted_m + noise_m;
        if !fault.frozen {
            self.frozen_at_m = None;
            return reading_m;
        }
        *self.frozen_at_m.get_or_insert(reading_m)
    }
}
