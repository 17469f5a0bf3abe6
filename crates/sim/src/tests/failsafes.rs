//! Automatic actions of the vehicle, and reasons against arming.

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::Ground;
use super::timeline::Timeline;

/// The tolerance against measured times: telemetry at 10 Hz, and heartbeats.
const TOLERANCE_S: f64 = 0.35;

fn hovering(height_m: f32) -> Timeline {
    Timeline::of(Ground::hovering(height_m))
}

#[test]
fn the_ekf_failsafe_does_what_its_parameters_say() {
    for (action, threshold, mode) in [(1.0, 0.8, 9), (2.0, 0.8, 2), (3.0, 0.8, 9), (1.0, 0.0, 4)] {
        let mut seen = hovering(15.0);
        seen.ground.set("FS_EKF_ACTION", action);
        seen.ground.set("FS_EKF_THRESH", threshold);
        seen.ground.set("SIM_GPS_DISABLE", 1.0);
        seen.run(10.0);
        assert_eq!(seen.ground.truth().mode, mode, "{action} {threshold}");
    }
}

#[test]
fn batteries_act_by_level_voltage_and_charge() {
    let cases: &[(&str, f32, f32, u8)] = &[
        ("BATT_FS_LOW_ACT", 0.0, 10.2, 4),
        ("BATT_FS_LOW_ACT", 1.0, 10.2, 9),
        ("BATT_FS_LOW_ACT", 2.0, 10.2, 6),
        ("BATT_FS_LOW_ACT", 3.0, 10.2, 21),
        ("BATT_FS_LOW_ACT", 4.0, 10.2, 21),
        ("BATT_FS_LOW_ACT", 6.0, 10.2, 6),
        ("BATT_FS_LOW_ACT", 7.0, 10.2, 17),
    ];
    for (name, action, at_s, mode) in cases {
        let mut seen = hovering(25.0);
        seen.ground.set("BATT_LOW_VOLT", 11.0);
        seen.ground.set(name, *action);
        seen.mark();
        seen.ground.set("SIM_BATT_VOLTAGE", 10.7);
        seen.run(11.0);
        let at_s = f64::from(*at_s);
        seen.must_say(
            TOLERANCE_S,
            &[
                (at_s, "Battery 1 is low 10.70V used "),
                (at_s, "Battery Failsafe"),
            ],
        );
        assert_eq!(seen.ground.truth().mode, *mode, "{name} {action}");
    }
    let mut seen = hovering(5.0);
    seen.ground.set("BATT_FS_LOW_ACT", 5.0);
    seen.ground.set("BATT_LOW_MAH", 3299.0);
    seen.run(0.3);
    assert!(!seen.ground.truth().armed, "terminated");
}

#[test]
fn a_critical_battery_lands_after_a_pause_and_forbids_arming_until_a_reboot() {
    let mut seen = hovering(25.0);
    for (name, value) in [
        ("BATT_LOW_VOLT", 11.0),
        ("BATT_CRT_VOLT", 10.0),
        ("BATT_FS_LOW_ACT", 2.0),
        ("BATT_FS_CRT_ACT", 1.0),
        ("SIM_BATT_VOLTAGE", 10.7),
    ] {
        seen.ground.set(name, value);
    }
    seen.run(11.0);
    seen.must_say(
        TOLERANCE_S,
        &[(10.2, "mode 6 status 5"), (10.2, "health 5021")],
    );
    seen.mark();
    seen.ground.set("SIM_BATT_VOLTAGE", 9.6);
    seen.run(10.5);
    seen.must_say(
        TOLERANCE_S,
        &[
            (10.1, "mode 9 status 5"),
            (10.1, "Battery 1 is critical 9.60V used "),
            (10.1, "Battery Failsafe"),
        ],
    );
    let before = seen.ground.truth().position_ned_m[2];
    seen.run(2.0);
    let paused = seen.ground.truth().position_ned_m[2] - before;
    assert!(paused < 1.5, "waits before it descends: {paused}");
    seen.run(55.0);
    assert!(!seen.ground.truth().armed);
    let unasked = [
        "PreArm: Battery 1 low voltage failsafe",
        "PreArm: Battery failsafe",
    ];
    assert!(
        unasked
            .iter()
            .all(|text| seen.lines.iter().any(|(_, line)| line == text))
    );
    seen.ground.set("SIM_BATT_VOLTAGE", 12.6);
    seen.run(0.1);
    seen.ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    seen.mark();
    let refused = seen
        .ground
        .long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    assert_eq!(refused, MavResult::MAV_RESULT_FAILED);
    seen.run(0.1);
    seen.must_say(TOLERANCE_S, &[(0.0, "Arm: Battery failsafe")]);
    seen.must_not_say(&["low voltage"]);
    let forced = seen
        .ground
        .long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 2989.0]);
    assert_eq!(forced, MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn a_silent_ground_station_does_what_its_parameter_says() {
    for (rule, mode, text) in [
        (0.0, 4, ""),
        (1.0, 6, "GCS Failsafe"),
        (3.0, 21, "GCS Failsafe"),
        (4.0, 21, "GCS Failsafe"),
        (5.0, 9, "GCS Failsafe"),
        (6.0, 6, "Trying RTL Mode"),
        (7.0, 17, "GCS Failsafe"),
    ] {
        let mut seen = hovering(15.0);
        seen.ground.set("FS_GCS_ENABLE", rule);
        seen.ground.heartbeat();
        seen.mark();
        seen.beats = false;
        seen.run(6.0);
        if !text.is_empty() {
            seen.must_say(TOLERANCE_S, &[(5.1, text)]);
        }
        assert_eq!(seen.ground.truth().mode, mode, "{rule}");
        seen.mark();
        seen.beats = true;
        seen.run(1.5);
        if rule > 0.0 {
            seen.must_say(1.2, &[(0.1, "GCS Failsafe Cleared")]);
        }
        assert_eq!(seen.ground.truth().mode, mode, "stays");
    }
}

#[test]
fn options_let_the_vehicle_go_on() {
    let mut seen = hovering(15.0);
    seen.ground.set("FS_GCS_ENABLE", 1.0);
    seen.ground.set("FS_OPTIONS", 8.0);
    seen.ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 9.0]);
    seen.mark();
    seen.beats = false;
    seen.run(6.0);
    seen.must_say(1.1, &[(5.2, "GCS Failsafe - Continuing Landing")]);
    assert_eq!(seen.ground.truth().mode, 9);
    let mut seen = hovering(15.0);
    seen.ground.set("FS_OPTIONS", 4.0);
    seen.ground.set("SIM_RC_FAIL", 1.0);
    seen.run(1.5);
    seen.must_say(
        TOLERANCE_S,
        &[(1.0, "Radio Failsafe - Continuing Guided Mode")],
    );
    assert_eq!(seen.ground.truth().mode, 4);
}

#[test]
fn a_lost_remote_control_brings_the_vehicle_home() {
    for (fault, after_s) in [(1.0, 1.0), (2.0, 0.06)] {
        let mut seen = hovering(15.0);
        seen.ground.set("SIM_RC_FAIL", fault);
        seen.run(2.0);
        seen.must_say(0.1, &[(after_s, "mode 6 status 5")]);
        seen.must_say(0.1, &[(after_s, "Radio Failsafe")]);
        seen.must_say(0.2, &[(after_s + 0.1, "health 5220")]);
        seen.mark();
        seen.ground.set("SIM_RC_FAIL", 0.0);
        seen.run(1.0);
        seen.must_say(0.1, &[(0.05, "Radio Failsafe Cleared")]);
        assert_eq!(seen.ground.truth().mode, 6, "stays");
    }
}

#[test]
fn each_check_refuses_arming_unless_it_is_switched_off() {
    // Parameter, value, the bit of ARMING_CHECK, the reason.
    let cases: &[(&str, f32, u8, &str)] = &[
        ("SIM_BARO_DISABLE", 1.0, 1, "Baro: not healthy"),
        ("SIM_MAG1_FAIL", 1.0, 2, "Compass not healthy"),
        ("SIM_GPS_DISABLE", 1.0, 3, "GPS 1: Bad fix"),
        ("SIM_GYR_FAIL_MSK", 1.0, 4, "Gyros not healthy"),
        ("SIM_ACC_FAIL_MSK", 1.0, 4, "Accels not healthy"),
        ("SIM_ACCEL1_FAIL", 9.0, 4, "Accels inconsistent"),
        ("ANGLE_MAX", 900.0, 5, "Check ANGLE_MAX"),
        ("PILOT_SPEED_UP", 0.0, 5, "Check PILOT_SPEED_UP"),
        ("FS_THR_VALUE", 900.0, 5, "Check FS_THR_VALUE"),
        ("SIM_RC_FAIL", 2.0, 6, "Throttle below failsafe"),
        (
            "BATT_ARM_VOLT",
            13.0,
            8,
            "Battery 1 below minimum arming voltage",
        ),
        (
            "SIM_BATT_VOLTAGE",
            10.0,
            8,
            "Battery 1 low voltage failsafe",
        ),
    ];
    for (name, value, bit, reason) in cases {
        let mut ground = Ground::new();
        ground.run(2.0);
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
        ground.set(name, *value);
        ground.run(1.5);
        let before = ground.texts().len();
        let arm =
            |ground: &mut Ground| ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
        assert_eq!(arm(&mut ground), MavResult::MAV_RESULT_FAILED, "{name}");
        let said = ground.texts().split_off(before);
        assert!(said.contains(&format!("Arm: {reason}")), "{name}: {said:?}");
        ground.set("ARMING_CHECK", (0x01FE & !(1u32 << bit)) as f32);
        let before = ground.texts().len();
        arm(&mut ground);
        let said = ground.texts().split_off(before);
        assert!(
            !said.contains(&format!("Arm: {reason}")),
            "{name}: {said:?}"
        );
    }
}

#[test]
fn a_landing_mode_cannot_be_armed_unless_forced() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 9.0]);
    for (magic, result) in [
        (0.0, MavResult::MAV_RESULT_FAILED),
        (21196.0, MavResult::MAV_RESULT_FAILED),
        (2989.0, MavResult::MAV_RESULT_ACCEPTED),
    ] {
        let got = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, magic]);
        assert_eq!(got, result, "{magic}");
    }
}
