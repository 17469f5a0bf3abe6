//! The checks before arming, and what arming changes; figures and texts of `ArduCopter` 4.6.

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::*;

const ARM: MavCmd = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM;
const ACCEPTED: MavResult = MavResult::MAV_RESULT_ACCEPTED;
const FAILED: MavResult = MavResult::MAV_RESULT_FAILED;

fn mode(ground: &mut Ground, number: f32) {
    let result = ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, number]);
    assert_eq!(result, ACCEPTED);
}

/// Requests arming; returns the answer and the reasons against it.
fn arm(ground: &mut Ground) -> (MavResult, Vec<String>) {
    let before = ground.texts().len();
    let result = ground.long(ARM, [1.0]);
    let said = ground.texts().split_off(before);
    let reasons = said.iter().filter_map(|text| text.strip_prefix("Arm: "));
    (result, reasons.map(str::to_owned).collect())
}

#[test]
fn wrong_parameters_forbid_arming_with_their_reason() {
    let mut ground = Ground::new();
    ground.run(2.0);
    mode(&mut ground, 4.0);
    for (name, value, reason) in [
        ("RC3_TRIM", 900.0, "RC3_MIN is greater than RC3_TRIM"),
        ("RC1_MIN", 1600.0, "Roll radio min too high"),
        (
            "SERVO1_FUNCTION",
            0.0,
            "Motors: no SERVOx_FUNCTION set to Motor1",
        ),
        (
            "SERVO1_TRIM",
            1000.0,
            "SERVO1_MIN is greater than SERVO1_TRIM",
        ),
        (
            "MOT_PWM_MIN",
            2000.0,
            "Motors: Check MOT_PWM_MIN and MOT_PWM_MAX",
        ),
        ("FRAME_CLASS", 0.0, "Motors: Check frame class and type"),
        ("FRAME_TYPE", 99.0, "Motors: Check frame class and type"),
        ("BRD_VBUS_MIN", 5.5, "Board (5.0v) out of range 5.5-5.8v"),
        (
            "MOT_SPIN_MIN",
            0.4,
            "Motors: MOT_SPIN_MIN too high 0.40 > 0.3",
        ),
        ("MOT_SPIN_ARM", 0.5, "Motors: MOT_SPIN_ARM > MOT_SPIN_MIN"),
        (
            "PSC_POSXY_P",
            -1.0,
            "Bad parameter: PSC_POSXY_P must be > 0",
        ),
        (
            "ATC_RAT_RLL_D",
            -1.0,
            "Bad parameter: ATC_RAT_RLL_D must be >= 0",
        ),
        ("ACRO_BAL_ROLL", 99.0, "Check ACRO_BAL_ROLL/PITCH"),
        ("GPS_HDOP_GOOD", 10.0, "High GPS HDOP"),
        ("RTL_ALT_TYPE", 1.0, "waiting for terrain data"),
        ("ARMING_MIS_ITEMS", 1.0, "Missing mission item: land"),
        ("EK3_SRC3_YAW", 17.0, "AHRS: Check EK3_SRC3_YAW"),
        (
            "EK3_SRC1_POSXY",
            6.0,
            "AHRS: EK3 sources require VisualOdom",
        ),
    ] {
        let old = ground.world.parameter(0, name) as f32;
        ground.set(name, value);
        let (result, reasons) = arm(&mut ground);
        assert_eq!(result, FAILED, "{name}");
        assert!(reasons.contains(&reason.to_owned()), "{name}: {reasons:?}");
        ground.set(name, old);
    }
    assert_eq!(arm(&mut ground), (ACCEPTED, Vec::new()));
}

#[test]
fn inertial_sensors_that_disagree_forbid_arming_until_they_agree_for_ten_seconds() {
    for (name, value, reason) in [
        ("SIM_ACC1_BIAS_X", 5.0, "Accels inconsistent"),
        ("SIM_GYR1_BIAS_X", 1.0, "Gyros inconsistent"),
    ] {
        let mut ground = Ground::new();
        ground.run(2.0);
        mode(&mut ground, 4.0);
        ground.set(name, value);
        ground.run(2.0);
        assert_eq!(arm(&mut ground), (FAILED, vec![reason.to_owned()]));
        ground.set(name, 0.0);
        ground.run(5.0);
        assert_eq!(arm(&mut ground).0, FAILED, "{name}");
        ground.run(7.0);
        assert_eq!(arm(&mut ground).0, ACCEPTED, "{name}");
    }
}

#[test]
fn without_a_receiver_since_the_boot_the_reason_says_so() {
    let mut ground = Ground::new();
    ground.set("SIM_RC_FAIL", 1.0);
    ground.set("INITIAL_MODE", 9.0);
    ground = rebooted(ground);
    assert_eq!(ground.truth().mode, 9, "INITIAL_MODE");
    mode(&mut ground, 4.0);
    assert_eq!(arm(&mut ground), (FAILED, vec!["RC not found".to_owned()]));
    ground.sticks(1000);
    ground.run(0.3);
    assert_eq!(arm(&mut ground).0, ACCEPTED);
}

#[test]
fn auto_needs_a_mission_to_arm() {
    let mut ground = Ground::new();
    ground.run(2.0);
    mode(&mut ground, 3.0);
    let (result, reasons) = arm(&mut ground);
    assert_eq!(
        (result, reasons.as_slice()),
        (FAILED, &["Mode requires mission".to_owned()][..])
    );
}

#[test]
fn a_home_that_a_ground_station_has_set_stays_when_the_vehicle_arms() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let here = start();
    let mut p = [0.0; 7];
    p[4] = here.at.lat_deg as f32;
    p[5] = here.at.lon_deg as f32;
    p[6] = here.altitude_amsl_m as f32 + 20.0;
    assert_eq!(ground.long7(MavCmd::MAV_CMD_DO_SET_HOME, p), ACCEPTED);
    ground.arm();
    ground.takeoff(5.0);
    ground.run(25.0);
    let height_m = -ground.truth().position_ned_m[2];
    assert!((height_m - 25.0).abs() < 0.2, "{height_m}");
}

#[test]
fn without_a_gps_since_the_boot_modes_without_a_position_arm() {
    let mut ground = Ground::new();
    ground.set("SIM_GPS_DISABLE", 1.0);
    ground = rebooted(ground);
    ground.run(10.0);
    for (number, result) in [
        (0.0, ACCEPTED),
        (2.0, ACCEPTED),
        (5.0, FAILED),
        (4.0, FAILED),
    ] {
        mode(&mut ground, number);
        assert_eq!(arm(&mut ground).0, result, "mode {number}");
        ground.long(ARM, [0.0, 21196.0]);
    }
}

/// The vehicle after a reboot, with a new connection.
pub(super) fn rebooted(mut ground: Ground) -> Ground {
    ground.run(2.0);
    let reboot = MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN;
    assert_eq!(ground.long(reboot, [1.0]), ACCEPTED);
    ground.run(0.5);
    ground.port = ground.world.connect(0);
    ground.heard.clear();
    ground.run(2.0);
    ground
}

#[test]
fn a_reboot_counts_and_brings_the_vehicle_back_to_its_start() {
    let mut ground = Ground::hovering(5.0);
    ground.goto([40.0, 0.0, -5.0]);
    ground.run(15.0);
    mode(&mut ground, 9.0);
    ground.until(30.0, |truth| !truth.armed);
    assert!(ground.truth().position_ned_m[0] > 39.0);
    let boots = ground.world.parameter(0, "STAT_BOOTCNT");
    let ground = rebooted(ground);
    assert!((ground.world.parameter(0, "STAT_BOOTCNT") - boots - 1.0).abs() < 1e-9);
    let at = ground.truth().at;
    assert!(at.distance_m(start().at) < 0.1, "{at:?}");
}
