//! The time between arming and the climb.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::*;
use sortie_geo::maths;

const ALIGNED: &str = "in-flight yaw alignment complete";

fn alignments(ground: &Ground) -> usize {
    let texts = ground.texts();
    texts.iter().filter(|text| text.contains(ALIGNED)).count()
}

#[test]
fn a_takeoff_right_after_arming_waits_for_the_motors() {
    for (pause_s, lifted_s) in [(0.0, 4.0), (1.0, 3.0), (3.0, 1.8)] {
        let mut ground = Ground::armed();
        ground.run(pause_s);
        ground.takeoff(10.0);
        let waited_s = ground.until(10.0, |truth| !truth.on_ground);
        assert!(
            (waited_s - lifted_s).abs() < 0.4,
            "{pause_s} s after arming it lifts after {waited_s} s"
        );
    }
}

#[test]
fn the_yaw_is_aligned_once_in_each_flight_above_the_ground() {
    let mut ground = Ground::armed();
    ground.takeoff(10.0);
    let height = |truth: &Truth| -truth.position_ned_m[2];
    ground.until(20.0, |truth| height(truth) >= 2.4);
    assert_eq!(alignments(&ground), 0);
    ground.until(5.0, |truth| height(truth) >= 2.7);
    // One for each core of the EKF.
    assert_eq!(alignments(&ground), 2);
    ground.run(10.0);
    ground.goto([0.0, 0.0, -1.0]);
    ground.run(15.0);
    ground.goto([0.0, 0.0, -8.0]);
    ground.run(15.0);
    assert_eq!(alignments(&ground), 2, "still the same flight");
    ground.long(MavCmd::MAV_CMD_NAV_LAND, [0.0]);
    ground.run(40.0);
    let mut again = ground;
    again.arm();
    again.takeoff(10.0);
    again.run(20.0);
    assert_eq!(alignments(&again), 4);
}

#[test]
fn what_newly_forbids_arming_is_told_without_being_asked() {
    let mut ground = Ground::new();
    ground.run(40.0);
    let told = |ground: &Ground| {
        let texts = ground.texts();
        texts
            .iter()
            .filter(|text| text.contains("PreArm: "))
            .count()
    };
    assert_eq!(told(&ground), 0, "{:?}", ground.texts());
    ground.set("SIM_GPS_DISABLE", 1.0);
    ground.set("FENCE_ALT_MAX", -5.0);
    ground.set("FENCE_ENABLE", 1.0);
    ground.run(6.0);
    assert!(told(&ground) > 0, "{:?}", ground.texts());
    let refused = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0]);
    assert_eq!(refused, MavResult::MAV_RESULT_FAILED);
}

/// The highest speed over ground on the way to a point.
fn fastest_to(ground: &mut Ground, north_m: f32) -> f64 {
    ground.goto([north_m, 0.0, -10.0]);
    let mut fastest = 0.0_f64;
    for _ in 0..2500 {
        ground.step();
        let [north, east, _] = ground.truth().velocity_ned_m_s;
        fastest = fastest.max(maths::hypot(north, east));
    }
    fastest
}

#[test]
fn a_speed_is_forgotten_by_the_first_target_after_a_takeoff_and_by_another_kind_of_target() {
    let slowly = |ground: &mut Ground| {
        let answer = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 3.0]);
        assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED);
    };
    for climbs_for_s in [5.0, 30.0] {
        let mut ground = Ground::armed();
        ground.takeoff(10.0);
        ground.run(climbs_for_s);
        slowly(&mut ground);
        let fastest = fastest_to(&mut ground, 60.0);
        assert!(fastest > 8.0, "{fastest} after {climbs_for_s} s");
        slowly(&mut ground);
        for north_m in [30.0, 60.0] {
            let fastest = fastest_to(&mut ground, north_m);
            assert!(fastest < 3.3, "{fastest}");
        }
        ground.fly([1.0, 0.0, 0.0]);
        ground.run(5.0);
        let fastest = fastest_to(&mut ground, 0.0);
        assert!(fastest > 8.0, "{fastest}");
    }
}

#[test]
fn a_place_to_fly_to_is_told_from_the_first_target_on_and_not_in_a_takeoff() {
    let told = |ground: &mut Ground| {
        let heard = ground.heard.len();
        ground.run(2.0);
        let messages = ground.messages_since(heard).into_iter();
        let told = messages.filter(|it| matches!(it, MavMessage::POSITION_TARGET_GLOBAL_INT(_)));
        told.count()
    };
    let mut ground = Ground::hovering(10.0);
    let every_us = 100_000.0;
    ground.long(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [87.0, every_us]);
    assert_eq!(told(&mut ground), 0);
    ground.goto([10.0, 0.0, -10.0]);
    assert!(told(&mut ground) > 15);
}

/// A real one disarmed at once, or two seconds after arming.
#[test]
fn a_landing_on_the_ground_stops_the_motors_at_once() {
    for (wait_s, most_s) in [(5.0, 0.2), (0.5, 1.8)] {
        let mut ground = Ground::armed();
        ground.run(wait_s);
        ground.long(MavCmd::MAV_CMD_NAV_LAND, []);
        let off_s = ground.until(10.0, |truth| !truth.armed);
        assert!(off_s < most_s, "{off_s} s after {wait_s} s");
    }
}
