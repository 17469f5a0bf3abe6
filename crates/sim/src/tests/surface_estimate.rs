//! Lost and doubtful estimates of rovers, as a real `ArduRover` 4.6 had them in SITL.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::driving::{enter, guided, texts};
use super::*;

const HOLD: u8 = 4;
const LOITER: f32 = 5.0;

/// The texts and their seconds.
fn timeline(ground: &mut Ground, seconds: f64) -> Vec<(f64, String)> {
    let mut first = ground.heard.len();
    let mut all = Vec::new();
    for step in 1..=(seconds * 10.0) as u32 {
        ground.run(0.1);
        for message in ground.messages_since(first) {
            if let MavMessage::STATUSTEXT(text) = message {
                let text = text.text.to_str().expect("text").to_owned();
                all.push((f64::from(step) * 0.1, text));
            }
        }
        first = ground.heard.len();
    }
    all
}

#[track_caller]
fn assert_timeline(got: &[(f64, String)], real: &[(f64, &str)]) {
    let said: Vec<&str> = got.iter().map(|(_, text)| text.as_str()).collect();
    let expected: Vec<&str> = real.iter().map(|(_, text)| *text).collect();
    assert_eq!(said, expected, "{got:?}");
    for ((at_s, text), (real_s, _)) in got.iter().zip(real) {
        assert!(
            (at_s - real_s).abs() < 0.7,
            "{text} after {at_s:.1}, the real one {real_s}"
        );
    }
}

fn under_way() -> Ground {
    let mut ground = guided(Chassis::Ackermann);
    ground.goto([300.0, 0.0, 0.0]);
    ground.run(6.0);
    ground
}

#[test]
fn without_gps_a_rover_falls_back_and_holds() {
    let mut ground = under_way();
    ground.set("SIM_GPS_DISABLE", 1.0);
    let lost = [
        (7.2, "AHRS: DCM active"),
        (8.2, "EKF variance"),
        (8.2, "EKF failsafe"),
        (15.2, "EKF3 IMU0 stopped aiding"),
        (15.2, "EKF3 IMU1 stopped aiding"),
    ];
    assert_timeline(&timeline(&mut ground, 45.0), &lost);
    assert_eq!(ground.truth().mode, HOLD);
    assert_eq!(enter(&mut ground, 15.0), MavResult::MAV_RESULT_FAILED);
    ground.set("SIM_GPS_DISABLE", 0.0);
    let found = [
        (0.4, "EKF3 IMU0 is using GPS"),
        (0.4, "EKF3 IMU1 is using GPS"),
        (0.4, "AHRS: EKF3 active"),
        (1.2, "EKF failsafe cleared"),
    ];
    assert_timeline(&timeline(&mut ground, 10.0), &found);
    assert_eq!(enter(&mut ground, 15.0), MavResult::MAV_RESULT_ACCEPTED);
    // The path was recorded all the time.
    assert_eq!(enter(&mut ground, 12.0), MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn the_action_is_that_of_the_parameter_and_of_the_mode() {
    for (action, mode, acts, ends_in) in [
        (2.0, 15.0, true, 15),
        (0.0, 15.0, false, 15),
        (1.0, 0.0, false, 0),
    ] {
        let mut ground = under_way();
        ground.set("FS_EKF_ACTION", action);
        enter(&mut ground, mode);
        ground.set("SIM_GPS_DISABLE", 1.0);
        ground.run(12.0);
        assert_eq!(ground.truth().mode, ends_in, "{action} {mode}");
        let said = texts(&ground);
        assert!(said.contains(&"EKF variance".to_owned()));
        assert_eq!(
            said.contains(&"EKF failsafe".to_owned()),
            acts,
            "{action} {mode}"
        );
    }
}

#[test]
fn a_glitch_is_a_failsafe_until_the_position_is_adopted() {
    let mut ground = under_way();
    ground.set("SIM_GPS_GLITCH_X", 0.001);
    let glitch = [
        (4.0, "AHRS: DCM active"),
        (4.8, "EKF variance"),
        (4.8, "EKF failsafe"),
        (10.2, "AHRS: EKF3 active"),
        (11.0, "EKF failsafe cleared"),
    ];
    assert_timeline(&timeline(&mut ground, 25.0), &glitch);
}

#[test]
fn without_the_failsafe_modes_are_refused_on_the_simpler_estimate() {
    let mut ground = under_way();
    ground.set("FS_EKF_THRESH", 0.0);
    ground.set("SIM_GPS_GLITCH_X", 0.001);
    ground.run(6.0);
    let said = texts(&ground);
    assert!(said.contains(&"AHRS: DCM active".to_owned()), "{said:?}");
    assert_eq!(enter(&mut ground, LOITER), MavResult::MAV_RESULT_FAILED);
    ground.run(10.0);
    assert_eq!(enter(&mut ground, LOITER), MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn the_threshold_counts_for_an_armed_vehicle() {
    let mut ground = under_way();
    ground.set("FS_EKF_THRESH", 0.001);
    let low = [(0.8, "EKF variance"), (0.8, "EKF failsafe")];
    assert_timeline(&timeline(&mut ground, 15.0), &low);
    assert_eq!(enter(&mut ground, 15.0), MavResult::MAV_RESULT_FAILED);
    ground.set("FS_EKF_THRESH", 0.8);
    assert_timeline(
        &timeline(&mut ground, 5.0),
        &[(1.0, "EKF failsafe cleared")],
    );
    enter(&mut ground, 0.0);
    ground.long7(
        MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
        [0.0, 21196.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    ground.set("FS_EKF_THRESH", 0.001);
    ground.run(3.0);
    enter(&mut ground, 15.0);
    let arm = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(arm, MavResult::MAV_RESULT_ACCEPTED);
}
