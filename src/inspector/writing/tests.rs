//! Tests that fields written by name are read back unchanged.

use mavlink::dialects::ardupilotmega::MavMessage;
use proptest::prelude::*;

use super::*;
use crate::wire::{Encoder, Outgoing};

fn message(name: &str) -> &'static MessageDefinition {
    Definitions::get().named(name).expect(name).1
}

fn bytes(name: &str, text: &str) -> Vec<u8> {
    let written = write(message(name), text);
    written
        .unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
        .bytes
}

/// The words that a fault covers, its message and its advice.
fn fault(name: &str, text: &str) -> [String; 3] {
    let fault = write(message(name), text).expect_err(text);
    let help = fault.help.map_or(String::new(), |help| help.to_string());
    [text[fault.span].to_owned(), fault.message.to_string(), help]
}

#[test]
fn values_are_numbers_names_masks_lists_and_texts() {
    for text in [
        "custom_mode=513 type=2 base_mode=129 mavlink_version=3",
        "custom_mode=0x201 TYPE=quadrotor base_mode=SAFETY_ARMED|1 mavlink_version=3",
        "type = MAV_TYPE_QUADROTOR  custom_mode=5.13e2 base_mode=MAV_MODE_FLAG_SAFETY_ARMED|CUSTOM_MODE_ENABLED mavlink_version=3",
    ] {
        assert_eq!(
            bytes("heartbeat", text),
            [1, 2, 0, 0, 2, 0, 129, 0, 3],
            "{text}"
        );
    }
    let q = bytes("SET_ATTITUDE_TARGET", "q=[ 1, -0.5 ] thrust=NaN");
    assert_eq!(q[4..8], 1.0_f32.to_le_bytes());
    assert_eq!(q[8..12], (-0.5_f32).to_le_bytes());
    assert!(
        q[12..20].iter().all(|&byte| byte == 0),
        "the rest of the list"
    );
    let thrust = q[32..36].try_into().expect("four bytes");
    assert!(f32::from_le_bytes(thrust).is_nan());
    let text = bytes(
        "STATUSTEXT",
        r##"severity=ALERT text="no \"#1\" \x41 = b""##,
    );
    assert_eq!(text[..16], *b"\x01no \"#1\" A = b\0\0");
    let bare = bytes("PARAM_SET", "param_id=WPNAV_SPEED");
    assert_eq!(bare[6..18], *b"WPNAV_SPEED\0");
}

#[test]
fn the_receiver_is_open_only_where_the_text_omits_it() {
    let open = write(
        message("PARAM_REQUEST_READ"),
        "target_component=5 param_index=-1",
    );
    let open = open.expect("good");
    assert_eq!((open.open_system, open.open_component), (Some(2), None));
    assert_eq!(open.addressed(3, 1)[..4], [0xFF, 0xFF, 3, 5]);
    let beat = write(message("HEARTBEAT"), "").expect("good");
    assert_eq!((beat.open_system, beat.addressed(3, 1)), (None, vec![0; 9]));
}

#[test]
fn extensions_are_sent_only_if_they_are_not_zero() {
    for (text, len) in [("", 30), ("yaw=0", 30), ("yaw=1", 52)] {
        let written = write(message("GPS_RAW_INT"), text).expect(text);
        assert_eq!(written.addressed(1, 1).len(), len, "{text}");
    }
}

/// A message, its fields, and the words that the fault covers, its message and its advice.
type FaultCase<'a> = (&'a str, &'a str, [&'a str; 3]);

#[track_caller]
fn check(cases: &[FaultCase<'_>]) {
    for (name, text, expected) in cases {
        assert_eq!(fault(name, text), *expected, "{text}");
    }
}

#[test]
fn faults_in_names_and_numbers_have_a_place_a_reason_and_advice() {
    check(&[
        (
            "HEARTBEAT",
            "typ=2",
            [
                "typ",
                "HEARTBEAT has no field `typ`",
                "did you mean `type`?",
            ],
        ),
        (
            "COMMAND_ACK",
            "wrong=2",
            [
                "wrong",
                "COMMAND_ACK has no field `wrong`",
                "its fields: command, result, progress, result_param2, target_system, target_component",
            ],
        ),
        (
            "HEARTBEAT",
            "type=QUADROTR",
            [
                "QUADROTR",
                "MAV_TYPE has no value `QUADROTR`",
                "did you mean `QUADROTOR`?",
            ],
        ),
        (
            "HEARTBEAT",
            "base_mode=SAFETY_ARMED|MAV_MODE_FLAG_AUTO_ENABLD",
            [
                "MAV_MODE_FLAG_AUTO_ENABLD",
                "MAV_MODE_FLAG has no value `MAV_MODE_FLAG_AUTO_ENABLD`",
                "did you mean `AUTO_ENABLED`?",
            ],
        ),
        (
            "HEARTBEAT",
            "custom_mode=1 type=256",
            ["256", "type: `256` is out of range: 0 to 255", ""],
        ),
        (
            "ATTITUDE",
            "roll=1e39",
            ["1e39", "roll: `1e39` is out of range: a number", ""],
        ),
        (
            "HEARTBEAT",
            "type=1.5",
            ["1.5", "`1.5` is not a whole number", ""],
        ),
        (
            "PARAM_REQUEST_READ",
            "param_index=x",
            ["x", "param_index: `x` is not a number", ""],
        ),
    ]);
}

#[test]
fn faults_in_the_shape_of_a_value_have_a_place_a_reason_and_advice() {
    check(&[
        (
            "ATTITUDE_QUATERNION",
            "repr_offset_q=[1,2,3,4, 5]",
            ["5", "repr_offset_q has only 4 elements", ""],
        ),
        (
            "ATTITUDE_QUATERNION",
            "repr_offset_q=1",
            [
                "1",
                "repr_offset_q is a list of up to 4 numbers",
                "write it as `repr_offset_q=[1,2]`",
            ],
        ),
        (
            "ATTITUDE",
            "roll=[1]",
            ["[1]", "roll takes one value, not a list", ""],
        ),
        (
            "ATTITUDE",
            "roll=\"1\"",
            ["\"1\"", "roll takes a number, not text", ""],
        ),
        (
            "PARAM_SET",
            "param_id=SEVENTEEN_LETTERS",
            ["SEVENTEEN_LETTERS", "param_id has room for 16 bytes", ""],
        ),
        (
            "ATTITUDE",
            "roll=1 roll=2",
            ["roll", "the field `roll` is given twice", ""],
        ),
        (
            "ATTITUDE",
            "roll= ",
            [
                "roll",
                "the value of `roll` is missing",
                "write each field as `NAME=VALUE`",
            ],
        ),
        (
            "STATUSTEXT",
            "text=\"open",
            ["\"open", "the closing `\"` is missing", ""],
        ),
        (
            "STATUSTEXT",
            "text=\"a\\n\"",
            ["\\", "unknown escape: write `\\\\`, `\\\"` or `\\x41`", ""],
        ),
    ]);
}

#[test]
fn names_may_be_written_with_their_enum() {
    let field = |name: &str, text: &str| bytes(name, text)[..4].to_vec();
    let short = field("EKF_STATUS_REPORT", "velocity_variance=1");
    assert_eq!(short, 1.0_f32.to_le_bytes());
    let wrong = fault("HEARTBEAT", "type=MAV_STATE_QUADROTOR");
    assert_eq!(wrong[0], "MAV_STATE_QUADROTOR");
}

fn frame_of(id: u32, payload: Vec<u8>) -> Vec<u8> {
    let mut bytes = Vec::new();
    Encoder::new(1, 1).encode(&Outgoing::Raw { id, payload }, &mut bytes);
    bytes
}

#[test]
fn secrets_are_never_written_out() {
    let frame = frame_of(256, vec![7; 42]);
    let anatomy = Anatomy::of(&frame).expect("a frame");
    assert_eq!(written(&anatomy), None);
}

#[test]
fn a_frame_becomes_a_line_that_can_be_edited() {
    let frame = frame_of(0, vec![4, 0, 0, 0, 2, 3, 209, 4, 3]);
    let line = written(&Anatomy::of(&frame).expect("a frame"));
    assert_eq!(
        line.as_deref(),
        Some(
            "HEARTBEAT custom_mode=4 type=QUADROTOR autopilot=ARDUPILOTMEGA \
             base_mode=CUSTOM_MODE_ENABLED|STABILIZE_ENABLED|MANUAL_INPUT_ENABLED|SAFETY_ARMED \
             system_status=ACTIVE mavlink_version=3"
        )
    );
}

proptest! {
    /// Any frame of the dialect is written as a line that gives its payload again, except for its receiver and the
    /// bits of a NaN.
    #[test]
    fn every_frame_is_read_back_from_its_line(
        place in 0usize..1000,
        noise in prop::collection::vec(prop_oneof![Just(0u8), any::<u8>()], 255),
    ) {
        let all = MavMessage::all_messages();
        let (_, id) = all[place % all.len()];
        let definition = Definitions::get().message(id).expect("in the table");
        let len: usize = definition.fields.iter().map(FieldDefinition::wire_len).sum();
        let frame = frame_of(id, noise[..len].to_vec());
        let anatomy = Anatomy::of(&frame).expect("a frame");
        let Some(line) = written(&anatomy) else {
            prop_assert!(is_secret(id));
            return Ok(());
        };
        let (_, fields) = line.split_once(' ').unwrap_or((&line, ""));
        let again = write(definition, fields);
        let again = again.unwrap_or_else(|fault| panic!("{line}: {fault:?}")).bytes;
        for (field, at) in placed(definition) {
            let place = at..at + field.wire_len();
            let [before, after] = [&noise[place.clone()], &again[place]];
            if field.name.starts_with("target_") && before != after {
                continue;
            }
            let numbers = before.chunks(field.kind.wire_len()).zip(after.chunks(field.kind.wire_len()));
            for (before, after) in numbers {
                let [old, new] = [before, after].map(|bytes| element(field.kind, bytes).number());
                prop_assert!(before == after || old.is_nan() && new.is_nan(), "{}: {line}", field.name);
            }
        }
    }
}
