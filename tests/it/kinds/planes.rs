//! Planes: after the sources only, no `ArduPlane` takes part.

use super::*;

#[test]
fn verbs_that_do_not_suit_a_plane_are_refused_before_anything_is_sent() {
    let mut talk = Talk::guided(PLANE);
    talk.assert_unsuited(&[("goto", goto(500.0, 0.0), "`1 mode takeoff`")]);
    talk.craft.height_m = 50.0;
    talk.pass(1);
    talk.assert_unsuited(&[
        ("takeoff", takeoff(), "`1 mode takeoff`"),
        ("land", land(), "a plane lands by plan"),
        ("yaw", yaw(), "a plane turns only as it moves"),
        ("velocity", velocity([10.0, 0.0, 0.0]), "`1 speed`"),
        ("orbit", orbit(), "WP_LOITER_RAD"),
        ("resume", resume(), "`1 plan resume`"),
        ("speed", speed(SpeedAxis::Climb), "TECS_CLMB_MAX"),
    ]);
}

#[test]
fn a_plane_has_arrived_when_it_circles_around_its_goal() {
    let mut talk = Talk::guided(PLANE);
    talk.craft.height_m = 50.0;
    talk.pass(1);
    let order = talk.order("goto", goto(150.0, 0.0));
    talk.pass(5);
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    assert_eq!(
        talk.craft.heard.last().map(String::as_str),
        Some("MAV_CMD_DO_REPOSITION")
    );
    talk.pass(20);
    assert_eq!(talk.last(order), Some(RowState::Done));
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
    // The type of the speed: 0 is airspeed.
    assert_eq!(
        talk.craft.heard.last().map(String::as_str),
        Some("MAV_CMD_DO_CHANGE_SPEED 0")
    );
}

#[test]
fn a_plane_is_back_when_it_circles_above_home() {
    let mut talk = Talk::guided(PLANE);
    (talk.craft.height_m, talk.craft.at_m) = (50.0, [200.0, 0.0]);
    talk.pass(1);
    let order = talk.order("rtl", rtl());
    talk.pass(5);
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    talk.pass(30);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!(talk.has_arrived() && talk.session.vehicle().airborne());
}

#[test]
fn a_plane_above_home_is_not_back_until_it_is_at_its_height() {
    let mut talk = Talk::guided(PLANE);
    let order = talk.order("rtl", rtl());
    for height_m in [0.0, 20.0] {
        talk.craft.height_m = height_m;
        talk.pass(5);
        assert_eq!(talk.last(order), Some(RowState::Accepted), "{height_m} m");
        assert!(!talk.has_arrived(), "{height_m} m");
    }
    talk.craft.height_m = 45.0;
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!(talk.has_arrived());
}

#[test]
fn a_plan_begins_at_its_first_item_on_the_ground_and_continues_in_the_air() {
    for (height_m, item) in [(0.0, 1), (50.0, 4)] {
        let mut talk = Talk::guided(PLANE);
        talk.craft.height_m = height_m;
        talk.pass(1);
        let order = talk.order("plan start", Command::PlanFlight(PlanFlight::Start));
        talk.pass(1);
        assert_eq!(talk.last(order), Some(RowState::Done));
        assert_eq!((talk.craft.mode(), talk.craft.plan_item), ("AUTO", item));
    }
}

#[test]
fn a_plane_flies_to_metres_from_its_origin_and_keeps_no_heading() {
    let mut talk = Talk::guided(PLANE);
    (talk.craft.height_m, talk.craft.at_m) = (50.0, [20.0, -10.0]);
    talk.pass(1);
    let local = |heading| {
        Command::Motion(MotionCommand::Goto {
            destination: Destination::Local {
                north_m: 100.0,
                east_m: 30.0,
                up_m: Some(60.0),
            },
            heading,
        })
    };
    let words = "leave out `face` and `keep`";
    talk.assert_unsuited(&[
        ("goto", local(Heading::Keep), words),
        ("goto", local(Heading::Fixed(90.0)), words),
    ]);
    let order = talk.order("goto", local(Heading::Auto));
    let [north_m, east_m] = talk.craft.goal_m.expect("a goal");
    let is_there = (north_m - 100.0).abs() < 0.5 && (east_m - 30.0).abs() < 0.5;
    assert!(is_there, "{north_m} {east_m}");
    assert!((talk.craft.goal_height_m - 60.0).abs() < 0.5);
    talk.pass(20);
    assert_eq!(talk.last(order), Some(RowState::Done));
}

#[test]
fn a_plane_that_hovers_may_take_off() {
    let mut talk = Talk::guided(PLANE);
    talk.craft.hovers = true;
    talk.session.fetch_parameters(talk.now);
    talk.pass(2);
    let order = talk.order("takeoff", takeoff());
    talk.pass(2);
    assert_eq!(
        talk.last(order),
        Some(RowState::Done),
        "{}",
        talk.explanation(order)
    );
    let mut talk = Talk::guided(MavType::MAV_TYPE_VTOL_TILTROTOR);
    talk.craft.hovers = true;
    let order = talk.order("takeoff", takeoff());
    talk.pass(2);
    assert_eq!(talk.last(order), Some(RowState::Done));
}
