//! The default drone: SITL's default multirotor with a battery that runs down.

use std::sync::Arc;

use serde_json::json;

use super::{Airframe, Figures, layout};

/// The capacity of a three-cell lithium polymer pack, in ampere hours. SITL's default has no limit
/// and would hover forever.
const CAPACITY_AH: f64 = 4.0;
/// Volts under load at which the battery is low and critical. The voltage of SITL's cells sags more
/// than that of most: under the hover's 35 A they reach these voltages at about 20 and 10 % of the
/// charge, so voltage and charge agree.
const LOW_V: f64 = 9.9;
const CRITICAL_V: f64 = 9.3;
/// The shares of the charge to which these voltages correspond.
const LOW: f64 = 0.2;
const CRITICAL: f64 = 0.1;
/// `FailsafeAction`: return to launch, and land.
const RETURN: f64 = 2.0;
const LAND: f64 = 1.0;

impl Airframe {
    /// SITL's default multirotor with a number of motors and a battery of 4 Ah. With a low battery the vehicle
    /// returns, with a critical one it lands. Both simulators use it by default.
    pub fn standard(motors: usize) -> Self {
        let usual = Figures::default();
        let figures = Figures {
            battery_capacity_ah: CAPACITY_AH,
            motors: layout::standard(motors, usual.diagonal_m),
            ..usual
        };
        let capacity_mah = CAPACITY_AH * 1000.0;
        Self {
            file: Some(json!({ "battCapacityAh": CAPACITY_AH, "num_motors": motors })),
            parameters: vec![
                ("BATT_CAPACITY", capacity_mah),
                ("BATT_LOW_VOLT", LOW_V),
                ("BATT_CRT_VOLT", CRITICAL_V),
                ("BATT_LOW_MAH", capacity_mah * LOW),
                ("BATT_CRT_MAH", capacity_mah * CRITICAL),
                ("BATT_FS_LOW_ACT", RETURN),
                ("BATT_FS_CRT_ACT", LAND),
            ],
            ..Self::derived(figures)
        }
    }

    /// [`Airframe::standard`] with four motors, to share.
    pub fn shared_standard() -> Arc<Self> {
        Arc::new(Self::standard(4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_that_sitl_gets_describes_the_same_drone() {
        for motors in layout::COUNTS {
            let standard = Airframe::standard(motors);
            let text = standard.file().expect("it has one").to_string();
            let (read, warnings) = Airframe::from_json(&text).expect("it is valid");
            assert_eq!((read.figures, warnings), (standard.figures, Vec::new()));
        }
    }
}
