//! Missions compared with the order and times of real flights.

use super::*;

/// Flies a mission and compares the time and the text of each message.
fn follow(ground: &mut Ground, real: &[(f64, &[&str])], share: f64) {
    for (measured_s, words) in real {
        let mut said = Vec::new();
        let mut elapsed = 0.0;
        let mut first = None;
        // Messages sent at the same time may arrive over a few steps.
        while said.len() < words.len() {
            let (after_s, news) = ground.next_news(measured_s * 2.0 + 5.0);
            elapsed += after_s;
            first.get_or_insert(elapsed);
            said.extend(news);
        }
        let first = first.unwrap_or(0.0);
        println!(
            "{first:7.2} s, real {measured_s:7.2} s ({:+5.1} %) {said:?}",
            (first / measured_s - 1.0) * 100.0
        );
        assert_eq!(said, *words);
        assert!(
            (first - measured_s).abs() <= measured_s * share + 0.15,
            "{words:?} after {first:.2} s, real {measured_s:.2} s"
        );
    }
}

/// The mission recorded on 20 November 2026.
fn recorded() -> Vec<Item> {
    vec![
        act(22, [0.0; 4], 20.0),
        at(16, 60.0, 0.0, 25.0),
        with(at(16, 60.0, 60.0, 25.0), [3.0, 0.0, 0.0, 0.0]),
        at(201, 30.0, 30.0, 5.0),
        act(178, [1.0, 4.0, -1.0, 0.0], 0.0),
        at(16, 0.0, 60.0, 30.0),
        act(183, [9.0, 1700.0, 0.0, 0.0], 0.0),
        act(93, [5.0, -1.0, -1.0, -1.0], 0.0),
        at(16, -30.0, 0.0, 20.0),
        act(20, [0.0; 4], 0.0),
    ]
}

/// Recording `d_mission` (`ArduCopter` 4.6.0-dev SITL): start at 69.33 s, seconds between the messages.
#[test]
fn the_recorded_mission_is_flown_in_the_same_order_and_time() {
    let mut ground = ready_with(&recorded());
    ground.run(1.5);
    assert_eq!(ground.current(), (0, 10, 2, 0));
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_ACCEPTED);
    ground.step();
    assert_eq!(ground.news(), ["Mission: 1 Takeoff", "Mission: 1 Takeoff"]);
    assert_eq!(ground.current(), (1, 10, 3, 1));
    follow(
        &mut ground,
        &[
            (12.82, &["R 1", "Mission: 2 WP"]),
            (11.48, &["R 2", "Reached command #2", "Mission: 3 WP"]),
        ],
        0.05,
    );
    let pause = MavCmd::MAV_CMD_DO_PAUSE_CONTINUE;
    assert_eq!(ground.long(pause, [0.0]), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.current(), (3, 10, 4, 1));
    ground.run(5.0);
    assert_eq!(ground.long(pause, [1.0]), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.current(), (3, 10, 3, 1));
    ground.run(0.07);
    ground.news();
    ground.autopilot().plans_changed(ListKind::Plan);
    ground.step();
    assert_eq!(
        ground.news(),
        ["Mission: 3 WP", "Auto mission changed, restarted command"]
    );
    follow(
        &mut ground,
        &[(
            15.67,
            &[
                "R 4",
                "Reached command #3",
                "Mission: 4 SetROI",
                "Mission: 6 WP",
                "Mission: 5 ChangeSpeed",
                "R 5",
            ],
        )],
        0.05,
    );
    ground.run(3.0);
    ground.mode(GUIDED);
    assert_eq!(ground.current(), (6, 10, 2, 0));
    ground.run(4.0);
    ground.mode(AUTO);
    ground.step();
    assert_eq!(ground.news(), ["Mission: 6 WP"]);
    follow(
        &mut ground,
        &[
            (
                13.31,
                &[
                    "R 6",
                    "Reached command #6",
                    "Mission: 7 SetServo",
                    "Mission: 8 Delay",
                    "Delaying 5 sec",
                ],
            ),
            (5.0, &["R 8", "Mission: 9 WP"]),
            (14.06, &["R 9", "Reached command #9", "Mission: 10 RTL"]),
            (46.53, &["R 10", "Disarming motors"]),
        ],
        0.05,
    );
    assert_eq!(ground.current(), (0, 10, 5, 1));
    assert!(!ground.truth().armed);
}

/// The second mission of the same recording: it waits in AUTO, armed on the ground, jumps, and ends
/// in the air.
#[test]
fn a_mission_with_a_jump_waits_for_its_start_and_ends_hovering() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 15.0),
        at(16, 30.0, 0.0, 15.0),
        at(16, 30.0, 30.0, 15.0),
        act(177, [2.0, 1.0, 0.0, 0.0], 0.0),
        at(16, 0.0, 30.0, 15.0),
    ]);
    ground.mode(AUTO);
    ground.step();
    assert_eq!(ground.news(), ["Mission: 1 Takeoff"]);
    ground.run(8.0);
    assert!(ground.truth().on_ground && ground.truth().armed);
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_ACCEPTED);
    follow(
        &mut ground,
        &[
            (9.99, &["R 1", "Mission: 2 WP"]),
            (8.65, &["R 2", "Reached command #2", "Mission: 3 WP"]),
            (
                6.25,
                &[
                    "R 3",
                    "Reached command #3",
                    "Mission: 4 Jump 1/1",
                    "Mission: 2 WP",
                ],
            ),
            (7.02, &["R 2", "Reached command #2", "Mission: 3 WP"]),
            (6.81, &["R 3", "Reached command #3", "Mission: 5 WP"]),
            (8.14, &["R 5", "Reached command #5"]),
        ],
        0.05,
    );
    assert_eq!(ground.current(), (5, 5, 5, 1));
    ground.run(8.0);
    let before = ground.truth();
    assert!(before.velocity_ned_m_s.iter().all(|v| v.abs() < 0.05));
    ground.set_current(2);
    assert_eq!(ground.current(), (2, 5, 2, 1));
    ground.run(6.0);
    assert!(ground.truth().at.distance_m(before.at) < 0.1);
    ground.mode(LAND);
    ground.run(40.0);
    assert_eq!(ground.current(), (0, 5, 2, 0));
}

/// Flown by the same firmware on 21 November 2026: 60 m legs with corners, climbs and descents
/// between them, and a landing at a place. After the landing, the mission is back before its first
/// item and the mode is still AUTO.
#[test]
fn corners_are_cut_as_by_the_real_vehicle_and_a_landing_begins_the_mission_anew() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 15.0),
        at(16, 60.0, 0.0, 15.0),
        at(16, 60.0, 60.0, 15.0),
        at(16, 0.0, 60.0, 25.0),
        at(16, 0.0, 0.0, 15.0),
        at(16, 30.0, -30.0, 15.0),
        at(21, 0.0, -20.0, 0.0),
    ]);
    ground.run(1.5);
    ground.start_mission();
    ground.step();
    ground.news();
    follow(
        &mut ground,
        &[
            (10.8, &["R 1", "Mission: 2 WP"]),
            (11.4, &["R 2", "Reached command #2", "Mission: 3 WP"]),
            (8.85, &["R 3", "Reached command #3", "Mission: 4 WP"]),
            (8.8, &["R 4", "Reached command #4", "Mission: 5 WP"]),
            (8.5, &["R 5", "Reached command #5", "Mission: 6 WP"]),
            (8.8, &["R 6", "Reached command #6", "Mission: 7 Land"]),
            (38.75, &["Disarming motors", "Mission: 1 Takeoff"]),
        ],
        0.05,
    );
    assert_eq!(ground.current(), (1, 7, 3, 1));
    assert!(!ground.truth().armed);
}

/// Flown by the same firmware on 21 November 2026. The simulator flies splines as straight lines, so their times are
/// not compared.
#[test]
fn conditions_circles_and_stays_take_as_long_as_the_real_ones() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 10.0),
        act(112, [3.0, 0.0, 0.0, 0.0], 0.0),
        act(183, [9.0, 1700.0, 0.0, 0.0], 0.0),
        at(16, 50.0, 0.0, 10.0),
        act(114, [20.0, 0.0, 0.0, 0.0], 0.0),
        act(178, [1.0, 3.0, -1.0, 0.0], 0.0),
        act(115, [90.0, 0.0, 1.0, 0.0], 0.0),
        at(16, 0.0, 0.0, 10.0),
        act(600, [7.0, 0.0, 0.0, 0.0], 0.0),
        with(at(18, 0.0, 30.0, 10.0), [1.0, 0.0, -10.0, 0.0]),
        with(at(19, 0.0, 0.0, 12.0), [4.0, 0.0, 0.0, 0.0]),
        at(31, 0.0, 0.0, 16.0),
        at(82, 20.0, 0.0, 12.0),
        act(93, [2.0, -1.0, -1.0, -1.0], 0.0),
        at(201, 50.0, 50.0, 5.0),
        at(16, 10.0, 10.0, 12.0),
        act(201, [0.0; 4], 0.0),
        act(205, [1.0, 2.0, 3.0, 0.0], 0.0),
        act(92, [0.0; 4], 0.0),
        at(17, 5.0, 5.0, 12.0),
    ]);
    ground.run(1.5);
    ground.start_mission();
    ground.step();
    ground.news();
    follow(
        &mut ground,
        &[
            (8.8, &["R 1", "Mission: 2 CondDelay", "Mission: 4 WP"]),
            (3.0, &["R 2", "Mission: 3 SetServo"]),
            (
                8.05,
                &[
                    "R 4",
                    "Reached command #4",
                    "Mission: 5 CondDist",
                    "Mission: 8 WP",
                ],
            ),
            (
                5.3,
                &["R 5", "Mission: 6 ChangeSpeed", "R 6", "Mission: 7 CondYaw"],
            ),
            (4.7, &["R 7"]),
            (
                0.8,
                &[
                    "R 8",
                    "Reached command #8",
                    "Mission: 9 Tag 0",
                    "Mission: 10 LoitTurns",
                ],
            ),
            (32.4, &["R 10", "Mission: 11 LoitTime"]),
            (
                14.6,
                &["R 11", "Reached command #11", "Mission: 12 LoitAltitude"],
            ),
            (3.8, &["Mission: 13 SplineWP"]),
        ],
        // The time of the last leg but one is counted from 3 s after its beginning.
        0.06,
    );
}

/// Flown by the same firmware on 21 November 2026: speeds changed by commands on the way, a circle of the usual size,
/// items that the vehicle skips, a takeoff in the air, and a second start after the end.
#[test]
fn speeds_change_on_the_way_and_what_cannot_be_flown_is_skipped() {
    let mut ground = ready_with(&[
        act(22, [0.0; 4], 10.0),
        at(16, 150.0, 0.0, 10.0),
        at(16, 150.0, 20.0, 10.0),
        with(at(18, 120.0, 20.0, 10.0), [1.0, 0.0, 0.0, 0.0]),
        act(30, [0.0; 4], 20.0),
        act(210, [1.0, 0.0, 0.0, 0.0], 0.0),
        act(19, [2.0, 0.0, 0.0, 0.0], 0.0),
        act(22, [0.0; 4], 25.0),
        at(16, 100.0, 0.0, 25.0),
    ]);
    ground.run(1.5);
    ground.start_mission();
    ground.step();
    ground.news();
    follow(&mut ground, &[(8.85, &["R 1", "Mission: 2 WP"])], 0.05);
    let speed = MavCmd::MAV_CMD_DO_CHANGE_SPEED;
    ground.run(4.1);
    ground.long(speed, [1.0, 4.0, -1.0]);
    ground.run(10.05);
    ground.long(speed, [1.0, 8.0, -1.0]);
    follow(
        &mut ground,
        &[
            (11.75, &["R 2", "Reached command #2", "Mission: 3 WP"]),
            (6.75, &["R 3", "Reached command #3", "Mission: 4 LoitTurns"]),
            (
                29.4,
                &[
                    "R 6",
                    "Mission: 5 ContinueAndChangeAlt",
                    "Mission: 6 InvertedFlight",
                    "Mission: 7 LoitTime",
                    "Skipping invalid cmd #210",
                ],
            ),
        ],
        0.05,
    );
    // The duration of the first leg of some millimetres depends on the vehicle's exact position.
    follow(
        &mut ground,
        &[(3.2, &["R 7", "Reached command #7", "Mission: 8 Takeoff"])],
        0.35,
    );
    follow(
        &mut ground,
        &[
            (9.15, &["R 8", "Mission: 9 WP"]),
            (10.4, &["R 9", "Reached command #9"]),
        ],
        0.05,
    );
    assert_eq!(ground.current(), (9, 9, 5, 1));
    ground.run(3.0);
    ground.start_mission();
    ground.run(0.1);
    assert_eq!(
        ground.news(),
        ["Mission: 1 Takeoff", "R 1", "Mission: 2 WP"]
    );
    ground.run(4.0);
    ground.autopilot().vehicle.plans.mission.clear();
    ground.autopilot().plans_changed(ListKind::Plan);
    ground.step();
    assert_eq!(
        ground.news(),
        ["Auto mission changed but failed to restart command"]
    );
    assert_eq!(ground.current(), (2, 0, 1, 1));
    assert_eq!(ground.start_mission(), MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(ground.truth().mode, 3);
}
