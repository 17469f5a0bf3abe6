//! The checks before arming, in the order in which `ArduCopter` makes them.

use std::time::Duration;

use crate::boot::Boot;
use crate::estimator::{Estimator, Faults};
use crate::failsafe::{Failsafe, FailsafeRules};
use crate::mode::{self, Mode};
use crate::parameters::Parameters;

/// The time between reports of the reasons against arming.
pub(super) const REPORT_EVERY: Duration = Duration::from_secs(30);
/// The delay of a report of new reasons, after the last report.
pub(super) const REPORT_SOON: Duration = Duration::from_secs(4);
/// The time between checks, in steps.
pub(crate) const LOOK_STEPS: u64 = 100;
/// The margin required between the lowest throttle of a calibrated remote control and `FS_THR_VALUE`.
const THROTTLE_MARGIN_US: f64 = 10.0;
const LOSS_OF_SIGNAL_US: f64 = 910.0;
/// A throttle stick above this would lift a vehicle in a piloted mode, in microseconds.
const CLIMB_US: u16 = 1600;

/// The checks before arming, each a bit of `ARMING_CHECK`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Check {
    Barometer = 1 << 1,
    Compass = 1 << 2,
    Gps = 1 << 3,
    Inertial = 1 << 4,
    Parameters = 1 << 5,
    Radio = 1 << 6,
    Voltage = 1 << 7,
    Battery = 1 << 8,
}

/// The selected checks, and parameters whose own values are checked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ArmingRules {
    checks: u32,
    throttle_min_us: f64,
    angle_max_cdeg: f64,
    pilot_up_cm_s: f64,
    station_failsafe: i32,
}

impl ArmingRules {
    pub(crate) fn read(all: &Parameters) -> Self {
        Self {
            checks: all.value("ARMING_CHECK") as i64 as u32,
            throttle_min_us: all.value("RC3_MIN"),
            angle_max_cdeg: all.value("ANGLE_MAX"),
            pilot_up_cm_s: all.value("PILOT_SPEED_UP"),
            station_failsafe: all.value("FS_GCS_ENABLE") as i32,
        }
    }

    /// Whether all optional checks are off.
    pub(crate) fn is_off(&self) -> bool {
        self.checks == 0
    }

    /// Whether a check is selected; bit 0 selects all.
    fn has(&self, check: Check) -> bool {
        self.checks & (1 | check as u32) != 0
    }
}

/// The inputs of the checks.
pub(crate) struct ArmingChecks<'a> {
    pub(crate) rules: &'a ArmingRules,
    pub(crate) failsafe_rules: &'a FailsafeRules,
    pub(crate) faults: &'a Faults,
    pub(crate) boot: &'a Boot,
    pub(crate) estimator: &'a Estimator,
    pub(crate) failsafe: &'a Failsafe,
    pub(crate) mode: &'a Mode,
    pub(crate) has_home: bool,
    /// The throttle received from the remote control, and the stick itself, in microseconds.
    pub(crate) received_throttle_us: f64,
    pub(crate) throttle_us: u16,
    /// The reasons against arming from the battery, the bench and the fence.
    pub(crate) battery: Option<&'static str>,
    pub(crate) workbench: Vec<&'static str>,
    pub(crate) fence: Option<&'static str>,
}

impl ArmingChecks<'_> {
    /// The reasons against arming now; empty if there are none.
    pub(crate) fn obstacles(&self) -> Vec<&'static str> {
        if self.rules.is_off() {
            return self.mandatory_obstacles();
        }
        let mut reasons = self.parameter_obstacles();
        if !self.boot.is_over() {
            reasons.extend(self.boot.obstacles(self.mode, self.has_home));
        }
        self.sensor_obstacles(&mut reasons);
        self.power_obstacles(&mut reasons);
        reasons.extend(&self.workbench);
        reasons.extend(self.fence);
        reasons
    }

    /// The checks that cannot be switched off.
    pub(crate) fn mandatory_obstacles(&self) -> Vec<&'static str> {
        let mut reasons: Vec<_> = self
            .boot
            .reference_obstacle(self.mode)
            .into_iter()
            .collect();
        if self.boot.is_over() {
            reasons.extend(self.estimate_obstacle());
        }
        reasons
    }

    /// Checks made only when all others pass and arming was requested.
    pub(crate) fn last_obstacles(&self) -> Vec<&'static str> {
        let by_itself = matches!(
            self.mode.number,
            mode::GUIDED | mode::GUIDED_NOGPS | mode::AUTO
        );
        let high = self.throttle_us > CLIMB_US;
        if self.rules.has(Check::Radio) && high && !by_itself {
            vec!["Throttle too high"]
        } else {
            Vec::new()
        }
    }

    fn parameter_obstacles(&self) -> Vec<&'static str> {
        let rules = self.rules;
        let failsafes = self.failsafe_rules;
        let mut reasons = Vec::new();
        if rules.has(Check::Parameters) {
            let low_us = failsafes.radio_low_us;
            let margin = rules.throttle_min_us <= low_us + THROTTLE_MARGIN_US;
            let first = if failsafes.radio != 0 && (margin || low_us < LOSS_OF_SIGNAL_US) {
                Some("Check FS_THR_VALUE")
            } else if !(1000.0..=8000.0).contains(&rules.angle_max_cdeg) {
                Some("Check ANGLE_MAX")
            } else if rules.pilot_up_cm_s <= 0.0 {
                Some("Check PILOT_SPEED_UP")
            } else {
                None
            };
            if rules.station_failsafe == 2 {
                reasons.push("FS_GCS_ENABLE=2 removed, see FS_OPTIONS");
            }
            reasons.extend(first);
        }
        if self.failsafe.station_is_lost() {
            reasons.push("GCS failsafe on");
        }
        if rules.has(Check::Radio)
            && failsafes.radio != 0
            && self.received_throttle_us < failsafes.radio_low_us
        {
            reasons.push("Throttle below failsafe");
        }
        reasons
    }

    fn sensor_obstacles(&self, reasons: &mut Vec<&'static str>) {
        let rules = self.rules;
        let faults = self.faults;
        let barometers_off = faults.barometers.iter().any(|barometer| barometer.disabled);
        if rules.has(Check::Barometer) && barometers_off {
            reasons.push("Baro: not healthy");
        }
        if rules.has(Check::Inertial) {
            if faults.gyro_failed {
                reasons.push("Gyros not healthy");
            }
            if faults.accelerometer_failed {
                reasons.push("Accels not healthy");
            } else if faults.has_stuck_accelerometer() {
                reasons.push("Accels inconsistent");
            }
        }
        if rules.has(Check::Compass) && !self.estimator.compass_is_healthy() {
            reasons.push("Compass not healthy");
        }
        if self.boot.is_over() {
            reasons.extend(self.gps_obstacle());
        }
    }

    fn gps_obstacle(&self) -> Option<&'static str> {
        if !self.mode.needs_position() {
            return None;
        }
        if self.rules.has(Check::Gps) && self.estimator.fix().is_some_and(|fix| !fix.is_locked()) {
            return Some("GPS 1: Bad fix");
        }
        self.estimate_obstacle()
    }

    /// The check of the estimate, needed in modes that depend on it.
    fn estimate_obstacle(&self) -> Option<&'static str> {
        if !self.mode.needs_position() {
            return None;
        }
        if !self.estimator.has_position() {
            return Some("Need Position Estimate");
        }
        if self.estimator.is_glitching() {
            return Some("GPS glitching");
        }
        let threshold = self.failsafe_rules.ekf_threshold;
        let ratios = self.estimator.ratios();
        let over = |ratio: f64| threshold > 0.0 && ratio >= threshold;
        if over(ratios.compass) {
            Some("EKF compass variance")
        } else if over(ratios.position) {
            Some("EKF position variance")
        } else if over(ratios.velocity) {
            Some("EKF velocity variance")
        } else if over(ratios.height) {
            Some("EKF height variance")
        } else {
            None
        }
    }

    fn power_obstacles(&self, reasons: &mut Vec<&'static str>) {
        let rules = self.rules;
        if rules.has(Check::Battery) {
            reasons.extend(self.battery);
        }
        if self.failsafe.radio_is_lost() {
            reasons.push("Radio failsafe on");
        }
        if rules.has(Check::Voltage) && self.failsafe.battery_is_down() {
            reasons.push("Battery failsafe");
        }
    }
}
