//! Return paths, delays to a time of day, and speeds that change while a mission is flown.

use super::*;
use crate::cmd;

/// Takeoff, a waypoint, the return path and its leg, the start of a landing without a place, the landing.
fn with_return_path() -> Vec<Item> {
    vec![
        act(22, [0.0; 4], 10.0),
        at(16, 33.0, 0.0, 10.0),
        at(cmd::DO_RETURN_PATH_START, 33.0, 0.0, 0.0),
        at(16, 22.0, 0.0, 10.0),
        act(cmd::DO_LAND_START, [0.0; 4], 0.0),
        at(21, 0.0, 0.0, 0.0),
    ]
}

#[test]
fn a_return_path_is_joined_at_its_nearest_leg_on_the_ground_and_in_flight() {
    let command = MavCmd::MAV_CMD_DO_RETURN_PATH_START;
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.load(&with_return_path());
    assert_eq!(ground.long(command, []), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.current().0, 4);

    let mut ground = Ground::hovering(15.0);
    ground.load(&with_return_path());
    assert_eq!(ground.long(command, []), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.autopilot().reported_mode(), 27);
    assert!(ground.texts().contains(&"Return path started".to_owned()));
    ground.run(1.0);
    assert_eq!(ground.current().0, 4);

    let mut ground = Ground::hovering(15.0);
    ground.load(&with_return_path());
    assert_eq!(ground.mode(27.0), MavResult::MAV_RESULT_ACCEPTED);
    ground.run(1.0);
    assert_eq!(ground.current().0, 4);
}

#[test]
fn a_delay_waits_for_a_time_of_day() {
    // The world begins at midnight.
    let delay = with(act(93, [0.0; 4], 0.0), [-1.0, 0.0, 0.0, 32.0]);
    let mut ground = ready_with(&[delay, act(22, [0.0; 4], 10.0)]);
    ground
        .autopilot()
        .vehicle
        .parameters
        .set("DISARM_DELAY", 0.0);
    ground.autopilot().vehicle.retune();
    ground.start_mission();
    ground.until(60.0, |truth| truth.position_ned_m[2] < -0.1);
    let lifted_s = ground.world.now().as_secs_f64();
    assert!((32.0..36.0).contains(&lifted_s), "{lifted_s}");
    // With any hour and minute, the delay lasts until the given second of a minute.
    let item = with(act(93, [0.0; 4], 0.0), [-1.0, -1.0, -1.0, 10.0]);
    let left_s =
        super::super::start::until_time_of_day_s(&item, std::time::Duration::from_secs(95));
    assert!((left_s - 35.0).abs() < 1e-6, "{left_s}");
}

#[test]
fn a_speed_set_by_parameter_acts_on_the_leg_that_is_flown() {
    let mut ground = ready_with(&[act(22, [0.0; 4], 10.0), at(16, 600.0, 0.0, 10.0)]);
    ground.start_mission();
    ground.until(40.0, |truth| truth.velocity_ned_m_s[0] > 9.8);
    ground.set("WPNAV_SPEED", 500.0);
    ground.run(8.0);
    let speed = ground.truth().velocity_ned_m_s[0];
    assert!((speed - 5.0).abs() < 0.2, "{speed}");
}
