//! Answers and messages, compared with those that the real vehicle sent to the same clients.

use mavlink::dialects::ardupilotmega::{COMMAND_INT_DATA, MavCmd, MavFrame, MavMessage, MavResult};

use super::*;
use crate::autopilot::telemetry;

const CALIBRATE: MavCmd = MavCmd::MAV_CMD_PREFLIGHT_CALIBRATION;

fn message(ground: &Ground, id: u32) -> MavMessage {
    telemetry::message(id, &ground.world.slots[0].autopilot).expect("it is sent")
}

#[test]
fn calibrations_answer_like_the_real_ones() {
    let mut ground = Ground::new();
    ground.run(8.0);
    let mut answers = |p: [f32; 7]| {
        let before = ground.heard.len();
        ground.long7(CALIBRATE, p);
        let acks: Vec<u8> = ground
            .messages_since(before)
            .iter()
            .filter_map(|message| match message {
                MavMessage::COMMAND_ACK(ack) => Some(ack.result as u8),
                _ => None,
            })
            .collect();
        (acks, ground.texts().last().cloned().unwrap_or_default())
    };
    let barometer = answers([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(barometer.0, [5, 0]);
    let accelerometers = answers([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let text = "Place vehicle level and press any key.";
    assert_eq!(accelerometers, (vec![0], text.to_owned()));
    let briefly = [0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0];
    assert_eq!(answers(briefly).0, [0]);
    assert_eq!(answers(briefly).0, [1], "within five seconds");
    assert_eq!(answers([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]).0, [0]);
}

#[test]
fn telemetry_at_rest_has_the_fields_of_the_real_one() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let MavMessage::BATTERY_STATUS(battery) = message(&ground, 147) else {
        panic!("a battery")
    };
    assert!(battery.fault_bitmask.is_empty());
    let MavMessage::RAW_IMU(raw) = message(&ground, 27) else {
        panic!("an inertial sensor")
    };
    assert_eq!(
        [raw.xmag, raw.ymag, raw.zmag, raw.temperature],
        [232, 52, -528, 2700]
    );
    let MavMessage::GPS_RAW_INT(gps) = message(&ground, 24) else {
        panic!("a receiver")
    };
    assert_eq!(gps.alt_ellipsoid, 584_000);
    let MavMessage::AUTOPILOT_VERSION(version) = message(&ground, 148) else {
        panic!("a version")
    };
    assert!(
        version
            .flight_custom_version
            .iter()
            .all(u8::is_ascii_hexdigit)
    );
    assert_eq!(version.uid, 0);
}

#[test]
fn the_third_compass_feels_the_lean() {
    let mut ground = Ground::hovering(10.0);
    let field = |ground: &Ground| match message(ground, 129) {
        MavMessage::SCALED_IMU3(data) => [data.xmag, data.ymag, data.zmag],
        _ => panic!("a compass"),
    };
    let level = field(&ground);
    ground.fly([10.0, 0.0, 0.0]);
    ground.run(0.6);
    assert_ne!(field(&ground), level);
}

#[test]
fn a_takeoff_in_guided_reports_a_target_without_a_height() {
    let mut ground = Ground::armed();
    ground.takeoff(15.0);
    ground.run(4.0);
    let MavMessage::POSITION_TARGET_LOCAL_NED(target) = message(&ground, 85) else {
        panic!("a target")
    };
    assert!(target.z.abs() < f32::EPSILON);
}

#[test]
fn a_position_from_outside_is_denied_as_a_whole_number_command_only() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let command = MavCmd::MAV_CMD_EXTERNAL_POSITION_ESTIMATE;
    let answer = ground.int(&COMMAND_INT_DATA {
        command,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        ..Default::default()
    });
    assert_eq!(answer, MavResult::MAV_RESULT_DENIED);
    assert_eq!(ground.long(command, []), MavResult::MAV_RESULT_UNSUPPORTED);
}

#[test]
fn a_receiver_that_is_switched_off_in_flight_ends_in_a_landing() {
    let mut ground = Ground::hovering(20.0);
    ground.set("GPS1_TYPE", 0.0);
    ground.run(20.0);
    assert_eq!(ground.truth().mode, 9);
}
