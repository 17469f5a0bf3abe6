//! The switches of the remote control.

use mavlink::dialects::ardupilotmega::{MavMessage, RC_CHANNELS_OVERRIDE_DATA};

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
