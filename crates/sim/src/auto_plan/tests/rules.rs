//! Rules for starting, stopping, setting and refusing. Facts without a source come from a flight of the same
//! firmware on 21 November 2026.

use super::*;

const SET_CURRENT: MavCmd = MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT;

/// Takeoff to 8 m and two waypoints.
fn short() -> Vec<Item> {
    vec![
        act(22, [0.0; 4], 8.0),
        at(16, 40.0, 0.0, 8.0),
        at(16, 40.0, 40.0, 8.0),
    ]
}

/// A vehicle in the air, on the way to the first waypoint.
fn under_way(items: &[Item]) -> Ground {
    let mut ground = under_way_from(items, 2);
    ground.run(6.0);
    assert_eq!(ground.current().0, 2);
    ground.news();
    ground
}

/// A vehicle that flies a mission, at the moment at which `current` becomes its current item.
fn under_way_from(items: &[Item], current: u16) -> Ground {
    let mut ground = ready_with(items);
    ground.start_mission();
    for _ in 0..2000 {
        ground.step();
        if ground.current().0 == current {
            return ground;
        }
    }
    panic!("never came to item {current}: {:?}", ground.current());
}

#[test]
fn without_a_mission_auto_is_refused_armed_and_ends_in_land_disarmed() {
    let mut ground = Ground::new();
    ground.run(2.0);
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.truth().mode, 9);
    assert_eq!(ground.mode(AUTO), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(1.0);
    assert_eq!((ground.truth().mode, ground.current()), (3, (0, 0, 1, 1)));

    let mut ground = Ground::hovering(10.0);
    ground.news();
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_FAILED);
    assert_eq!(ground.mode(AUTO), MavResult::MAV_RESULT_FAILED);
    let refusal = "Mode change to AUTO failed: init failed";
    assert_eq!(ground.news(), [refusal, refusal]);
    assert_eq!(ground.truth().mode, 4);
}

#[test]
fn a_mission_that_does_not_take_off_first_is_refused_on_the_ground_but_flown_in_the_air() {
    let list = &short()[1..];
    let mut ground = ready_with(list);
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_FAILED);
    assert_eq!(
        ground.news(),
        [
            "Auto: Missing Takeoff Cmd",
            "Mode change to AUTO failed: init failed"
        ]
    );
    let mut ground = Ground::hovering(8.0);
    ground.load(list);
    ground.news();
    assert_eq!(ground.mode(AUTO), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(20.0);
    assert_eq!(
        ground.news()[..3],
        ["Mission: 1 WP", "R 1", "Reached command #1"]
    );
}

#[test]
fn a_start_while_disarmed_is_accepted_and_moves_nothing() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.load(&short());
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(5.0);
    assert_eq!(ground.current(), (1, 3, 3, 1));
    assert!(ground.truth().on_ground && !ground.truth().armed);
    let refused = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    assert_eq!(refused, MavResult::MAV_RESULT_FAILED);
    assert!(
        ground
            .texts()
            .iter()
            .any(|text| text == "Arm: AUTO mode not armable")
    );
}

#[test]
fn with_auto_options_3_a_vehicle_armed_in_auto_takes_off_at_once() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.load(&short());
    ground.set("AUTO_OPTIONS", 3.0);
    ground.mode(AUTO);
    let armed = ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    assert_eq!(armed, MavResult::MAV_RESULT_ACCEPTED);
    ground.until(15.0, |truth| truth.position_ned_m[2] < -7.0);
}

#[test]
fn in_auto_on_the_ground_the_throttle_starts_the_mission() {
    let mut ground = ready_with(&short());
    ground.mode(AUTO);
    ground.run(5.0);
    assert!(ground.truth().on_ground);
    ground.sticks(1500);
    ground.until(15.0, |truth| truth.position_ned_m[2] < -7.0);
}

#[test]
fn the_current_item_can_be_set_on_the_ground_and_in_the_air() {
    let mut ground = ready_with(&short());
    for (first, reset, result, current) in [
        (3.0, 0.0, MavResult::MAV_RESULT_ACCEPTED, 3),
        (99.0, 0.0, MavResult::MAV_RESULT_DENIED, 3),
        (-1.0, 1.0, MavResult::MAV_RESULT_DENIED, 3),
        (f32::NAN, 0.0, MavResult::MAV_RESULT_DENIED, 3),
        (0.0, 0.0, MavResult::MAV_RESULT_ACCEPTED, 1),
    ] {
        assert_eq!(ground.long(SET_CURRENT, [first, reset]), result, "{first}");
        assert_eq!(ground.current(), (current, 3, 2, 0), "{first}");
    }
    ground.start_mission();
    ground.run(16.0);
    ground.news();
    assert_eq!(
        ground.long(SET_CURRENT, [3.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    assert_eq!(ground.news(), ["Mission: 3 WP"]);
    assert_eq!(ground.current(), (3, 3, 3, 1));
    assert_eq!(
        ground.long(SET_CURRENT, [2.0, 1.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    assert_eq!(ground.news(), ["Mission: 2 WP", "Mission: 2 WP"]);
}

#[test]
fn only_a_way_to_a_place_can_be_paused() {
    let pause = MavCmd::MAV_CMD_DO_PAUSE_CONTINUE;
    let mut ground = ready_with(&short());
    ground.start_mission();
    ground.run(4.0);
    ground.news();
    assert_eq!(ground.long(pause, [0.0]), MavResult::MAV_RESULT_FAILED);
    assert_eq!(ground.news(), ["Failed to pause"]);
    assert_eq!(ground.long(pause, [1.0]), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.long(pause, [7.0]), MavResult::MAV_RESULT_DENIED);
    ground.run(14.0);
    assert_eq!(ground.long(pause, [0.0]), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(6.0);
    let held = ground.truth();
    ground.run(10.0);
    assert!(held.at.distance_m(ground.truth().at) < 0.5);
    ground.long(pause, [1.0]);
    ground.run(12.0);
    assert_eq!(ground.current().0, 3);
}

#[test]
fn a_jump_to_itself_ends_the_mission_after_64_rounds() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 8.0),
        act(177, [2.0, -1.0, 0.0, 0.0], 0.0),
        at(16, 0.0, 10.0, 8.0),
    ]);
    ground.start_mission();
    ground.run(15.0);
    let news = ground.news();
    assert_eq!(
        news.last().map(String::as_str),
        Some("Mission: 2 Jump 64/unlimited")
    );
    assert_eq!(ground.current(), (1, 3, 5, 1));
}

#[test]
fn a_landing_sequence_is_flown_in_a_mode_of_its_own() {
    let start_landing = MavCmd::MAV_CMD_DO_LAND_START;
    let mut ground = under_way(&short());
    assert_eq!(ground.long(start_landing, []), MavResult::MAV_RESULT_FAILED);
    assert_eq!(ground.news()[0], "Unable to start landing sequence");
    let mut list = short();
    list.extend([
        act(189, [0.0; 4], 0.0),
        at(16, 0.0, 10.0, 8.0),
        act(20, [0.0; 4], 0.0),
    ]);
    let mut ground = under_way(&list);
    assert_eq!(
        ground.long(start_landing, []),
        MavResult::MAV_RESULT_ACCEPTED
    );
    assert_eq!(
        ground.news(),
        [
            "Mission: 4 LandStart",
            "Mission: 5 WP",
            "Landing sequence start"
        ]
    );
    assert_eq!(ground.truth().mode, 27);
    ground.run(80.0);
    assert_eq!(ground.current(), (0, 6, 5, 1));
    assert!(!ground.truth().armed);
}

#[test]
fn tags_are_jumped_to_from_the_list_and_by_command() {
    let mut list = short();
    list.insert(1, act(600, [7.0, 0.0, 0.0, 0.0], 0.0));
    list.push(act(601, [7.0, 1.0, 0.0, 0.0], 0.0));
    let mut ground = ready_with(&list);
    ground.start_mission();
    ground.run(40.0);
    let news = ground.news();
    assert!(
        news.iter().any(|text| text == "Mission: 5 Jump 1/1"),
        "{news:?}"
    );
    let jump = MavCmd::MAV_CMD_DO_JUMP_TAG;
    assert_eq!(ground.long(jump, [8.0]), MavResult::MAV_RESULT_FAILED);
    assert_eq!(ground.long(jump, [7.0]), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.news(), ["Mission: 2 Tag 0", "Mission: 3 WP"]);
}

#[test]
fn the_nose_follows_wp_yaw_behavior_and_a_place_of_interest_outdoes_it() {
    for (behaviour, heading_deg) in [(0.0, 0.0), (1.0, 90.0), (2.0, 90.0), (3.0, 90.0)] {
        let mut ground = ready_with(&[act(22, [0.0; 4], 8.0), at(16, 0.0, 80.0, 8.0)]);
        ground.set("WP_YAW_BEHAVIOR", behaviour);
        ground.start_mission();
        ground.run(17.0);
        let off = sortie_geo::wrap_180(ground.truth().heading_deg - heading_deg);
        assert!(off.abs() < 3.0, "{behaviour}: {off}");
    }
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 8.0),
        at(201, 500.0, 0.0, 0.0),
        at(16, 0.0, 60.0, 8.0),
        at(16, 0.0, 0.0, 8.0),
        act(201, [0.0; 4], 0.0),
        at(16, 0.0, 60.0, 8.0),
    ]);
    ground.start_mission();
    ground.run(16.0);
    let off = sortie_geo::wrap_180(ground.truth().heading_deg);
    assert!(off.abs() < 10.0, "{off}");
}

#[test]
fn a_place_left_out_is_the_one_before_and_frames_mean_their_heights() {
    let home_m = 584.0;
    for (frame, z) in [
        (0, home_m + 20.0),
        (5, home_m + 20.0),
        (3, 20.0),
        (6, 20.0),
        (10, 20.0),
        (11, 20.0),
    ] {
        let there = Item {
            frame,
            ..at(16, 30.0, 0.0, z)
        };
        let mut ground = ready_with(&[act(22, [0.0; 4], 15.0), there, act(16, [0.0; 4], 12.0)]);
        ground.start_mission();
        while ground.current().0 < 3 {
            ground.step();
        }
        let height_m = -ground.truth().position_ned_m[2];
        assert!((height_m - 20.0).abs() < 1.5, "{frame}: {height_m}");
        ground.run(15.0);
        let end = ground.truth().position_ned_m;
        assert!(
            (end[0] - 30.0).abs() < 1.0 && (end[2] + 12.0).abs() < 0.5,
            "{end:?}"
        );
    }
}

#[test]
fn a_landing_may_be_followed_by_a_takeoff_when_mis_options_say_so() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 5.0),
        act(21, [0.0; 4], 0.0),
        act(22, [0.0; 4], 6.0),
        at(16, 10.0, 0.0, 6.0),
    ]);
    ground.set("MIS_OPTIONS", 4.0);
    ground.start_mission();
    ground.run(60.0);
    assert_eq!(ground.current(), (4, 4, 5, 1));
    assert!(ground.truth().armed && !ground.truth().on_ground);
}

#[test]
fn a_landing_on_the_ground_is_over_at_once_and_a_takeoff_follows_it() {
    for (options, is_armed, current) in [(4.0, true, 3), (0.0, false, 1)] {
        let mut ground = ready_with(&[
            act(22, [0.0; 4], 5.0),
            act(21, [0.0; 4], 0.0),
            act(22, [0.0; 4], 6.0),
        ]);
        ground.set("MIS_OPTIONS", options);
        ground.run(3.0);
        assert_eq!(ground.mode(AUTO), MavResult::MAV_RESULT_ACCEPTED);
        ground.run(0.2);
        ground.set_current(2);
        ground.run(0.3);
        assert_eq!(ground.truth().armed, is_armed, "{options}");
        assert_eq!(ground.current().0, current, "{options}");
    }
}

#[test]
fn the_message_that_sets_an_item_is_answered_with_the_item_that_was_asked() {
    let mut ground = ready_with(&short());
    ground.set_current(99);
    assert!(ground.messages_since(0).is_empty());
    ground.set_current(0);
    let answers = ground.messages_since(0);
    assert!(
        matches!(&answers[..], [MavMessage::MISSION_CURRENT(data)] if data.seq == 0 && data.total == 3),
        "{answers:?}"
    );
    assert_eq!(ground.current(), (1, 3, 2, 0));
}

#[test]
fn an_emptied_mission_is_forgotten_and_a_shortened_one_cannot_be_restarted() {
    let mut ground = under_way(&short());
    ground.autopilot().vehicle.plans.mission.truncate(2);
    ground.autopilot().plans_changed(ListKind::Plan);
    ground.step();
    assert_eq!(
        ground.news(),
        ["Auto mission changed but failed to restart command"]
    );
    let mut ground = ready_with(&short());
    ground.set_current(2);
    ground.autopilot().vehicle.plans.mission.clear();
    ground.autopilot().plans_changed(ListKind::Plan);
    assert_eq!(ground.current(), (0, 0, 1, 0));
}

#[test]
fn with_mis_restart_auto_begins_at_the_first_item() {
    for (restart, first) in [(0.0, "Mission: 3 WP"), (1.0, "Mission: 1 Takeoff")] {
        let mut ground = under_way(&short());
        ground.set("MIS_RESTART", restart);
        ground.long(SET_CURRENT, [3.0]);
        ground.mode(GUIDED);
        ground.news();
        ground.mode(AUTO);
        ground.run(0.1);
        assert_eq!(ground.news()[0], first);
    }
}

#[test]
fn guided_enable_hands_the_vehicle_to_targets_until_the_item_is_left() {
    let mut list = short();
    list[1] = act(92, [1.0, 0.0, 0.0, 0.0], 0.0);
    let mut ground = under_way(&list);
    ground.goto([-20.0, 0.0, -10.0]);
    ground.run(15.0);
    assert!((ground.truth().position_ned_m[0] + 20.0).abs() < 0.5);
    assert_eq!(ground.truth().mode, 3);
    ground.long(SET_CURRENT, [3.0]);
    ground.goto([-20.0, 0.0, -10.0]);
    ground.run(20.0);
    assert!((ground.truth().position_ned_m[0] - 40.0).abs() < 0.5);
}

#[test]
fn actions_set_home_and_servos_and_the_unknown_is_skipped_with_a_text() {
    let mut list = vec![
        act(22, [0.0; 4], 8.0),
        act(183, [9.0, 1700.0, 0.0, 0.0], 0.0),
        at(179, 5.0, 5.0, 0.0),
        act(210, [1.0, 0.0, 0.0, 0.0], 0.0),
        act(30, [0.0; 4], 20.0),
    ];
    list.push(at(16, 30.0, 0.0, 8.0));
    let mut ground = under_way_from(&list, 6);
    ground.run(1.0);
    let vehicle = &ground.autopilot().vehicle;
    assert_eq!(vehicle.servos_us[8], 1700);
    let home = vehicle.datum.home_point();
    assert!((home.x - 5.0).abs() < 0.1 && (home.y - 5.0).abs() < 0.1);
    let news = ground.news();
    assert!(
        news.iter().any(|text| text == "Skipping invalid cmd #210"),
        "{news:?}"
    );
}

#[test]
fn a_height_is_met_where_the_estimator_believes_it_to_be() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 10.0),
        act(93, [15.0, -1.0, -1.0, -1.0], 0.0),
        at(31, 0.0, 0.0, 25.0),
        act(17, [0.0; 4], 25.0),
    ]);
    ground.run(1.5);
    ground.start_mission();
    ground.run(10.0);
    ground.set("SIM_BARO_GLITCH", 8.0);
    let mut highest_m: f64 = 0.0;
    for _ in 0..4000 {
        ground.step();
        highest_m = highest_m.max(-ground.truth().position_ned_m[2]);
    }
    let news = ground.news();
    assert!(
        news.iter().any(|text| text == "Mission: 4 LoitUnlim"),
        "{news:?}"
    );
    assert!((highest_m - 17.0).abs() < 1.5, "{highest_m}");
}

/// A pilot at a ground station may enter AUTO after the takeoff is accepted and before the motors
/// lift.
#[test]
fn auto_entered_after_a_commanded_takeoff_lifts_without_throttle() {
    let mut ground = ready_with(&short());
    let takeoff = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 10.0];
    let answer = ground.long(MavCmd::MAV_CMD_NAV_TAKEOFF, takeoff);
    assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.mode(AUTO), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(15.0);
    assert_eq!(ground.current().0, 2, "on the way to the first waypoint");
}
