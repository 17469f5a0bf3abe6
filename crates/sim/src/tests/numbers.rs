//! Whatever the parameters, airframe and mode, numbers stay finite. No vehicle sinks into the ground, gains energy that
//! its motors did not supply, or charges its battery.

use std::sync::Arc;

use proptest::prelude::*;

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, RC_CHANNELS_OVERRIDE_DATA};

use super::transfers::{flight, upload};
use super::*;
use crate::airframe::tests::any_frame;
use crate::body::Body;
use crate::kinematics::{GRAVITY_M_S2, STEP_S};
use crate::parameters::Parameters;

/// Any parameter with a value of any size; half of the draws concern the simulation itself.
fn any_setting() -> impl Strategy<Value = (&'static str, f32)> {
    let all = Parameters::new(crate::VehicleKind::Copter, 1);
    let names: Vec<&'static str> = (0..all.count())
        .filter_map(|index| all.at(index))
        .map(|parameter| parameter.name)
        .filter(|name| !name.starts_with("SYSID"))
        .collect();
    let own: Vec<&'static str> = names
        .iter()
        .copied()
        .filter(|name| {
            [
                "SIM_WIND",
                "SIM_BATT",
                "SIM_ENGINE",
                "WPNAV",
                "PSC",
                "ATC",
                "ANGLE",
            ]
            .iter()
            .any(|start| name.starts_with(start))
        })
        .collect();
    let name = prop_oneof![
        proptest::sample::select(names),
        proptest::sample::select(own)
    ];
    let value = prop_oneof![-10.0..10.0_f32, -1e4..1e4_f32, -1e9..1e9_f32, Just(0.0_f32)];
    (name, value)
}

fn check(truth: &Truth) {
    let numbers = [
        truth.at.lat_deg,
        truth.at.lon_deg,
        truth.altitude_amsl_m,
        truth.roll_deg,
        truth.pitch_deg,
        truth.heading_deg,
        truth.battery_voltage_v,
        truth.battery_current_a,
        truth.battery_consumed_mah,
        truth.throttle,
    ];
    let moving = truth.position_ned_m.iter().chain(&truth.velocity_ned_m_s);
    for number in numbers.iter().chain(moving) {
        assert!(number.is_finite(), "{truth:?}");
    }
    assert!(truth.position_ned_m[2] <= 0.0, "{truth:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_settings_of_any_airframe_keep_finite_numbers_above_the_ground(
        airframe in any_frame(),
        before in proptest::collection::vec(any_setting(), 0..6),
        after in proptest::collection::vec(any_setting(), 1..12),
        target in proptest::array::uniform3(-1e3..1e3_f32),
    ) {
        let mut ground = Ground::flying(Arc::new(airframe));
        for (name, value) in before {
            ground.set(name, value);
        }
        ground.run(2.0);
        let slot = &mut ground.world.slots[0].autopilot;
        slot.set_mode_numbered(4);
        slot.vehicle.safety.armed = true;
        let mut climb = [0.0; 7];
        climb[6] = 20.0;
        ground.long7(mavlink::dialects::ardupilotmega::MavCmd::MAV_CMD_NAV_TAKEOFF, climb);
        ground.run(6.0);
        check(&ground.truth());
        ground.goto(target);
        for (name, value) in after {
            ground.set(name, value);
            ground.run(0.7);
            check(&ground.truth());
        }
        let mut drawn = ground.truth().battery_consumed_mah;
        for _ in 0..300 {
            ground.step();
            let truth = ground.truth();
            check(&truth);
            prop_assert!(truth.battery_consumed_mah >= drawn);
            drawn = truth.battery_consumed_mah;
        }
    }
}

/// Every mode that can be entered, including AUTO and the piloted ones.
const MODES: [f32; 15] = [
    0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 9.0, 11.0, 16.0, 17.0, 20.0, 21.0, 24.0,
];
/// The distance from the centre of a tumbling vehicle to its motors in metres, with a margin.
const ARM_M: f64 = 0.35;

/// The energy per mass, relative to the ground.
fn energy(body: &Body) -> f64 {
    0.5 * body.velocity_m_s.length_squared() + GRAVITY_M_S2 * body.height_m()
}

/// The maximum work that the motors can do in a step, per mass, between two states.
fn most_work(before: &Body, after: &Body) -> f64 {
    let tumbling = after
        .upset
        .as_ref()
        .map_or(0.0, |upset| upset.rates_rad_s.length());
    let speed = before
        .velocity_m_s
        .length()
        .max(after.velocity_m_s.length());
    after.thrust_m_s2 * (speed + ARM_M * tumbling) * STEP_S
}

fn steer(ground: &mut Ground, [roll, pitch, throttle, yaw]: [u16; 4]) {
    ground.say(MavMessage::RC_CHANNELS_OVERRIDE(
        RC_CHANNELS_OVERRIDE_DATA {
            chan1_raw: roll,
            chan2_raw: pitch,
            chan3_raw: throttle,
            chan4_raw: yaw,
            target_system: 1,
            target_component: 1,
            ..Default::default()
        },
    ));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn in_calm_air_no_mode_makes_energy_or_charge(
        legs in proptest::collection::vec(
            (proptest::sample::select(&MODES[..]), proptest::array::uniform4(1000..=2000_u16), any_setting()),
            2..10,
        ),
    ) {
        let mut ground = Ground::new();
        ground.run(2.0);
        upload(&mut ground, mavlink::dialects::ardupilotmega::MavMissionType::MAV_MISSION_TYPE_MISSION, &flight());
        ground.arm();
        ground.takeoff(8.0);
        ground.run(8.0);
        for (mode, sticks, (name, value)) in legs {
            // The wind may carry a vehicle: then its energy does not come from the motors alone.
            if !name.starts_with("SIM_WIND") {
                ground.set(name, value);
            }
            ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, mode]);
            for step in 0..300 {
                if step % 50 == 0 {
                    steer(&mut ground, sticks);
                }
                let before = ground.world.slots[0].autopilot.vehicle.plant.body.clone();
                let drawn = ground.truth().battery_consumed_mah;
                ground.step();
                let truth = ground.truth();
                check(&truth);
                prop_assert!(truth.battery_consumed_mah >= drawn, "{mode} {truth:?}");
                let after = &ground.world.slots[0].autopilot.vehicle.plant.body;
                let gained = energy(after) - energy(&before);
                prop_assert!(gained <= most_work(&before, after) + 1e-6, "{mode} {gained} {before:?} {after:?}");
            }
            ground.heard.clear();
        }
    }
}
