//! Drones of the workshop: what was computed of them against what they do in the air, at sea level and without wind.

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult, RC_CHANNELS_OVERRIDE_DATA};

use super::*;
use crate::workshop::{Air, Design, Figures};

const ALT_HOLD: f32 = 2.0;
/// The part of the charge that the endurance is compared over.
const USED: f64 = 0.8;

/// A quad, a hexa, one with lithium ion cells, a heavy one and a racer.
const DESIGNS: [&str; 5] = [
    include_str!("../../../designs/starter.toml"),
    include_str!("../../../designs/gas-hexa.toml"),
    include_str!("../../../designs/endurance.toml"),
    include_str!("../../../designs/deminer.toml"),
    include_str!("../../../designs/scout.toml"),
];

/// A design, what was computed of it, and it in the air. Nothing brings it home before its battery is empty.
fn flown(source: &str) -> (Design, Figures, Ground) {
    let design = Design::from_toml(source).expect("a good design");
    let figures = design.figures(Air::default()).expect("complete");
    let built = design.airframe().expect("complete");
    let (airframe, warnings) = Airframe::from_json(&built.frame.to_string()).expect("valid");
    assert_eq!(warnings, []);
    let start = Start {
        altitude_amsl_m: 0.0,
        ..start()
    };
    let mut ground = Ground::in_world(&WorldConfig {
        airframes: vec![Arc::new(airframe.with_parameters(built.parameters))],
        ..WorldConfig::row(1, start)
    });
    for name in ["BATT_FS_LOW_ACT", "BATT_FS_CRT_ACT"] {
        ground.set(name, 0.0);
    }
    (design, figures, ground.hover(20.0))
}

fn compare(name: &str, what: &str, computed: f64, found: f64, within: f64) {
    println!("{name:14} {what:14} computed {computed:8.2} flown {found:8.2}");
    let error = (found - computed).abs();
    assert!(
        error <= within,
        "{name}: {what} {found:.3} instead of {computed:.3}"
    );
}

/// Seconds in the hover from a full battery until a share of its charge is used. What take-off took counts as hover.
fn endurance_s(ground: &mut Ground, capacity_ah: f64, share: f64) -> f64 {
    let battery = |ground: &Ground| ground.world.slots[0].autopilot.battery;
    let begun = battery(ground);
    let before_s = begun.consumed_mah * 3.6 / begun.current_a;
    let mut steps = 0_u32;
    while battery(ground).consumed_mah < share * capacity_ah * 1000.0 {
        ground.step();
        ground.heard.clear();
        steps += 1;
    }
    before_s + f64::from(steps) * STEP.as_secs_f64()
}

#[test]
fn a_design_hovers_with_the_throttle_the_power_and_for_as_long_as_computed() {
    for source in DESIGNS {
        let (design, figures, mut ground) = flown(source);
        let name = design.name.as_str();
        let throttle = ground.truth().throttle;
        compare(name, "throttle", figures.hover_throttle, throttle, 0.03);
        let battery = ground.world.slots[0].autopilot.battery;
        let power_w = battery.current_a * battery.voltage_v;
        compare(
            name,
            "hover W",
            figures.hover_power_w,
            power_w,
            0.02 * power_w,
        );
        let time_s = endurance_s(&mut ground, figures.capacity_ah, USED);
        compare(name, "hover s", figures.hover_80_s, time_s, 0.05 * time_s);
        let height_m = -ground.truth().position_ned_m[2];
        assert!(
            (height_m - 20.0).abs() < 1.0,
            "{name}: still up at {height_m} m"
        );
    }
}

#[test]
fn a_design_flies_as_fast_as_computed() {
    for source in DESIGNS {
        let (design, figures, mut ground) = flown(source);
        let name = design.name.as_str();
        let mode = ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, ALT_HOLD]);
        assert_eq!(mode, MavResult::MAV_RESULT_ACCEPTED);
        // The nose is held down until it gets no faster.
        for _ in 0..600 {
            ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
                RC_CHANNELS_OVERRIDE_DATA {
                    chan1_raw: 1500,
                    chan2_raw: 1000,
                    chan3_raw: 1500,
                    chan4_raw: 1500,
                    target_system: 1,
                    target_component: 1,
                    ..Default::default()
                },
            ));
            ground.run(0.1);
        }
        let truth = ground.truth();
        let [north, east, _] = truth.velocity_ned_m_s;
        let speed = north.hypot(east);
        compare(name, "top m/s", figures.top_speed_m_s, speed, 0.1 * speed);
    }
}
