//! Vehicles that announce their modes, and vehicles that do not.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    AVAILABLE_MODES_DATA, AVAILABLE_MODES_MONITOR_DATA, CURRENT_MODE_DATA, MavModeProperty,
    MavStandardMode,
};

use super::*;

const REQUEST: MavCmd = MavCmd::MAV_CMD_REQUEST_MESSAGE;
const SET_MODE: MavCmd = MavCmd::MAV_CMD_DO_SET_MODE;

/// The indices of the modes that the session has requested, 0 for all.
fn asked(scene: &Scene) -> Vec<u32> {
    let requests = scene.longs(REQUEST).into_iter();
    let modes = requests.filter(|long| long.param1 as u32 == AVAILABLE_MODES_DATA::ID);
    modes.map(|long| long.param2 as u32).collect()
}

/// Announces a mode of the scripted vehicle: 1 is its own, 2 cannot be set by users, and any other
/// is a standard mode without a name.
fn announce(scene: &mut Scene, index: u8) {
    let (number, name, standard_mode, properties) = match index {
        1 => (
            65,
            "Lawn\u{1b} Mower",
            MavStandardMode::MAV_STANDARD_MODE_NON_STANDARD,
            MavModeProperty::MAV_MODE_PROPERTY_AUTO_MODE,
        ),
        2 => (
            66,
            "Hide",
            MavStandardMode::MAV_STANDARD_MODE_NON_STANDARD,
            MavModeProperty::MAV_MODE_PROPERTY_NOT_USER_SELECTABLE,
        ),
        _ => (
            6,
            "",
            MavStandardMode::MAV_STANDARD_MODE_SAFE_RECOVERY,
            MavModeProperty::empty(),
        ),
    };
    scene.hear(MavMessage::AVAILABLE_MODES(AVAILABLE_MODES_DATA {
        number_modes: 3,
        mode_index: index,
        standard_mode,
        custom_mode: number,
        properties,
        mode_name: name.into(),
    }));
}

/// Flies a vehicle on for this many seconds, with a heartbeat each second.
fn fly_on(scene: &mut Scene, seconds: u32) {
    for _ in 0..seconds {
        scene.heartbeat(STABILIZE, false);
        scene.pass(ms(1000));
    }
}

fn set_mode(scene: &mut Scene, entry: u32, name: &str) {
    let name = name.to_owned();
    scene.order(
        entry,
        "mode",
        Command::Flight(FlightCommand::SetMode { name }),
    );
}

#[test]
fn modes_are_asked_for_and_those_that_were_lost_again() {
    let mut scene = Scene::new();
    fly_on(&mut scene, 1);
    assert_eq!(asked(&scene), [0]);
    announce(&mut scene, 1);
    announce(&mut scene, 3);
    fly_on(&mut scene, 5);
    assert_eq!(asked(&scene), [0, 2]);
    announce(&mut scene, 2);
    fly_on(&mut scene, 20);
    assert_eq!(asked(&scene), [0, 2]);
    assert!(scene.session.vehicle().modes.is_complete());
    // A vehicle that can change its modes says so by its monitor; without an answer, it is asked again after 4 s.
    for (seq, expected) in [(1, 2), (1, 2), (2, 4)] {
        let monitor = AVAILABLE_MODES_MONITOR_DATA { seq };
        scene.hear(MavMessage::AVAILABLE_MODES_MONITOR(monitor));
        fly_on(&mut scene, 5);
        assert_eq!(asked(&scene).len(), expected, "{seq}");
    }
}

#[test]
fn each_lost_mode_has_its_own_tries_and_a_new_list_starts_again() {
    let mut scene = Scene::new();
    fly_on(&mut scene, 1);
    announce(&mut scene, 1);
    fly_on(&mut scene, 40);
    assert_eq!(asked(&scene), [0, 2, 2, 2]);
    announce(&mut scene, 2);
    fly_on(&mut scene, 40);
    assert_eq!(asked(&scene), [0, 2, 2, 2, 3, 3, 3]);
    for seq in [1, 2] {
        let monitor = AVAILABLE_MODES_MONITOR_DATA { seq };
        scene.hear(MavMessage::AVAILABLE_MODES_MONITOR(monitor));
    }
    fly_on(&mut scene, 40);
    assert_eq!(asked(&scene)[7..], [0; 3]);
}

#[test]
fn a_vehicle_without_the_message_keeps_the_built_in_names() {
    let mut scene = Scene::new();
    fly_on(&mut scene, 1);
    // As ArduCopter 4.6-dev answers.
    scene.ack(REQUEST, MavResult::MAV_RESULT_FAILED);
    fly_on(&mut scene, 60);
    assert_eq!(
        asked(&scene),
        [0; 3],
        "a few tries, since a request may be lost"
    );
    set_mode(&mut scene, 1, "GUIDED");
    let sent = scene.longs(SET_MODE).last().map(|long| long.param2);
    assert_eq!(sent, Some(4.0));
    assert_eq!(
        scene.session.vehicle().mode_name().as_deref(),
        Some("STABILIZE")
    );
}

#[test]
fn announced_modes_are_set_by_their_names_and_hidden_ones_refused() {
    let mut scene = Scene::new();
    for index in 1..=3 {
        announce(&mut scene, index);
    }
    set_mode(&mut scene, 1, "lawn?_mower");
    let sent = scene.longs(SET_MODE).last().map(|long| long.param2);
    assert_eq!(sent, Some(65.0));
    scene.ack(SET_MODE, MavResult::MAV_RESULT_ACCEPTED);
    scene.heartbeat(65, false);
    scene.pass(ms(100));
    assert_eq!(scene.states(1).last(), Some(&RowState::Done));
    assert!(
        scene.notices.iter().any(|it| it.contains("Lawn?_Mower")),
        "{:?}",
        scene.notices
    );
    for (entry, name, why) in [
        (2, "HIDE", "mode Hide is set by the vehicle itself only"),
        (3, "GUIDED", "no mode GUIDED"),
    ] {
        set_mode(&mut scene, entry, name);
        assert_eq!(scene.states(entry), [RowState::Refused], "{name}");
        let said = scene.explanation(entry);
        assert!(said.contains(why), "{said}");
    }
    // A standard mode has its standard name; the built-in one of its number stays valid.
    for (entry, name) in [(4, "SAFE_RECOVERY"), (5, "RTL")] {
        set_mode(&mut scene, entry, name);
        let sent = scene.longs(SET_MODE).last().map(|long| long.param2);
        assert_eq!(sent, Some(6.0), "{name}");
        scene.ack(SET_MODE, MavResult::MAV_RESULT_ACCEPTED);
        scene.heartbeat(6, false);
        scene.pass(ms(100));
    }
}

#[test]
fn a_mode_that_was_set_but_not_entered_is_known() {
    let mut scene = Scene::new();
    let current = |intended| {
        MavMessage::CURRENT_MODE(CURRENT_MODE_DATA {
            custom_mode: STABILIZE,
            intended_custom_mode: intended,
            ..CURRENT_MODE_DATA::DEFAULT
        })
    };
    scene.hear(current(GUIDED));
    let vehicle = scene.session.vehicle();
    let intended = vehicle.mode_not_reached().map(|mode| vehicle.name_of(mode));
    assert_eq!(intended.as_deref(), Some("GUIDED"));
    scene.hear(current(0));
    assert_eq!(scene.session.vehicle().mode_not_reached(), None, "unknown");
}
