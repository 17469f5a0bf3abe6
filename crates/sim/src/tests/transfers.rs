//! Transfers of missions, fences and rally points with a ground station.

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_REQUEST_DATA, MISSION_CLEAR_ALL_DATA, MISSION_COUNT_DATA,
    MISSION_ITEM_INT_DATA, MISSION_REQUEST_INT_DATA, MISSION_WRITE_PARTIAL_LIST_DATA, MavCmd,
    MavFrame, MavMessage, MavMissionResult, MavMissionType,
};
use proptest::prelude::*;

use super::Ground;
use sortie_wire::Outgoing;

pub(super) const MISSION: MavMissionType = MavMissionType::MAV_MISSION_TYPE_MISSION;
const FENCE: MavMissionType = MavMissionType::MAV_MISSION_TYPE_FENCE;
const RALLY: MavMissionType = MavMissionType::MAV_MISSION_TYPE_RALLY;

/// An item: command, first parameter, height.
pub(super) type Short = (MavCmd, f32, f32);

fn item(list: MavMissionType, seq: u16, (command, first, height_m): Short) -> MavMessage {
    MavMessage::MISSION_ITEM_INT(MISSION_ITEM_INT_DATA {
        param1: first,
        x: -353_632_620 + i32::from(seq) * 1000,
        y: 1_491_652_370,
        z: height_m,
        seq,
        command,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        target_system: 1,
        mission_type: list,
        ..Default::default()
    })
}

pub(super) fn flight() -> Vec<Short> {
    vec![
        (MavCmd::MAV_CMD_NAV_WAYPOINT, 0.0, 584.0),
        (MavCmd::MAV_CMD_NAV_TAKEOFF, 0.0, 20.0),
        (MavCmd::MAV_CMD_NAV_WAYPOINT, 3.7, 25.0),
        (MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, 0.0, 0.0),
    ]
}

fn square() -> Vec<Short> {
    vec![(MavCmd::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, 3.0, 0.0); 3]
}

pub(super) fn count(ground: &mut Ground, list: MavMissionType, count: u16) {
    ground.say(MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        count,
        target_system: 1,
        mission_type: list,
        ..Default::default()
    }));
}

/// The last acknowledgement among the frames received since `first`.
fn ack(ground: &Ground, first: usize) -> Option<MavMissionResult> {
    let said = ground.messages_since(first);
    said.into_iter().rev().find_map(|message| match message {
        MavMessage::MISSION_ACK(data) => Some(data.mavtype),
        _ => None,
    })
}

/// The items that the vehicle requested.
#[expect(
    deprecated,
    reason = "the vehicle asks in the old way, as ArduCopter does"
)]
pub(super) fn asked_since(ground: &Ground, first: usize) -> Vec<u16> {
    let said = ground.messages_since(first);
    said.iter()
        .filter_map(|message| match message {
            MavMessage::MISSION_REQUEST(data) => Some(data.seq),
            _ => None,
        })
        .collect()
}

/// Uploads a list, each item on request.
pub(super) fn upload(
    ground: &mut Ground,
    list: MavMissionType,
    items: &[Short],
) -> Option<MavMissionResult> {
    let first = ground.heard.len();
    count(ground, list, items.len() as u16);
    for (seq, short) in items.iter().enumerate() {
        let asked = asked_since(ground, first).contains(&(seq as u16));
        if !asked {
            break;
        }
        ground.say(item(list, seq as u16, *short));
    }
    ack(ground, first)
}

pub(super) fn download(
    ground: &mut Ground,
    list: MavMissionType,
    seq: u16,
) -> Option<MISSION_ITEM_INT_DATA> {
    let first = ground.heard.len();
    ground.say(MavMessage::MISSION_REQUEST_INT(MISSION_REQUEST_INT_DATA {
        seq,
        mission_type: list,
        ..Default::default()
    }));
    let said = ground.messages_since(first);
    said.into_iter().find_map(|message| match message {
        MavMessage::MISSION_ITEM_INT(data) => Some(data),
        _ => None,
    })
}

pub(super) fn parameter(ground: &Ground, name: &str) -> Vec<f32> {
    let said = ground.messages_since(0);
    said.into_iter()
        .filter_map(|message| match message {
            MavMessage::PARAM_VALUE(data) if data.param_id.to_str() == Ok(name) => {
                Some(data.param_value)
            }
            _ => None,
        })
        .collect()
}

#[test]
fn a_mission_comes_back_as_the_vehicle_keeps_it() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let result = upload(&mut ground, MISSION, &flight());
    assert_eq!(result, Some(MavMissionResult::MAV_MISSION_ACCEPTED));
    assert!(ground.texts().contains(&"Flight plan received".to_owned()));
    assert_eq!(parameter(&ground, "MIS_TOTAL"), [1.0, 2.0, 3.0, 4.0]);
    let home = download(&mut ground, MISSION, 0).expect("home");
    assert_eq!(
        (home.x, home.frame as u8, home.autocontinue),
        (-353_632_620, 0, 1)
    );
    let point = download(&mut ground, MISSION, 2).expect("there");
    assert_eq!((point.x, point.frame as u8), (-353_630_620, 3));
    assert!((point.param1 - 3.0).abs() < f32::EPSILON);
    let back = download(&mut ground, MISSION, 3).expect("there");
    assert_eq!((back.x, back.y, back.frame as u8), (0, 0, 0));
    let first = ground.heard.len();
    assert_eq!(download(&mut ground, MISSION, 4), None);
    let said = ground.messages_since(first);
    assert!(matches!(&said[0], MavMessage::MISSION_COUNT(data) if data.count == 4));
    assert_eq!(
        ack(&ground, first),
        Some(MavMissionResult::MAV_MISSION_ERROR)
    );
}

#[test]
fn a_refused_upload_leaves_what_came_so_far() {
    let refusals = [
        (
            MavCmd::MAV_CMD_USER_1,
            MavMissionResult::MAV_MISSION_UNSUPPORTED,
        ),
        (
            MavCmd::MAV_CMD_DO_SET_ROI_LOCATION,
            MavMissionResult::MAV_MISSION_UNSUPPORTED,
        ),
        // A jump to item 0.
        (MavCmd::MAV_CMD_DO_JUMP, MavMissionResult::MAV_MISSION_ERROR),
    ];
    for (command, reason) in refusals {
        let mut ground = Ground::new();
        ground.heartbeat();
        upload(&mut ground, MISSION, &flight());
        let bad = [flight()[0], (command, 0.0, 0.0), flight()[1]];
        assert_eq!(upload(&mut ground, MISSION, &bad), Some(reason));
        assert!(
            download(&mut ground, MISSION, 2).is_some(),
            "truncated only"
        );
        assert!(download(&mut ground, MISSION, 3).is_none());
    }
}

#[test]
fn a_silent_uploader_is_asked_every_second_and_given_up_after_eight() {
    let mut ground = Ground::new();
    ground.run(1.0);
    count(&mut ground, MISSION, 4);
    let first = ground.heard.len();
    ground.run(7.9);
    assert_eq!(asked_since(&ground, first), [0; 7]);
    assert_eq!(ack(&ground, first), None);
    ground.run(0.2);
    let cancelled = MavMissionResult::MAV_MISSION_OPERATION_CANCELLED;
    assert_eq!(ack(&ground, first), Some(cancelled));
    assert!(
        ground
            .texts()
            .contains(&"Mission upload timeout".to_owned())
    );
}

#[test]
fn a_wrong_item_is_refused_and_the_upload_goes_on() {
    let mut ground = Ground::new();
    ground.heartbeat();
    count(&mut ground, MISSION, 2);
    let first = ground.heard.len();
    ground.say(item(MISSION, 1, flight()[1]));
    let wrong = MavMissionResult::MAV_MISSION_INVALID_SEQUENCE;
    assert_eq!(ack(&ground, first), Some(wrong));
    ground.say(item(MISSION, 0, flight()[0]));
    ground.say(item(MISSION, 1, flight()[1]));
    let done = MavMissionResult::MAV_MISSION_ACCEPTED;
    assert_eq!(ack(&ground, first), Some(done));
    count(&mut ground, MISSION, 2000);
    let full = MavMissionResult::MAV_MISSION_NO_SPACE;
    assert_eq!(ack(&ground, first), Some(full));
    assert!(
        ground
            .texts()
            .contains(&"Only 650 items are supported".to_owned())
    );
}

#[test]
fn a_part_of_a_mission_can_be_replaced() {
    let mut ground = Ground::new();
    ground.heartbeat();
    upload(&mut ground, MISSION, &flight());
    let first = ground.heard.len();
    let mut partial = MISSION_WRITE_PARTIAL_LIST_DATA {
        start_index: 2,
        end_index: 2,
        target_system: 1,
        ..Default::default()
    };
    ground.say(MavMessage::MISSION_WRITE_PARTIAL_LIST(partial.clone()));
    ground.say(item(MISSION, 2, (MavCmd::MAV_CMD_NAV_WAYPOINT, 9.0, 60.0)));
    let done = MavMissionResult::MAV_MISSION_ACCEPTED;
    assert_eq!(ack(&ground, first), Some(done));
    let replaced = download(&mut ground, MISSION, 2).expect("there");
    assert!((replaced.z - 60.0).abs() < f32::EPSILON);
    assert!(download(&mut ground, MISSION, 3).is_some());
    partial.start_index = -1;
    ground.say(MavMessage::MISSION_WRITE_PARTIAL_LIST(partial));
    let refused = MavMissionResult::MAV_MISSION_ERROR;
    assert_eq!(ack(&ground, first), Some(refused));
}

#[test]
fn a_bad_fence_leaves_the_old_one_intact() {
    let mut ground = Ground::new();
    ground.heartbeat();
    let accepted = Some(MavMissionResult::MAV_MISSION_ACCEPTED);
    assert_eq!(upload(&mut ground, FENCE, &square()), accepted);
    assert_eq!(parameter(&ground, "FENCE_TOTAL"), [5.0]);
    let bad = &square()[..2];
    let error = Some(MavMissionResult::MAV_MISSION_ERROR);
    assert_eq!(upload(&mut ground, FENCE, bad), error);
    let texts = [
        "Fence Indexed OK",
        "Incorrect item count",
        "Fence validation failed",
    ];
    assert!(ground.texts().ends_with(&texts.map(str::to_owned)));
    assert!(download(&mut ground, FENCE, 2).is_some());
    let point = [(MavCmd::MAV_CMD_NAV_RALLY_POINT, 0.0, 12.0)];
    assert_eq!(upload(&mut ground, RALLY, &point), accepted);
    assert_eq!(parameter(&ground, "RALLY_TOTAL"), [1.0]);
    ground.say(MavMessage::MISSION_CLEAR_ALL(MISSION_CLEAR_ALL_DATA {
        mission_type: FENCE,
        ..Default::default()
    }));
    assert!(download(&mut ground, FENCE, 0).is_none());
    assert!(download(&mut ground, RALLY, 0).is_some());
}

#[test]
fn another_ground_station_waits_until_an_upload_is_over() {
    let mut ground = Ground::new();
    ground.heartbeat();
    count(&mut ground, MISSION, 4);
    let other = ground.world.connect(0);
    let mut encoder = sortie_wire::Encoder::new(254, 190);
    let mut bytes = Vec::new();
    let message = MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        count: 2,
        ..Default::default()
    });
    encoder.encode(&message.into(), &mut bytes);
    ground.world.receive(other, &bytes);
    let mut answer = Vec::new();
    ground.world.take_output(other, &mut answer);
    let mut decoder = sortie_wire::Decoder::new();
    decoder.push(&answer);
    let frame = decoder.next_frame().expect("an answer");
    let denied = MavMissionResult::MAV_MISSION_DENIED;
    let sortie_wire::Content::Message(MavMessage::MISSION_ACK(data)) = frame.content else {
        panic!("{frame:?}");
    };
    assert_eq!((data.mavtype, data.target_system), (denied, 254));
}

#[test]
fn the_capabilities_are_those_that_are_served() {
    let mut ground = Ground::new();
    ground.heartbeat();
    let first = ground.heard.len();
    ground.say(MavMessage::AUTOPILOT_VERSION_REQUEST(
        AUTOPILOT_VERSION_REQUEST_DATA::default(),
    ));
    let said = ground.messages_since(first);
    let MavMessage::AUTOPILOT_VERSION(data) = &said[0] else {
        panic!("{said:?}");
    };
    // Missions as floats and integers, FTP, fence and rally points.
    let served = 0x1 | 0x4 | 0x20 | 0x4000 | 0x8000;
    assert_eq!(data.capabilities.bits() & served, served);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn no_payload_brings_the_vehicle_down(
        requests in prop::collection::vec(
            (
                prop::sample::select(vec![38_u32, 39, 40, 43, 44, 45, 47, 51, 73, 110, 117, 119, 121, 122]),
                prop::collection::vec(prop_oneof![Just(0_u8), Just(1), Just(255), any::<u8>()], 0..254),
            ),
            1..20,
        ),
    ) {
        let mut ground = Ground::new();
        for (id, payload) in requests {
            ground.send(&Outgoing::Raw { id, payload });
            ground.step();
        }
        ground.run(0.1);
        // The vehicle still answers.
        let first = ground.heard.len();
        ground.say(MavMessage::AUTOPILOT_VERSION_REQUEST(
            AUTOPILOT_VERSION_REQUEST_DATA::default(),
        ));
        prop_assert!(!ground.messages_since(first).is_empty());
    }
}
