//! Messages that a session receives, requests and answers.

use super::*;

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
fn acknowledgements_of_our_own_requests_for_telemetry_answer_no_command() {
    let interval = MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL;
    let mut scene = Scene::new();
    scene.pass(ms(200));
    let asked = scene.longs(interval).len();
    assert!(asked > 0);
    let command = Command::Query(QueryCommand::Interval {
        message: 30,
        rate_hz: 10.0,
    });
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
