//! The battery, after `ArduPilot`'s `SIM_Battery`. The resting voltage follows a lithium polymer curve, and the load
//! reduces it. Without a capacity, the battery never runs down.

use super::airframe::Airframe;
use super::kinematics::STEP_S;

/// Volts of a cell at rest, and the charge that is left, in percent.
const CELL: [(f64, f64); 40] = [
    (4.173, 100.0),
    (4.112, 96.15),
    (4.085, 92.31),
    (4.071, 88.46),
    (4.039, 84.62),
    (3.987, 80.77),
    (3.943, 76.92),
    (3.908, 73.08),
    (3.887, 69.23),
    (3.854, 65.38),
    (3.833, 61.54),
    (3.801, 57.69),
    (3.783, 53.85),
    (3.742, 50.0),
    (3.715, 46.15),
    (3.679, 42.31),
    (3.636, 38.46),
    (3.588, 34.62),
    (3.543, 30.77),
    (3.503, 26.92),
    (3.462, 23.08),
    (3.379, 19.23),
    (3.296, 15.38),
    (3.218, 11.54),
    (3.165, 7.69),
    (3.091, 3.85),
    (2.977, 2.0),
    (2.8, 1.5),
    (2.7, 1.3),
    (2.5, 1.2),
    (2.3, 1.1),
    (2.1, 1.0),
    (1.9, 0.9),
    (1.6, 0.8),
    (1.3, 0.7),
    (1.0, 0.6),
    (0.6, 0.4),
    (0.3, 0.2),
    (0.01, 0.01),
    (0.001, 0.001),
];
const CELL_FULL_V: f64 = CELL[0].0;
/// The cutoff frequency of the voltage filter, in hertz.
const FILTER_HZ: f64 = 10.0;

/// Charge, voltage and current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Battery {
    pub(super) voltage_v: f64,
    pub(super) current_a: f64,
    pub(super) consumed_mah: f64,
    /// Energy drawn, in watt hours.
    pub(super) consumed_wh: f64,
    left_ah: f64,
    /// The `SIM_BATT_VOLTAGE` last applied.
    set_v: f64,
}

impl Battery {
    /// A battery charged to a voltage.
    pub(super) fn charged(airframe: &Airframe, voltage_v: f64) -> Self {
        let mut battery = Self {
            voltage_v,
            current_a: 0.0,
            consumed_mah: 0.0,
            consumed_wh: 0.0,
            left_ah: 0.0,
            set_v: voltage_v,
        };
        battery.charge(airframe, voltage_v);
        battery
    }

    /// Draws `power_w` for one step. A change of `set_v` (`SIM_BATT_VOLTAGE`) charges or drains the
    /// battery at once.
    /// The voltage of a battery with unlimited charge under a load that costs `drop_v`.
    pub(super) fn sag(&mut self, drop_v: f64, airframe: &Airframe) {
        if airframe.battery_capacity_ah() <= 0.0 {
            self.voltage_v = self.set_v - drop_v;
        }
    }

    pub(super) fn step(&mut self, power_w: f64, set_v: f64, airframe: &Airframe) {
        if (set_v - self.set_v).abs() > 1e-6 {
            self.charge(airframe, set_v);
        }
        self.current_a = power_w / self.voltage_v.max(0.1);
        let capacity_ah = airframe.battery_capacity_ah();
        if power_w > 0.0 {
            let drawn_ah = self.current_a * (STEP_S / 3600.0);
            self.consumed_mah += drawn_ah * 1000.0;
            self.consumed_wh += drawn_ah * self.voltage_v;
            self.left_ah = (self.left_ah - drawn_ah).max(0.0);
        } else if capacity_ah <= 0.0 {
            return;
        }
        if capacity_ah > 0.0 {
            let resting_v = resting_voltage_v(100.0 * self.left_ah / capacity_ah, airframe);
            let loaded_v = resting_v - self.current_a * airframe.battery_resistance_ohm();
            let blend = STEP_S / (STEP_S + 1.0 / (std::f64::consts::TAU * FILTER_HZ));
            self.voltage_v = (self.voltage_v + (loaded_v - self.voltage_v) * blend).max(0.0);
        }
    }

    /// The share of the full voltage.
    pub(super) fn voltage_share(&self, airframe: &Airframe) -> f64 {
        self.voltage_v / airframe.full_voltage_v()
    }

    /// The remaining share of a capacity, in percent.
    pub(super) fn remaining_percent(&self, capacity_mah: f64) -> i8 {
        (100.0 * (1.0 - self.consumed_mah / capacity_mah)).clamp(0.0, 100.0) as i8
    }

    fn charge(&mut self, airframe: &Airframe, voltage_v: f64) {
        self.set_v = voltage_v;
        self.voltage_v = voltage_v;
        let cell_v = voltage_v / airframe.full_voltage_v() * CELL_FULL_V;
        self.left_ah = airframe.battery_capacity_ah() * charge_percent(cell_v) * 0.01;
    }
}

/// The voltage of an airframe's battery at a charge in percent, without load, in volts: the `SIM_BATT_VOLTAGE` that gives
/// the battery this charge.
pub fn resting_voltage_v(charge_percent: f64, airframe: &Airframe) -> f64 {
    let cell_v = between(
        charge_percent,
        CELL.iter().map(|&(volts, charge)| (charge, volts)),
    );
    airframe.full_voltage_v() * cell_v.unwrap_or(0.001) / CELL_FULL_V
}

/// The charge of a cell at this resting voltage, in percent.
fn charge_percent(cell_v: f64) -> f64 {
    between(cell_v, CELL.iter().copied())
        .unwrap_or(0.0)
        .min(100.0)
}

/// Interpolates a table with falling values; `None` below its end.
fn between(at: f64, table: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let mut above: Option<(f64, f64)> = None;
    for (place, value) in table {
        if let Some((place_above, value_above)) = above.filter(|_| at >= place) {
            let share = (at - place) / (place_above - place);
            return Some(value + share * (value_above - value));
        }
        above = Some((place, value));
    }
    None
}

#[cfg(test)]
mod tests;
