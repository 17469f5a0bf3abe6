//! The comparison, tested on flights with known differences.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, LOCAL_POSITION_NED_DATA, MavCmd,
    MavMessage, MavModeFlag, MavResult, STATUSTEXT_DATA,
};
use mavlink::types::CharArray;
use mavlink::{MavlinkVersion, Message as _};

use super::*;
use crate::wire::{Content, Encoder};

fn frame(message: MavMessage) -> Frame {
    Frame {
        system: 7,
        component: 1,
        sequence: 0,
        version: MavlinkVersion::V2,
        seal: crate::wire::Seal::Unsigned,
        wire_len: 0,
        content: Content::Message(message),
    }
}

fn said(at_s: f64, message: MavMessage) -> Timed {
    Timed {
        at: Duration::from_secs_f64(at_s),
        frame: frame(message),
    }
}

/// A vehicle that flies north at a speed, beginning after one second.
fn flight(speed_m_s: f32, from_m: f32) -> Vec<Timed> {
    (0..100_u8)
        .map(|step| {
            let seconds = f32::from(step) / 10.0;
            let way = (seconds - 1.0).max(0.0) * speed_m_s;
            let data = LOCAL_POSITION_NED_DATA {
                x: from_m + way,
                vx: if seconds < 1.0 { 0.0 } else { speed_m_s },
                ..Default::default()
            };
            said(f64::from(seconds), MavMessage::LOCAL_POSITION_NED(data))
        })
        .collect()
}

fn manoeuvre(aim: Aim) -> Manoeuvre {
    Manoeuvre {
        name: "north".to_owned(),
        from_s: 1.0,
        last_asked_s: 9.0,
        to_s: 9.0,
        aim,
    }
}

#[test]
fn a_slower_vehicle_falls_behind_and_a_shifted_start_does_not_count() {
    let real = Observed::new(&flight(5.0, 0.0));
    let simulated = Observed::new(&flight(4.0, 30.0));
    let compared = compare(
        &[manoeuvre(Aim::Place([19.0, 0.0, 0.0]))],
        &real,
        &simulated,
    );
    let flight = &compared.manoeuvres[0];
    assert!((flight.apart_at_start_m - 30.0).abs() < 1e-3, "{flight:?}");
    // One metre per second over 8 s: 8 m at the end, and a root mean square of 8 / √3.
    assert!((flight.position_m.largest - 8.0).abs() < 0.02, "{flight:?}");
    assert!(
        (flight.position_m.rms - 8.0 / 3.0_f64.sqrt()).abs() < 0.1,
        "{flight:?}"
    );
    assert!(
        (flight.velocity_m_s.largest - 1.0).abs() < 1e-3,
        "{flight:?}"
    );
    assert!(
        (flight.recorded_reach_s.expect("reached") - 3.62).abs() < 0.03,
        "{flight:?}"
    );
    assert_eq!(flight.simulated_reach_s, None, "it is beyond the place");
}

#[test]
fn the_same_flight_has_no_differences() {
    let observed = Observed::new(&flight(5.0, 0.0));
    let compared = compare(&[manoeuvre(Aim::Velocity)], &observed, &observed);
    let flight = &compared.manoeuvres[0];
    assert_eq!(flight.position_m, Difference::default());
    assert!((flight.top_speed_m_s - 5.0).abs() < 1e-6);
    assert!(compared.answers.iter().all(Answers::identical));
}

fn text(at_s: f64, text: &str) -> Timed {
    let data = STATUSTEXT_DATA {
        text: CharArray::from(text),
        ..Default::default()
    };
    said(at_s, MavMessage::STATUSTEXT(data))
}

#[test]
fn texts_differ_by_their_words_and_order_but_not_by_their_numbers() {
    let real = Observed::new(&[text(1.0, "hit at 0.49 m/s"), text(2.0, "a"), text(3.0, "b")]);
    for (others, identical) in [
        (vec!["hit at 0.501 m/s", "a", "b"], true),
        (vec!["hit at 0.5 m/s", "b", "a"], false),
        (vec!["hit at 0.5 m/s", "a"], false),
        (vec!["hit at 0.5 km/h", "a", "b"], false),
    ] {
        let heard: Vec<Timed> = (1_u8..)
            .zip(&others)
            .map(|(at, words)| text(f64::from(at), words))
            .collect();
        let compared = compare(&[], &real, &Observed::new(&heard));
        let texts = compared.answers.iter().find(|one| one.kind == "texts");
        assert_eq!(texts.expect("texts").identical(), identical, "{others:?}");
    }
}

fn command(at_s: f64, command: MavCmd, param7: f32) -> Timed {
    let data = COMMAND_LONG_DATA {
        command,
        param7,
        target_system: 7,
        ..Default::default()
    };
    said(at_s, MavMessage::COMMAND_LONG(data))
}

#[test]
fn a_refused_command_begins_no_manoeuvre() {
    let mut heard = flight(1.0, 0.0);
    for (at_s, result) in [
        (1.1, MavResult::MAV_RESULT_FAILED),
        (4.1, MavResult::MAV_RESULT_ACCEPTED),
    ] {
        let data = COMMAND_ACK_DATA {
            command: MavCmd::MAV_CMD_NAV_TAKEOFF,
            result,
            ..Default::default()
        };
        heard.push(said(at_s, MavMessage::COMMAND_ACK(data)));
    }
    let sent = [1.0, 4.0].map(|at_s| command(at_s, MavCmd::MAV_CMD_NAV_TAKEOFF, 9.0));
    let cut = manoeuvre::cut(&sent, &Observed::new(&heard));
    let names: Vec<(&str, f64)> = cut
        .iter()
        .map(|one| (one.name.as_str(), one.from_s))
        .collect();
    assert_eq!(names, [("takeoff 9 m", 4.0)]);
}

#[test]
fn a_rover_is_known_by_its_type_and_by_its_first_output() {
    use crate::sim::{Chassis, VehicleKind};
    use mavlink::dialects::ardupilotmega::{MavType, PARAM_VALUE_DATA};

    let beat = |mavtype| {
        let data = HEARTBEAT_DATA {
            mavtype,
            custom_mode: 11,
            ..Default::default()
        };
        said(0.0, MavMessage::HEARTBEAT(data))
    };
    let output = |param_value| {
        let data = PARAM_VALUE_DATA {
            param_id: CharArray::from("SERVO1_FUNCTION"),
            param_value,
            ..Default::default()
        };
        said(0.1, MavMessage::PARAM_VALUE(data))
    };
    for (mavtype, function, kind, mode) in [
        (
            MavType::MAV_TYPE_QUADROTOR,
            33.0,
            VehicleKind::Copter,
            "DRIFT",
        ),
        (
            MavType::MAV_TYPE_GROUND_ROVER,
            26.0,
            VehicleKind::Rover(Chassis::Ackermann),
            "RTL",
        ),
        (
            MavType::MAV_TYPE_GROUND_ROVER,
            73.0,
            VehicleKind::Rover(Chassis::Skid),
            "RTL",
        ),
        (
            MavType::MAV_TYPE_SURFACE_BOAT,
            26.0,
            VehicleKind::Rover(Chassis::Boat),
            "RTL",
        ),
    ] {
        let observed = Observed::new(&[beat(mavtype), output(function)]);
        assert_eq!(observed.kind(), kind);
        assert_eq!(observed.modes[0].text, mode);
    }
}

#[test]
fn a_rover_is_there_when_it_says_so() {
    let mut heard = flight(1.0, 0.0);
    heard.push(text(4.5, "Reached destination"));
    let real = Observed::new(&heard);
    let compared = compare(&[manoeuvre(Aim::Told("Reached destination"))], &real, &real);
    assert_eq!(compared.manoeuvres[0].recorded_reach_s, Some(3.5));
    let compared = compare(&[manoeuvre(Aim::Told("Mission Complete"))], &real, &real);
    assert_eq!(compared.manoeuvres[0].recorded_reach_s, None);
}

#[test]
fn a_recording_is_read_from_tlogs_and_addressed_to_the_simulated_vehicle() {
    let heartbeat = MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        base_mode: MavModeFlag::empty(),
        ..Default::default()
    });
    let tlog = |system: u8, at_us: u64, message: &MavMessage| {
        let mut bytes = at_us.to_be_bytes().to_vec();
        Encoder::new(system, 1).encode(&message.clone().into(), &mut bytes);
        bytes
    };
    let Content::Message(mode) = command(0.0, MavCmd::MAV_CMD_DO_SET_MODE, 0.0).frame.content
    else {
        unreachable!("it is a message");
    };
    assert_eq!(mode.target_system_id(), Some(7));
    let mut heard = tlog(7, 1_000_000, &heartbeat);
    heard.extend(tlog(7, 3_000_000, &heartbeat));
    let recording = Recording::from_tlogs(&heard, &tlog(255, 2_000_000, &mode));
    assert_eq!(recording.sent[0].at, Duration::from_secs(1));
    assert_eq!(recording.heard.len(), 2);
    let answers = Observed::new(&replay(&recording, &Observed::new(&recording.heard)));
    // Mode 0 by a command without bit 0 of parameter 1 is denied; a vehicle that is not addressed would be silent.
    let acks: Vec<&str> = answers.acks.iter().map(|ack| ack.text.as_str()).collect();
    assert_eq!(acks, ["DO_SET_MODE DENIED"]);
}
