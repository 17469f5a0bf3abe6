//! Failing motors, emptying batteries, frames of other sizes, wind: compared with figures measured on a SITL of the
//! same version with the same frame.

use std::sync::Arc;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavType};

use super::flight::close;
use super::*;

/// `ArduPilot`'s example of a heavy octocopter, Callisto.
const HEAVY: &str = r#"{"mass": 32.5, "diagonal_size": 1.325, "refSpd": 25.0, "refAngle": 30.0, "refVoltage": 46.9,
    "refCurrent": 65.36, "refAlt": 26, "refTempC": 25, "refBatRes": 0.024, "maxVoltage": 50.4, "battCapacityAh": 44,
    "propExpo": 0.5, "refRotRate": 120, "hoverThrOut": 0.36, "pwmMin": 1000, "pwmMax": 1940, "spin_min": 0.2,
    "spin_max": 0.975, "slew_max": 75, "disc_area": 1.82, "mdrag_coef": 0.10, "num_motors": 8}"#;

fn flying(frame: &str) -> Ground {
    let (airframe, warnings) = Airframe::from_json(frame).expect("valid");
    assert_eq!(warnings, []);
    Ground::flying(Arc::new(airframe))
}

fn fail_motor(ground: &mut Ground, output: f32, multiplier: f32) {
    ground.set("SIM_ENGINE_FAIL", output);
    ground.set("SIM_ENGINE_MUL", multiplier);
}

fn body(ground: &mut Ground) -> &mut body::Body {
    &mut ground.world.slots[0].autopilot.vehicle.plant.body
}

/// The largest distance from the current position within a time.
fn excursion(ground: &mut Ground, seconds: f64) -> f64 {
    let from = DVec3::from_array(ground.truth().position_ned_m);
    let mut most: f64 = 0.0;
    for _ in 0..(seconds * 100.0) as usize {
        ground.step();
        most = most.max(DVec3::from_array(ground.truth().position_ned_m).distance(from));
    }
    most
}

fn said(ground: &Ground, what: &str) -> bool {
    ground.texts().iter().any(|text| text.starts_with(what))
}

#[test]
fn a_quad_that_loses_a_motor_tumbles_to_the_ground_and_stays_armed() {
    let mut ground = Ground::hovering(25.0);
    fail_motor(&mut ground, 1.0, 0.0);
    let mut most_lean: f64 = 0.0;
    let fell = ground.until(10.0, |t| {
        most_lean = most_lean.max(t.roll_deg.abs());
        t.on_ground
    });
    close("falls for", fell, 2.9, 0.03);
    assert!(most_lean > 90.0, "upside down on the way: {most_lean}");
    ground.run(5.0);
    let truth = ground.truth();
    assert!(truth.armed && -truth.position_ned_m[2] < 1.0, "{truth:?}");
    assert!(
        said(&ground, "SIM Hit ground at 13."),
        "{:?}",
        ground.texts()
    );
    assert!(!said(&ground, "Crash"), "{:?}", ground.texts());
}

#[test]
fn a_weak_motor_is_made_up_for() {
    let mut ground = Ground::hovering(25.0);
    fail_motor(&mut ground, 1.0, 0.7);
    close("excursion", excursion(&mut ground, 8.0), 0.98, 0.15);
    close("throttle", ground.truth().throttle, 0.455, 0.03);
    assert!(excursion(&mut ground, 5.0) < 0.1, "it holds");
    fail_motor(&mut ground, 1.0, 1.0);
    ground.run(20.0);
    assert!(body(&mut ground).upset.is_none(), "mended");
    let truth = ground.truth();
    close("throttle", truth.throttle, 0.36, 0.01);
    assert!(excursion(&mut ground, 5.0) < 0.1);
}

#[test]
fn a_motor_at_half_its_pulse_loses_too_much_thrust() {
    let mut ground = Ground::hovering(25.0);
    fail_motor(&mut ground, 1.0, 0.5);
    let mut warned = 0.0;
    while !said(&ground, "Potential Thrust Loss (2)") && warned < 10.0 {
        ground.run(0.1);
        warned += 0.1;
    }
    close("warned", warned, 2.8, 0.12);
    let landed = warned + ground.until(10.0, |t| t.on_ground);
    close("on the ground", landed, 6.3, 0.12);
    assert!(
        said(&ground, "SIM Hit ground at 5."),
        "{:?}",
        ground.texts()
    );
}

#[test]
fn a_hexacopter_survives_the_loss_of_a_motor() {
    let mut ground = flying("{\"num_motors\": 6}").hover(25.0);
    fail_motor(&mut ground, 1.0, 0.0);
    let mut lowest: f64 = 25.0;
    for _ in 0..3000 {
        ground.step();
        lowest = lowest.min(-ground.truth().position_ned_m[2]);
    }
    // The real vehicle sank to 17.9 m, reported the loss after 3.2 s and returned to its height.
    close("lowest", lowest, 17.9, 0.15);
    close("height", -ground.truth().position_ned_m[2], 25.0, 0.02);
    assert!(said(&ground, "Potential Thrust Loss (2)"));
}

#[test]
fn a_heavy_octocopter_flies_like_the_real_one() {
    let mut ground = flying(HEAVY).hover(25.0);
    close("hover", ground.truth().battery_current_a, 62.9, 0.01);
    close("voltage", ground.truth().battery_voltage_v, 48.69, 0.005);
    ground.goto([150.0, 0.0, -25.0]);
    for (wait_s, north_m, current_a) in [(2.0, 3.58, 65.7), (2.0, 17.24, 66.5), (6.0, 77.05, 63.2)]
    {
        ground.run(wait_s);
        let truth = ground.truth();
        assert!((truth.position_ned_m[0] - north_m).abs() < 0.5, "{truth:?}");
        close("current", truth.battery_current_a, current_a, 0.02);
    }
    ground.run(20.0);
    fail_motor(&mut ground, 1.0, 0.0);
    close("excursion", excursion(&mut ground, 8.0), 0.97, 0.2);
    let heartbeat = ground
        .messages_since(0)
        .into_iter()
        .find_map(|message| match message {
            MavMessage::HEARTBEAT(data) => Some(data.mavtype),
            _ => None,
        });
    assert_eq!(heartbeat, Some(MavType::MAV_TYPE_OCTOROTOR));
}

#[test]
fn a_small_battery_lets_the_vehicle_fall() {
    let mut ground = flying("{\"battCapacityAh\": 1.2}").hover(20.0);
    let parameters = &ground.world.slots[0].autopilot.vehicle.parameters;
    close("capacity", parameters.value("BATT_CAPACITY"), 1200.0, 1e-6);
    let drawn = ground.truth().battery_consumed_mah;
    assert!((200.0..400.0).contains(&drawn), "{drawn}");
    ground.until(200.0, |t| t.battery_consumed_mah > 872.0);
    close("voltage", ground.truth().battery_voltage_v, 10.24, 0.01);
    close("current", ground.truth().battery_current_a, 34.6, 0.01);
    close("throttle", ground.truth().throttle, 0.45, 0.03);
    ground.until(60.0, |t| t.on_ground);
    let truth = ground.truth();
    close("drawn", truth.battery_consumed_mah, 1190.0, 0.01);
    assert!(truth.battery_voltage_v < 8.0, "{truth:?}");
    ground.run(0.1);
    assert!(said(&ground, "SIM Hit ground"), "{:?}", ground.texts());
}

#[test]
fn a_wind_that_rises_pushes_the_vehicle_away_for_a_while() {
    let mut ground = Ground::hovering(25.0);
    ground.set("SIM_WIND_SPD", 10.0);
    ground.set("SIM_WIND_DIR", 90.0);
    close("excursion", excursion(&mut ground, 10.0), 0.87, 0.05);
    assert!(excursion(&mut ground, 10.0) < 0.05);

    let mut ground = Ground::hovering(25.0);
    ground.set("SIM_WIND_TURB", 3.0);
    let off = excursion(&mut ground, 30.0);
    assert!((0.03..0.2).contains(&off), "{off}");
}

#[test]
fn a_wreck_falls_and_its_crash_is_noticed() {
    let mut ground = Ground::hovering(25.0);
    body(&mut ground).hit(DVec3::new(-3.0, 0.0, 0.0));
    ground.until(5.0, |t| t.on_ground);
    let disarmed = ground.until(10.0, |t| !t.armed);
    assert!((1.5..4.0).contains(&disarmed), "{disarmed}");
    ground.run(0.1);
    assert!(
        said(&ground, "Crash: Disarming: AngErr="),
        "{:?}",
        ground.texts()
    );
    let truth = ground.truth();
    assert!(
        truth.roll_deg.abs().max(truth.pitch_deg.abs()) > 15.0,
        "{truth:?}"
    );
    assert!(truth.battery_current_a.abs() < 1e-9);
}

#[test]
fn the_crash_check_can_be_switched_off_and_a_reboot_mends_a_wreck() {
    let mut ground = Ground::hovering(15.0);
    ground.set("FS_CRASH_CHECK", 0.0);
    body(&mut ground).hit(DVec3::new(-3.0, 0.0, 0.0));
    ground.run(9.0);
    assert!(ground.truth().armed && !said(&ground, "Crash"));
    ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21196.0]);
    ground.long(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0]);
    ground.run(0.5);
    assert!(!body(&mut ground).wrecked && body(&mut ground).upset.is_none());
    let truth = ground.truth();
    assert!(truth.roll_deg.abs() < 1e-9 && truth.pitch_deg.abs() < 1e-9);
}

#[test]
fn each_vehicle_has_its_own_airframe() {
    let heavy = Arc::new(Airframe::from_json(HEAVY).expect("valid").0);
    let config = WorldConfig {
        airframes: vec![Airframe::shared_default(), heavy],
        ..WorldConfig::row(3, start())
    };
    let world = World::new(&config);
    let volts = [0, 1, 2].map(|vehicle| world.truth(vehicle).battery_voltage_v.round() as i32);
    assert_eq!(volts, [13, 50, 50]);
}

#[test]
fn vehicles_share_their_tuning_until_a_parameter_differs() {
    let mut ground = Ground::in_world(&WorldConfig::row(3, start()));
    let shares = |world: &World| {
        let [first, rest @ ..] = world.slots.as_slice() else {
            panic!("three vehicles");
        };
        let first = &first.autopilot.vehicle.tuning;
        rest.iter()
            .filter(|slot| Arc::ptr_eq(&slot.autopilot.vehicle.tuning, first))
            .count()
    };
    assert_eq!(shares(&ground.world), 2);
    ground.set("WPNAV_SPEED", 700.0);
    assert_eq!(shares(&ground.world), 0);
    let speeds = ground.world.slots[..2]
        .iter()
        .map(|slot| slot.autopilot.vehicle.tuning.flight.speed_m_s);
    assert_eq!(speeds.collect::<Vec<_>>(), [7.0, 10.0]);
}
