//! Commands, refusals, streams, parameters and bad input.

use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, MISSION_COUNT_DATA, MISSION_REQUEST_LIST_DATA, MavCmd, MavFrame, MavMessage,
    MavMissionResult, MavModeFlag, MavParamType, MavResult, PARAM_REQUEST_LIST_DATA,
    PARAM_REQUEST_READ_DATA, TIMESYNC_DATA,
};
use mavlink::types::CharArray;
use proptest::prelude::*;

use super::ground::GUIDED;
use super::*;
use crate::wire::{Encoder, Outgoing};

const ACCEPTED: MavResult = MavResult::MAV_RESULT_ACCEPTED;
const DENIED: MavResult = MavResult::MAV_RESULT_DENIED;
const UNSUPPORTED: MavResult = MavResult::MAV_RESULT_UNSUPPORTED;
const FAILED: MavResult = MavResult::MAV_RESULT_FAILED;

fn ids(messages: &[MavMessage]) -> Vec<u32> {
    messages.iter().map(mavlink::Message::message_id).collect()
}

#[test]
fn a_silent_port_hears_heartbeats_and_events_only() {
    let mut ground = Ground::new();
    ground.run(12.0);
    let heard = ids(&ground.messages_since(0));
    assert!(
        heard.iter().all(|id| [0, 111, 49, 242].contains(id)),
        "{heard:?}"
    );
    assert_eq!(
        heard.iter().filter(|id| **id == 0).count(),
        13,
        "one per second"
    );
    assert!(heard.contains(&242) && heard.contains(&111));
}

#[test]
fn the_vehicle_is_honest_until_it_is_ready() {
    let mut ground = Ground::new();
    ground.heartbeat();
    ground.run(0.5);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]),
        ACCEPTED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        FAILED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 21196.0]),
        FAILED
    );
    assert!(
        ground
            .texts()
            .contains(&"Arm: Need Position Estimate".to_owned())
    );
    let state = |ground: &mut Ground| {
        let before = ground.heard.len();
        ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [1.0]);
        ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [193.0]);
        let mut state = (false, 0);
        for message in ground.messages_since(before) {
            match message {
                MavMessage::SYS_STATUS(data) => {
                    state.0 = data.onboard_control_sensors_health.bits() & 0x1000_0000 != 0;
                }
                MavMessage::EKF_STATUS_REPORT(data) => state.1 = data.flags.bits(),
                _ => {}
            }
        }
        state
    };
    assert_eq!(state(&mut ground), (false, 0x00A7));
    ground.run(1.0);
    assert_eq!(state(&mut ground), (true, 0x033F));
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
}

#[test]
fn the_ack_comes_before_the_reason_and_names_the_asker() {
    let mut ground = Ground::new();
    let before = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    let said = ground.messages_since(before);
    let MavMessage::COMMAND_ACK(ack) = &said[0] else {
        panic!("{said:?}");
    };
    assert_eq!((ack.target_system, ack.target_component), (255, 190));
    assert!(matches!(said[1], MavMessage::STATUSTEXT(_)));
}

#[test]
fn refusals_are_those_of_the_real_vehicle_on_the_ground() {
    let mut ground = Ground::new();
    ground.run(2.0);
    use MavCmd as C;
    for (command, p, result) in [
        (C::MAV_CMD_NAV_TAKEOFF, [0.0; 4], FAILED),
        (C::MAV_CMD_DO_SET_MODE, [0.0, 4.0, 0.0, 0.0], DENIED),
        (C::MAV_CMD_DO_SET_MODE, [209.0, 4.5, 0.0, 0.0], ACCEPTED),
        (C::MAV_CMD_DO_SET_MODE, [1.0, 99.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_DO_SET_MODE, [1.0, -1.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_DO_SET_MODE, [1.0, 14.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_DO_SET_MODE, [1.0, f32::NAN, 0.0, 0.0], ACCEPTED),
        (C::MAV_CMD_DO_SET_MODE, [1.0, 9.0, 0.0, 0.0], ACCEPTED),
        (
            C::MAV_CMD_COMPONENT_ARM_DISARM,
            [1.0, 0.0, 0.0, 0.0],
            FAILED,
        ),
        (
            C::MAV_CMD_COMPONENT_ARM_DISARM,
            [0.0, 0.0, 0.0, 0.0],
            ACCEPTED,
        ),
        (C::MAV_CMD_CONDITION_YAW, [400.0, 0.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_CONDITION_YAW, [10.0, 0.0, 0.0, 2.0], FAILED),
        (C::MAV_CMD_DO_CHANGE_SPEED, [0.0, -1.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_DO_CHANGE_SPEED, [0.0, 5.0, 0.0, 0.0], ACCEPTED),
        (C::MAV_CMD_DO_REPOSITION, [-1.0, 1.0, 0.0, 0.0], UNSUPPORTED),
        (C::MAV_CMD_NAV_WAYPOINT, [0.0; 4], UNSUPPORTED),
        (C::MAV_CMD_DO_ORBIT, [0.0; 4], UNSUPPORTED),
        (C::MAV_CMD_PREFLIGHT_STORAGE, [1.0, 0.0, 0.0, 0.0], DENIED),
        (C::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [0.0; 4], UNSUPPORTED),
        (
            C::MAV_CMD_SET_MESSAGE_INTERVAL,
            [12345.0, 1000.0, 0.0, 0.0],
            DENIED,
        ),
        (C::MAV_CMD_REQUEST_MESSAGE, [141.0, 0.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_REQUEST_MESSAGE, [148.0, 0.0, 0.0, 0.0], ACCEPTED),
        (C::MAV_CMD_DO_SET_SERVO, [1.0, 1500.0, 0.0, 0.0], FAILED),
        (C::MAV_CMD_DO_SET_SERVO, [9.0, 1500.0, 0.0, 0.0], ACCEPTED),
    ] {
        assert_eq!(ground.long(command, p), result, "{command:?} {p:?}");
    }
    for text in [
        "No such mode 99",
        "No such mode 255",
        "Mode change to FLIP failed: init failed",
        "Arm: LAND mode not armable",
        "No ap_message for mavlink id (12345)",
    ] {
        assert!(ground.texts().iter().any(|said| said == text), "{text}");
    }
}

#[test]
fn refusals_are_those_of_the_real_vehicle_in_the_air() {
    let mut ground = Ground::hovering(10.0);
    let mut takeoff = [0.0; 7];
    takeoff[6] = 20.0;
    assert_eq!(ground.long7(MavCmd::MAV_CMD_NAV_TAKEOFF, takeoff), FAILED);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21195.0]),
        FAILED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]),
        FAILED
    );
    assert_eq!(ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 3.0]), FAILED);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 27.0]),
        FAILED
    );
    let texts = ground.texts();
    assert!(
        texts.iter().any(|t| t == "landing sequence found"),
        "two chunks: {texts:?}"
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_FLIGHTTERMINATION, [1.0]),
        ACCEPTED
    );
    assert!(!ground.truth().armed);
}

#[test]
fn commands_without_a_name_and_for_others_are_treated_as_the_vehicle_does() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let raw = |number: u16, system: u8| {
        let mut payload = vec![0; 33];
        payload[28..30].copy_from_slice(&number.to_le_bytes());
        payload[30] = system;
        Outgoing::Raw { id: 76, payload }
    };
    let before = ground.heard.len();
    ground.send(&raw(9999, 1));
    let frame = ground.heard.last().expect("an answer");
    assert_eq!(frame.content.id(), 77);
    let crate::wire::Content::Undecoded { payload, .. } = &frame.content else {
        panic!("{frame:?}");
    };
    assert_eq!(
        (payload[0..2].to_vec(), payload[2]),
        (9999u16.to_le_bytes().to_vec(), 3)
    );
    assert_eq!(ground.heard.len(), before + 1);
    ground.send(&raw(400, 77));
    assert_eq!(ground.heard.len(), before + 1, "not for this vehicle");
    ground.send(&raw(400, 0));
    assert_eq!(ground.heard.len(), before + 2, "a broadcast");
}

#[test]
fn takeoff_by_command_int_wants_the_relative_frame() {
    let mut ground = Ground::armed();
    let takeoff = |frame| COMMAND_INT_DATA {
        command: MavCmd::MAV_CMD_NAV_TAKEOFF,
        z: 10.0,
        frame,
        ..Default::default()
    };
    assert_eq!(ground.int(takeoff(MavFrame::MAV_FRAME_GLOBAL)), DENIED);
    ground.goto([10.0, 0.0, -10.0]);
    ground.run(3.0);
    assert!(
        ground.truth().on_ground,
        "targets before the takeoff are ignored"
    );
    assert_eq!(
        ground.int(takeoff(MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT)),
        ACCEPTED
    );
    ground.run(5.0);
    assert!(!ground.truth().on_ground);
}

#[test]
fn armed_and_idle_the_vehicle_disarms_after_its_delay() {
    let mut ground = Ground::armed();
    let delay = ground.until(20.0, |t| !t.armed);
    assert!((delay - 10.0).abs() < 0.1, "{delay}");
    ground.set("DISARM_DELAY", 0.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
    ground.run(30.0);
    assert!(ground.truth().armed);
}

#[test]
fn a_mode_change_sends_a_heartbeat_at_once() {
    let mut ground = Ground::new();
    ground.run(1.5);
    let before = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]);
    let said = ground.messages_since(before);
    let beat = said.iter().find_map(|message| match message {
        MavMessage::HEARTBEAT(data) => Some(data),
        _ => None,
    });
    let beat = beat.expect("a heartbeat");
    assert_eq!(beat.custom_mode, 4);
    assert_eq!(beat.base_mode.bits(), 89);
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    let before = ground.heard.len();
    ground.run(1.1);
    let armed = ground.messages_since(before).iter().any(|message| {
        matches!(message, MavMessage::HEARTBEAT(data) if data.base_mode.contains(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED))
    });
    assert!(armed);
}

#[test]
#[expect(deprecated, reason = "ArduPilot's own frame for body offsets")]
fn targets_work_in_every_frame_that_the_real_vehicle_has() {
    use MavFrame as F;
    for (frame, p, goal) in [
        (
            F::MAV_FRAME_LOCAL_NED,
            [10.0, 20.0, -15.0],
            [10.0, 20.0, -15.0],
        ),
        (
            F::MAV_FRAME_LOCAL_OFFSET_NED,
            [10.0, 0.0, -5.0],
            [10.0, 0.0, -15.0],
        ),
        (
            F::MAV_FRAME_BODY_OFFSET_NED,
            [10.0, 0.0, 0.0],
            [0.0, 10.0, -10.0],
        ),
    ] {
        let mut ground = Ground::hovering(10.0);
        ground.long(MavCmd::MAV_CMD_CONDITION_YAW, [90.0, 0.0, 1.0, 0.0]);
        ground.run(6.0);
        ground.target(p, [0.0; 3], 0x0DF8, frame);
        ground.run(20.0);
        let at = ground.truth().position_ned_m;
        for axis in 0..3 {
            assert!(
                (at[axis] - f64::from(goal[axis] as f32)).abs() < 0.5,
                "{frame:?}: {at:?}"
            );
        }
    }
}

#[test]
fn nonsense_targets_stop_the_vehicle() {
    for (p, mask, frame) in [
        (
            [f32::NAN, 0.0, -10.0],
            0x0DF8,
            MavFrame::MAV_FRAME_LOCAL_NED,
        ),
        (
            [f32::INFINITY, 0.0, -10.0],
            0x0DF8,
            MavFrame::MAV_FRAME_LOCAL_NED,
        ),
        ([0.0; 3], 0x0FFF, MavFrame::MAV_FRAME_LOCAL_NED),
        ([0.0; 3], 0x0DF8, MavFrame::MAV_FRAME_LOCAL_FLU),
    ] {
        let mut ground = Ground::hovering(10.0);
        ground.goto([200.0, 0.0, -10.0]);
        ground.run(5.0);
        ground.target(p, [0.0; 3], mask, frame);
        ground.run(10.0);
        let truth = ground.truth();
        assert!(truth.velocity_ned_m_s[0].abs() < 0.3, "{truth:?}");
        assert!(truth.position_ned_m[0] < 80.0 && truth.armed);
    }
}

#[test]
fn repositioning_pausing_and_going_on() {
    let mut ground = Ground::hovering(10.0);
    let goal = start().at.moved(100.0, 0.0);
    let (x, y) = goal.to_e7();
    let reposition = |flag: f32| COMMAND_INT_DATA {
        command: MavCmd::MAV_CMD_DO_REPOSITION,
        param1: -1.0,
        param2: flag,
        x,
        y,
        z: 20.0,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        ..Default::default()
    };
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 17.0]);
    assert_eq!(ground.int(reposition(0.0)), DENIED);
    assert_eq!(ground.int(reposition(1.0)), ACCEPTED);
    ground.run(4.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, [0.0]),
        ACCEPTED
    );
    ground.run(8.0);
    assert!(ground.truth().velocity_ned_m_s[0].abs() < 0.2);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, [1.0]),
        ACCEPTED
    );
    ground.run(20.0);
    let truth = ground.truth();
    assert!(
        truth.at.distance_m(goal) < 1.0 && (truth.altitude_amsl_m - 604.0).abs() < 0.3,
        "{truth:?}"
    );
}

#[test]
fn streams_come_at_the_asked_rate_and_only_on_the_asking_port() {
    let mut ground = Ground::new();
    let other = ground.world.connect(0);
    ground.run(2.0);
    ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [33.0, 100_000.0]);
    let mut rest = Vec::new();
    ground.world.take_output(other, &mut rest);
    rest.clear();
    let before = ground.heard.len();
    ground.run(14.0);
    let count = ids(&ground.messages_since(before))
        .iter()
        .filter(|id| **id == 33)
        .count();
    assert!((139..=141).contains(&count), "{count}");
    ground.world.take_output(other, &mut rest);
    assert!(
        rest.len() < 1000,
        "the other port hears heartbeats only: {}",
        rest.len()
    );
}

#[test]
fn parameters_are_listed_read_and_set_like_the_real_ones() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let before = ground.heard.len();
    ground.say(MavMessage::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA {
        target_system: 1,
        target_component: 1,
    }));
    ground.run(0.5);
    let listed: Vec<_> = ground
        .messages_since(before)
        .into_iter()
        .filter_map(|message| match message {
            MavMessage::PARAM_VALUE(data) => Some((data.param_index, data.param_count)),
            _ => None,
        })
        .collect();
    let count = listed[0].1;
    assert!(count > 150);
    assert_eq!(
        listed,
        (0..count).map(|index| (index, count)).collect::<Vec<_>>()
    );

    let before = ground.heard.len();
    ground.say(MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: -1,
        target_system: 1,
        target_component: 1,
        param_id: CharArray::from("rtl_alt"),
    }));
    ground.set("NO_SUCH", 1.0);
    ground.set("RTL_ALT", f32::NAN);
    ground.set("RTL_ALT", 2000.9);
    let answers: Vec<_> = ground
        .messages_since(before)
        .into_iter()
        .filter_map(|message| match message {
            MavMessage::PARAM_VALUE(data) => Some(data),
            _ => None,
        })
        .collect();
    assert_eq!(answers.len(), 2, "{answers:?}");
    assert_eq!(answers[0].param_index, u16::MAX);
    assert_eq!(answers[0].param_id.to_str(), Ok("rtl_alt"));
    assert_eq!(answers[0].param_type, MavParamType::MAV_PARAM_TYPE_INT32);
    assert!((answers[1].param_value - 2000.0).abs() < f32::EPSILON);
}

#[test]
fn plans_time_and_versions_are_answered() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let before = ground.heard.len();
    ground.say(MavMessage::MISSION_REQUEST_LIST(
        MISSION_REQUEST_LIST_DATA::default(),
    ));
    ground.say(MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        count: 3,
        target_system: 1,
        ..Default::default()
    }));
    ground.say(MavMessage::TIMESYNC(TIMESYNC_DATA {
        ts1: 77,
        ..Default::default()
    }));
    let said = ground.messages_since(before);
    assert!(matches!(&said[0], MavMessage::MISSION_COUNT(data) if data.count == 0));
    assert!(
        matches!(&said[1], MavMessage::MISSION_ACK(data) if data.mavtype == MavMissionResult::MAV_MISSION_UNSUPPORTED)
    );
    assert!(
        matches!(&said[2], MavMessage::TIMESYNC(data) if data.ts1 == 77 && data.tc1 == 2_000_000_000)
    );
}

#[test]
fn a_reboot_drops_the_link_and_keeps_the_parameters() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("WPNAV_SPEED", 700.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]),
        ACCEPTED
    );
    assert!(ground.world.is_open(ground.port));
    ground.run(0.3);
    assert!(!ground.world.is_open(ground.port));
    ground.port = ground.world.connect(0);
    let before = ground.heard.len();
    ground.say(MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: -1,
        target_system: 1,
        target_component: 1,
        param_id: CharArray::from("WPNAV_SPEED"),
    }));
    let said = ground.messages_since(before);
    assert!(
        matches!(&said[0], MavMessage::PARAM_VALUE(data) if (data.param_value - 700.0).abs() < 0.1)
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        FAILED,
        "not ready again yet"
    );
}

#[test]
fn a_port_that_nobody_reads_keeps_a_bounded_number_of_whole_frames() {
    let mut world = World::new(&WorldConfig::row(1, start(), 5.0));
    let port = world.connect(0);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(255, 190);
    let mut ask = |p1: f32| {
        let mut payload = vec![0; 33];
        payload[0..4].copy_from_slice(&p1.to_le_bytes());
        payload[4..8].copy_from_slice(&1000f32.to_le_bytes());
        payload[28..30].copy_from_slice(&511u16.to_le_bytes());
        encoder.encode(&Outgoing::Raw { id: 76, payload }, &mut bytes);
    };
    ask(30.0);
    ask(147.0);
    world.receive(port, &bytes);
    for _ in 0..4000 {
        world.step();
    }
    let mut output = Vec::new();
    world.take_output(port, &mut output);
    assert!(
        output.len() <= 256 * 1024 && output.len() > 200 * 1024,
        "{}",
        output.len()
    );
    let mut decoder = crate::wire::Decoder::new();
    decoder.push(&output);
    while decoder.next_frame().is_some() {}
    assert_eq!(decoder.counters().skipped_bytes, 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_bytes_harm_nothing(noise in prop::collection::vec(any::<u8>(), 0..4000)) {
        let mut ground = Ground::new();
        let port = ground.port;
        ground.world.receive(port, &noise);
        ground.run(2.0);
        prop_assert_eq!(ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]), ACCEPTED);
    }

    #[test]
    fn valid_frames_with_random_fields_never_break_the_flight(
        frames in prop::collection::vec((prop::sample::select(vec![11u32, 20, 21, 23, 43, 44, 66, 70, 75, 76, 82, 84, 86, 110, 111]), prop::collection::vec(any::<u8>(), 60), any::<bool>()), 1..80),
        commands in prop::collection::vec((0u16..600, prop::array::uniform7(prop::num::f32::ANY)), 1..80),
    ) {
        let mut ground = Ground::hovering(10.0);
        for (id, mut payload, own) in frames {
            if own && payload.len() > 50 { payload[30] = 1; payload[50] = 1; payload[4] = 1; }
            ground.send(&Outgoing::Raw { id, payload });
            ground.run(0.05);
        }
        for (number, p) in commands {
            let mut payload = vec![0; 33];
            for (i, value) in p.iter().enumerate() {
                payload[4 * i..4 * i + 4].copy_from_slice(&value.to_le_bytes());
            }
            payload[28..30].copy_from_slice(&number.to_le_bytes());
            ground.send(&Outgoing::Raw { id: 76, payload });
            ground.run(0.05);
        }
        ground.run(5.0);
        let truth = ground.truth();
        prop_assert!(truth.position_ned_m.iter().chain(&truth.velocity_ned_m_s).all(|v| v.is_finite()), "{:?}", truth);
        prop_assert!(truth.heading_deg.is_finite() && truth.altitude_amsl_m >= 583.9);
    }
}

#[test]
fn equal_worlds_say_equal_bytes() {
    let run = || {
        let mut world = World::new(&WorldConfig {
            seed: 9,
            ..WorldConfig::row(3, start(), 5.0)
        });
        let port = world.connect(2);
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(255, 190);
        encoder.set_version(MavlinkVersion::V1);
        for (number, p) in [(511u16, [30.0f32, 20_000.0]), (176, [1.0, GUIDED])] {
            let mut payload = vec![0; 33];
            payload[0..4].copy_from_slice(&p[0].to_le_bytes());
            payload[4..8].copy_from_slice(&p[1].to_le_bytes());
            payload[28..30].copy_from_slice(&number.to_le_bytes());
            encoder.encode(&Outgoing::Raw { id: 76, payload }, &mut bytes);
        }
        world.receive(port, &bytes);
        let mut output = Vec::new();
        for _ in 0..500 {
            world.step();
            world.take_output(port, &mut output);
        }
        output
    };
    let first = run();
    assert!(first.len() > 3000, "{}", first.len());
    assert_eq!(first, run());
}
