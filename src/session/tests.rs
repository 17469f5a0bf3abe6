//! Sessions against a scripted vehicle, with the time in the test's hands.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavAutopilot, MavCmd, MavMessage,
    MavModeFlag, MavResult, MavSeverity, MavState, MavType, STATUSTEXT_DATA, TIMESYNC_DATA,
};

use super::*;
use crate::commands::{Destination, Heading};

const GUIDED: u32 = 4;
const STABILIZE: u32 = 0;

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// A session and the vehicle at its other end.
struct Scene {
    session: Session,
    now: Duration,
    sequence: u8,
    sent: Vec<Outgoing>,
    rows: Vec<RowUpdate>,
    notices: Vec<String>,
}

impl Scene {
    fn new() -> Self {
        let mut scene = Self {
            session: Session::new(3, 1, Duration::ZERO),
            now: Duration::ZERO,
            sequence: 0,
            sent: Vec::new(),
            rows: Vec::new(),
            notices: Vec::new(),
        };
        scene.heartbeat(STABILIZE, false);
        scene.rows.clear();
        scene
    }

    fn hear(&mut self, message: MavMessage) {
        self.hear_from(1, message);
    }

    fn hear_from(&mut self, component: u8, message: MavMessage) {
        let frame = Frame {
            system: 3,
            component,
            sequence: self.sequence,
            version: mavlink::MavlinkVersion::V2,
            signed: false,
            wire_len: 20,
            content: Content::Message(message),
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.session.receive(&frame, self.now);
        self.collect();
    }

    fn heartbeat(&mut self, custom_mode: u32, armed: bool) {
        let armed_flag = if armed {
            MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED
        } else {
            MavModeFlag::empty()
        };
        self.hear(MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode,
            mavtype: MavType::MAV_TYPE_QUADROTOR,
            autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
            base_mode: MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | armed_flag,
            system_status: MavState::MAV_STATE_STANDBY,
            ..HEARTBEAT_DATA::DEFAULT
        }));
    }

    fn ack(&mut self, command: MavCmd, result: MavResult) {
        self.hear(MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
            command,
            result,
            target_system: 255,
            target_component: 190,
            ..COMMAND_ACK_DATA::DEFAULT
        }));
    }

    fn text(&mut self, text: &str) {
        self.hear(MavMessage::STATUSTEXT(STATUSTEXT_DATA {
            severity: MavSeverity::MAV_SEVERITY_CRITICAL,
            text: text.into(),
            ..STATUSTEXT_DATA::DEFAULT
        }));
    }

    fn pass(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.now += ms(10).min(until.saturating_sub(self.now));
            self.session.poll(self.now);
            self.collect();
        }
    }

    fn order(&mut self, entry: u32, verb: &'static str, command: Command) {
        let order = Order {
            entry: EntryId(entry),
            verb,
            retry: Retry {
                tries: 3,
                every: ms(1000),
                deadline: ms(3500),
            },
            command,
        };
        self.session.order(order, self.now);
        self.collect();
    }

    fn collect(&mut self) {
        self.sent.extend(self.session.take_outgoing());
        for report in self.session.take_reports() {
            match report {
                Report::Row(row) => self.rows.push(row),
                Report::Notice(notice) => self.notices.push(notice.text),
            }
        }
    }

    /// The `COMMAND_LONGs` of a kind that were sent.
    fn longs(&self, command: MavCmd) -> Vec<&COMMAND_LONG_DATA> {
        self.sent
            .iter()
            .filter_map(|sent| match sent {
                Outgoing::Message(MavMessage::COMMAND_LONG(long)) if long.command == command => {
                    Some(long)
                }
                _ => None,
            })
            .collect()
    }

    fn states(&self, entry: u32) -> Vec<RowState> {
        self.rows
            .iter()
            .filter(|row| row.entry == EntryId(entry))
            .map(|row| row.state)
            .collect()
    }

    fn explanation(&self, entry: u32) -> String {
        self.rows
            .iter()
            .rev()
            .find(|row| row.entry == EntryId(entry) && row.explanation.is_some())
            .and_then(|row| row.explanation.clone())
            .unwrap_or_default()
    }
}

const ARM: MavCmd = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM;

#[test]
fn an_accepted_arm_is_done_when_the_heartbeat_says_armed() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arm);
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1), [RowState::Sent, RowState::Accepted]);
    scene.heartbeat(GUIDED, true);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn a_silent_vehicle_is_asked_on_schedule_and_never_after_the_deadline() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arm);
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
    scene.order(1, "arm", Command::Arm);
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
    scene.order(1, "arm", Command::Arm);
    scene.text("Arm: Gyros inconsistent");
    scene.ack(ARM, MavResult::MAV_RESULT_FAILED);
    scene.pass(ms(400));
    assert!(scene.explanation(1).contains("Gyros inconsistent"));
}

#[test]
fn an_acknowledgement_for_another_ground_station_is_not_ours() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arm);
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
    scene.order(1, "arm", Command::Arm);
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
    scene.order(1, "arm", Command::Arm);
    scene.heartbeat(STABILIZE, true);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn later_commands_wait_until_the_earlier_one_is_settled() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, false);
    scene.order(1, "arm", Command::Arm);
    scene.order(2, "takeoff", Command::Takeoff { altitude_m: 20.0 });
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
        "guided",
        Command::SetMode {
            name: "GUIDED".into(),
        },
    );
    scene.order(2, "arm", Command::Arm);
    scene.order(3, "rtl", Command::ReturnToLaunch);
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    assert_eq!(scene.states(2).last(), Some(&RowState::Superseded));
    assert_eq!(scene.explanation(2), "rtl took its place");
    assert_eq!(scene.states(3), [RowState::Sent]);
    assert!(scene.longs(ARM).is_empty());
}

#[test]
fn a_setpoint_outside_guided_is_refused_here_because_the_vehicle_would_ignore_it() {
    let mut scene = Scene::new();
    let goto = Command::Goto {
        destination: Destination::Local {
            north_m: 10.0,
            east_m: 0.0,
            up_m: None,
        },
        heading: Heading::Auto,
    };
    scene.order(1, "goto", goto);
    assert_eq!(scene.states(1), [RowState::Refused]);
    assert!(
        scene.explanation(1).contains("GUIDED"),
        "{}",
        scene.explanation(1)
    );
}

#[test]
fn silence_is_noticed_within_three_seconds_and_so_is_the_return() {
    let mut scene = Scene::new();
    scene.pass(ms(2900));
    assert!(scene.session.vehicle().link.lost);
    assert_eq!(
        scene
            .notices
            .iter()
            .filter(|text| *text == "link lost")
            .count(),
        1
    );
    scene.heartbeat(STABILIZE, false);
    assert!(!scene.session.vehicle().link.lost);
    assert!(
        scene
            .notices
            .iter()
            .any(|text| text.starts_with("link back after"))
    );
}

#[test]
fn telemetry_that_does_not_come_is_asked_for_three_times_and_then_left_alone() {
    let mut scene = Scene::new();
    for _ in 0..40 {
        scene.pass(ms(1000));
        scene.heartbeat(STABILIZE, false);
    }
    let asked = scene
        .longs(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL)
        .iter()
        .filter(|long| (long.param1 - 30.0).abs() < 0.1)
        .count();
    assert_eq!(asked, 3);
}

#[test]
fn telemetry_that_comes_often_enough_is_not_asked_for() {
    let mut scene = Scene::new();
    for step in 0..200u64 {
        scene.now = ms(step * 50);
        scene.hear(MavMessage::ATTITUDE(
            mavlink::dialects::ardupilotmega::ATTITUDE_DATA::default(),
        ));
        scene.session.poll(scene.now);
        scene.collect();
    }
    let asked = scene
        .longs(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL)
        .iter()
        .any(|long| (long.param1 - 30.0).abs() < 0.1);
    assert!(!asked);
}

#[test]
fn the_round_trip_is_measured_and_the_vehicles_question_answered() {
    let mut scene = Scene::new();
    scene.pass(ms(200));
    let asked = scene
        .sent
        .iter()
        .find_map(|sent| match sent {
            Outgoing::Message(MavMessage::TIMESYNC(sync)) if sync.tc1 == 0 => Some(sync.ts1),
            _ => None,
        })
        .expect("a request was sent");
    let sent_at = Duration::from_nanos(asked as u64);
    scene.now = sent_at + ms(40);
    scene.hear(MavMessage::TIMESYNC(TIMESYNC_DATA {
        tc1: 5,
        ts1: asked,
        ..TIMESYNC_DATA::DEFAULT
    }));
    assert_eq!(scene.session.vehicle().link.round_trip, Some(ms(40)));
    scene.hear(MavMessage::TIMESYNC(TIMESYNC_DATA {
        tc1: 0,
        ts1: 77,
        ..TIMESYNC_DATA::DEFAULT
    }));
    assert!(scene.sent.iter().any(|sent| matches!(
        sent,
        Outgoing::Message(MavMessage::TIMESYNC(sync)) if sync.ts1 == 77 && sync.tc1 != 0
    )));
}

#[test]
fn the_answer_to_a_replaced_command_is_not_taken_for_that_of_its_successor() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arm);
    scene.order(2, "kill", Command::Kill);
    // Both are one MAV_CMD; this is the arm's.
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
    scene.order(1, "kill", Command::Kill);
    scene.ack(ARM, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1).last(), Some(&RowState::Accepted));
    scene.pass(ms(200));
    scene.heartbeat(STABILIZE, false);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn acknowledgements_of_our_own_requests_for_telemetry_answer_no_command() {
    let interval = MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL;
    let mut scene = Scene::new();
    scene.pass(ms(200));
    let asked = scene.longs(interval).len();
    assert!(asked > 0);
    let command = Command::MessageInterval {
        message: 30,
        rate_hz: 10.0,
    };
    scene.order(1, "interval", command);
    for _ in 0..asked {
        scene.ack(interval, MavResult::MAV_RESULT_FAILED);
    }
    assert_eq!(scene.states(1), [RowState::Sent]);
    scene.ack(interval, MavResult::MAV_RESULT_ACCEPTED);
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
}

#[test]
fn a_companion_does_not_hide_that_the_autopilot_is_silent() {
    let mut scene = Scene::new();
    for _ in 0..4 {
        scene.pass(ms(1000));
        scene.hear_from(191, MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()));
    }
    assert!(scene.session.vehicle().link.lost);
}

#[test]
fn a_temporary_rejection_is_tried_again_and_then_explained() {
    let mut scene = Scene::new();
    scene.order(1, "arm", Command::Arm);
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
        "guided",
        Command::SetMode {
            name: "GUIDED".into(),
        },
    );
    scene.order(2, "arm", Command::Arm);
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
fn a_velocity_ends_without_effect_when_the_vehicle_leaves_guided() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    scene.hear(MavMessage::EXTENDED_SYS_STATE(
        mavlink::dialects::ardupilotmega::EXTENDED_SYS_STATE_DATA {
            landed_state: mavlink::dialects::ardupilotmega::MavLandedState::MAV_LANDED_STATE_IN_AIR,
            ..Default::default()
        },
    ));
    let command = Command::Velocity {
        ned_m_s: [2.0, 0.0, 0.0],
        lasting: ms(10_000),
    };
    scene.order(1, "velocity", command);
    scene.pass(ms(1000));
    assert_eq!(
        scene.states(1),
        [RowState::Sent],
        "{}",
        scene.explanation(1)
    );
    scene.heartbeat(STABILIZE, true);
    assert_eq!(scene.states(1).last(), Some(&RowState::NoEffect));
    assert!(scene.explanation(1).contains("STABILIZE"));
}

#[test]
fn a_refused_command_does_not_take_the_place_of_what_is_flying() {
    let mut scene = Scene::new();
    scene.heartbeat(GUIDED, true);
    let takeoff = MavCmd::MAV_CMD_NAV_TAKEOFF;
    scene.order(1, "takeoff", Command::Takeoff { altitude_m: 20.0 });
    scene.ack(takeoff, MavResult::MAV_RESULT_ACCEPTED);
    scene.order(2, "disarm", Command::Disarm);
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
    scene.order(1, "land", Command::Land);
    scene.pass(ms(500));
    scene.hear(attitude(400));
    assert_eq!(scene.states(1).last(), Some(&RowState::Superseded));
    let sent = scene.longs(MavCmd::MAV_CMD_NAV_LAND).len();
    scene.pass(ms(5000));
    assert_eq!(scene.longs(MavCmd::MAV_CMD_NAV_LAND).len(), sent);
}
