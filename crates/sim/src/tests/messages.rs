//! The messages that can be requested, and those in the streams.

use mavlink::dialects::ardupilotmega::{self, MavCmd, MavMessage, MavResult};

use super::*;

/// The results of `REQUEST_MESSAGE` in a sweep of an `ArduCopter` 4.6 SITL: these messages are
/// sent, those in `SILENT` are accepted without being sent, and all others fail.
const COMING: &[u32] = &[
    0, 1, 2, 24, 26, 27, 29, 30, 31, 32, 33, 36, 42, 46, 49, 62, 65, 74, 83, 108, 116, 125, 129,
    133, 137, 147, 148, 152, 163, 164, 165, 168, 178, 193, 235, 241, 242, 245, 286, 376, 11030,
];
const SILENT: &[u32] = &[
    22, 34, 35, 85, 87, 100, 124, 127, 128, 132, 143, 162, 173, 180, 181, 191, 192, 194, 195, 225,
    226, 246, 259, 260, 262, 271, 280, 281, 285, 301, 373, 9005, 10008, 11020,
];

#[test]
fn messages_come_are_silent_or_fail_as_with_the_real_vehicle() {
    let mut ground = Ground::new();
    ground.run(3.0);
    // 435 to 437, by which later versions announce their modes, fail as well.
    for id in (0..400).chain([435, 436, 437, 9005, 10008, 11020, 11030, 12345]) {
        let before = ground.heard.len();
        let result = ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [id as f32]);
        let came = ground.heard[before..]
            .iter()
            .any(|frame| frame.content.id() == id);
        let known = COMING.contains(&id) || SILENT.contains(&id);
        let accepted = result == MavResult::MAV_RESULT_ACCEPTED;
        assert_eq!(accepted, known, "{id}: {result:?}");
        if id != 77 && id != 253 {
            assert_eq!(came, COMING.contains(&id), "{id}");
        }
        let result = ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [id as f32, -1.0]);
        assert_eq!(result == MavResult::MAV_RESULT_ACCEPTED, known, "{id}");
    }
}

#[test]
#[expect(deprecated, reason = "ground stations in use ask for streams with it")]
fn all_streams_at_4_hz_are_as_many_messages_as_the_real_ones() {
    let mut ground = Ground::new();
    ground.run(3.0);
    ground.say(MavMessage::REQUEST_DATA_STREAM(
        ardupilotmega::REQUEST_DATA_STREAM_DATA {
            req_message_rate: 4,
            target_system: 1,
            start_stop: 1,
            ..Default::default()
        },
    ));
    ground.run(1.0);
    let before = ground.heard.len();
    ground.run(10.0);
    let per_s = (ground.heard.len() - before) as f64 / 10.0;
    // Measured: 107.7, with LOCAL_POSITION_NED and WIND only 3 times of 4, because the position arrived late.
    assert!((106.5..111.0).contains(&per_s), "{per_s}");
}

#[test]
fn counters_are_told_every_half_minute_and_after_a_flight() {
    let mut ground = Ground::hovering(10.0);
    ground.run(30.0);
    ground.long(MavCmd::MAV_CMD_NAV_LAND, [0.0]);
    ground.until(60.0, |truth| !truth.armed);
    ground.run(0.5);
    let told: Vec<String> = ground
        .messages_since(0)
        .iter()
        .filter_map(|message| match message {
            MavMessage::PARAM_VALUE(data) => Some(data.param_id.to_str().expect("name").to_owned()),
            _ => None,
        })
        .collect();
    for (name, least) in [
        ("STAT_RUNTIME", 3),
        ("STAT_FLTTIME", 2),
        ("MOT_THST_HOVER", 1),
    ] {
        let times = told.iter().filter(|told| *told == name).count();
        assert!(times >= least, "{name}: {times}");
    }
    let learned = ground.world.slots[0]
        .autopilot
        .vehicle
        .parameters
        .value("MOT_THST_HOVER");
    assert!((0.33..0.385).contains(&learned), "{learned}");
}
