//! Commands, refusals and targets.

use mavlink::dialects::ardupilotmega::{
    COMMAND_INT_DATA, MavCmd, MavFrame, MavMessage, MavModeFlag, MavResult,
};

use super::ground::GUIDED;
use super::*;
use sortie_wire::Outgoing;

const ACCEPTED: MavResult = MavResult::MAV_RESULT_ACCEPTED;
const DENIED: MavResult = MavResult::MAV_RESULT_DENIED;
const UNSUPPORTED: MavResult = MavResult::MAV_RESULT_UNSUPPORTED;
const FAILED: MavResult = MavResult::MAV_RESULT_FAILED;

fn ids(messages: &[MavMessage]) -> Vec<u32> {
    messages.iter().map(mavlink::Message::message_id).collect()
}

#[test]
fn a_silent_port_hears_heartbeats_and_events_only() {
    let mut ground = Ground::new();
    ground.run(12.0);
    let heard = ids(&ground.messages_since(0));
    assert!(
        heard.iter().all(|id| [0, 111, 49, 242].contains(id)),
        "{heard:?}"
    );
    assert_eq!(
        heard.iter().filter(|id| **id == 0).count(),
        13,
        "one per second"
    );
    assert!(heard.contains(&242) && heard.contains(&111));
}

#[test]
fn the_vehicle_is_honest_until_it_is_ready() {
    let mut ground = Ground::new();
    ground.heartbeat();
    ground.run(0.5);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]),
        ACCEPTED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        FAILED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 21196.0]),
        FAILED
    );
    assert!(
        ground
            .texts()
            .contains(&"Arm: Need Position Estimate".to_owned())
    );
    let state = |ground: &mut Ground| {
        let before = ground.heard.len();
        ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [1.0]);
        ground.long(MavCmd::MAV_CMD_REQUEST_MESSAGE, [193.0]);
        let mut state = (false, 0);
        for message in ground.messages_since(before) {
            match message {
                MavMessage::SYS_STATUS(data) => {
                    state.0 = data.onboard_control_sensors_health.bits() & 0x1000_0000 != 0;
                }
                MavMessage::EKF_STATUS_REPORT(data) => state.1 = data.flags.bits(),
                _ => {}
            }
        }
        state
    };
    assert_eq!(state(&mut ground), (false, 0x00A7));
    ground.run(1.0);
    assert_eq!(state(&mut ground), (true, 0x033F));
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
}

#[test]
fn the_ack_comes_before_the_reason_and_names_the_asker() {
    let mut ground = Ground::new();
    let before = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    let said = ground.messages_since(before);
    let MavMessage::COMMAND_ACK(ack) = &said[0] else {
        panic!("{said:?}");
    };
    assert_eq!((ack.target_system, ack.target_component), (255, 190));
    assert!(matches!(said[1], MavMessage::STATUSTEXT(_)));
}

#[test]
fn refusals_are_those_of_the_real_vehicle_on_the_ground() {
    let mut ground = Ground::new();
    ground.run(2.0);
    for (command, p, result) in [
        (MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0; 4], FAILED),
        (MavCmd::MAV_CMD_DO_SET_MODE, [0.0, 4.0, 0.0, 0.0], DENIED),
        (
            MavCmd::MAV_CMD_DO_SET_MODE,
            [209.0, 4.5, 0.0, 0.0],
            ACCEPTED,
        ),
        (MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 99.0, 0.0, 0.0], FAILED),
        (MavCmd::MAV_CMD_DO_SET_MODE, [1.0, -1.0, 0.0, 0.0], FAILED),
        (MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 14.0, 0.0, 0.0], FAILED),
        (
            MavCmd::MAV_CMD_DO_SET_MODE,
            [1.0, f32::NAN, 0.0, 0.0],
            DENIED,
        ),
        (MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 9.0, 0.0, 0.0], ACCEPTED),
        (
            MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
            [1.0, 0.0, 0.0, 0.0],
            FAILED,
        ),
        (
            MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
            [0.0, 0.0, 0.0, 0.0],
            ACCEPTED,
        ),
        (
            MavCmd::MAV_CMD_CONDITION_YAW,
            [400.0, 0.0, 0.0, 0.0],
            FAILED,
        ),
        (MavCmd::MAV_CMD_CONDITION_YAW, [10.0, 0.0, 0.0, 2.0], FAILED),
        (
            MavCmd::MAV_CMD_DO_CHANGE_SPEED,
            [0.0, -1.0, 0.0, 0.0],
            FAILED,
        ),
        (
            MavCmd::MAV_CMD_DO_CHANGE_SPEED,
            [0.0, 5.0, 0.0, 0.0],
            FAILED,
        ),
        (
            MavCmd::MAV_CMD_DO_REPOSITION,
            [-1.0, 1.0, 0.0, 0.0],
            UNSUPPORTED,
        ),
        (MavCmd::MAV_CMD_NAV_WAYPOINT, [0.0; 4], UNSUPPORTED),
        (MavCmd::MAV_CMD_DO_ORBIT, [0.0; 4], UNSUPPORTED),
        (
            MavCmd::MAV_CMD_PREFLIGHT_STORAGE,
            [1.0, 0.0, 0.0, 0.0],
            DENIED,
        ),
        (
            MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
            [0.0; 4],
            UNSUPPORTED,
        ),
        (
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
            [12345.0, 1000.0, 0.0, 0.0],
            DENIED,
        ),
        (
            MavCmd::MAV_CMD_REQUEST_MESSAGE,
            [141.0, 0.0, 0.0, 0.0],
            FAILED,
        ),
        (
            MavCmd::MAV_CMD_REQUEST_MESSAGE,
            [148.0, 0.0, 0.0, 0.0],
            ACCEPTED,
        ),
        (
            MavCmd::MAV_CMD_DO_SET_SERVO,
            [1.0, 1500.0, 0.0, 0.0],
            FAILED,
        ),
        (
            MavCmd::MAV_CMD_DO_SET_SERVO,
            [9.0, 1500.0, 0.0, 0.0],
            ACCEPTED,
        ),
    ] {
        assert_eq!(ground.long(command, p), result, "{command:?} {p:?}");
    }
    for text in [
        "No such mode 99",
        "No such mode 255",
        "Mode change to FLIP failed: init failed",
        "Arm: LAND mode not armable",
        "No ap_message for mavlink id (12345)",
    ] {
        assert!(ground.texts().iter().any(|said| said == text), "{text}");
    }
}

#[test]
fn refusals_are_those_of_the_real_vehicle_in_the_air() {
    let mut ground = Ground::hovering(10.0);
    let mut takeoff = [0.0; 7];
    takeoff[6] = 20.0;
    assert_eq!(ground.long7(MavCmd::MAV_CMD_NAV_TAKEOFF, takeoff), FAILED);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21195.0]),
        FAILED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]),
        FAILED
    );
    assert_eq!(ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 3.0]), FAILED);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 27.0]),
        FAILED
    );
    let texts = ground.texts();
    assert!(
        texts.iter().any(|t| t == "landing sequence found"),
        "two chunks: {texts:?}"
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_FLIGHTTERMINATION, [1.0]),
        ACCEPTED
    );
    assert!(!ground.truth().armed);
}

#[test]
fn commands_without_a_name_and_for_others_are_treated_as_the_vehicle_does() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let raw = |number: u16, system: u8| {
        let mut payload = vec![0; 33];
        payload[28..30].copy_from_slice(&number.to_le_bytes());
        payload[30] = system;
        Outgoing::Raw { id: 76, payload }
    };
    let before = ground.heard.len();
    ground.send(&raw(9999, 1));
    let frame = ground.heard.last().expect("an answer");
    assert_eq!(frame.content.id(), 77);
    let sortie_wire::Content::Undecoded { payload, .. } = &frame.content else {
        panic!("{frame:?}");
    };
    assert_eq!(
        (payload[0..2].to_vec(), payload[2]),
        (9999u16.to_le_bytes().to_vec(), 3)
    );
    assert_eq!(ground.heard.len(), before + 1);
    ground.send(&raw(400, 77));
    assert_eq!(ground.heard.len(), before + 1, "not for this vehicle");
    ground.send(&raw(400, 0));
    assert_eq!(ground.heard.len(), before + 2, "a broadcast");
}

#[test]
fn takeoff_by_command_int_wants_the_relative_frame() {
    let mut ground = Ground::armed();
    let takeoff = |frame| COMMAND_INT_DATA {
        command: MavCmd::MAV_CMD_NAV_TAKEOFF,
        z: 10.0,
        frame,
        ..Default::default()
    };
    assert_eq!(ground.int(&takeoff(MavFrame::MAV_FRAME_GLOBAL)), DENIED);
    ground.goto([10.0, 0.0, -10.0]);
    ground.run(3.0);
    assert!(
        ground.truth().on_ground,
        "targets before the takeoff are ignored"
    );
    assert_eq!(
        ground.int(&takeoff(MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT)),
        ACCEPTED
    );
    ground.run(5.0);
    assert!(!ground.truth().on_ground);
}

#[test]
fn armed_and_idle_the_vehicle_disarms_after_its_delay() {
    let mut ground = Ground::armed();
    let delay = ground.until(20.0, |t| !t.armed);
    assert!((delay - 10.0).abs() < 0.1, "{delay}");
    ground.set("DISARM_DELAY", 0.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        ACCEPTED
    );
    ground.run(30.0);
    assert!(ground.truth().armed);
}

#[test]
fn a_mode_change_sends_a_heartbeat_at_once() {
    let mut ground = Ground::new();
    ground.run(1.5);
    let before = ground.heard.len();
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]);
    let said = ground.messages_since(before);
    let beat = said.iter().find_map(|message| match message {
        MavMessage::HEARTBEAT(data) => Some(data),
        _ => None,
    });
    let beat = beat.expect("a heartbeat");
    assert_eq!(beat.custom_mode, 4);
    assert_eq!(beat.base_mode.bits(), 89);
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    let before = ground.heard.len();
    ground.run(1.1);
    let armed = ground.messages_since(before).iter().any(|message| {
        matches!(message, MavMessage::HEARTBEAT(data) if data.base_mode.contains(MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED))
    });
    assert!(armed);
}

#[test]
#[expect(deprecated, reason = "ArduPilot's own frame for body offsets")]
fn targets_work_in_every_frame_that_the_real_vehicle_has() {
    use MavFrame as F;
    for (frame, p, goal) in [
        (
            F::MAV_FRAME_LOCAL_NED,
            [10.0, 20.0, -15.0],
            [10.0, 20.0, -15.0],
        ),
        (
            F::MAV_FRAME_LOCAL_OFFSET_NED,
            [10.0, 0.0, -5.0],
            [10.0, 0.0, -15.0],
        ),
        (
            F::MAV_FRAME_BODY_OFFSET_NED,
            [10.0, 0.0, 0.0],
            [0.0, 10.0, -10.0],
        ),
    ] {
        let mut ground = Ground::hovering(10.0);
        ground.long(MavCmd::MAV_CMD_CONDITION_YAW, [90.0, 0.0, 1.0, 0.0]);
        ground.run(6.0);
        ground.target(p, [0.0; 3], 0x0DF8, frame);
        ground.run(20.0);
        let at = ground.truth().position_ned_m;
        for axis in 0..3 {
            assert!(
                (at[axis] - f64::from(goal[axis] as f32)).abs() < 0.5,
                "{frame:?}: {at:?}"
            );
        }
    }
}

#[test]
fn nonsense_targets_stop_the_vehicle() {
    for (p, mask, frame) in [
        (
            [f32::NAN, 0.0, -10.0],
            0x0DF8,
            MavFrame::MAV_FRAME_LOCAL_NED,
        ),
        (
            [f32::INFINITY, 0.0, -10.0],
            0x0DF8,
            MavFrame::MAV_FRAME_LOCAL_NED,
        ),
        ([0.0; 3], 0x0FFF, MavFrame::MAV_FRAME_LOCAL_NED),
        ([0.0; 3], 0x0DF8, MavFrame::MAV_FRAME_LOCAL_FLU),
    ] {
        let mut ground = Ground::hovering(10.0);
        ground.goto([200.0, 0.0, -10.0]);
        ground.run(5.0);
        ground.target(p, [0.0; 3], mask, frame);
        ground.run(10.0);
        let truth = ground.truth();
        assert!(truth.velocity_ned_m_s[0].abs() < 0.3, "{truth:?}");
        assert!(truth.position_ned_m[0] < 80.0 && truth.armed);
    }
}

#[test]
fn repositioning_pausing_and_going_on() {
    let mut ground = Ground::hovering(10.0);
    let goal = start().at.moved(100.0, 0.0);
    let (x, y) = goal.to_e7();
    let reposition = |flag: f32| COMMAND_INT_DATA {
        command: MavCmd::MAV_CMD_DO_REPOSITION,
        param1: -1.0,
        param2: flag,
        x,
        y,
        z: 20.0,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        ..Default::default()
    };
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 17.0]);
    assert_eq!(ground.int(&reposition(0.0)), DENIED);
    assert_eq!(ground.int(&reposition(1.0)), ACCEPTED);
    ground.run(4.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, [0.0]),
        ACCEPTED
    );
    ground.run(8.0);
    assert!(ground.truth().velocity_ned_m_s[0].abs() < 0.2);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, [1.0]),
        ACCEPTED
    );
    ground.run(20.0);
    let truth = ground.truth();
    assert!(
        truth.at.distance_m(goal) < 1.0 && (truth.altitude_amsl_m - 604.0).abs() < 0.3,
        "{truth:?}"
    );
}
