//! Tests of the rows for other stations' commands.

use mavlink::dialects::ardupilotmega::{
    MISSION_ACK_DATA, MISSION_COUNT_DATA, MavMissionResult, MavMissionType, PARAM_SET_DATA,
    PARAM_VALUE_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};

use super::*;
use crate::ledger::{ForeignCommand, ForeignId, RowState, StationId};
use crate::vehicle::{AnnouncedMode, Heartbeat, Mode, SystemStatus, Vehicle, VehicleClass};

const STATION_254: StationId = StationId(address(254, 230));
/// Vehicle 3, a copter.
fn three() -> Vehicle {
    let mut vehicle = Vehicle::new(3, 1);
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: Heartbeat::ARDUPILOT,
        class: VehicleClass::Copter,
        mode: Mode::copter(0),
        armed: false,
        status: SystemStatus::Standby,
        at: Duration::ZERO,
    });
    vehicle
}

fn content(sender: MavAddress, what: &Outgoing) -> crate::wire::Content {
    framed(sender, what).1.content
}

/// A row with its line and outcome.
fn told(row: Option<ForeignCommand>) -> Option<String> {
    row.map(|row| format!("{}: {}", row.line(), row.outcome()))
}

fn commanded(watch: &mut StationWatch, what: &Outgoing, at: u64) -> Option<ForeignCommand> {
    let deed = deed_of(&content(address(254, 230), what))?;
    watch.commanded(STATION_254, &deed, &three(), ms(at))
}

fn answered(watch: &mut StationWatch, what: &Outgoing, at: u64) -> Option<ForeignCommand> {
    watch.answered(&content(address(3, 1), what), &three(), ms(at))
}

fn answer(command: MavCmd, result: MavResult) -> Outgoing {
    MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command,
        result,
        target_system: 254,
        target_component: 230,
        ..COMMAND_ACK_DATA::default()
    })
    .into()
}

#[test]
fn commands_are_named_in_the_words_of_the_console_and_questions_are_none() {
    let count = |list, count| {
        MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
            target_system: 3,
            mission_type: list,
            count,
            ..MISSION_COUNT_DATA::default()
        })
        .into()
    };
    let fence = MavMissionType::MAV_MISSION_TYPE_FENCE;
    let cases: [(Outgoing, Option<&str>); 8] =
        [
            (
                command(3, MavCmd::MAV_CMD_DO_SET_MODE, 1.0, 6.0),
                Some("mode RTL"),
            ),
            (
                command(3, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 0.0, 0.0),
                Some("disarm"),
            ),
            (
                command(3, MavCmd::MAV_CMD_NAV_TAKEOFF, 0.0, 0.0),
                Some("NAV_TAKEOFF"),
            ),
            (
                MavMessage::SET_POSITION_TARGET_LOCAL_NED(
                    SET_POSITION_TARGET_LOCAL_NED_DATA::default(),
                )
                .into(),
                Some("steering"),
            ),
            (count(fence, 4), Some("fence upload, items: 4")),
            (count(fence, 0), Some("fence clear")),
            (command(3, MavCmd::MAV_CMD_REQUEST_MESSAGE, 0.0, 0.0), None),
            (beat(), None),
        ];
    for (what, expected) in cases {
        let row = commanded(&mut StationWatch::new(OWN), &what, 0);
        let said = row.map(|row| row.what.to_string());
        assert_eq!(said.as_deref(), expected);
    }
}

#[test]
fn a_command_and_its_answer_are_one_row() {
    let mut watch = StationWatch::new(OWN);
    let mode = command(3, MavCmd::MAV_CMD_DO_SET_MODE, 1.0, 6.0);
    let row = commanded(&mut watch, &mode, 1000);
    assert_eq!(
        told(row).as_deref(),
        Some("GCS 254/230: 3 mode RTL: no answer yet")
    );
    let denied = answer(
        MavCmd::MAV_CMD_DO_SET_MODE,
        MavResult::MAV_RESULT_UNSUPPORTED,
    );
    let row = answered(&mut watch, &denied, 1100).expect("it is news");
    assert_eq!((row.id, row.state), (ForeignId(0), RowState::Refused));
    assert!(row.explanation.is_some());
    // Answers to the console itself, and those to questions, are no commands of others.
    for (to, command) in [
        (OWN, MavCmd::MAV_CMD_NAV_LAND),
        (address(255, 0), MavCmd::MAV_CMD_NAV_LAND),
        (address(0, 0), MavCmd::MAV_CMD_NAV_LAND),
        (address(254, 230), MavCmd::MAV_CMD_REQUEST_MESSAGE),
    ] {
        assert_eq!(answered(&mut watch, &ack(to, command), 1200), None);
    }
}

#[test]
fn a_station_on_another_radio_shows_in_the_answers_to_it() {
    let mut watch = StationWatch::new(OWN);
    let land = answer(MavCmd::MAV_CMD_NAV_LAND, MavResult::MAV_RESULT_ACCEPTED);
    let row = answered(&mut watch, &land, 0);
    assert_eq!(
        told(row).as_deref(),
        Some("GCS 254/230: 3 NAV_LAND: accepted")
    );
    assert_eq!(answered(&mut watch, &land, 200), None, "held back");
    let rows = watch.due(ms(1500));
    assert_eq!(rows.len(), 1);
    assert_eq!((rows[0].id, rows[0].count), (ForeignId(0), 2));
    assert!(watch.due(ms(1600)).is_empty());
}

#[test]
fn a_station_that_repeats_is_one_row_with_a_count() {
    let mut watch = StationWatch::new(OWN);
    let arm = command(3, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, 1.0, 0.0);
    let yes = answer(
        MavCmd::MAV_CMD_COMPONENT_ARM_DISARM,
        MavResult::MAV_RESULT_ACCEPTED,
    );
    let mut last = None;
    for again in 0..20 {
        for row in [
            commanded(&mut watch, &arm, again * 2000),
            answered(&mut watch, &yes, again * 2000 + 50),
        ] {
            last = row.or(last);
        }
    }
    last = watch.due(ms(60_000)).pop().or(last);
    let row = last.expect("rows");
    assert_eq!((row.id, row.count), (ForeignId(0), 20));
    assert_eq!(row.state, RowState::Accepted);
    // A minute later, it is another command.
    let later = commanded(&mut watch, &arm, 200_000).expect("a new row");
    assert_eq!((later.id, later.count), (ForeignId(1), 1));
}

#[test]
fn a_flood_is_a_few_rows() {
    let mut watch = StationWatch::new(OWN);
    let mut reports = 0;
    let mut ids = std::collections::BTreeSet::new();
    for at in 0..2000_u64 {
        let mode = command(3, MavCmd::MAV_CMD_DO_SET_MODE, 1.0, (at % 100) as f32);
        let rows = commanded(&mut watch, &mode, at).into_iter();
        for row in rows.chain(watch.due(ms(at))) {
            reports += 1;
            ids.insert(row.id);
        }
    }
    assert_eq!(ids.len(), 7, "six rows and the one for the rest");
    assert!(reports < 30, "{reports}");
    // As many stations as there are addresses cannot fill the memory.
    for system in 1..=254 {
        for component in 1..=255 {
            let station = StationId(address(system, component));
            drop(watch.commanded(station, &Deed::Arm(true), &three(), ms(2500)));
        }
    }
    assert!(watch.due(ms(4000)).len() <= 600);
    // A minute later, others have room again.
    let other = StationId(address(9, 9));
    let later = watch.commanded(other, &Deed::Arm(true), &three(), ms(70_000));
    assert!(later.is_some());
}

#[test]
fn parameters_and_lists_are_answered_by_their_own_messages() {
    let mut watch = StationWatch::new(OWN);
    let set = MavMessage::PARAM_SET(PARAM_SET_DATA {
        target_system: 3,
        param_id: "RTL_ALT".into(),
        param_value: 3000.0,
        ..PARAM_SET_DATA::default()
    });
    let row = commanded(&mut watch, &set.into(), 0).expect("a row");
    assert_eq!(row.what.to_string(), "param set RTL_ALT 3000");
    let value = |value| {
        MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_id: "RTL_ALT".into(),
            param_value: value,
            ..PARAM_VALUE_DATA::default()
        })
        .into()
    };
    let row = answered(&mut watch, &value(1500.0), 100);
    assert_eq!(
        told(row).as_deref(),
        Some("GCS 254/230: 3 param set RTL_ALT 3000: refused: it stays 1500")
    );
    // That value was on its way before; the true answer follows.
    assert_eq!(answered(&mut watch, &value(3000.0), 200), None, "held back");
    let row = watch.due(ms(1500)).pop();
    assert_eq!(
        told(row).as_deref(),
        Some("GCS 254/230: 3 param set RTL_ALT 3000: accepted")
    );
    assert_eq!(answered(&mut watch, &value(1500.0), 3000), None);
    let clear = MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        target_system: 3,
        count: 9,
        ..MISSION_COUNT_DATA::default()
    });
    drop(commanded(&mut watch, &clear.into(), 5000));
    let full = MavMessage::MISSION_ACK(MISSION_ACK_DATA {
        target_system: 254,
        target_component: 230,
        mavtype: MavMissionResult::MAV_MISSION_NO_SPACE,
        ..MISSION_ACK_DATA::default()
    });
    let row = answered(&mut watch, &full.into(), 5100);
    assert_eq!(
        told(row).as_deref(),
        Some("GCS 254/230: 3 plan upload, items: 9: refused: NO_SPACE")
    );
}

#[test]
fn answers_are_for_the_command_that_waits_longest_and_those_of_a_burst_for_its_row() {
    let mut watch = StationWatch::new(OWN);
    let mode = |number| command(3, MavCmd::MAV_CMD_DO_SET_MODE, 1.0, number);
    let says = |result| answer(MavCmd::MAV_CMD_DO_SET_MODE, result);
    drop(commanded(&mut watch, &mode(6.0), 0));
    drop(commanded(&mut watch, &mode(9.0), 10));
    let first = answered(&mut watch, &says(MavResult::MAV_RESULT_FAILED), 20);
    let second = answered(&mut watch, &says(MavResult::MAV_RESULT_ACCEPTED), 30);
    let states = [first, second].map(|row| row.map(|row| (row.id, row.state)));
    assert_eq!(
        states,
        [
            Some((ForeignId(0), RowState::Refused)),
            Some((ForeignId(1), RowState::Accepted))
        ]
    );
    for number in 10..30_u8 {
        let at = 1000 + u64::from(number);
        drop(commanded(&mut watch, &mode(f32::from(number)), at));
        drop(answered(
            &mut watch,
            &says(MavResult::MAV_RESULT_ACCEPTED),
            at,
        ));
    }
    let rows = watch.due(ms(3000));
    let rest = rows.iter().find(|row| row.id == ForeignId(6));
    let rest = rest.expect("the row for the rest");
    assert_eq!((rest.count, rest.state), (16, RowState::Accepted));
}

fn mode(number: f32) -> Outgoing {
    command(3, MavCmd::MAV_CMD_DO_SET_MODE, 1.0, number)
}

#[test]
fn a_command_after_another_one_is_a_new_row_even_if_it_is_like_an_earlier_one() {
    let mut watch = StationWatch::new(OWN);
    let mut last = None;
    for (number, at) in [(4.0, 0), (6.0, 2000), (4.0, 4000)] {
        last = commanded(&mut watch, &mode(number), at);
    }
    let row = last.expect("it is news");
    assert_eq!((row.id, row.count), (ForeignId(2), 1));
    assert_eq!(row.what.to_string(), "mode GUIDED");
    let again = commanded(&mut watch, &mode(4.0), 6000).expect("it is news");
    assert_eq!((again.id, again.count), (ForeignId(2), 2));
    // The same if only the answers show the commands.
    let mut watch = StationWatch::new(OWN);
    let (land, takeoff) = (MavCmd::MAV_CMD_NAV_LAND, MavCmd::MAV_CMD_NAV_TAKEOFF);
    for (command, at, expected) in [
        (land, 0, (0, 1)),
        (takeoff, 2000, (1, 1)),
        (land, 4000, (2, 1)),
        (land, 6000, (2, 2)),
    ] {
        let says = answer(command, MavResult::MAV_RESULT_ACCEPTED);
        let row = answered(&mut watch, &says, at).expect("it is news");
        assert_eq!((row.id.0, row.count), expected, "{at}");
    }
}

#[test]
fn steering_is_one_row_beside_commands_and_is_reported_once_a_minute() {
    let mut watch = StationWatch::new(OWN);
    let setpoint: Outgoing =
        MavMessage::SET_POSITION_TARGET_LOCAL_NED(SET_POSITION_TARGET_LOCAL_NED_DATA::default())
            .into();
    let mut reports = Vec::new();
    for at in (0..150_000).step_by(100) {
        reports.extend(commanded(&mut watch, &setpoint, at));
        if at == 5000 || at == 9000 {
            // The same command again: setpoints between are no other command.
            let row = commanded(&mut watch, &mode(6.0), at).expect("it is news");
            assert_eq!(row.id, ForeignId(1));
        }
        let due = watch.due(ms(at)).into_iter();
        reports.extend(due.filter(|row| row.id == ForeignId(0)));
    }
    assert_eq!(reports.len(), 3, "at 0, 60 and 120 s");
    assert_eq!(
        told(reports.pop()).as_deref(),
        Some("GCS 254/230: 3 steering: sent")
    );
}

#[test]
fn a_parameter_that_was_never_answered_is_not_refused_by_a_later_download() {
    let mut watch = StationWatch::new(OWN);
    let set = MavMessage::PARAM_SET(PARAM_SET_DATA {
        target_system: 3,
        param_id: "RTL_ALT".into(),
        param_value: 3000.0,
        ..PARAM_SET_DATA::default()
    });
    drop(commanded(&mut watch, &set.into(), 0));
    let value = MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_id: "RTL_ALT".into(),
        param_value: 1500.0,
        ..PARAM_VALUE_DATA::default()
    });
    assert_eq!(answered(&mut watch, &value.into(), 7_200_000), None);
}

#[test]
fn the_mode_of_a_px4_has_a_main_and_a_sub_number() {
    let mut vehicle = three();
    if let Some(heartbeat) = &mut vehicle.heartbeat {
        heartbeat.autopilot = 12;
        heartbeat.mode.class = VehicleClass::Other;
    }
    for (index, number, name) in [(1, 0x0304_0000, "Hold"), (2, 0x0504_0000, "Return")] {
        let mode = AnnouncedMode {
            index,
            number,
            name: name.to_owned(),
            is_selectable: true,
        };
        vehicle.modes.add(mode, 2);
    }
    let set = |sub| COMMAND_LONG_DATA {
        target_system: 3,
        command: MavCmd::MAV_CMD_DO_SET_MODE,
        param1: 1.0,
        param2: 4.0,
        param3: sub,
        ..COMMAND_LONG_DATA::default()
    };
    let mut watch = StationWatch::new(OWN);
    for (sub, expected) in [(3.0, "mode Hold"), (5.0, "mode Return")] {
        let content = content(
            address(254, 230),
            &MavMessage::COMMAND_LONG(set(sub)).into(),
        );
        let deed = deed_of(&content).expect("a command");
        let row = watch.commanded(STATION_254, &deed, &vehicle, ms(0));
        assert_eq!(row.expect("it is news").what.to_string(), expected);
    }
}
