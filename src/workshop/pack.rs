//! The battery of a design under load.

use super::design::Drive;
use super::part::{Battery, Chemistry};

/// Resting voltage of a lithium polymer cell, by charge in percent.
const POLYMER: [(f64, f64); 14] = [
    (0.0, 3.0),
    (5.0, 3.45),
    (10.0, 3.6),
    (15.0, 3.66),
    (20.0, 3.7),
    (30.0, 3.75),
    (40.0, 3.79),
    (50.0, 3.83),
    (60.0, 3.87),
    (70.0, 3.92),
    (80.0, 3.98),
    (90.0, 4.06),
    (95.0, 4.13),
    (100.0, 4.2),
];
/// Resting voltage of a lithium ion cell, by charge in percent. `ArduPilot`'s `SIM_Battery` has one
/// curve for all cells, so the simulators' voltage differs slightly from this one between full and
/// empty; the energy, which determines the endurance, differs by less than 4 %.
const ION: [(f64, f64); 12] = [
    (0.0, 2.5),
    (5.0, 3.0),
    (10.0, 3.18),
    (20.0, 3.36),
    (30.0, 3.48),
    (40.0, 3.57),
    (50.0, 3.65),
    (60.0, 3.74),
    (70.0, 3.83),
    (80.0, 3.92),
    (90.0, 4.02),
    (100.0, 4.15),
];
/// Capacity by temperature: degrees Celsius, and shares of the nominal capacity; typical of lithium
/// polymer packs.
const CAPACITY: [(f64, f64); 5] = [
    (-20.0, 0.60),
    (-10.0, 0.75),
    (0.0, 0.87),
    (10.0, 0.95),
    (25.0, 1.0),
];
/// The relative growth of the resistance with each degree below 25 °C.
const COLD_RESISTANCE: f64 = 0.03;
const ROOM_TEMPERATURE_C: f64 = 25.0;
/// A step of the discharge, in percent.
const STEP: f64 = 0.5;

/// All batteries of a drone together, at a temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pack {
    chemistry: Chemistry,
    cells: f64,
    pub capacity_ah: f64,
    pub resistance_ohm: f64,
    pub max_current_a: f64,
    /// The share of the charge that a flight may use.
    pub usable: f64,
}

/// Voltage and current of a pack at a charge and a power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loaded {
    pub volts: f64,
    pub amperes: f64,
}

impl Pack {
    pub fn of(drive: &Drive<'_>, temperature_c: f64) -> Self {
        Self::of_cells(drive.battery, drive.packs, temperature_c)
    }

    /// Packs of a kind in parallel.
    pub fn of_cells(battery: &Battery, packs: u8, temperature_c: f64) -> Self {
        let packs = f64::from(packs);
        let cells = f64::from(battery.cells);
        let cold = 1.0 + COLD_RESISTANCE * (ROOM_TEMPERATURE_C - temperature_c).max(0.0);
        Self {
            chemistry: battery.chemistry,
            cells,
            capacity_ah: battery.capacity_ah * packs * interpolated(&CAPACITY, temperature_c),
            resistance_ohm: cells * (battery.cell_resistance_mohm * 1e-3) * cold / packs,
            max_current_a: battery.c_rate * battery.capacity_ah * packs,
            usable: match battery.chemistry {
                Chemistry::Polymer => 0.80,
                Chemistry::Ion => 0.90,
            },
        }
    }

    /// The voltage at rest with a full charge.
    pub fn full_v(&self) -> f64 {
        self.resting_v(100.0)
    }

    /// The energy at nominal voltage (3.7 V per cell), in watt hours.
    pub fn energy_wh(&self) -> f64 {
        self.cells * 3.7 * self.capacity_ah
    }

    /// The voltage and current under a power at a charge in percent; `None` if the voltage breaks
    /// down: no current gives this power.
    pub fn loaded(&self, charge: f64, power_w: f64) -> Option<Loaded> {
        let resting = self.resting_v(charge);
        let root = resting * resting - 4.0 * self.resistance_ohm * power_w;
        if root <= 0.0 {
            return None;
        }
        let amperes = (resting - root.sqrt()) / (2.0 * self.resistance_ohm);
        Some(Loaded {
            volts: resting - amperes * self.resistance_ohm,
            amperes,
        })
    }

    /// How long a full pack supplies a power, in seconds, and the charge at the end, in percent.
    /// The end is reached when `share` of the charge is used, or when the voltage falls below
    /// `needed_v`.
    pub fn lasts(&self, power_w: f64, share: f64, needed_v: f64) -> (f64, f64) {
        let (mut charge, mut time_s) = (100.0, 0.0);
        while charge > 100.0 * (1.0 - share) {
            let loaded = self.loaded(charge, power_w);
            let Some(loaded) = loaded.filter(|loaded| loaded.volts >= needed_v) else {
                break;
            };
            time_s += self.capacity_ah * 3600.0 * STEP * 0.01 / loaded.amperes;
            charge -= STEP;
        }
        (time_s, charge)
    }

    fn resting_v(&self, charge: f64) -> f64 {
        let curve: &[(f64, f64)] = match self.chemistry {
            Chemistry::Polymer => &POLYMER,
            Chemistry::Ion => &ION,
        };
        self.cells * interpolated(curve, charge)
    }
}

/// A value between the points of a table with rising arguments; outside the table, the value at its end.
fn interpolated(table: &[(f64, f64)], at: f64) -> f64 {
    let (Some(first), Some(last)) = (table.first(), table.last()) else {
        return 0.0;
    };
    let at = at.clamp(first.0, last.0);
    table
        .windows(2)
        .find(|pair| at <= pair[1].0)
        .map_or(last.1, |pair| {
            let ((from, low), (to, high)) = (pair[0], pair[1]);
            low + (high - low) * (at - from) / (to - from)
        })
}
