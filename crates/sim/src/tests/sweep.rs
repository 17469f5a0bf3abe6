//! Every command that was sent to an `ArduCopter` 4.6 SITL, with its answer (0 accepted, 1 temporarily rejected,
//! 2 denied, 3 unsupported, 4 failed). Measured in November 2026 with every parameter zero unless given.

use mavlink::dialects::ardupilotmega::{MavMessage, STATUSTEXT_DATA};

use super::*;
use sortie_wire::Outgoing;

/// The result of a command by number, with its first parameters, and the texts that came with it.
fn ask(ground: &mut Ground, number: u16, first: &[f32]) -> (u8, Vec<String>) {
    let mut p = [0.0f32; 7];
    p[..first.len()].copy_from_slice(first);
    let mut payload = vec![0; 33];
    for (place, value) in p.iter().enumerate() {
        payload[place * 4..place * 4 + 4].copy_from_slice(&value.to_le_bytes());
    }
    payload[28..30].copy_from_slice(&number.to_le_bytes());
    payload[30] = 1;
    answer(ground, &Outgoing::Raw { id: 76, payload }, number)
}

/// The result of a command sent as `COMMAND_INT`, with a frame, a place (degrees times 1e7 or whole numbers) and a
/// height.
fn ask_int(
    ground: &mut Ground,
    number: u16,
    (frame, p): (u8, [f32; 4]),
    (x, y, z): (i32, i32, f32),
) -> (u8, Vec<String>) {
    let mut payload = vec![0; 35];
    for (place, value) in p.iter().enumerate() {
        payload[place * 4..place * 4 + 4].copy_from_slice(&value.to_le_bytes());
    }
    payload[16..20].copy_from_slice(&x.to_le_bytes());
    payload[20..24].copy_from_slice(&y.to_le_bytes());
    payload[24..28].copy_from_slice(&z.to_le_bytes());
    payload[28..30].copy_from_slice(&number.to_le_bytes());
    payload[30] = 1;
    payload[32] = frame;
    answer(ground, &Outgoing::Raw { id: 75, payload }, number)
}

fn answer(ground: &mut Ground, outgoing: &Outgoing, number: u16) -> (u8, Vec<String>) {
    let before = ground.heard.len();
    ground.send(outgoing);
    let mut result = None;
    let mut texts = Vec::new();
    for frame in &ground.heard[before..] {
        match &frame.content {
            sortie_wire::Content::Message(MavMessage::COMMAND_ACK(data)) => {
                result = Some(data.result as u8);
            }
            sortie_wire::Content::Undecoded { id: 77, payload } => {
                assert_eq!(u16::from_le_bytes([payload[0], payload[1]]), number);
                result = Some(payload[2]);
            }
            sortie_wire::Content::Message(MavMessage::STATUSTEXT(STATUSTEXT_DATA {
                text, ..
            })) => {
                texts.push(text.to_str().expect("text").to_owned());
            }
            _ => {}
        }
    }
    (result.expect("an answer"), texts)
}

const UNSUPPORTED: &[u16] = &[
    16, 18, 19, 23, 24, 25, 30, 31, 33, 34, 35, 36, 80, 81, 82, 83, 92, 93, 94, 95, 112, 113, 114,
    159, 177, 180, 186, 187, 190, 191, 192, 194, 196, 200, 210, 212, 213, 214, 215, 217, 220, 221,
    222, 223, 240, 241, 242, 243, 246, 252, 260, 262, 310, 311, 405, 406, 420, 519, 521, 522, 525,
    526, 527, 528, 529, 530, 531, 533, 600, 2002, 2003, 2004, 2005, 2010, 2502, 2503, 2504, 2505,
    2510, 2511, 2800, 3000, 3001, 4000, 4001, 4501, 5000, 5001, 5002, 5003, 5004, 5100, 5200, 9999,
    10151, 30001, 30002, 31000, 31014, 42000, 42004, 42005, 42427, 42501, 42505, 42650, 42702,
    42703, 43000, 43001, 43002, 43003, 43005, 43006,
];
const ACCEPTED: &[u16] = &[
    17, 20, 21, 85, 115, 179, 181, 182, 195, 197, 198, 201, 202, 203, 206, 208, 209, 216, 401, 410,
    510, 511, 512, 2001, 2520, 2600, 32000, 42001, 42003, 42006, 42428, 42651, 42701,
];
const FAILED: &[u16] = &[
    22, 84, 178, 183, 184, 188, 189, 193, 204, 205, 211, 218, 500, 520, 601, 1000, 1001, 2000,
    2500, 2501, 10001, 42429, 42600,
];
const DENIED: &[u16] = &[32, 176, 245, 532, 534, 42007, 42700];

#[test]
fn every_command_with_zeros_is_answered_like_the_real_vehicle() {
    let mut ground = Ground::new();
    ground.run(2.0);
    for (numbers, result) in [(ACCEPTED, 0), (DENIED, 2), (UNSUPPORTED, 3), (FAILED, 4)] {
        for number in numbers {
            ask(&mut ground, 176, &[1.0, 0.0]);
            assert_eq!(ask(&mut ground, *number, &[]).0, result, "{number}");
        }
    }
}

/// A command, its first parameters, the result and the texts.
type Row = (u16, &'static [f32], u8, &'static [&'static str]);

const SETTINGS: &[Row] = &[
    (400, &[2.0], 3, &[]),
    (400, &[-1.0], 3, &[]),
    (400, &[0.5], 3, &[]),
    (400, &[f32::NAN], 3, &[]),
    (176, &[1.0, -2.0], 4, &["No such mode 254"]),
    (176, &[128.0, 2.0], 2, &[]),
    (176, &[f32::NAN, 4.0], 2, &[]),
    (32, &[77.0], 0, &[]),
    (510, &[12345.0], 4, &[]),
    (511, &[33.0, -1.0], 0, &[]),
    (
        511,
        &[12345.0, 100.0],
        2,
        &["No ap_message for mavlink id (12345)"],
    ),
    (512, &[141.0], 4, &[]),
    (512, &[111.0], 4, &[]),
    (520, &[1.0], 0, &[]),
    (520, &[2.0], 4, &[]),
    (
        183,
        &[1.0, 1500.0],
        4,
        &["ServoRelayEvent: Channel 1 is already in use"],
    ),
    (183, &[5.0, 1500.0], 0, &[]),
    (183, &[9.0, 1500.0], 0, &[]),
    (183, &[33.0, 1500.0], 4, &[]),
    (184, &[9.0, 1500.0, 2.0, 1.0], 0, &[]),
    (181, &[0.0, 2.0], 0, &[]),
    (181, &[1.0, 1.0], 4, &[]),
    (182, &[1.0, 2.0, 1.0], 4, &[]),
    (218, &[300.0, 2.0], 0, &[]),
    (218, &[9.0, 3.0], 2, &[]),
    (218, &[41.0, 2.0], 4, &["Invalid channel option (41)"]),
    (
        218,
        &[17.0, 2.0],
        0,
        &["Mode change to AUTOTUNE failed: init failed"],
    ),
    (42651, &[255.0, 50.0], 0, &[]),
    (42007, &[1.0], 0, &[]),
    (42007, &[4.0], 2, &[]),
    (2600, &[1.0], 0, &["High Latency enabled"]),
    (115, &[400.0], 4, &[]),
    (115, &[-1.0], 4, &[]),
    (115, &[90.0, 0.0, 0.0, 2.0], 4, &[]),
];

const PLACES: &[Row] = &[
    (193, &[0.0], 4, &["Failed to pause"]),
    (193, &[1.0], 4, &["Failed to resume"]),
    (193, &[2.0], 2, &[]),
    (201, &[0.0, 0.0, 0.0, 0.0, 95.0, 149.1, 10.0], 4, &[]),
    (179, &[0.0, 0.0, 0.0, 0.0, 95.0, 149.16, 600.0], 4, &[]),
    (179, &[2.0, 0.0, 0.0, 0.0, -35.36, 149.16, 600.0], 4, &[]),
    (
        179,
        &[0.0, 0.0, 0.0, 0.0, -35.36, 149.16, 200_000.0],
        2,
        &[],
    ),
    (179, &[0.0, 0.0, 0.0, 0.0, -35.36, 149.16, 600.0], 0, &[]),
    (241, &[0.0, 76.0], 0, &[]),
    (241, &[0.0, 0.0, 0.0, 1.0], 3, &[]),
    (401, &[1.0], 0, &["PreArm: RC calibrating"]),
    (241, &[], 3, &[]),
    (245, &[1.0], 2, &[]),
    (401, &[1.0], 0, &[]),
];

/// The reasons against arming, in order.
const ARMING: &[Row] = &[
    (208, &[3.0], 4, &[]),
    (208, &[1.0], 0, &[]),
    (208, &[2.0], 0, &["Parachute: Landed"]),
    (5300, &[0.0], 0, &[]),
    (
        401,
        &[],
        0,
        &[
            "PreArm: Hardware safety switch",
            "PreArm: Chute has no relay",
        ],
    ),
    (5300, &[1.0], 0, &[]),
    (42424, &[8.0], 4, &[]),
    (42424, &[1.0], 0, &[]),
    (42425, &[], 4, &[]),
    (
        400,
        &[1.0],
        4,
        &[
            "Arm: Compass calibration running",
            "Arm: Chute has no relay",
        ],
    ),
    (42426, &[], 0, &[]),
    (
        400,
        &[1.0],
        4,
        &[
            "Arm: Compass calibrated requires reboot",
            "Arm: Chute has no relay",
        ],
    ),
];

#[test]
fn parameters_of_commands_are_judged_like_the_real_vehicle_judges_them() {
    let mut ground = Ground::new();
    ground.run(2.0);
    for rows in [SETTINGS, PLACES, ARMING] {
        check(&mut ground, rows);
    }
}

fn check(ground: &mut Ground, rows: &[Row]) {
    for (number, p, result, texts) in rows {
        let (got, said) = ask(ground, *number, p);
        assert_eq!((got, said), (*result, texts.map_owned()), "{number} {p:?}");
    }
}

trait Owned {
    fn map_owned(&self) -> Vec<String>;
}

impl Owned for &[&str] {
    fn map_owned(&self) -> Vec<String> {
        self.iter().map(|text| (*text).to_owned()).collect()
    }
}

#[test]
fn places_of_commands_are_judged_by_their_frame() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let there = (-353_632_620, 1_491_652_370, 20.0);
    let nowhere = (0, 0, 0.0);
    let change = [1.0, 1.0, 0.0, 0.0];
    for (number, frame, p, place, result) in [
        (192, 3, change, there, 0),
        (192, 0, change, there, 0),
        (192, 3, change, nowhere, 2),
        (192, 20, change, there, 2),
        (192, 3, [0.0; 4], there, 2),
        (192, 3, change, (950_000_000, 0, 20.0), 2),
        (192, 3, change, (there.0, there.1, 200_000.0), 2),
        (192, 3, change, (there.0, there.1, f32::NAN), 2),
        (179, 0, [0.0; 4], there, 0),
        (179, 20, [0.0; 4], there, 2),
        (179, 20, [0.0; 4], nowhere, 0),
        (201, 3, [0.0; 4], there, 0),
        (201, 20, [0.0; 4], nowhere, 2),
        (195, 20, [0.0; 4], there, 2),
        (22, 3, [0.0; 4], there, 4),
        (22, 0, [0.0; 4], there, 2),
        (22, 6, [0.0; 4], there, 2),
        (84, 3, [0.0; 4], there, 4),
        (176, 0, [0.0; 4], there, 2),
        (20, 0, [0.0; 4], there, 0),
        (31000, 0, [0.0; 4], there, 3),
    ] {
        ask(&mut ground, 176, &[1.0, 0.0]);
        let (got, said) = ask_int(&mut ground, number, (frame, p), place);
        assert_eq!(got, result, "{number} frame {frame} {place:?}");
        let strange = frame == 20 && result == 2;
        assert_eq!(
            said.contains(&"Unknown mavlink coordinate frame 20".to_owned()),
            strange
        );
    }
}

#[test]
fn speed_and_pause_depend_on_the_mode() {
    let mut ground = Ground::new();
    ground.run(2.0);
    for (mode, speed, pause) in [
        (0.0, 4, 4),
        (2.0, 4, 4),
        (4.0, 0, 0),
        (5.0, 4, 4),
        (6.0, 0, 4),
        (9.0, 4, 4),
        (16.0, 4, 4),
        (17.0, 4, 4),
        (20.0, 0, 0),
        (21.0, 0, 4),
    ] {
        assert_eq!(ask(&mut ground, 176, &[1.0, mode]).0, 0);
        for kind in [-1.0, 0.0, 1.0, 2.5, 9.0] {
            assert_eq!(ask(&mut ground, 178, &[kind, 3.0]).0, speed, "{mode}");
        }
        assert_eq!(ask(&mut ground, 178, &[0.0, 0.0]).0, 4);
        assert_eq!(ask(&mut ground, 193, &[0.0]).0, pause, "{mode}");
    }
}

#[test]
fn commands_in_the_air_are_answered_like_the_real_vehicle() {
    let mut ground = Ground::hovering(10.0);
    let rows: &[Row] = &[
        (
            209,
            &[1.0, 1.0, 1100.0, 1.0],
            4,
            &["Motor Test: vehicle not landed"],
        ),
        (401, &[], 1, &[]),
        (42424, &[], 4, &["Disarm to allow compass calibration"]),
        (42426, &[], 0, &[]),
        (241, &[1.0], 4, &["Disarm to allow calibration"]),
        (241, &[], 4, &["Disarm to allow calibration"]),
        (246, &[1.0], 4, &[]),
        (246, &[], 4, &[]),
        (400, &[2.0], 3, &[]),
        (185, &[], 4, &[]),
        (178, &[4.0, 1.0], 0, &[]),
        (193, &[], 0, &[]),
        (193, &[1.0], 0, &[]),
        (183, &[9.0, 1500.0], 0, &[]),
        (208, &[2.0], 0, &[]),
        (22, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 20.0], 4, &[]),
        (245, &[1.0], 2, &[]),
        (245, &[2.0], 0, &["All parameters reset, reboot board"]),
        (185, &[1.0], 0, &["Disarming motors"]),
    ];
    check(&mut ground, rows);
}

#[test]
fn a_motor_test_says_when_it_starts_and_ends() {
    let mut ground = Ground::new();
    ground.heartbeat();
    ground.run(2.0);
    let (result, said) = ask(&mut ground, 209, &[1.0, 0.0, 10.0, 0.5]);
    assert_eq!((result, said), (0, vec!["starting motor test".to_owned()]));
    let before = ground.heard.len();
    ask(&mut ground, 512, &[36.0]);
    let turning = ground.messages_since(before).iter().any(|message| {
        matches!(message, MavMessage::SERVO_OUTPUT_RAW(data) if data.servo3_raw == 1100 && data.servo1_raw == 1000)
    });
    assert!(turning);
    ground.run(1.0);
    assert!(ground.texts().contains(&"finished motor test".to_owned()));
}

#[test]
fn erased_parameters_come_back_as_defaults_after_the_reboot() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("RTL_ALT", 4200.0);
    assert_eq!(ask(&mut ground, 245, &[2.0]).0, 0);
    let value = |ground: &Ground| {
        ground.world.slots[0]
            .autopilot
            .vehicle
            .parameters
            .value("RTL_ALT") as i32
    };
    assert_eq!(value(&ground), 4200, "at work until the reboot");
    assert_eq!(ask(&mut ground, 246, &[1.0]).0, 0);
    ground.run(1.0);
    assert_eq!(value(&ground), 1500);
}
