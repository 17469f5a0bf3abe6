//! The switches of the remote control.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult, RC_CHANNELS_OVERRIDE_DATA};

use super::*;

/// Holds the eighth and the ninth channel for a while, with the sticks centred and the throttle down.
fn hold(ground: &mut Ground, eighth_us: u16, ninth_us: u16, seconds: f64) {
    for _ in 0..(seconds / 0.1).round() as usize {
        ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
            RC_CHANNELS_OVERRIDE_DATA {
                chan1_raw: 1500,
                chan2_raw: 1500,
                chan3_raw: 1000,
                chan4_raw: 1500,
                chan5_raw: u16::MAX,
                chan6_raw: u16::MAX,
                chan7_raw: u16::MAX,
                chan8_raw: eighth_us,
                chan9_raw: ninth_us,
                target_system: 1,
                target_component: 1,
                ..Default::default()
            },
        ));
        ground.run(0.1);
    }
}

fn with_options(eighth: f32, ninth: f32) -> Ground {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("RC8_OPTION", eighth);
    ground.set("RC9_OPTION", ninth);
    hold(&mut ground, 1000, 1000, 1.0);
    ground
}

#[test]
fn a_switch_enters_its_mode_and_leaves_it_for_that_of_the_mode_switch() {
    let mut ground = with_options(4.0, 18.0);
    let mut modes = Vec::new();
    for (eighth, ninth) in [(1900, 1000), (1000, 1000), (1000, 1900), (1000, 1500)] {
        hold(&mut ground, eighth, ninth, 0.5);
        modes.push(ground.truth().mode);
    }
    assert_eq!(modes, [6, 0, 9, 0]);
}

#[test]
fn a_switch_arms_and_disarms_but_not_where_it_is_found() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("RC8_OPTION", 153.0);
    hold(&mut ground, 1900, 0, 1.0);
    assert!(!ground.truth().armed);
    hold(&mut ground, 1000, 0, 1.0);
    hold(&mut ground, 1900, 0, 1.0);
    assert!(ground.truth().armed);
    hold(&mut ground, 1000, 0, 1.0);
    assert!(!ground.truth().armed);
}

#[test]
fn a_switch_announces_its_function_and_an_emergency_stop_forbids_arming() {
    let mut ground = with_options(31.0, 11.0);
    hold(&mut ground, 1900, 1900, 0.5);
    let texts = ground.texts();
    for text in ["RC8: MotorEStop HIGH", "RC9: Fence HIGH"] {
        assert!(texts.contains(&text.to_owned()), "{texts:?}");
    }
    assert!((ground.world.parameter(0, "FENCE_ENABLE") - 1.0).abs() < 1e-9);
    let autopilot = &ground.world.slots[0].autopilot;
    let reasons = autopilot.arming_checks().obstacles();
    assert!(
        reasons
            .iter()
            .any(|reason| reason == "Motors Emergency Stopped")
    );
}

/// Holds the sticks, with the eighth channel at a pulse width, for a while.
fn fly(ground: &mut Ground, sticks_us: [u16; 4], eighth_us: u16, seconds: f64) {
    let [chan1_raw, chan2_raw, chan3_raw, chan4_raw] = sticks_us;
    for _ in 0..(seconds / 0.1).round() as usize {
        ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
            RC_CHANNELS_OVERRIDE_DATA {
                chan1_raw,
                chan2_raw,
                chan3_raw,
                chan4_raw,
                chan8_raw: eighth_us,
                target_system: 1,
                target_component: 1,
                ..Default::default()
            },
        ));
        ground.run(0.1);
    }
}

const CENTRED: [u16; 4] = [1500; 4];

fn said(ground: &Ground, text: &str) -> bool {
    ground.texts().iter().any(|said| said == text)
}

#[test]
fn zigzag_stores_two_points_and_flies_to_the_lines_through_them() {
    let mut ground = Ground::hovering(10.0);
    ground.set("RC8_OPTION", 61.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 24.0]);
    fly(&mut ground, CENTRED, 1500, 1.0);
    fly(&mut ground, CENTRED, 1100, 1.0);
    fly(&mut ground, [1700, 1500, 1500, 1500], 1500, 4.0);
    fly(&mut ground, CENTRED, 1500, 5.0);
    let b = ground.truth().position_ned_m;
    fly(&mut ground, CENTRED, 1900, 1.0);
    fly(&mut ground, [1500, 1300, 1500, 1500], 1500, 4.0);
    fly(&mut ground, CENTRED, 1500, 5.0);
    let ahead = ground.truth().position_ned_m;
    fly(&mut ground, CENTRED, 1100, 12.0);
    let across = ground.truth().position_ned_m;
    assert!(b[1] > 5.0 && ahead[0] > 5.0, "{b:?} {ahead:?}");
    assert!(across[1].abs() < 1.0, "{across:?}");
    assert!((across[0] - ahead[0]).abs() < 1.0, "{across:?}");
    for text in [
        "ZIGZAG: point A stored",
        "ZIGZAG: point B stored",
        "ZIGZAG: moving to A",
        "ZIGZAG: manual control",
    ] {
        assert!(said(&ground, text), "{text}: {:?}", ground.texts());
    }
}

#[test]
fn the_sticks_refer_to_the_heading_at_arming_in_simple_mode() {
    let mut ground = Ground::hovering(10.0);
    ground.set("RC8_OPTION", 3.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 5.0]);
    // Turned to the right by a quarter, forward is still north.
    fly(&mut ground, [1500, 1500, 1500, 1700], 1000, 3.0);
    fly(&mut ground, CENTRED, 1900, 2.0);
    assert!(said(&ground, "SIMPLE mode on"));
    let before = ground.truth();
    assert!(before.heading_deg > 60.0, "{}", before.heading_deg);
    fly(&mut ground, [1500, 1300, 1500, 1500], 1900, 4.0);
    let after = ground.truth().position_ned_m;
    let moved = [0, 1].map(|axis| after[axis] - before.position_ned_m[axis]);
    assert!(moved[0] > 5.0 && moved[1].abs() < 1.0, "{moved:?}");
}

#[test]
fn a_switch_saves_places_as_a_mission() {
    let mut ground = Ground::hovering(10.0);
    ground.set("RC8_OPTION", 7.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 5.0]);
    for eighth_us in [1000, 1900, 1000, 1900] {
        fly(&mut ground, CENTRED, eighth_us, 0.5);
    }
    let mission = &ground.world.slots[0].autopilot.vehicle.plans.mission;
    let commands: Vec<_> = mission.iter().map(|item| item.command).collect();
    assert_eq!(commands, [22, 16, 16]);
    assert!((ground.world.parameter(0, "MIS_TOTAL") - 3.0).abs() < 1e-9);
}

#[test]
fn an_interlock_that_is_on_forbids_arming_and_one_that_is_off_stops_the_motors() {
    let mut ground = Ground::new();
    ground.run(2.0);
    ground.set("RC8_OPTION", 32.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 5.0]);
    let low = [1500, 1500, 1000, 1500];
    fly(&mut ground, low, 1900, 1.0);
    let arm = |ground: &mut Ground| ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
    assert_eq!(arm(&mut ground), MavResult::MAV_RESULT_FAILED);
    assert!(said(&ground, "Arm: Motor Interlock Enabled"));
    fly(&mut ground, low, 1000, 1.0);
    assert_eq!(arm(&mut ground), MavResult::MAV_RESULT_ACCEPTED);
    let up = [1500, 1500, 1800, 1500];
    fly(&mut ground, up, 1000, 4.0);
    assert!(ground.truth().position_ned_m[2] > -0.1);
    fly(&mut ground, up, 1900, 8.0);
    assert!(ground.truth().position_ned_m[2] < -2.0);
    fly(&mut ground, low, 1000, 15.0);
    assert!(!ground.truth().armed);
}

#[test]
fn switches_turn_the_gps_and_overrides_off() {
    let mut ground = with_options(65.0, 0.0);
    hold(&mut ground, 1900, 0, 0.5);
    assert!(
        ground.world.slots[0]
            .autopilot
            .vehicle
            .tuning
            .faults
            .gps
            .disabled
    );
    hold(&mut ground, 1000, 0, 0.5);
    assert!(
        !ground.world.slots[0]
            .autopilot
            .vehicle
            .tuning
            .faults
            .gps
            .disabled
    );
    ground.set("RC9_OPTION", 46.0);
    hold(&mut ground, 1900, 1000, 0.5);
    let channels = ground.world.slots[0].autopilot.vehicle.sticks().channels_us;
    assert_eq!(channels[7], 1800, "the transmitter's own");
    ground.long(MavCmd::MAV_CMD_DO_AUX_FUNCTION, [46.0, 2.0]);
    ground.set("RC9_OPTION", 0.0);
    hold(&mut ground, 1900, 0, 0.2);
    let channels = ground.world.slots[0].autopilot.vehicle.sticks().channels_us;
    assert_eq!(channels[7], 1900);
}

#[test]
fn a_parachute_is_released_above_its_least_height_only() {
    let mut ground = Ground::hovering(8.0);
    ground.set("RC8_OPTION", 23.0);
    fly(&mut ground, CENTRED, 1500, 1.0);
    fly(&mut ground, CENTRED, 1900, 0.5);
    assert!(said(&ground, "Parachute: Too low") && ground.truth().armed);
    let mut ground = Ground::hovering(15.0);
    ground.long(MavCmd::MAV_CMD_DO_PARACHUTE, [1.0]);
    ground.long(MavCmd::MAV_CMD_DO_PARACHUTE, [2.0]);
    assert!(said(&ground, "Parachute: Released") && !ground.truth().armed);
}

/// As a real rover answered.
#[test]
fn a_rover_has_switches_of_its_own_and_lacks_those_of_copters() {
    let mut ground = super::driving::guided(Chassis::Ackermann);
    for (function, mode) in [(51.0, 0), (53.0, 3), (54.0, 4), (59.0, 7), (72.0, 9)] {
        let answer = ground.long(MavCmd::MAV_CMD_DO_AUX_FUNCTION, [function, 2.0]);
        assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED, "{function}");
        assert_eq!(ground.truth().mode, mode, "{function}");
    }
    for (function, answer) in [
        (0.0, MavResult::MAV_RESULT_ACCEPTED),
        (74.0, MavResult::MAV_RESULT_ACCEPTED),
        (3.0, MavResult::MAV_RESULT_FAILED),
        (33.0, MavResult::MAV_RESULT_FAILED),
    ] {
        let got = ground.long(MavCmd::MAV_CMD_DO_AUX_FUNCTION, [function, 2.0]);
        assert_eq!(got, answer, "{function}");
    }
    let is_said = ground
        .texts()
        .contains(&"Invalid channel option (33)".to_owned());
    assert!(is_said, "the copter's BRAKE");
}

#[test]
fn each_relay_has_its_switch_and_an_absent_one_stays_off() {
    let mut ground = Ground::new();
    ground.run(2.0);
    let mut switched = |function: f32, position: f32, is_present: f32, number: usize| {
        ground.set(&format!("RELAY{number}_FUNCTION"), is_present);
        let answer = ground.long(MavCmd::MAV_CMD_DO_AUX_FUNCTION, [function, position]);
        assert_eq!(answer, MavResult::MAV_RESULT_ACCEPTED, "{function}");
        ground.world.slots[0].autopilot.workbench.relays_on
    };
    let functions = [28.0, 34.0, 35.0, 36.0, 66.0, 67.0];
    for (function, number) in functions.into_iter().zip(1..) {
        assert_eq!(switched(function, 2.0, 0.0, number), 0, "{function}");
        assert_eq!(switched(function, 2.0, 1.0, number), 1 << (number - 1));
        assert_eq!(switched(function, 0.0, 1.0, number), 0, "{function}");
    }
}
