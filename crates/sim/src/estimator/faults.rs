//! Sensor faults: the `SIM_*` parameters.

use std::time::Duration;

use glam::DVec3;

use crate::parameters::Parameters;

/// The default hard-iron offset of each simulated compass (`SIM_MAGn_OFS_*`), in milligauss.
const COMPASS_OFFSET_MGAUSS: DVec3 = DVec3::new(5.0, 13.0, -18.0);
/// Gyros that differ by more than this, in radians per second, are inconsistent.
const GYROS_AGREE_RAD_S: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Bits of `SIM_ACC_FAIL_MSK` and `SIM_GYR_FAIL_MSK`: the first sensor.
const FIRST: u8 = 1;

/// Why the autopilot does not use its GPS receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GpsUnused {
    /// No receiver is configured (`GPS1_TYPE` 0).
    Absent,
    /// A switch of the remote control has turned it off.
    SwitchedOff,
}

/// The GPS receiver (`SIM_GPS_*`).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GpsFault {
    pub(crate) disabled: bool,
    /// Why the autopilot does not use a working receiver; `None` if it uses the receiver.
    pub(crate) unused: Option<GpsUnused>,
    pub(crate) jammed: bool,
    /// Degrees north, degrees east, metres up.
    pub(crate) glitch: DVec3,
    pub(crate) satellites: u8,
    /// The error of its altitude, in metres up.
    pub(crate) altitude_offset_m: f64,
    pub(crate) altitude_noise_m: f64,
    /// The time since boot before which there is no position.
    pub(crate) lock_after: Duration,
    pub(crate) period: Duration,
    pub(crate) lag: Duration,
}

/// One barometer (`SIM_BARO_*`, `SIM_BAR2_*`).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BarometerFault {
    pub(crate) disabled: bool,
    pub(crate) frozen: bool,
    /// The barometer's error, in metres up.
    pub(crate) glitch_m: f64,
    pub(crate) drift_m_s: f64,
    /// The greatest random error of one reading, in metres.
    pub(crate) noise_m: f64,
}

/// The remote control receiver's output (`SIM_RC_FAIL`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RadioFault {
    Fine,
    /// The receiver sends no pulses.
    Silent,
    /// The receiver sends a throttle of 950 µs, which indicates a lost transmitter.
    Low,
}

/// All faults of a vehicle's sensors.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Faults {
    pub(crate) gps: GpsFault,
    pub(crate) barometers: [BarometerFault; 2],
    pub(crate) compasses_failed: [bool; 3],
    /// The error of each compass beyond its calibration, in milligauss.
    pub(crate) compass_errors_mgauss: [f64; 3],
    /// A constant that an accelerometer reports on all axes; 0 if it works.
    pub(crate) accelerometers_stuck_m_s2: [f64; 2],
    pub(crate) accelerometer_failed: bool,
    pub(crate) gyro_failed: bool,
    /// Whether the first two accelerometers, and the first two gyros, differ by more than arming tolerates.
    pub(crate) inertial_differences: [bool; 2],
    pub(crate) radio: RadioFault,
    /// Simulated seconds per second (`SIM_SPEEDUP`).
    pub(crate) speedup: f64,
    /// Whether any fault affects the estimator.
    pub(crate) any: bool,
}

impl Faults {
    /// Reads the parameters. Unreasonable values are limited to the range that the arithmetic
    /// allows.
    pub(crate) fn read(all: &Parameters) -> Self {
        let on = |name| all.value(name) != 0.0;
        let mut faults = Self {
            gps: GpsFault::read(all),
            barometers: ["SIM_BARO", "SIM_BAR2"].map(|stem| BarometerFault::read(all, stem)),
            compasses_failed: ["SIM_MAG1_FAIL", "SIM_MAG2_FAIL", "SIM_MAG3_FAIL"].map(on),
            compass_errors_mgauss: ["SIM_MAG1_OFS", "SIM_MAG2_OFS", "SIM_MAG3_OFS"]
                .map(|stem| compass_error(all, stem)),
            accelerometers_stuck_m_s2: ["SIM_ACCEL1_FAIL", "SIM_ACCEL2_FAIL"]
                .map(|name| all.value(name).clamp(-200.0, 200.0)),
            accelerometer_failed: all.value("SIM_ACC_FAIL_MSK") as u8 & FIRST != 0,
            gyro_failed: all.value("SIM_GYR_FAIL_MSK") as u8 & FIRST != 0,
            inertial_differences: inertial_differences(all),
            radio: match all.value("SIM_RC_FAIL") as i32 {
                1 => RadioFault::Silent,
                2 => RadioFault::Low,
                _ => RadioFault::Fine,
            },
            speedup: all.value("SIM_SPEEDUP"),
            any: false,
        };
        faults.any = faults.gps.is_faulty()
            || faults.barometers.iter().any(BarometerFault::is_faulty)
            // The second barometer always has a little noise, which counts if the first is disabled.
            || faults.barometers[0].noise_m != 0.0
            || faults.compasses_failed.contains(&true)
            || faults.compass_errors_mgauss.iter().any(|off| *off > 1.0)
            || faults.has_stuck_accelerometer();
        faults
    }

    /// Disables the GPS if `off`, the setting of a switch of the remote control, is true.
    pub(crate) fn switch_gps(&mut self, off: bool) {
        if off && !self.gps.disabled {
            self.gps.unused = Some(GpsUnused::SwitchedOff);
        }
        self.gps.disabled |= off;
        self.any |= off;
    }

    /// Whether an accelerometer reports a constant.
    pub(crate) fn has_stuck_accelerometer(&self) -> bool {
        self.accelerometers_stuck_m_s2
            .iter()
            .any(|stuck| *stuck != 0.0)
    }
}

impl GpsFault {
    fn read(all: &Parameters) -> Self {
        let glitch = DVec3::new(
            all.value("SIM_GPS_GLITCH_X").clamp(-90.0, 90.0),
            all.value("SIM_GPS_GLITCH_Y").clamp(-90.0, 90.0),
            all.value("SIM_GPS_GLITCH_Z").clamp(-1e5, 1e5),
        );
        let period = Duration::from_secs_f64(1.0 / all.value("SIM_GPS_HZ").clamp(1.0, 20.0));
        let lag_ms = all.value("SIM_GPS_LAG_MS").clamp(0.0, 1000.0);
        let absent = all.value("GPS1_TYPE") == 0.0;
        Self {
            disabled: all.value("SIM_GPS_DISABLE") != 0.0 || absent,
            unused: absent.then_some(GpsUnused::Absent),
            // Only the value 1 jams.
            jammed: (all.value("SIM_GPS_JAM") - 1.0).abs() < 0.5,
            glitch,
            satellites: all.value("SIM_GPS_NUMSATS").clamp(0.0, 255.0) as u8,
            altitude_offset_m: all.value("SIM_GPS_ALT_OFS"),
            altitude_noise_m: all.value("SIM_GPS_NOISE").clamp(0.0, 1e4),
            lock_after: Duration::from_secs_f64(all.value("SIM_GPS_LOCKTIME").clamp(0.0, 1e5)),
            period,
            lag: Duration::from_secs_f64(lag_ms * 1e-3).min(period),
        }
    }

    fn is_faulty(&self) -> bool {
        let untrue = self.altitude_offset_m != 0.0 || self.altitude_noise_m != 0.0;
        self.disabled || self.jammed || untrue || self.glitch != DVec3::ZERO
    }
}

impl BarometerFault {
    fn read(all: &Parameters, stem: &str) -> Self {
        let value = |what: &str| all.value(&format!("{stem}_{what}"));
        Self {
            disabled: value("DISABLE") != 0.0,
            frozen: (value("FREEZE") - 1.0).abs() < 0.5,
            glitch_m: value("GLITCH").clamp(-1e4, 1e4),
            drift_m_s: value("DRIFT").clamp(-100.0, 100.0),
            noise_m: value("RND").clamp(-1e3, 1e3),
        }
    }

    fn is_faulty(&self) -> bool {
        self.disabled || self.frozen || self.glitch_m != 0.0 || self.drift_m_s != 0.0
    }
}

/// Whether the first two accelerometers differ by more than `ARMING_ACCTHRESH`, and the first two gyros by more than 5
/// degrees per second.
fn inertial_differences(all: &Parameters) -> [bool; 2] {
    let bias = |sensor: &str, axis: &str| all.value(&format!("SIM_{sensor}_BIAS_{axis}"));
    let difference = |first: &str, second: &str| {
        DVec3::from_array(["X", "Y", "Z"].map(|axis| bias(first, axis) - bias(second, axis)))
    };
    // The vertical axis counts half.
    let accelerometers = difference("ACC1", "ACC2") * DVec3::new(1.0, 1.0, 0.5);
    let gyros = difference("GYR1", "GYR2");
    [
        accelerometers.length() > all.value("ARMING_ACCTHRESH"),
        gyros.length() > GYROS_AGREE_RAD_S,
    ]
}

fn compass_error(all: &Parameters, stem: &str) -> f64 {
    let axis = |name: &str| all.value(&format!("{stem}_{name}"));
    let offset = DVec3::new(axis("X"), axis("Y"), axis("Z"));
    (offset - COMPASS_OFFSET_MGAUSS).length().min(1e4)
}
