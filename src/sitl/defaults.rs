//! The parameters that a new vehicle needs before it can be armed.
//!
//! Tested with the copter, plane, rover and sub of `ArduPilot` 4.6: with these parameters, each
//! arms in GUIDED (a sub in MANUAL) as soon as it has a position. A version silently ignores
//! parameters that it does not have.

use super::SitlKind;
use crate::sim::{Airframe, Chassis, VehicleKind};

/// Pulses of the radio and of the throttle's output, in microseconds.
const PULSE_US: [(&str, f64); 3] = [("MIN", 1000.0), ("MAX", 2000.0), ("TRIM", 1500.0)];
const CELL_FULL_V: f64 = 4.2;
/// The limits of a vehicle's `DataFlash` logs: a new one takes the place of the oldest, and none is written if the disk is
/// nearly full.
const LOGS: [(&str, f64); 2] = [("LOG_MAX_FILES", 20.0), ("LOG_FILE_MB_FREE", 1000.0)];
/// The cell voltage at which a pack under load counts as low.
const CELL_LOW_V: f64 = 3.5;
/// The voltages over which the thrust is kept constant, as shares of the full battery: 9.6 and 12.8 V of three cells.
const COMPENSATED: (f64, f64) = (9.6 / 12.6, 12.8 / 12.6);

/// Lever arm times hover throttle of the default quad, whose gains are the autopilot's defaults.
const USUAL_AUTHORITY: f64 = 0.35 * 0.39;

/// The start parameters of every vehicle of a kind: calibrations that are not all zero, and
/// settings of the kind, which for a copter match the embedded simulator.
pub(super) fn of(kind: SitlKind) -> Vec<(String, f64)> {
    let mut all = vec![("BATT_MONITOR".to_owned(), 4.0)];
    let logs = LOGS.map(|(name, value)| (name.to_owned(), value));
    all.extend(logs);
    for compass in ["", "2", "3"] {
        for (axis, offset) in [("X", 5.0), ("Y", 13.0), ("Z", -18.0)] {
            all.push((format!("COMPASS_OFS{compass}_{axis}"), offset));
        }
    }
    for sensor in ["", "2"] {
        for axis in ["X", "Y", "Z"] {
            all.push((format!("INS_ACC{sensor}OFFS_{axis}"), 0.001));
            all.push((format!("INS_ACC{sensor}SCAL_{axis}"), 1.001));
        }
    }
    for channel in 1..=8 {
        let pulses = PULSE_US.map(|(end, pulse_us)| (format!("RC{channel}_{end}"), pulse_us));
        all.extend(pulses);
    }
    let own = own(kind).iter();
    all.extend(own.map(|&(name, value)| (name.to_owned(), value)));
    all
}

fn own(kind: SitlKind) -> &'static [(&'static str, f64)] {
    match kind {
        SitlKind::Copter => &[
            ("ATC_RAT_YAW_P", 0.3),
            ("ATC_RAT_YAW_I", 0.02),
            ("FENCE_RADIUS", 150.0),
            ("FS_THR_ENABLE", 1.0),
            ("SIM_BARO_RND", 0.0),
            // The rate of a copter's control loop. SITL subtracts the charge of each step of its physics in 32-bit
            // numbers: with its 1200 steps a second, rounding changes the endurance of large batteries by up to 8 %.
            ("SIM_RATE_HZ", 400.0),
        ],
        // The trim of a throttle is at its lower end. Without its airspeed sensor, the model ignores commanded speeds;
        // it flies at 22 m/s.
        SitlKind::Plane => &[
            ("ARSPD_USE", 1.0),
            ("AIRSPEED_CRUISE", 22.0),
            ("AIRSPEED_MIN", 10.0),
            ("AIRSPEED_MAX", 30.0),
            ("TRIM_THROTTLE", 50.0),
            ("WP_LOITER_RAD", 80.0),
            ("RC3_TRIM", 1000.0),
            ("SERVO3_MIN", 1000.0),
            ("SERVO3_MAX", 2000.0),
        ],
        // A rover has the settings of its model.
        SitlKind::Rover | SitlKind::Sub => &[],
    }
}

/// The settings that a model of a rover or boat needs to drive as in the embedded simulator; models that the simulator
/// lacks get those of `rover`. Empty for other vehicles.
pub(super) fn of_model(kind: SitlKind, model: &str) -> Vec<(String, f64)> {
    if kind != SitlKind::Rover {
        return Vec::new();
    }
    let embedded = VehicleKind::named(model).unwrap_or(VehicleKind::Rover(Chassis::Ackermann));
    let own = embedded.own_parameters().into_iter();
    // By their decimals, so that 0.1 stays 0.1.
    own.filter_map(|(name, value)| Some((name.to_owned(), value.to_string().parse().ok()?)))
        .collect()
}

/// The settings for a multirotor's airframe: its battery, the thrust of its motors, and gains for their torque.
pub(super) fn of_airframe(airframe: &Airframe) -> Vec<(String, f64)> {
    let full_v = airframe.full_voltage_v();
    let mut all = vec![
        ("MOT_BAT_VOLT_MIN", full_v * COMPENSATED.0),
        ("MOT_BAT_VOLT_MAX", full_v * COMPENSATED.1),
        ("MOT_THST_EXPO", airframe.thrust_expo()),
        (
            "MOT_THST_HOVER",
            airframe.hover_share().clamp(0.125, 0.6875),
        ),
    ];
    let capacity_ah = airframe.battery_capacity_ah();
    if capacity_ah > 0.0 {
        let cells = (full_v / CELL_FULL_V).round().max(1.0);
        all.push(("BATT_CAPACITY", capacity_ah * 1000.0));
        all.push(("BATT_LOW_VOLT", cells * CELL_LOW_V));
    }
    let torque = airframe.diagonal_m() * airframe.hover_share();
    let gain = (torque / USUAL_AUTHORITY).clamp(0.25, 2.0);
    for axis in [
        "ATC_RAT_RLL_P",
        "ATC_RAT_RLL_I",
        "ATC_RAT_PIT_P",
        "ATC_RAT_PIT_I",
    ] {
        all.push((axis, 0.135 * gain));
    }
    for axis in ["ATC_RAT_RLL_D", "ATC_RAT_PIT_D"] {
        all.push((axis, 0.0036 * gain));
    }
    let places = 1e5;
    let rounded = |value: f64| (value * places).round() / places;
    all.into_iter()
        .map(|(name, value)| (name.to_owned(), rounded(value)))
        .collect()
}
