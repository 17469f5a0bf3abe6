//! Several serial ports, and several ground stations on each.

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MavCmd, MavMessage, MavResult, PARAM_REQUEST_LIST_DATA,
    PARAM_REQUEST_READ_DATA,
};
use mavlink::types::CharArray;

use super::*;
use sortie_wire::{Decoder, Encoder};

const ATTITUDE: u32 = 30;
const PARAM_VALUE: u32 = 22;
const COMMAND_ACK: u32 = 77;

/// The message ids that wait on a port.
fn take(world: &mut World, port: PortId) -> Vec<u32> {
    let (mut bytes, mut decoder) = (Vec::new(), Decoder::new());
    world.take_output(port, &mut bytes);
    decoder.push(&bytes);
    std::iter::from_fn(|| decoder.next_frame())
        .map(|frame| frame.content.id())
        .collect()
}

fn count(ids: &[u32], id: u32) -> usize {
    ids.iter().filter(|own| **own == id).count()
}

/// A ground station on serial 0 that has requested `ATTITUDE` at 10 Hz.
fn streaming() -> Ground {
    let mut ground = Ground::new();
    ground.run(2.0);
    let accepted = ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [30.0, 100_000.0]);
    assert_eq!(accepted, MavResult::MAV_RESULT_ACCEPTED);
    ground
}

#[test]
fn each_serial_port_has_its_own_rates() {
    let mut ground = streaming();
    let others = [Serial::One, Serial::Two].map(|serial| ground.world.connect_to(0, serial));
    let before = ground.heard.len();
    ground.run(14.0);
    let heard: Vec<u32> = ground.heard[before..]
        .iter()
        .map(|frame| frame.content.id())
        .collect();
    let streamed = count(&heard, ATTITUDE);
    assert!((139..=141).contains(&streamed), "{streamed}");
    for other in others {
        let ids = take(&mut ground.world, other);
        assert_eq!(count(&ids, ATTITUDE), 0);
        assert!((14..=15).contains(&count(&ids, 0)), "{ids:?}");
    }
}

#[test]
fn rates_outlast_the_one_who_asked_and_end_with_a_reboot() {
    let mut ground = streaming();
    ground.world.disconnect(ground.port);
    ground.run(60.0);
    ground.port = ground.world.connect(0);
    ground.run(0.01);
    let port = ground.port;
    let at_once = ground.heard.len();
    for _ in 0..200 {
        ground.world.step();
    }
    let ids = take(&mut ground.world, port);
    assert!((19..=21).contains(&count(&ids, ATTITUDE)), "{ids:?}");
    assert!(at_once > 0, "the next one is served at once");

    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(0.5);
    let port = ground.world.connect(0);
    ground.run(2.0);
    assert_eq!(count(&take(&mut ground.world, port), ATTITUDE), 0);
}

#[test]
fn all_on_one_serial_port_get_its_streams_and_only_the_asker_its_answers() {
    let mut ground = streaming();
    let other = ground.world.connect(0);
    let list = MavMessage::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA {
        target_system: 1,
        target_component: 1,
    });
    ground.say(list);
    ground.say(MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: -1,
        target_system: 1,
        target_component: 1,
        param_id: CharArray::from("RTL_ALT"),
    }));
    ground.long(MavCmd::MAV_CMD_DO_SEND_BANNER, [0.0]);
    ground.run(1.0);
    let ids = take(&mut ground.world, other);
    assert!((9..=11).contains(&count(&ids, ATTITUDE)), "{ids:?}");
    assert_eq!(count(&ids, PARAM_VALUE) + count(&ids, COMMAND_ACK), 0);
    assert!(count(&ids, 253) > 0, "texts are for everybody: {ids:?}");
    ground.set("RTL_ALT", 1600.0);
    let ids = take(&mut ground.world, other);
    assert_eq!(ids, [PARAM_VALUE], "everybody hears of a change");
}

#[test]
fn nobody_sees_gaps_because_others_are_answered() {
    let mut ground = streaming();
    let other = ground.world.connect(0);
    for _ in 0..20 {
        ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [148.0]);
        ground.run(0.1);
    }
    let (mut bytes, mut decoder) = (Vec::new(), Decoder::new());
    ground.world.take_output(other, &mut bytes);
    decoder.push(&bytes);
    let mut next = 0;
    while let Some(frame) = decoder.next_frame() {
        assert_eq!(frame.sequence, next);
        next += 1;
    }
    assert!(next > 15);
}

#[test]
fn rates_in_parameters_count_from_the_next_boot_on() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("SR1_EXTRA1", 4.0);
    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(0.5);
    let ports = Serial::ALL.map(|serial| ground.world.connect_to(0, serial));
    for _ in 0..1000 {
        ground.world.step();
    }
    let counts = ports.map(|port| count(&take(&mut ground.world, port), ATTITUDE));
    assert_eq!((counts[0], counts[2]), (0, 0));
    assert!((39..=41).contains(&counts[1]), "{counts:?}");
}

#[test]
fn beyond_254_vehicles_system_ids_repeat_and_ports_tell_the_vehicles_apart() {
    let mut world = World::new(&WorldConfig::row(300, start()));
    let ports = [0, 253, 254, 299].map(|vehicle| world.connect(vehicle));
    for _ in 0..200 {
        world.step();
    }
    let systems = ports.map(|port| {
        let (mut bytes, mut decoder) = (Vec::new(), Decoder::new());
        world.take_output(port, &mut bytes);
        decoder.push(&bytes);
        decoder.next_frame().expect("a heartbeat").system
    });
    assert_eq!(systems, [1, 254, 1, 46]);
    let mut bytes = Vec::new();
    let arm = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_DO_SET_MODE,
        param1: 1.0,
        param2: 4.0,
        target_system: 1,
        ..Default::default()
    });
    Encoder::new(255, 190).encode_message(&arm, &mut bytes);
    world.receive(ports[2], &bytes);
    assert_eq!((world.truth(0).mode, world.truth(254).mode), (0, 4));
}

#[test]
fn ports_leave_nothing_behind() {
    let mut world = World::new(&WorldConfig::row(2, start()));
    let keeper = world.connect(1);
    for round in 0..100 {
        let ports = Serial::ALL.map(|serial| world.connect_to(round % 2, serial));
        assert_eq!(world.connections(), 4);
        world.step();
        for port in ports {
            world.disconnect(port);
            assert!(!world.is_open(port));
        }
    }
    assert_eq!(world.connections(), 1);
    let nowhere = world.connect(7);
    assert!(world.is_open(keeper) && !world.is_open(nowhere));
}

#[test]
fn a_world_stepped_in_parts_says_the_same_bytes() {
    let run = |parts: usize| {
        let mut world = World::new(&WorldConfig {
            seed: 3,
            ..WorldConfig::row(7, start())
        });
        let ports: Vec<_> = (0..7).map(|vehicle| world.connect(vehicle)).collect();
        let mut bytes = Vec::new();
        for _ in 0..300 {
            world.step_in_parts(parts, |parts| {
                for part in parts.into_iter().rev() {
                    part.step();
                }
            });
            for port in &ports {
                world.take_output(*port, &mut bytes);
            }
        }
        bytes
    };
    let whole = run(1);
    assert!(whole.len() > 500);
    assert_eq!(whole, run(3));
    assert_eq!(whole, run(100));
}
