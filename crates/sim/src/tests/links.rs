//! Streams, parameters, plans, reboots and bad input.

use mavlink::MavlinkVersion;
use mavlink::dialects::ardupilotmega::{
    MISSION_COUNT_DATA, MISSION_REQUEST_LIST_DATA, MavCmd, MavMessage, MavParamType, MavResult,
    PARAM_REQUEST_LIST_DATA, PARAM_REQUEST_READ_DATA, TIMESYNC_DATA,
};
use mavlink::types::CharArray;
use proptest::prelude::*;

use super::ground::GUIDED;
use super::*;
use sortie_wire::{Encoder, Outgoing};

const ACCEPTED: MavResult = MavResult::MAV_RESULT_ACCEPTED;
const FAILED: MavResult = MavResult::MAV_RESULT_FAILED;

#[test]
fn parameters_are_listed_read_and_set_like_the_real_ones() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let before = ground.heard.len();
    ground.say(MavMessage::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA {
        target_system: 1,
        target_component: 1,
    }));
    ground.run(0.7);
    let listed: Vec<_> = ground
        .messages_since(before)
        .into_iter()
        .filter_map(|message| match message {
            MavMessage::PARAM_VALUE(data) => Some((data.param_index, data.param_count)),
            _ => None,
        })
        .collect();
    let count = listed[0].1;
    assert_eq!(count, 1382);
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
    assert_eq!(super::transfers::asked_since(&ground, before), [0]);
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
    let mut world = World::new(&WorldConfig::row(1, start()));
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
    let mut decoder = sortie_wire::Decoder::new();
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
        frames in prop::collection::vec((prop::sample::select(vec![11u32, 20, 21, 23, 43, 44, 66, 70, 75, 76, 82, 84, 86, 110, 111, 256]), prop::collection::vec(any::<u8>(), 60), any::<bool>()), 1..80),
        commands in prop::collection::vec((0u16..600, prop::array::uniform7(prop::num::f32::ANY)), 1..80),
    ) {
        let mut ground = Ground::hovering(10.0);
        for (id, mut payload, own) in frames {
            if own && payload.len() > 50 { payload[30] = 1; payload[50] = 1; payload[4] = 1; payload[8] = 1; }
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
            ..WorldConfig::row(3, start())
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_parameter_value_makes_the_flight_infinite(
        values in prop::collection::vec((0u16..1382, prop::num::f32::ANY), 1..40),
    ) {
        let mut ground = Ground::hovering(10.0);
        let names = crate::parameters::Parameters::new(crate::VehicleKind::Copter, 1);
        for (index, value) in values {
            let name = names.at(index).map_or("", |parameter| parameter.name);
            // This parameter makes the vehicle ignore the test's ground station, as it should.
            if name != "SYSID_ENFORCE" {
                ground.set(name, value);
            }
        }
        ground.goto([100.0, 50.0, -20.0]);
        ground.run(5.0);
        for mode in [7.0, 5.0, 17.0, 4.0, 6.0] {
            ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, mode]);
            ground.run(3.0);
        }
        let truth = ground.truth();
        let numbers = truth.position_ned_m.iter().chain(&truth.velocity_ned_m_s);
        prop_assert!(numbers.into_iter().all(|v| v.is_finite()), "{:?}", truth);
        prop_assert!(truth.position_ned_m[2] <= 0.0 && truth.heading_deg.is_finite());
    }
}
