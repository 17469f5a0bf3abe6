//! The boot of the real vehicle, event by event.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::super::*;
use super::timeline::Timeline;
use super::{Ground, start};

const TOLERANCE_S: f64 = 0.3;
const ARM: MavCmd = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM;

fn booting() -> Ground {
    Ground::in_world(&WorldConfig {
        boot: BootPace::Realistic,
        ..WorldConfig::row(1, start())
    })
}

#[test]
fn the_boot_keeps_the_times_of_the_real_one() {
    let mut seen = Timeline::of(booting());
    seen.run(44.5);
    // The timeline starts half a second after the boot.
    let table = [
        (1.0, "mode 0 status 4"),
        (1.9, "Barometer 1 calibration complete"),
        (1.9, "Barometer 2 calibration complete"),
        (2.4, "mode 0 status 3"),
        (2.4, "ArduPilot Ready"),
        (2.4, "AHRS: DCM active"),
        (2.7, "RC7: SaveWaypoint LOW"),
        (4.4, "EKF3 IMU0 initialised"),
        (4.4, "EKF3 IMU1 initialised"),
        (4.4, "AHRS: EKF3 active"),
        (5.8, "EKF3 IMU0 tilt alignment complete"),
        (5.8, "EKF3 IMU1 tilt alignment complete"),
        (5.9, "EKF3 IMU0 MAG0 initial yaw alignment complete"),
        (5.9, "EKF3 IMU1 MAG0 initial yaw alignment complete"),
        (6.0, "flags 00a7"),
        (9.8, "GPS 1: probing for u-blox at 230400 baud"),
        (9.8, "GPS 1: detected u-blox"),
        (9.9, "fix 1 3"),
        (10.1, "fix 6 10"),
        (20.0, "EKF3 IMU0 origin set"),
        (20.0, "Field Elevation Set: 584m"),
        (20.2, "EKF3 IMU1 origin set"),
        (23.5, "health 5221"),
        (41.6, "EKF3 IMU0 is using GPS"),
        (41.6, "EKF3 IMU1 is using GPS"),
        (41.7, "flags 033f"),
    ]
    .map(|(t, line)| (t - 0.5, line));
    seen.must_say(TOLERANCE_S, &table);
}

#[test]
fn arming_is_refused_for_the_real_reasons_in_order() {
    let mut ground = booting();
    ground.heartbeat();
    ground.run(1.1);
    let reasons = |ground: &mut Ground| {
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
        let before = ground.texts().len();
        let result = ground.long(ARM, [1.0, 0.0]);
        (result, ground.texts().split_off(before))
    };
    let early = [
        "Need Alt Estimate",
        "Accels inconsistent",
        "EKF attitude is bad",
    ];
    let cases: &[(f64, &[&str])] = &[
        (
            1.2,
            &[
                "Need Alt Estimate",
                "Gyros not healthy",
                "EKF attitude is bad",
                "Compass not healthy",
                "AHRS: waiting for home",
                "Battery 1 unhealthy",
            ],
        ),
        (
            2.8,
            &[early[0], early[1], early[2], "AHRS: waiting for home"],
        ),
        (
            5.2,
            &[early[0], early[1], early[2], "AHRS: waiting for home"],
        ),
        (6.8, &["Accels inconsistent", "AHRS: waiting for home"]),
        (11.6, &["Accels inconsistent", "AHRS: waiting for home"]),
        (12.5, &["Gyros inconsistent", "AHRS: waiting for home"]),
        (19.7, &["Gyros inconsistent", "AHRS: waiting for home"]),
        (21.3, &["Gyros inconsistent", "Need Position Estimate"]),
        (22.9, &["Need Position Estimate"]),
        (41.4, &["Need Position Estimate"]),
    ];
    for (at_s, expected) in cases {
        let wait_s = at_s - ground.world.now().as_secs_f64();
        ground.run(wait_s);
        let (result, said) = reasons(&mut ground);
        assert_eq!(result, MavResult::MAV_RESULT_FAILED);
        let expected: Vec<_> = expected
            .iter()
            .map(|reason| format!("Arm: {reason}"))
            .collect();
        assert_eq!(said, expected, "{at_s} s");
    }
    ground.run(0.6);
    assert_eq!(reasons(&mut ground).0, MavResult::MAV_RESULT_ACCEPTED);
}

#[test]
fn a_forced_arming_meets_the_checks_that_cannot_be_left_out() {
    let mut ground = booting();
    ground.heartbeat();
    ground.run(1.2);
    ground.long(ARM, [1.0, 2989.0]);
    let first = ground
        .texts()
        .into_iter()
        .find(|text| text.starts_with("Arm"));
    assert_eq!(first.as_deref(), Some("Arm: AHRS: EKF3 not started"));
    ground.run(7.8);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    ground.set("ARMING_CHECK", 0.0);
    assert_eq!(ground.long(ARM, [1.0, 0.0]), MavResult::MAV_RESULT_FAILED);
    assert_eq!(
        ground.texts().last().map(String::as_str),
        Some("Arm: AHRS: EK3 sources require GPS")
    );
}

#[test]
fn a_mode_set_too_early_is_lost_and_obstacles_are_told_unasked() {
    let mut ground = booting();
    ground.heartbeat();
    ground.run(1.2);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    ground.run(1.5);
    assert_eq!(ground.truth().mode, 0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    ground.run(28.0);
    assert!(
        ground
            .texts()
            .contains(&"PreArm: Need Position Estimate".to_owned())
    );
}

#[test]
fn the_origin_comes_unasked_and_text_stands_between_the_frames() {
    let mut ground = booting();
    let mut bytes = Vec::new();
    for _ in 0..120 {
        ground.world.step();
        ground.world.take_output(ground.port, &mut bytes);
    }
    assert!(bytes.starts_with(b"\n\nInit ArduCopter V4.6"));
    let mut decoder = sortie_wire::Decoder::new();
    decoder.push(&bytes);
    let mut frames = 0;
    while decoder.next_frame().is_some() {
        frames += 1;
    }
    assert_eq!(frames, 1, "the first heartbeat");
    ground.run(19.0);
    let origins: Vec<_> = ground
        .messages_since(0)
        .into_iter()
        .filter(|message| {
            matches!(
                message,
                MavMessage::GPS_GLOBAL_ORIGIN(_) | MavMessage::HOME_POSITION(_)
            )
        })
        .collect();
    assert_eq!(origins.len(), 2);
}

#[test]
fn without_a_client_or_a_gps_the_boot_waits() {
    let mut world = World::new(&WorldConfig {
        boot: BootPace::Realistic,
        ..WorldConfig::row(1, start())
    });
    for _ in 0..1000 {
        world.step();
    }
    assert!(world.slots[0].autopilot.vehicle.boot.awaits_client());
    let mut ground = booting();
    ground.set("SIM_GPS_DISABLE", 1.0);
    ground.run(50.0);
    assert!(!ground.world.slots[0].autopilot.vehicle.is_ready());
    ground.set("SIM_GPS_DISABLE", 0.0);
    ground.run(23.0);
    assert!(ground.world.slots[0].autopilot.vehicle.is_ready());
}

#[test]
fn a_gps_that_is_off_since_the_boot_is_the_reason_against_arming() {
    let mut ground = Ground::new();
    ground.set("SIM_GPS_DISABLE", 1.0);
    ground.run(5.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    assert_eq!(ground.long(ARM, [1.0, 0.0]), MavResult::MAV_RESULT_FAILED);
    assert_eq!(
        ground.texts().last().map(String::as_str),
        Some("Arm: GPS 1: Bad fix")
    );
}

#[test]
fn a_vehicle_asked_for_another_pace_tells_the_world() {
    let mut ground = Ground::new();
    assert_eq!(ground.world.wanted_speedup(), None);
    ground.set("SIM_SPEEDUP", 5.0);
    assert_eq!(ground.world.wanted_speedup(), Some(5.0));
}

#[test]
fn vehicles_that_were_switched_on_long_ago_are_ready_and_quiet() {
    let mut ground = Ground::in_world(&WorldConfig {
        boot: BootPace::Over,
        ..WorldConfig::row(1, start())
    });
    ground.run(0.05);
    assert!(ground.texts().is_empty(), "{:?}", ground.texts());
    assert!(ground.world.slots[0].autopilot.vehicle.is_ready());
    let guided = ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    assert_eq!(guided, MavResult::MAV_RESULT_ACCEPTED);
    ground.arm();
}
