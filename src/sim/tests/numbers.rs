//! No parameter and no airframe makes a vehicle lose its numbers or sink into the ground.

use proptest::prelude::*;

use super::*;
use crate::sim::airframe::tests::any_frame;
use crate::sim::parameters::Parameters;

/// Any parameter with a value of any size; half of the draws concern the simulation itself.
fn any_setting() -> impl Strategy<Value = (&'static str, f32)> {
    let all = Parameters::new(1);
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
        slot.set_mode(4);
        slot.safety.armed = true;
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
