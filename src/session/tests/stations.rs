//! System ids in the parameters of a vehicle: its own, and that of the station that it obeys.

use super::*;

/// The vehicle's report of a parameter.
fn value(name: &str, value: f32) -> MavMessage {
    MavMessage::PARAM_VALUE(mavlink::dialects::ardupilotmega::PARAM_VALUE_DATA {
        param_value: value,
        param_id: name.into(),
        param_type: mavlink::dialects::ardupilotmega::MavParamType::MAV_PARAM_TYPE_INT16,
        param_count: 900,
        param_index: u16::MAX,
    })
}

#[test]
fn a_reboot_under_another_system_id_is_done_when_that_id_is_heard() {
    let reboot = Command::Device(crate::commands::DeviceCommand::Reboot);
    for (set, is_done) in [(Some(7.0), true), (Some(8.0), false), (None, false)] {
        let mut scene = Scene::new();
        if let Some(number) = set {
            scene.hear(value("SYSID_THISMAV", number));
        }
        scene.order(1, "reboot", reboot.clone());
        scene.ack(
            MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
            MavResult::MAV_RESULT_ACCEPTED,
        );
        scene.pass(ms(4000));
        assert_ne!(scene.states(1).last(), Some(&RowState::Done), "too early");
        scene.session.hear_new_vehicle(7, scene.now);
        scene.pass(ms(100));
        let done = scene.states(1).last() == Some(&RowState::Done);
        assert_eq!(done, is_done, "{set:?} {:?}", scene.explanation(1));
        let said = scene.notices.iter().any(|it| it.contains("forget 3"));
        assert_eq!(said, is_done, "{:?}", scene.notices);
        assert_eq!(scene.explanation(1).contains("vehicle 7"), is_done);
    }
}

#[test]
fn channels_are_held_only_by_the_station_that_the_vehicle_obeys() {
    use crate::commands::{DeviceCommand, StickChange};
    let hold = Command::Device(DeviceCommand::Sticks(StickChange::Hold {
        channel: 3,
        pulse_us: 1500,
    }));
    for (station, known, state, remark) in [
        (255, None, RowState::Done, "rc release"),
        (77, None, RowState::Done, "SYSID_MYGCS"),
        (77, Some(255.0), RowState::Refused, "SYSID_MYGCS"),
        (77, Some(77.0), RowState::Done, "rc release"),
        (255, Some(77.0), RowState::Refused, "station 77"),
    ] {
        let mut scene = Scene::new();
        scene.session.vehicle.station = station;
        if let Some(number) = known {
            scene.hear(value("SYSID_MYGCS", number));
        }
        scene.order(1, "rc", hold.clone());
        let words = scene.explanation(1);
        assert_eq!(scene.states(1), [state], "{station} {known:?} {words}");
        assert!(words.contains(remark), "{station} {known:?} {words}");
        let is_unsure = state == RowState::Done && remark == "SYSID_MYGCS";
        assert_eq!(words.contains("unknown"), is_unsure, "{words}");
        let is_held = scene.session.vehicle().held.is_some();
        assert_eq!(is_held, state == RowState::Done);
    }
}
