//! Orders superseded because another source has taken over the vehicle.

use mavlink::dialects::ardupilotmega::{EXTENDED_SYS_STATE_DATA, MavLandedState};

use super::targets::under_way;
use super::*;

const RTL: u32 = 6;
const LAND: u32 = 9;

fn last(scene: &Scene, entry: u32) -> RowState {
    *scene.states(entry).last().expect("a row")
}

/// A vehicle that was on its way to a target, and has then accepted a return with entry 2.
fn returning() -> Scene {
    let mut scene = under_way();
    scene.order(2, "rtl", Command::Flight(FlightCommand::ReturnToLaunch));
    scene.ack(
        MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH,
        MavResult::MAV_RESULT_ACCEPTED,
    );
    scene
}

fn says(scene: &mut Scene, landed_state: MavLandedState) {
    scene.hear(MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
        landed_state,
        ..Default::default()
    }));
}

#[test]
fn a_goto_is_overtaken_by_the_mode_that_something_else_has_chosen() {
    let mut scene = under_way();
    scene.heartbeat(GUIDED, true);
    assert_eq!(last(&scene, 1), RowState::Sent);
    scene.heartbeat(RTL, true);
    assert_eq!(last(&scene, 1), RowState::Overtaken);
    assert_eq!(scene.explanation(1), "by RTL");
}

#[test]
fn a_goto_is_overtaken_when_the_motors_are_switched_off() {
    let mut scene = under_way();
    scene.heartbeat(GUIDED, true);
    scene.heartbeat(GUIDED, false);
    assert_eq!(last(&scene, 1), RowState::Overtaken);
    assert_eq!(scene.explanation(1), "by disarming");
}

#[test]
fn a_goto_that_a_crash_has_ended_says_so() {
    let mut scene = under_way();
    scene.heartbeat(GUIDED, true);
    scene.text("Crash: Disarming: AngErr=79>30, Accel=0.8<3.0");
    scene.heartbeat(GUIDED, false);
    assert_eq!(last(&scene, 1), RowState::Overtaken);
    assert_eq!(scene.explanation(1), "by a crash");
}

#[test]
fn an_order_of_ours_takes_the_place_of_a_goto_also_if_the_mode_shows_before_the_answer() {
    let mut scene = under_way();
    scene.heartbeat(GUIDED, true);
    scene.order(2, "rtl", Command::Flight(FlightCommand::ReturnToLaunch));
    scene.heartbeat(RTL, true);
    scene.ack(
        MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH,
        MavResult::MAV_RESULT_ACCEPTED,
    );
    assert_eq!(last(&scene, 1), RowState::Superseded);
}

#[test]
fn a_return_is_done_when_the_vehicle_has_landed() {
    let mut scene = returning();
    scene.heartbeat(RTL, true);
    for _ in 0..60 {
        scene.pass(ms(1000));
        scene.heartbeat(RTL, true);
    }
    assert_eq!(last(&scene, 2), RowState::Accepted);
    says(&mut scene, MavLandedState::MAV_LANDED_STATE_ON_GROUND);
    assert_eq!(last(&scene, 2), RowState::Done);
}

#[test]
fn a_return_that_does_not_begin_has_no_effect() {
    let mut scene = returning();
    for _ in 0..4 {
        scene.heartbeat(GUIDED, true);
        scene.pass(ms(1000));
    }
    assert_eq!(last(&scene, 2), RowState::NoEffect);
    assert_eq!(scene.explanation(2), "not seen within 3 s: mode RTL");
}

#[test]
fn a_return_that_something_else_breaks_off_is_overtaken() {
    let mut scene = returning();
    scene.heartbeat(RTL, true);
    scene.heartbeat(LAND, true);
    assert_eq!(last(&scene, 2), RowState::Overtaken);
    assert_eq!(scene.explanation(2), "by LAND");
}

#[test]
fn arming_that_was_done_ends_with_the_disarming() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    scene.heartbeat(STABILIZE, true);
    assert_eq!(last(&scene, 1), RowState::Done);
    scene.pass(ms(10_000));
    scene.heartbeat(STABILIZE, false);
    assert_eq!(last(&scene, 1), RowState::Overtaken);
    assert_eq!(scene.explanation(1), "by disarming: no takeoff within 10 s");
    let reported = scene.states(1).len();
    scene.heartbeat(STABILIZE, false);
    assert_eq!(scene.states(1).len(), reported, "it is said once");
}

#[test]
fn arming_is_not_overtaken_by_our_own_disarming() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    scene.heartbeat(STABILIZE, true);
    scene.order(2, "disarm", Command::Arming(ArmingCommand::Disarm));
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    scene.heartbeat(STABILIZE, false);
    assert_eq!(last(&scene, 1), RowState::Done);
    assert_eq!(last(&scene, 2), RowState::Done);
}

#[test]
fn a_takeoff_is_overtaken_by_the_landing_that_another_station_orders() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.order(
        1,
        "takeoff",
        Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
    );
    scene.ack(MavCmd::MAV_CMD_NAV_TAKEOFF, MavResult::MAV_RESULT_ACCEPTED);
    scene.heartbeat(GUIDED, true);
    assert_eq!(last(&scene, 1), RowState::Accepted);
    scene.heartbeat(LAND, true);
    assert_eq!(last(&scene, 1), RowState::Overtaken);
    assert_eq!(scene.explanation(1), "by LAND");
}
