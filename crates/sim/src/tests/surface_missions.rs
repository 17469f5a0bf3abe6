//! Mission items of rovers, with the times, places and texts that a real `ArduRover` 4.6 had in SITL.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::driving::{guided, off_m, texts};
use super::*;
use sortie_geo::wrap_180;

const AUTO: u16 = 10;
const WAYPOINT: u16 = 16;
const TURNS: u16 = 18;
const GUIDED_ENABLE: u16 = 92;
const CHANGE_SPEED: u16 = 178;
const REVERSE: u16 = 194;
const FENCE: u16 = 207;
const YAW_SPEED: u16 = 213;
const GUIDED_LIMITS: u16 = 222;

fn act(command: u16, params: [f32; 4]) -> Item {
    Item {
        command,
        params,
        frame: crate::frame::GLOBAL_RELATIVE_ALT,
        ..Item::default()
    }
}

fn at(north: f64, east: f64, command: u16, params: [f32; 4]) -> Item {
    let (x, y) = start().at.moved(north, east).to_e7();
    Item {
        x,
        y,
        ..act(command, params)
    }
}

fn waypoint(north: f64, east: f64) -> Item {
    at(north, east, WAYPOINT, [0.0; 4])
}

/// A mission that has just begun.
fn on_a_mission(chassis: Chassis, items: &[Item]) -> Ground {
    let mut ground = guided(chassis);
    begin(&mut ground, items);
    ground
}

fn begin(ground: &mut Ground, items: &[Item]) {
    assert!(ground.world.load(0, ListKind::Plan, items));
    let answer = ground.long(MavCmd::MAV_CMD_MISSION_START, [0.0]);
    assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED);
}

/// The seconds after which a text arrives.
fn until_text(ground: &mut Ground, text: &str, most_s: f64) -> f64 {
    let first = ground.heard.len();
    let mut elapsed_s = 0.0;
    while elapsed_s < most_s {
        ground.run(0.1);
        elapsed_s += 0.1;
        let said = ground.messages_since(first).into_iter();
        if said.into_iter().any(
            |message| matches!(message, MavMessage::STATUSTEXT(said) if said.text.to_str() == Ok(text)),
        ) {
            return elapsed_s;
        }
    }
    f64::INFINITY
}

#[track_caller]
fn near(what: &str, got: f64, real: f64, within: f64) {
    assert!(
        (got - real).abs() <= within,
        "{what}: {got:.1}, the real one {real}"
    );
}

#[test]
fn turns_are_driven_around_their_place_and_counted() {
    let counterclockwise = at(30.0, 0.0, TURNS, [1.0, 0.0, -10.0, 1.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[counterclockwise, waypoint(0.0, 10.0)]);
    near(
        "the turn",
        until_text(&mut ground, "Mission: 2 WP", 60.0),
        34.4,
        1.5,
    );
    near(
        "the end",
        until_text(&mut ground, "Mission Complete", 60.0),
        16.4,
        1.5,
    );

    let wide = at(0.0, 300.0, TURNS, [0.1, 0.0, 307.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[wide, waypoint(0.0, 10.0)]);
    near(
        "a wide turn",
        until_text(&mut ground, "Mission: 2 WP", 60.0),
        41.8,
        1.0,
    );

    let none = at(30.0, 0.0, TURNS, [0.0, 0.0, 10.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[none, waypoint(0.0, 10.0)]);
    ground.run(0.1);
    assert!(
        texts(&ground).contains(&"Mission: 2 WP".to_owned()),
        "no turn at all"
    );
}

#[test]
fn a_narrow_circle_is_as_wide_as_the_vehicle_can_turn() {
    let narrow = at(10.0, 0.0, TURNS, [1.0, 0.0, 0.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[narrow]);
    ground.run(0.1);
    let text = "Circle: radius increased to TURN_RADIUS ( 0.9)".to_owned();
    assert!(texts(&ground).contains(&text));
}

/// The real one stood there for as long as it was watched, too.
#[test]
fn a_vehicle_at_right_angles_to_the_edge_of_its_circle_stands() {
    let circle = at(30.0, 30.0, TURNS, [2.0, 0.0, 10.0, 0.0]);
    let items = [waypoint(30.0, 0.0), circle, waypoint(0.0, 30.0)];
    let mut ground = on_a_mission(Chassis::Ackermann, &items);
    ground.run(100.0);
    let off = off_m(&ground.truth(), [38.0, 13.5]);
    assert!(off < 1.0, "{off}");
    assert!(!texts(&ground).contains(&"Mission: 3 WP".to_owned()));
}

#[test]
fn a_heading_is_driven_to_and_a_relative_one_to_the_west_for_ever() {
    let items = [
        waypoint(20.0, 0.0),
        act(YAW_SPEED, [90.0, 2.0, 0.0, 0.0]),
        waypoint(20.0, 30.0),
    ];
    let mut ground = on_a_mission(Chassis::Ackermann, &items);
    assert!(until_text(&mut ground, "Mission: 2 SetYawSpd", 20.0).is_finite());
    near(
        "the heading",
        until_text(&mut ground, "Mission: 3 WP", 20.0),
        2.4,
        0.6,
    );
    near(
        "the end",
        until_text(&mut ground, "Mission Complete", 30.0),
        13.8,
        1.5,
    );

    let west = act(YAW_SPEED, [-90.0, 1.0, 1.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[west, waypoint(20.0, 30.0)]);
    ground.run(60.0);
    near("along", ground.truth().heading_deg, 270.0, 4.0);
    assert!(!texts(&ground).contains(&"Mission: 2 WP".to_owned()));
}

#[test]
fn north_is_reached_from_either_side() {
    for legs in [
        vec![waypoint(20.0, 0.0)],
        vec![waypoint(20.0, 0.0), waypoint(20.0, 20.0)],
        vec![waypoint(20.0, 0.0), waypoint(20.0, -20.0)],
    ] {
        let next = format!("Mission: {} WP", legs.len() + 2);
        let north = [act(YAW_SPEED, [0.0, 2.0, 0.0, 0.0]), waypoint(90.0, 0.0)];
        let items = [legs.as_slice(), &north].concat();
        let mut ground = on_a_mission(Chassis::Ackermann, &items);
        assert!(until_text(&mut ground, &next, 60.0).is_finite(), "{legs:?}");
    }
}

#[test]
fn a_commanded_speed_is_that_of_what_the_mission_does() {
    let west = act(YAW_SPEED, [-90.0, 1.0, 1.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[west]);
    ground.run(10.0);
    near("before", super::driving::speed(&ground.truth()), 1.0, 0.2);
    let answer = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 2.0]);
    assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED);
    ground.run(10.0);
    near("after", super::driving::speed(&ground.truth()), 2.0, 0.2);
}

#[test]
fn a_speed_is_that_of_what_the_vehicle_does() {
    // The first one precedes the circle, the others are for it.
    let items = [
        act(CHANGE_SPEED, [1.0, 1.5, 0.0, 0.0]),
        act(CHANGE_SPEED, [1.0, 3.0, 0.0, 0.0]),
        act(CHANGE_SPEED, [1.0, -2.0, 0.0, 0.0]),
        at(20.0, 0.0, TURNS, [1.0, 0.0, 10.0, 0.0]),
        waypoint(0.0, 20.0),
    ];
    let mut ground = on_a_mission(Chassis::Ackermann, &items);
    ground.run(20.0);
    let said = texts(&ground);
    let speeds: Vec<_> = said
        .iter()
        .filter(|text| text.starts_with("speed"))
        .collect();
    assert_eq!(speeds, ["speed: 1.5 m/s", "speed: 3.0 m/s"], "{said:?}");
    assert!(
        said.contains(&"Mission: 3 ChangeSpeed".to_owned()),
        "{said:?}"
    );
    near(
        "the circle",
        super::driving::speed(&ground.truth()),
        3.0,
        0.3,
    );
}

#[test]
fn a_mission_ends_as_its_parameter_says() {
    // A place that is held has no speed to change.
    let (stops, holds) = (MavResult::MAV_RESULT_ACCEPTED, MavResult::MAV_RESULT_FAILED);
    for (behaviour, mode, answer) in [
        (0.0, 10, Some(stops)),
        (1.0, 10, Some(holds)),
        (2.0, 1, None),
        (3.0, 0, None),
    ] {
        let mut ground = guided(Chassis::Ackermann);
        ground.set("MIS_DONE_BEHAVE", behaviour);
        begin(&mut ground, &[waypoint(15.0, 0.0)]);
        near(
            "the end",
            until_text(&mut ground, "Mission Complete", 20.0),
            10.9,
            1.0,
        );
        ground.run(1.0);
        assert_eq!(ground.truth().mode, mode, "{behaviour}");
        if let Some(answer) = answer {
            let got = ground.long(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 2.0]);
            assert_eq!(got, answer, "{behaviour}");
        }
    }
}

#[test]
fn control_by_setpoints_ends_at_its_limits_and_at_its_place() {
    let items = [
        act(GUIDED_LIMITS, [4.0, 0.0, 0.0, 0.0]),
        act(GUIDED_ENABLE, [1.0, 0.0, 0.0, 0.0]),
        waypoint(10.0, 10.0),
    ];
    let mut ground = on_a_mission(Chassis::Ackermann, &items);
    near(
        "the time",
        until_text(&mut ground, "Mission: 3 WP", 20.0),
        4.0,
        0.2,
    );

    let there = at(1.0, 1.0, GUIDED_ENABLE, [1.0, 0.0, 0.0, 0.0]);
    let mut ground = on_a_mission(Chassis::Ackermann, &[there, waypoint(10.0, 10.0)]);
    ground.run(0.2);
    assert!(
        texts(&ground).contains(&"Mission: 2 WP".to_owned()),
        "it is there"
    );

    let far = [
        act(GUIDED_LIMITS, [0.0, 0.0, 0.0, 12.0]),
        act(GUIDED_ENABLE, [1.0, 0.0, 0.0, 0.0]),
        waypoint(10.0, 10.0),
    ];
    let mut ground = on_a_mission(Chassis::Ackermann, &far);
    ground.run(0.1);
    ground.goto([40.0, 0.0, 0.0]);
    assert!(until_text(&mut ground, "Mission: 3 WP", 20.0).is_finite());
    near("the way", ground.truth().position_ned_m[0], 12.0, 1.5);
}

#[test]
fn a_reversed_vehicle_backs_up_until_the_mission_or_the_mode_changes_that() {
    let items = [
        waypoint(15.0, 0.0),
        act(REVERSE, [1.0, 0.0, 0.0, 0.0]),
        waypoint(40.0, 0.0),
        waypoint(40.0, 20.0),
        act(REVERSE, [0.0; 4]),
        waypoint(20.0, 20.0),
    ];
    for (chassis, corner_s, end_s) in [
        (Chassis::Ackermann, 19.2, 38.0),
        (Chassis::Boat, 18.6, 36.8),
    ] {
        let mut ground = on_a_mission(chassis, &items);
        let there_s = until_text(&mut ground, "Reached waypoint #3", 40.0);
        near("the corner", there_s, corner_s, 3.0);
        let truth = ground.truth();
        let backwards = wrap_180(truth.heading_deg - 180.0).abs() < 60.0;
        assert!(truth.velocity_ned_m_s[0] > 0.5 && backwards, "{truth:?}");
        let more_s = until_text(&mut ground, "Mission Complete", 40.0);
        near("the end", there_s + more_s, end_s, 3.0);
    }
    let mut ground = guided(Chassis::Ackermann);
    let answer = ground.long(MavCmd::MAV_CMD_DO_SET_REVERSE, [1.0]);
    assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED);
    ground.goto([-60.0, 0.5, 0.0]);
    ground.run(8.0);
    assert!(ground.truth().velocity_ned_m_s[0] < -2.0);
    assert!(
        wrap_180(ground.truth().heading_deg).abs() < 30.0,
        "its nose still points north"
    );
}

#[test]
fn the_fence_is_switched_with_a_text() {
    let items = [
        act(FENCE, [1.0, 0.0, 0.0, 0.0]),
        waypoint(10.0, 0.0),
        act(FENCE, [0.0; 4]),
        waypoint(15.0, 0.0),
    ];
    let is_on = |ground: &Ground| {
        let vehicle = &ground.world.slots[0].autopilot.vehicle;
        vehicle.tuning.flight.fence.is_enabled
    };
    let mut ground = on_a_mission(Chassis::Ackermann, &items);
    assert!(!is_on(&ground));
    ground.run(0.2);
    let said = texts(&ground);
    assert!(said.contains(&"Fence Enabled".to_owned()), "{said:?}");
    assert!(is_on(&ground));
    assert!(until_text(&mut ground, "Fence Disabled", 30.0).is_finite());
    assert!(!is_on(&ground));
    assert_eq!(ground.truth().mode, u32::from(AUTO) as u8);
}
