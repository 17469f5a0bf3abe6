//! Commands, from the order to the effect.

use super::*;

#[test]
fn an_accepted_arm_is_done_when_the_heartbeat_says_armed() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1), [RowState::Sent, RowState::Accepted]);
    scene.heartbeat(GUIDED, true);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn a_silent_vehicle_is_asked_on_schedule_and_never_after_the_deadline() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.pass(ms(10_000));
    let sent = scene.longs(ARM);
    assert_eq!(
        sent.iter()
            .map(|long| long.confirmation)
            .collect::<Vec<_>>(),
        [0, 1, 2]
    );
    assert_eq!(scene.states(1).last(), Some(&RowState::TimedOut));
    assert_eq!(scene.explanation(1), "no answer to 3 tries in 3.5 s");
}

#[test]
fn a_refusal_is_explained_by_the_text_that_follows_it() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_FAILED);
    assert_eq!(
        scene.states(1),
        [RowState::Sent],
        "the reason may still come"
    );
    scene.text("Arm: Need Position Estimate");
    scene.pass(ms(400));
    assert_eq!(scene.states(1).last(), Some(&RowState::Refused));
    assert!(
        scene.explanation(1).contains("Need Position Estimate"),
        "{}",
        scene.explanation(1)
    );
}

#[test]
fn a_refusal_is_explained_by_the_text_that_came_before_it() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.text("Arm: Gyros inconsistent");
    scene.ack(ARM, MavResult::MAV_RESULT_FAILED);
    scene.pass(ms(400));
    assert!(scene.explanation(1).contains("Gyros inconsistent"));
}

#[test]
fn an_acknowledgement_for_another_ground_station_is_not_ours() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.hear(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command: ARM,
        result: MavResult::MAV_RESULT_FAILED,
        target_system: 100,
        ..COMMAND_ACK_DATA::DEFAULT
    }));
    scene.pass(ms(500));
    assert_eq!(scene.states(1), [RowState::Sent]);
}

#[test]
fn work_in_progress_is_not_sent_again_and_gets_more_time() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.hear(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command: ARM,
        result: MavResult::MAV_RESULT_IN_PROGRESS,
        progress: 40,
        ..COMMAND_ACK_DATA::DEFAULT
    }));
    scene.pass(ms(8000));
    assert_eq!(scene.states(1), [RowState::Sent, RowState::InProgress(40)]);
    assert_eq!(scene.longs(ARM).len(), 1);
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1).last(), Some(&RowState::Accepted));
}

#[test]
fn a_lost_acknowledgement_is_made_up_for_by_the_effect() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.heartbeat(STABILIZE, true);
    assert_eq!(
        scene.states(1).last(),
        Some(&RowState::Sent),
        "the answer may follow"
    );
    scene.pass(ms(400));
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn later_commands_wait_until_the_earlier_one_is_settled() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, false);
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.order(
        2,
        "takeoff",
        Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
    );
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert!(
        scene.longs(MavCmd::MAV_CMD_NAV_TAKEOFF).is_empty(),
        "the heartbeat has not said armed yet"
    );
    scene.heartbeat(GUIDED, true);
    assert_eq!(scene.longs(MavCmd::MAV_CMD_NAV_TAKEOFF).len(), 1);
}

#[test]
fn an_urgent_command_goes_before_everything_that_waits() {
    let mut scene = Scene::new();
    scene.order(
        1,
        "mode",
        Command::Flight(FlightCommand::SetMode {
            name: "GUIDED".into(),
        }),
    );
    scene.order(2, "arm", Command::Arming(ArmingCommand::Arm));
    scene.order(3, "rtl", Command::Flight(FlightCommand::ReturnToLaunch));
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    assert_eq!(scene.states(2).last(), Some(&RowState::Superseded));
    assert_eq!(scene.explanation(2), "by rtl");
    assert_eq!(scene.states(3), [RowState::Sent]);
    assert!(scene.longs(ARM).is_empty());
}

#[test]
fn a_setpoint_outside_guided_is_refused_here_because_the_vehicle_would_ignore_it() {
    let mut scene = Scene::new();
    let goto = Command::Motion(MotionCommand::Goto {
        destination: Destination::Local {
            north_m: 10.0,
            east_m: 0.0,
            up_m: None,
        },
        heading: Heading::Auto,
    });
    scene.order(1, "goto", goto);
    assert_eq!(scene.states(1), [RowState::Refused]);
    assert!(
        scene.explanation(1).contains("GUIDED"),
        "{}",
        scene.explanation(1)
    );
}

#[test]
fn the_answer_to_a_replaced_command_is_not_taken_for_that_of_its_successor() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.order(2, "kill", Command::Arming(ArmingCommand::Kill));
    // Both commands have the same `MAV_CMD`; this acknowledges the arm.
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(2), [RowState::Sent]);
    scene.heartbeat(STABILIZE, true);
    assert_eq!(scene.states(2), [RowState::Sent], "it is armed");
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(2).last(), Some(&RowState::Accepted));
    scene.pass(ms(100));
    scene.heartbeat(STABILIZE, false);
    assert_eq!(scene.states(2).last(), Some(&RowState::Done));
}

#[test]
fn what_was_so_before_proves_nothing_until_the_vehicle_says_it_again() {
    let mut scene = Scene::new();
    scene.now = ms(100);
    scene.order(1, "kill", Command::Arming(ArmingCommand::Kill));
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1).last(), Some(&RowState::Accepted));
    scene.pass(ms(200));
    scene.heartbeat(STABILIZE, false);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn a_temporary_rejection_is_tried_again_and_then_explained() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_TEMPORARILY_REJECTED);
    scene.pass(ms(1100));
    assert_eq!(scene.longs(ARM).len(), 2);
    scene.pass(ms(4000));
    assert_eq!(scene.states(1).last(), Some(&RowState::Refused));
}

#[test]
fn a_command_that_waited_too_long_is_not_sent_late() {
    let mut scene = Scene::new();
    scene.order(
        1,
        "mode",
        Command::Flight(FlightCommand::SetMode {
            name: "GUIDED".into(),
        }),
    );
    scene.order(2, "arm", Command::Arming(ArmingCommand::Arm));
    scene.pass(ms(5000));
    assert_eq!(scene.states(2), [RowState::TimedOut]);
    assert!(
        scene.explanation(2).starts_with("not sent"),
        "{}",
        scene.explanation(2)
    );
    assert!(scene.longs(ARM).is_empty());
}

#[test]
fn a_velocity_is_overtaken_when_the_vehicle_leaves_guided() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::EXTENDED_SYS_STATE(
        mavlink::dialects::ardupilotmega::EXTENDED_SYS_STATE_DATA {
            landed_state: mavlink::dialects::ardupilotmega::MavLandedState::MAV_LANDED_STATE_IN_AIR,
            ..Default::default()
        },
    ));
    let command = Command::Motion(MotionCommand::Velocity {
        ned_m_s: [2.0, 0.0, 0.0],
        lasting: ms(10_000),
    });
    scene.order(1, "velocity", command);
    scene.pass(ms(1000));
    assert_eq!(
        scene.states(1),
        [RowState::Sent],
        "{}",
        scene.explanation(1)
    );
    scene.heartbeat(STABILIZE, true);
    assert_eq!(scene.states(1).last(), Some(&RowState::Overtaken));
    assert!(scene.explanation(1).contains("STABILIZE"));
}

#[test]
fn a_refused_command_does_not_take_the_place_of_what_is_flying() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    let takeoff = MavCmd::MAV_CMD_NAV_TAKEOFF;
    scene.order(
        1,
        "takeoff",
        Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
    );
    scene.ack(takeoff, MavResult::MAV_RESULT_ACCEPTED);
    scene.order(2, "disarm", Command::Arming(ArmingCommand::Disarm));
    scene.ack(ARM, MavResult::MAV_RESULT_FAILED);
    scene.pass(ms(1000));
    assert_eq!(scene.states(2).last(), Some(&RowState::Refused));
    assert_eq!(scene.states(1).last(), Some(&RowState::Accepted));
}

#[test]
fn a_reboot_ends_what_was_meant_for_the_vehicle_before() {
    let mut scene = Scene::new();
    let attitude = |time_boot_ms| {
        MavMessage::ATTITUDE(mavlink::dialects::ardupilotmega::ATTITUDE_DATA {
            time_boot_ms,
            ..Default::default()
        })
    };
    scene.hear(attitude(60_000));
    scene.order(1, "land", Command::Flight(FlightCommand::Land));
    scene.pass(ms(500));
    scene.hear(attitude(400));
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    let sent = scene.longs(MavCmd::MAV_CMD_NAV_LAND).len();
    scene.pass(ms(5000));
    assert_eq!(scene.longs(MavCmd::MAV_CMD_NAV_LAND).len(), sent);
}

#[test]
fn who_has_started_the_autopilot_anew_needs_not_wait_for_its_clock() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::EXTENDED_SYS_STATE(
        mavlink::dialects::ardupilotmega::EXTENDED_SYS_STATE_DATA {
            landed_state: mavlink::dialects::ardupilotmega::MavLandedState::MAV_LANDED_STATE_IN_AIR,
            ..Default::default()
        },
    ));
    scene.order(1, "land", Command::Flight(FlightCommand::Land));
    scene.session.restarted(scene.now);
    scene.pass(ms(100));
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    let vehicle = scene.session.vehicle();
    assert_eq!(
        (vehicle.landed, vehicle.mode(), vehicle.armed()),
        (crate::vehicle::LandedState::Undefined, None, false)
    );
    assert_eq!(vehicle.link.reboots, 1);
    scene.heartbeat(STABILIZE, false);
    scene.order(2, "arm", Command::Arming(ArmingCommand::Arm));
    assert_ne!(scene.states(2).last(), Some(&RowState::Refused));
}

#[test]
fn a_turn_gives_way_to_a_movement_and_ends_none() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::ATTITUDE(
        mavlink::dialects::ardupilotmega::ATTITUDE_DATA::default(),
    ));
    let yaw = Command::Motion(MotionCommand::Yaw {
        angle_deg: 90.0,
        relative: false,
        rate_deg_s: None,
    });
    scene.order(1, "yaw", yaw.clone());
    scene.ack(
        MavCmd::MAV_CMD_CONDITION_YAW,
        MavResult::MAV_RESULT_ACCEPTED,
    );
    scene.order(
        2,
        "takeoff",
        Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
    );
    scene.ack(MavCmd::MAV_CMD_NAV_TAKEOFF, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    scene.order(3, "yaw", yaw);
    scene.ack(
        MavCmd::MAV_CMD_CONDITION_YAW,
        MavResult::MAV_RESULT_ACCEPTED,
    );
    scene.pass(ms(500));
    assert_eq!(scene.states(2).last(), Some(&RowState::Accepted));
}

fn message(line: &str) -> Command {
    let statement = language::parse(line, &language::Context::default()).expect(line);
    match statement.meaning {
        language::Meaning::Act(Act::Command(command)) => command,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn a_raw_message_is_sent_once_to_the_vehicle_and_claims_nothing_more() {
    let mut scene = Scene::new();
    scene.sent.clear();
    scene.order(
        1,
        "send",
        message("3 send PARAM_REQUEST_READ param_index=7"),
    );
    let id = 20;
    let payload = [&[7, 0, 3, 1][..], &[0; 16]].concat();
    assert_eq!(scene.sent, [Outgoing::Raw { id, payload }]);
    assert_eq!(scene.states(1), [RowState::Sent, RowState::SentOnly]);
    scene.pass(ms(10_000));
    assert_eq!(scene.states(1).len(), 2);
}

#[test]
fn the_answer_to_a_raw_message_is_not_taken_for_that_of_the_next_command() {
    let mut scene = Scene::new();
    scene.order(
        1,
        "send",
        message("3 send COMMAND_LONG command=COMPONENT_ARM_DISARM param1=1"),
    );
    scene.order(2, "arm", Command::Arming(ArmingCommand::Arm));
    scene.ack(ARM, MavResult::MAV_RESULT_FAILED);
    assert_eq!(scene.states(2), [RowState::Sent]);
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(2).last(), Some(&RowState::Accepted));
}

#[test]
fn a_raw_message_with_a_forced_disarm_is_as_risky_as_the_verb() {
    let kill = message("3 send COMMAND_LONG command=400 param2=21196");
    assert_eq!(kill.risk(), Risk::Unsafe);
    assert_eq!(message("3 send HEARTBEAT").risk(), Risk::None);
    assert_eq!(kill.setup(), Some(Setup::Anything));
}

#[test]
fn a_radio_under_test_delays_both_directions_and_shows_its_figures() {
    let mut scene = Scene::new();
    scene.pass(ms(100));
    scene.sent.clear();
    let satellite = RadioPreset::Satellite.test();
    scene.session.carry_out(Want::RadioTest(Some(satellite)));
    scene.order(1, "arm", Command::Arming(ArmingCommand::Arm));
    scene.pass(ms(590));
    assert!(scene.longs(ARM).is_empty(), "on the way");
    scene.pass(ms(20));
    assert_eq!(scene.longs(ARM).len(), 1);
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1), [RowState::Sent]);
    scene.pass(ms(610));
    assert_eq!(scene.states(1).last(), Some(&RowState::Accepted));
    let radio = scene.session.vehicle().link.radio.expect("under test");
    assert_eq!((radio.test, radio.received.passed), (satellite, 1));
    scene.session.carry_out(Want::RadioTest(None));
    scene.pass(ms(20));
    assert_eq!(scene.session.vehicle().link.radio, None);
}

/// While a list is downloaded, the old value may still be on its way when a new one is set.
#[test]
fn an_old_value_on_its_way_is_no_refusal() {
    let value = |param_value| {
        MavMessage::PARAM_VALUE(mavlink::dialects::ardupilotmega::PARAM_VALUE_DATA {
            param_id: "INS_GYROFFS_Y".into(),
            param_type: mavlink::dialects::ardupilotmega::MavParamType::MAV_PARAM_TYPE_REAL32,
            param_value,
            ..Default::default()
        })
    };
    let set = || {
        Command::Parameter(crate::commands::ParameterCommand::Set {
            name: "INS_GYROFFS_Y".to_owned(),
            value: 0.5,
        })
    };
    let mut scene = Scene::new();
    scene.order(1, "param", set());
    scene.hear(value(0.25));
    scene.pass(ms(300));
    scene.hear(value(0.5));
    scene.pass(ms(2000));
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));

    scene.order(2, "param", set());
    scene.hear(value(0.25));
    scene.pass(ms(900));
    assert!(!scene.states(2).contains(&RowState::Refused));
    scene.pass(ms(200));
    assert_eq!(scene.states(2).last(), Some(&RowState::Refused));
    assert!(scene.explanation(2).contains("stayed 0.25"));
}
