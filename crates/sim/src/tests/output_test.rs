//! Motor tests of rovers, with the answers, texts and outputs of a real `ArduRover` 4.6 in SITL.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::driving::{off_m, texts};
use super::flight::close;
use super::*;

const ACCEPTED: MavResult = MavResult::MAV_RESULT_ACCEPTED;
const PERCENT: f32 = 0.0;
const PULSE_WIDTH: f32 = 1.0;
const SERVO_OUTPUT_RAW: f32 = 36.0;

fn standing(chassis: Chassis) -> Ground {
    let mut ground = Ground::in_world(&WorldConfig {
        kinds: vec![VehicleKind::Rover(chassis)],
        ..WorldConfig::row(1, start())
    });
    ground.run(2.0);
    ground
}

fn test(ground: &mut Ground, asked: [f32; 4]) -> MavResult {
    ground.long(MavCmd::MAV_CMD_DO_MOTOR_TEST, asked)
}

/// The first and the third output, in microseconds.
fn outputs_us(ground: &mut Ground) -> [u16; 2] {
    ground.run(0.1);
    let before = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [SERVO_OUTPUT_RAW]);
    let heard = ground.messages_since(before).into_iter();
    let mut outputs = heard.filter_map(|message| match message {
        MavMessage::SERVO_OUTPUT_RAW(data) => Some([data.servo1_raw, data.servo3_raw]),
        _ => None,
    });
    outputs.next().expect("the outputs")
}

fn parameter(ground: &Ground, name: &str) -> f64 {
    ground.world.slots[0]
        .autopilot
        .vehicle
        .parameters
        .value(name)
}

#[test]
fn a_tested_motor_arms_drives_and_disarms() {
    for (chassis, rolls_m) in [(Chassis::Ackermann, 3.4), (Chassis::Boat, 7.5)] {
        let mut ground = standing(chassis);
        assert_eq!(test(&mut ground, [1.0, PERCENT, 20.0, 1.0]), ACCEPTED);
        assert_eq!(outputs_us(&mut ground), [1500, 1600], "{chassis:?}");
        ground.run(3.9);
        close("way", off_m(&ground.truth(), [0.0, 0.0]), rolls_m, 0.4);
        let said = texts(&ground);
        let ends: Vec<_> = said
            .iter()
            .filter(|it| it.starts_with("Throttle"))
            .collect();
        assert_eq!(ends, ["Throttle armed", "Throttle disarmed"], "{chassis:?}");
        assert_eq!(outputs_us(&mut ground), [1500, 1500]);
    }
}

#[test]
fn every_chassis_has_its_outputs() {
    for (chassis, motor, asked, expected) in [
        (Chassis::Ackermann, 2.0, [PERCENT, 20.0], [1600, 1500]),
        (Chassis::Ackermann, 2.0, [PERCENT, -20.0], [1400, 1500]),
        (Chassis::Ackermann, 2.0, [PULSE_WIDTH, 1550.0], [1550, 1500]),
        (Chassis::Ackermann, 3.0, [PERCENT, 20.0], [1500, 1500]),
        (Chassis::Ackermann, 0.0, [PERCENT, 20.0], [1500, 1500]),
        (Chassis::Skid, 1.0, [PERCENT, 20.0], [1500, 1500]),
        (Chassis::Skid, 3.0, [PERCENT, 20.0], [1600, 1500]),
        (Chassis::Skid, 4.0, [PULSE_WIDTH, 1600.0], [1500, 1600]),
    ] {
        let mut ground = standing(chassis);
        let [kind, value] = asked;
        assert_eq!(test(&mut ground, [motor, kind, value, 1.0]), ACCEPTED);
        let outputs = outputs_us(&mut ground);
        assert_eq!(outputs, expected, "{chassis:?}, motor {motor}, {asked:?}");
    }
}

#[test]
fn wrong_tests_are_refused_with_the_reason() {
    let mut ground = standing(Chassis::Ackermann);
    for (asked, text) in [
        ([5.0, PERCENT, 20.0], "Motor Test: invalid motor (5)"),
        ([2.0, 3.0, 0.0], "Motor Test: invalid throttle type: 3"),
        (
            [2.0, PULSE_WIDTH, 2300.0],
            "Motor Test: pwm (2300) too high",
        ),
        (
            [2.0, PERCENT, 101.0],
            "Motor Test: percentage (101) too high",
        ),
    ] {
        let [motor, kind, value] = asked;
        let answer = test(&mut ground, [motor, kind, value, 2.0]);
        assert_eq!(answer, MavResult::MAV_RESULT_FAILED, "{text}");
        assert_eq!(texts(&ground).last().map(String::as_str), Some(text));
    }
    ground.long(MavCmd::MAV_CMD_DO_SET_SAFETY_SWITCH_STATE, [0.0]);
    let answer = test(&mut ground, [2.0, PERCENT, 20.0, 2.0]);
    assert_eq!(answer, MavResult::MAV_RESULT_FAILED);
    let said = texts(&ground);
    assert!(
        said.contains(&"Motor Test: Safety switch".to_owned()),
        "{said:?}"
    );
    assert!(!said.contains(&"Throttle armed".to_owned()), "{said:?}");
}

#[test]
fn a_second_test_takes_over_and_the_first_output_keeps_its_value() {
    let mut ground = standing(Chassis::Ackermann);
    assert_eq!(test(&mut ground, [2.0, PERCENT, 10.0, 6.0]), ACCEPTED);
    ground.run(0.1);
    assert_eq!(test(&mut ground, [1.0, PERCENT, 40.0, 2.0]), ACCEPTED);
    assert_eq!(outputs_us(&mut ground), [1550, 1700]);
    // Once a test is under way, nothing is checked any more.
    assert_eq!(test(&mut ground, [9.0, 7.0, 400.0, 3.0]), ACCEPTED);
    assert_eq!(outputs_us(&mut ground), [1550, 1700]);
    ground.run(3.2);
    assert_eq!(outputs_us(&mut ground), [1500, 1500]);
}

#[test]
fn failsafes_are_off_during_a_test() {
    let mut ground = standing(Chassis::Ackermann);
    ground.set("FS_GCS_ENABLE", 1.0);
    let values = |ground: &Ground| {
        ["FS_GCS_ENABLE", "FS_THR_ENABLE"].map(|name| parameter(ground, name) as i32)
    };
    assert_eq!(values(&ground), [1, 1]);
    assert_eq!(test(&mut ground, [2.0, PERCENT, 10.0, 1.0]), ACCEPTED);
    assert_eq!(values(&ground), [0, 0]);
    ground.run(1.2);
    assert_eq!(values(&ground), [1, 1]);
}

#[test]
fn disarming_does_not_end_a_test() {
    let mut ground = standing(Chassis::Ackermann);
    assert_eq!(test(&mut ground, [2.0, PERCENT, 20.0, 3.0]), ACCEPTED);
    let disarm = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0]);
    assert_eq!(disarm, ACCEPTED);
    ground.run(1.0);
    assert_eq!(outputs_us(&mut ground), [1600, 1500]);
    ground.run(2.5);
    assert_eq!(outputs_us(&mut ground), [1500, 1500]);
}
