//! A rover and a boat, driven as a ground station does.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult, MavType};

use super::flight::close;
use super::*;
use sortie_geo::maths;

/// `custom_mode` of a rover.
const HOLD: f32 = 4.0;
const AUTO: f32 = 10.0;
const RTL: f32 = 11.0;
const SMART_RTL: f32 = 12.0;
const GUIDED: f32 = 15.0;
const ALL: [Chassis; 3] = [Chassis::Ackermann, Chassis::Skid, Chassis::Boat];

/// A ground station on a rover that has just been switched on.
fn connected(chassis: Chassis) -> Ground {
    Ground::in_world(&WorldConfig {
        kinds: vec![VehicleKind::Rover(chassis)],
        ..WorldConfig::row(1, start())
    })
}

pub(super) fn enter(ground: &mut Ground, mode: f32) -> MavResult {
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, mode])
}

/// An armed rover in GUIDED.
pub(super) fn guided(chassis: Chassis) -> Ground {
    let mut ground = connected(chassis);
    ground.run(2.0);
    assert_eq!(enter(&mut ground, GUIDED), MavResult::MAV_RESULT_ACCEPTED);
    let arm = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(arm, MavResult::MAV_RESULT_ACCEPTED, "{:?}", texts(&ground));
    ground
}

pub(super) fn texts(ground: &Ground) -> Vec<String> {
    let said = ground.messages_since(0).into_iter();
    said.filter_map(|message| match message {
        MavMessage::STATUSTEXT(text) => text.text.to_str().ok().map(str::to_owned),
        _ => None,
    })
    .collect()
}

pub(super) fn speed(truth: &Truth) -> f64 {
    let [north, east, _] = truth.velocity_ned_m_s;
    maths::hypot(north, east)
}

pub(super) fn off_m(truth: &Truth, [north, east]: [f64; 2]) -> f64 {
    let [x, y, _] = truth.position_ned_m;
    maths::hypot(x - north, y - east)
}

#[test]
fn a_rover_announces_itself() {
    for (chassis, mav_type) in [
        (Chassis::Ackermann, MavType::MAV_TYPE_GROUND_ROVER),
        (Chassis::Boat, MavType::MAV_TYPE_SURFACE_BOAT),
    ] {
        let mut ground = connected(chassis);
        ground.run(2.0);
        let heard = ground.messages_since(0);
        let beat = heard.into_iter().rev().find_map(|message| match message {
            MavMessage::HEARTBEAT(beat) => Some(beat),
            _ => None,
        });
        let beat = beat.expect("a heartbeat");
        assert_eq!((beat.mavtype, beat.custom_mode), (mav_type, 0), "MANUAL");
    }
}

#[test]
fn a_rover_drives_to_a_place_and_stops_there() {
    for chassis in ALL {
        let mut ground = guided(chassis);
        ground.goto([40.0, 10.0, 0.0]);
        let mut top: f64 = 0.0;
        for _ in 0..3500 {
            ground.step();
            top = top.max(speed(&ground.truth()));
        }
        let truth = ground.truth();
        let off = off_m(&truth, [40.0, 10.0]);
        println!(
            "{chassis:?}: top {top:.2}, off {off:.2}, speed {:.3}",
            speed(&truth)
        );
        assert!(off < 3.5 && speed(&truth) < 0.3, "{chassis:?}");
        assert!(truth.altitude_amsl_m > 583.99 && truth.armed);
    }
}

#[test]
fn a_rover_is_disarmed_on_its_way_too() {
    for chassis in ALL {
        let mut ground = guided(chassis);
        ground.goto([40.0, 10.0, 0.0]);
        ground.run(4.0);
        assert!(speed(&ground.truth()) > 0.5, "{chassis:?}");
        let disarm = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0]);
        assert_eq!(disarm, MavResult::MAV_RESULT_ACCEPTED, "{chassis:?}");
        assert!(!ground.truth().armed);
    }
}

#[test]
fn a_velocity_ends_three_seconds_after_the_last_setpoint() {
    let mut ground = guided(Chassis::Ackermann);
    for _ in 0..100 {
        ground.fly([0.0, 2.0, 0.0]);
        ground.run(0.1);
    }
    let truth = ground.truth();
    close("speed", truth.velocity_ned_m_s[1], 2.0, 0.05);
    close("heading", truth.heading_deg, 90.0, 0.05);
    ground.run(8.0);
    assert!(speed(&ground.truth()) < 0.05);
    assert!(texts(&ground).contains(&"target not received last 3secs, stopping".to_owned()));
}

#[test]
fn a_rover_comes_back_by_rtl_and_along_its_path() {
    for chassis in ALL {
        for mode in [RTL, SMART_RTL] {
            let mut ground = guided(chassis);
            for goal in [[30.0, 0.0, 0.0], [30.0, 30.0, 0.0]] {
                ground.goto(goal);
                ground.run(25.0);
            }
            assert!(off_m(&ground.truth(), [30.0, 30.0]) < 4.0);
            assert_eq!(enter(&mut ground, mode), MavResult::MAV_RESULT_ACCEPTED);
            let mut by_corner = f64::MAX;
            for _ in 0..6000 {
                ground.step();
                by_corner = by_corner.min(off_m(&ground.truth(), [30.0, 0.0]));
            }
            let truth = ground.truth();
            let off = off_m(&truth, [0.0, 0.0]);
            println!("{chassis:?} {mode}: off {off:.2}, corner {by_corner:.2}");
            assert!(
                off < 4.0 && speed(&truth) < 0.3 && truth.armed,
                "{chassis:?} {mode}"
            );
            assert_eq!(by_corner < 4.0, mode == SMART_RTL, "the path");
            assert!(texts(&ground).contains(&"Reached destination".to_owned()));
        }
    }
}

#[test]
fn hold_lets_the_vehicle_roll_out() {
    let mut ground = guided(Chassis::Ackermann);
    ground.goto([200.0, 0.0, 0.0]);
    ground.run(12.0);
    let before = ground.truth();
    close("speed", speed(&before), 5.0, 0.03);
    assert_eq!(enter(&mut ground, HOLD), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(15.0);
    let way = ground.truth().position_ned_m[0] - before.position_ned_m[0];
    // The speed decays with a time constant of 2 s.
    close("way", way, 10.0, 0.2);
}

#[test]
fn takeoffs_and_landings_are_unknown_to_a_rover() {
    let mut ground = guided(Chassis::Ackermann);
    for command in [
        MavCmd::MAV_CMD_NAV_TAKEOFF,
        MavCmd::MAV_CMD_NAV_LAND,
        MavCmd::MAV_CMD_CONDITION_YAW,
    ] {
        let result = ground.long(command, [0.0]);
        assert_eq!(result, MavResult::MAV_RESULT_UNSUPPORTED, "{command:?}");
    }
    let speed = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 3.0, -1.0]);
    assert_eq!(speed, MavResult::MAV_RESULT_FAILED, "without a place to go");
    assert_eq!(enter(&mut ground, AUTO), MavResult::MAV_RESULT_FAILED);
    let said = texts(&ground);
    assert!(said.ends_with(&[
        "No Mission. Can't set AUTO.".to_owned(),
        "Flight mode change failed".to_owned()
    ]));
}

#[test]
fn copters_and_rovers_share_a_world() {
    let mut world = World::new(&WorldConfig {
        kinds: vec![VehicleKind::Copter, VehicleKind::Rover(Chassis::Skid)],
        ..WorldConfig::row(3, start())
    });
    for _ in 0..300 {
        world.step();
    }
    assert!(world.find_parameter(0, "WPNAV_SPEED").is_some());
    for rover in [1, 2] {
        assert!(world.find_parameter(rover, "WP_SPEED").is_some());
        assert!(world.find_parameter(rover, "WPNAV_SPEED").is_none());
    }
}

#[test]
fn a_commanded_speed_holds_until_the_mode_changes() {
    let mut ground = guided(Chassis::Ackermann);
    ground.goto([300.0, 0.0, 0.0]);
    ground.run(10.0);
    for speed_m_s in [2.0, 8.0] {
        let result = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, speed_m_s, -1.0]);
        assert_eq!(result, MavResult::MAV_RESULT_ACCEPTED);
        ground.run(10.0);
        close("speed", speed(&ground.truth()), f64::from(speed_m_s), 0.05);
    }
    let none = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 0.0, -1.0]);
    assert_eq!(none, MavResult::MAV_RESULT_FAILED);
}

#[test]
fn a_lost_ground_station_stops_the_vehicle_by_the_name_of_the_radio() {
    let mut ground = guided(Chassis::Ackermann);
    ground.set("FS_GCS_ENABLE", 1.0);
    ground.heartbeat();
    ground.goto([200.0, 0.0, 0.0]);
    ground.run(6.2);
    assert_eq!(ground.truth().mode, 15);
    // 5 s of FS_GCS_TIMEOUT and 1.5 s of FS_TIMEOUT; the radio's check comes first.
    ground.run(0.6);
    assert_eq!(ground.truth().mode, 4, "HOLD");
    assert!(texts(&ground).contains(&"Radio Failsafe".to_owned()));
    ground.heartbeat();
    ground.run(0.3);
    assert!(texts(&ground).contains(&"GCS Failsafe Cleared".to_owned()));
}

#[test]
fn a_rover_with_a_fence_can_be_armed() {
    let mut ground = connected(Chassis::Ackermann);
    ground.set("FENCE_ENABLE", 1.0);
    ground.run(2.0);
    let arm = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(arm, MavResult::MAV_RESULT_ACCEPTED, "{:?}", texts(&ground));
}
