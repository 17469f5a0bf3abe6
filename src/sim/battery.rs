//! The battery of a default SITL: a voltage that never sags, and a current that follows the throttle.

use super::body::STEP_S;

/// Amperes at full throttle: a hover at 36 % draws 28.1 A.
const AMPERES_AT_FULL_THROTTLE: f64 = 78.0;

/// Current and what was drawn so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Battery {
    pub(super) current_a: f64,
    pub(super) consumed_mah: f64,
    /// Energy drawn, in watt hours.
    pub(super) consumed_wh: f64,
}

impl Battery {
    /// Draws current for one step.
    pub(super) fn step(&mut self, throttle: f64, voltage_v: f64) {
        if throttle <= 0.0 {
            self.current_a = 0.0;
            return;
        }
        self.current_a = throttle * AMPERES_AT_FULL_THROTTLE;
        let ampere_hours = self.current_a * (STEP_S / 3600.0);
        self.consumed_mah += ampere_hours * 1000.0;
        self.consumed_wh += ampere_hours * voltage_v;
    }

    /// What is left of a capacity, in percent.
    pub(super) fn remaining_percent(&self, capacity_mah: f64) -> i8 {
        (100.0 * (1.0 - self.consumed_mah / capacity_mah)).clamp(0.0, 100.0) as i8
    }
}
