//! The checks before arming, in the order in which `ArduCopter` makes them.

use std::time::Duration;

use super::ArmingMethod;
use super::reason::Reason;
use super::values::ValueChecks;

use crate::boot::Boot;
use crate::cmd;
use crate::estimator::{Estimator, Faults, GpsUnused};
use crate::failsafe::{Failsafe, FailsafeRules, is_over};
use crate::kind::VehicleKind;
use crate::mode::{Mode, ModeId};
use crate::parameters::Parameters;
use crate::plan::Item;

/// The time between reports of the reasons not to arm.
pub(super) const REPORT_EVERY: Duration = Duration::from_secs(30);
/// The delay before new reasons are reported, counted from the last report.
pub(super) const REPORT_SOON: Duration = Duration::from_secs(4);
/// The time between checks, in steps.
pub(crate) const LOOK_STEPS: u64 = 100;
/// The margin required between the lowest throttle of a calibrated remote control and
/// `FS_THR_VALUE`, in microseconds.
const THROTTLE_MARGIN_US: f64 = 10.0;
const LOSS_OF_SIGNAL_US: f64 = 910.0;
/// A throttle stick above this would lift a vehicle in a piloted mode, in microseconds.
const CLIMB_US: u16 = 1600;

/// The dilution of precision that the receiver reports, times 100.
pub(crate) const HDOP: f64 = 121.0;
/// Bits of `ARMING_MIS_ITEMS`, and the items they require.
const MISSION_ITEMS: &[(i32, u16, &str)] = &[
    (1, cmd::NAV_LAND, "land"),
    (1 << 1, cmd::NAV_VTOL_LAND, "vtol land"),
    (1 << 2, cmd::DO_LAND_START, "do land start"),
    (1 << 3, cmd::NAV_TAKEOFF, "takeoff"),
    (1 << 4, cmd::NAV_VTOL_TAKEOFF, "vtol takeoff"),
    (1 << 6, cmd::NAV_RETURN_TO_LAUNCH, "RTL"),
];
const RALLY_ITEM: i32 = 1 << 5;

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
    Mission = 1 << 14,
}

/// The selected checks, and parameters whose own values are checked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ArmingRules {
    checks: u32,
    /// A rover's `WP_SPEED`, its only parameter that is checked; `None` for a copter.
    rover_speed_m_s: Option<f64>,
    throttle_min_us: f64,
    angle_max_cdeg: f64,
    pilot_up_cm_s: f64,
    station_failsafe: i32,
    /// Whether an ACRO balance exceeds its angle gain.
    acro_balance_is_high: bool,
    return_above_terrain: bool,
    has_terrain: bool,
    hdop_max: f64,
    /// The kinds of items that a mission must have (`ARMING_MIS_ITEMS`).
    mission_items: i32,
    values: ValueChecks,
}

impl ArmingRules {
    pub(crate) fn read(all: &Parameters) -> Self {
        Self {
            checks: all.value("ARMING_CHECK") as i64 as u32,
            rover_speed_m_s: (all.kind() != VehicleKind::Copter).then(|| all.value("WP_SPEED")),
            throttle_min_us: all.value("RC3_MIN"),
            angle_max_cdeg: all.value("ANGLE_MAX"),
            pilot_up_cm_s: all.value("PILOT_SPEED_UP"),
            station_failsafe: all.value("FS_GCS_ENABLE") as i32,
            acro_balance_is_high: [
                ("ACRO_BAL_ROLL", "ATC_ANG_RLL_P"),
                ("ACRO_BAL_PITCH", "ATC_ANG_PIT_P"),
            ]
            .iter()
            .any(|(balance, gain)| all.value(balance) > all.value(gain)),
            return_above_terrain: all.value("RTL_ALT_TYPE") as i32 == 1,
            has_terrain: all.value("TERRAIN_ENABLE") > 0.0,
            // A rover does not check the precision.
            hdop_max: match all.kind() {
                VehicleKind::Copter => all.value("GPS_HDOP_GOOD"),
                VehicleKind::Rover(_) => f64::INFINITY,
            },
            mission_items: all.value("ARMING_MIS_ITEMS") as i32,
            values: ValueChecks::read(all),
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
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own, and any may hold beside any other"
)]
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
    pub(crate) throttle_is_down: bool,
    /// Whether a switch has stopped the motors.
    pub(crate) is_stopped: bool,
    /// Whether the motor interlock is on; `None` without a switch for it.
    pub(crate) interlock: Option<bool>,
    pub(crate) has_stop_switch: bool,
    /// Whether a receiver or an override has been heard since boot.
    pub(crate) radio_was_heard: bool,
    /// Whether the remote control is being calibrated.
    pub(crate) radio_calibrates: bool,
    /// Whether the accelerometers, and the gyros, disagree.
    pub(crate) inertial_doubts: [bool; 2],
    pub(crate) mission: &'a [Item],
    /// Whether there is a rally point.
    pub(crate) has_rally_point: bool,
    /// The reasons not to arm that come from the battery, the tests on the ground and the fence.
    pub(crate) battery: Option<&'static str>,
    pub(crate) workbench: Vec<&'static str>,
    pub(crate) fence: Option<&'static str>,
}

impl ArmingChecks<'_> {
    /// The reasons not to arm now; empty if there are none.
    pub(crate) fn obstacles(&self) -> Vec<Reason> {
        let values = &self.rules.values;
        let motors = self.motor_obstacles();
        if !motors.is_empty() {
            return motors;
        }
        if self.rules.is_off() {
            return self.mandatory_obstacles();
        }
        let mut reasons = self.parameter_obstacles();
        reasons.extend(self.radio_obstacle());
        if !self.boot.is_over() {
            let gps = &self.faults.gps;
            let is_blind = self.rules.has(Check::Gps) && (gps.disabled || gps.jammed);
            let reasons_of_boot = self.boot.obstacles(self.mode, self.has_home, is_blind);
            reasons.extend(reasons_of_boot.into_iter().map(Reason::from));
        }
        self.sensor_obstacles(&mut reasons);
        self.power_obstacles(&mut reasons);
        reasons.extend(self.mission_obstacle());
        reasons.extend(values.servos.iter().cloned());
        if self.rules.has(Check::Voltage) {
            reasons.extend(values.board.clone());
        }
        reasons.extend(self.terrain_obstacle());
        reasons.extend(self.workbench.iter().map(|reason| Reason::from(*reason)));
        reasons.extend(self.fence.map(Reason::from));
        if self.is_stopped {
            reasons.push("Motors Emergency Stopped".into());
        }
        reasons
    }

    /// Reasons that concern the motors; if there are any, no other check is made.
    fn motor_obstacles(&self) -> Vec<Reason> {
        let mut reasons = Vec::new();
        if self.interlock.is_some() && self.has_stop_switch {
            reasons.push("Interlock/E-Stop Conflict".into());
        }
        if self.interlock == Some(true) {
            reasons.push("Motor Interlock Enabled".into());
        }
        reasons.extend(self.rules.values.motors.clone());
        reasons
    }

    /// The reasons from the checks that cannot be switched off.
    pub(crate) fn mandatory_obstacles(&self) -> Vec<Reason> {
        let booting = self.boot.reference_obstacle(self.mode).map(Reason::from);
        let mut reasons: Vec<_> = self.source_obstacle().or(booting).into_iter().collect();
        if self.boot.is_over() {
            reasons.extend(self.estimate_obstacle());
        }
        reasons.extend(self.calibration_obstacle());
        reasons
    }

    /// Whether the parameters of the remote control are those of a calibrated one, or that is not checked.
    pub(crate) fn radio_is_calibrated(&self) -> bool {
        !self.rules.has(Check::Radio) || self.rules.values.sticks.is_empty()
    }

    fn calibration_obstacle(&self) -> Option<Reason> {
        self.radio_calibrates.then(|| "RC calibrating".into())
    }

    /// The reason from the checks that are made only when all others pass and arming was requested;
    /// `None` if they pass, too.
    pub(crate) fn last_obstacle(&self, method: ArmingMethod) -> Option<Reason> {
        let by_itself = method == ArmingMethod::Command
            && matches!(
                self.mode.id,
                ModeId::Guided | ModeId::GuidedNoGps | ModeId::Auto
            );
        let drives_motors = !self.mode.controls_height;
        let high = self.throttle_us > CLIMB_US || (drives_motors && !self.throttle_is_down);
        let flies = self.rules.rover_speed_m_s.is_none();
        (flies && self.rules.has(Check::Radio) && high && !by_itself)
            .then(|| "Throttle too high".into())
    }

    /// Whether the positions of sticks and switches are checked: a lost remote control has none.
    pub(crate) fn checks_sticks(&self) -> bool {
        let is_lost = self.failsafe.radio_is_lost() || !self.radio_was_heard;
        self.rules.has(Check::Radio) && !self.rules.is_off() && !is_lost
    }

    fn parameter_obstacles(&self) -> Vec<Reason> {
        let rules = self.rules;
        let failsafes = self.failsafe_rules;
        let mut reasons = Vec::new();
        if let Some(speed_m_s) = rules.rover_speed_m_s {
            let is_low = rules.has(Check::Parameters) && speed_m_s <= 0.0;
            reasons.extend(is_low.then(|| "WP_SPEED too low".into()));
            return reasons;
        }
        if rules.has(Check::Parameters) {
            let low_us = failsafes.radio_low_us;
            let margin = rules.throttle_min_us <= low_us + THROTTLE_MARGIN_US;
            let throttle = failsafes.radio != 0 && (margin || low_us < LOSS_OF_SIGNAL_US);
            let removed = "FS_GCS_ENABLE=2 removed, see FS_OPTIONS";
            let no_terrain = rules.return_above_terrain && !rules.has_terrain;
            let first = if throttle {
                Some("Check FS_THR_VALUE".into())
            } else if !(1000.0..=8000.0).contains(&rules.angle_max_cdeg) {
                Some("Check ANGLE_MAX".into())
            } else if rules.acro_balance_is_high {
                Some("Check ACRO_BAL_ROLL/PITCH".into())
            } else if rules.pilot_up_cm_s <= 0.0 {
                Some("Check PILOT_SPEED_UP".into())
            } else if no_terrain {
                Some("RTL_ALT_TYPE is above-terrain but no terrain data".into())
            } else {
                rules.values.controllers.clone()
            };
            if rules.station_failsafe == 2 && !throttle {
                reasons.push(removed.into());
            }
            reasons.extend(first);
        }
        if self.failsafe.station_is_lost() {
            reasons.push("GCS failsafe on".into());
        }
        reasons
    }

    fn radio_obstacle(&self) -> Option<Reason> {
        let failsafes = self.failsafe_rules;
        if !self.rules.has(Check::Radio) || failsafes.radio == 0 {
            None
        } else if !self.radio_was_heard {
            Some("RC not found".into())
        } else {
            let low = self.received_throttle_us < failsafes.radio_low_us;
            low.then(|| "Throttle below failsafe".into())
        }
    }

    /// The mission must have the items that a parameter requires, and AUTO needs a mission.
    fn mission_obstacle(&self) -> Option<Reason> {
        let wanted = self.rules.mission_items;
        if self.rules.has(Check::Mission) {
            let missing = MISSION_ITEMS.iter().find(|(bit, command, _)| {
                wanted & bit != 0
                    && !self
                        .mission
                        .iter()
                        .skip(1)
                        .any(|item| item.command == *command)
            });
            if let Some((_, _, name)) = missing {
                return Some(format!("Missing mission item: {name}").into());
            }
            if wanted & RALLY_ITEM != 0 && !self.has_rally_point {
                return Some("No sufficiently close rally point located".into());
            }
        }
        (self.mode.id == ModeId::Auto && self.mission.len() < 2)
            .then(|| "Mode requires mission".into())
    }

    /// A return above terrain needs terrain data around the vehicle, which the simulation does not
    /// provide.
    fn terrain_obstacle(&self) -> Option<Reason> {
        let rules = self.rules;
        (rules.has(Check::Parameters) && rules.return_above_terrain && rules.has_terrain)
            .then(|| "waiting for terrain data".into())
    }

    fn source_obstacle(&self) -> Option<Reason> {
        let [with_position, without] = &self.rules.values.sources;
        let used = if self.mode.needs_position() {
            with_position
        } else {
            without
        };
        used.clone()
    }

    fn sensor_obstacles(&self, reasons: &mut Vec<Reason>) {
        let rules = self.rules;
        let faults = self.faults;
        let barometers_off = faults.barometers.iter().any(|barometer| barometer.disabled);
        if rules.has(Check::Barometer) && barometers_off {
            reasons.push("Baro: not healthy".into());
        }
        if rules.has(Check::Inertial) {
            if faults.gyro_failed {
                reasons.push("Gyros not healthy".into());
            }
            if faults.accelerometer_failed {
                reasons.push("Accels not healthy".into());
            } else if faults.has_stuck_accelerometer() || self.inertial_doubts[0] {
                reasons.push("Accels inconsistent".into());
            } else if self.inertial_doubts[1] {
                reasons.push("Gyros inconsistent".into());
            }
        }
        if rules.has(Check::Compass) && !self.estimator.compass_is_healthy() {
            reasons.push("Compass not healthy".into());
        }
        let sources = self.source_obstacle();
        if self.boot.is_over() {
            reasons.extend(self.gps_obstacle().or(sources));
        } else {
            reasons.extend(sources);
        }
    }

    fn gps_obstacle(&self) -> Option<Reason> {
        if !self.mode.needs_position() {
            return None;
        }
        if self.rules.has(Check::Gps) {
            if self.faults.gps.unused == Some(GpsUnused::Absent) {
                return Some("GPS 1: primary but TYPE 0".into());
            }
            if self.estimator.fix().is_some_and(|fix| !fix.is_locked()) {
                return Some("GPS 1: Bad fix".into());
            }
        }
        let precise = self.rules.hdop_max >= HDOP;
        self.source_obstacle()
            .or_else(|| self.estimate_obstacle())
            .or_else(|| (self.rules.has(Check::Gps) && !precise).then(|| "High GPS HDOP".into()))
    }

    /// The check of the estimate, needed in modes that depend on it.
    fn estimate_obstacle(&self) -> Option<Reason> {
        if !self.mode.needs_position() {
            return None;
        }
        if self.rules.rover_speed_m_s.is_some() {
            return (!self.estimator.has_position()).then(|| "Need Position Estimate".into());
        }
        let threshold = self.failsafe_rules.ekf_threshold;
        let is_doubtful = threshold > 0.0 && is_over(self.estimator, threshold);
        if is_doubtful || !self.estimator.has_position() {
            return Some("Need Position Estimate".into());
        }
        if self.estimator.is_glitching() {
            return Some("GPS glitching".into());
        }
        let ratios = self.estimator.ratios();
        let over = |ratio: f64| threshold > 0.0 && ratio >= threshold;
        if over(ratios.compass) {
            Some("EKF compass variance".into())
        } else if over(ratios.position) {
            Some("EKF position variance".into())
        } else if over(ratios.velocity) {
            Some("EKF velocity variance".into())
        } else if over(ratios.height) {
            Some("EKF height variance".into())
        } else {
            None
        }
    }

    fn power_obstacles(&self, reasons: &mut Vec<Reason>) {
        let rules = self.rules;
        if rules.has(Check::Battery) {
            reasons.extend(self.battery.map(Reason::from));
        }
        if rules.has(Check::Radio) {
            if self.failsafe.radio_is_lost() {
                reasons.push("Radio failsafe on".into());
            } else {
                reasons.extend(rules.values.sticks.iter().cloned());
            }
        }
        reasons.extend(self.calibration_obstacle());
        let flies = rules.rover_speed_m_s.is_none();
        if flies && rules.has(Check::Voltage) && self.failsafe.battery_is_down() {
            reasons.push("Battery failsafe".into());
        }
    }
}
