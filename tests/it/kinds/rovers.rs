//! Rovers and boats.

use super::*;

#[test]
fn verbs_that_do_not_suit_a_rover_are_refused_before_anything_is_sent() {
    let mut talk = Talk::guided(ROVER);
    talk.assert_unsuited(&[
        (
            "takeoff",
            takeoff(),
            "it is a rover, which does not take off",
        ),
        ("land", land(), "`1 rtl` brings it back"),
        ("altitude", altitude(), "no height to change"),
        ("yaw", yaw(), "a rover turns only as it moves"),
        ("orbit", orbit(), "mode circle"),
        ("resume", resume(), "`1 plan resume`"),
        ("speed", speed(SpeedAxis::Climb), "neither climbs nor"),
        ("velocity", velocity([1.0, 0.0, -1.0]), "neither climbs nor"),
    ]);
    let mut talk = Talk::guided(BOAT);
    talk.assert_unsuited(&[("takeoff", takeoff(), "it is a boat")]);
}

#[test]
fn a_rover_has_arrived_where_it_stops_short_of_its_goal() {
    let mut talk = Talk::guided(ROVER);
    // A road uphill is not in the air.
    talk.craft.height_m = 12.0;
    let order = talk.order("goto", goto(30.0, 0.0));
    talk.pass(3);
    assert_eq!(talk.last(order), Some(RowState::Sent));
    let vehicle = talk.session.vehicle();
    assert!(!vehicle.airborne() && vehicle.is_under_way() && vehicle.moves());
    talk.pass(8);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!((talk.craft.at_m[0] - 28.0).abs() < 0.5);
    assert!(!talk.session.vehicle().moves());
}

#[test]
fn the_return_of_a_rover_is_done_when_it_stands_at_home() {
    let mut talk = Talk::guided(ROVER);
    let order = talk.order("goto", goto(0.0, 40.0));
    talk.pass(12);
    assert_eq!(talk.last(order), Some(RowState::Done));
    let order = talk.order("rtl", rtl());
    talk.pass(2);
    assert_eq!(talk.craft.mode(), "RTL");
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    assert!(!talk.has_arrived());
    talk.pass(10);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!(talk.has_arrived());
    assert!(talk.craft.armed, "a rover does not disarm itself");
}

#[test]
fn a_rover_in_smart_rtl_has_arrived_when_it_stands_at_home() {
    let mut talk = Talk::guided(ROVER);
    talk.craft.at_m = [0.0, 20.0];
    let name = "SMART_RTL".to_owned();
    talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
    talk.pass(2);
    // The target of this mode is the next place on the way back.
    talk.craft.goal_m = Some(talk.craft.at_m);
    talk.pass(1);
    assert!(!talk.has_arrived());
    (talk.craft.at_m, talk.craft.goal_m) = ([0.0, 1.0], None);
    talk.pass(1);
    assert!(talk.has_arrived());
}

#[test]
fn a_plan_goes_on_after_a_rover_has_held() {
    let mut talk = Talk::guided(ROVER);
    talk.craft.set_mode("HOLD");
    talk.pass(1);
    let order = talk.order(
        "plan resume",
        Command::PlanFlight(PlanFlight::Resume { item: None }),
    );
    // It has no plan, which is the only reason.
    let why = talk.explanation(order);
    assert!(!why.contains("on the ground"), "{why}");
}

#[test]
fn a_rover_that_stops_keeps_the_heading_of_its_velocity() {
    let mut talk = Talk::guided(ROVER);
    talk.order("velocity", velocity([0.0, 1.5, 0.0]));
    talk.pass(3);
    let last = talk.craft.velocity.expect("a setpoint");
    assert_eq!((last.vx, last.vy), (0.0, 0.0));
    assert!((last.yaw.to_degrees() - 90.0).abs() < 0.1);
    assert_eq!(last.type_mask.bits() & 0x400, 0, "the heading counts");
}

#[test]
fn a_rover_without_a_place_to_go_takes_no_speed_and_the_reason_says_so() {
    let mut talk = Talk::guided(ROVER);
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(8);
    assert_eq!(talk.last(order), Some(RowState::Refused));
    let why = talk.explanation(order);
    assert!(why.contains("`goto` first"), "{why}");
    talk.craft.set_mode("STEERING");
    talk.pass(1);
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(8);
    let why = talk.explanation(order);
    assert!(why.contains("STEERING"), "{why}");
}

#[test]
fn arming_and_modes_are_those_of_the_class() {
    let mut talk = Talk::new(ROVER);
    let order = talk.order("arm", Command::Arming(ArmingCommand::Arm));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
    for mode in [
        "MANUAL",
        "ACRO",
        "STEERING",
        "HOLD",
        "LOITER",
        "CIRCLE",
        "SMART_RTL",
        "GUIDED",
    ] {
        let name = mode.to_owned();
        let order = talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
        talk.pass(2);
        assert_eq!(
            (talk.craft.mode(), talk.last(order)),
            (mode, Some(RowState::Done))
        );
    }
    let name = "ALT_HOLD".to_owned();
    let order = talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
    assert_eq!(talk.last(order), Some(RowState::Refused));
    let order = talk.order("disarm", Command::Arming(ArmingCommand::Disarm));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
}
