use proptest::prelude::*;

use super::*;

fn small() -> Airframe {
    Airframe::from_json("{\"battCapacityAh\": 1.2}")
        .expect("valid")
        .0
}

/// Volts and amperes of a hovering SITL vehicle with a 1.2 Ah battery, by the charge drawn
/// (recording `k2_battery`).
#[test]
fn a_small_battery_empties_like_the_real_one() {
    let airframe = small();
    let mut battery = Battery::charged(&airframe, 12.6);
    let hover_w = airframe.power_w(crate::kinematics::GRAVITY_M_S2);
    for (drawn_mah, volts, amperes) in [
        (164.0, 11.94, 29.7),
        (332.0, 11.48, 30.8),
        (595.0, 10.99, 32.2),
        (777.0, 10.52, 33.7),
        (872.0, 10.24, 34.6),
    ] {
        while battery.consumed_mah < drawn_mah {
            battery.step(hover_w, 12.6, &airframe);
        }
        let (got_v, got_a) = (battery.voltage_v, battery.current_a);
        assert!(
            (got_v - volts).abs() < 0.08,
            "{got_v} V after {drawn_mah} mAh, measured {volts}"
        );
        assert!(
            (got_a - amperes).abs() < 0.3,
            "{got_a} A after {drawn_mah} mAh, measured {amperes}"
        );
    }
    while battery.consumed_mah < 1185.0 {
        battery.step(hover_w, 12.6, &airframe);
    }
    assert!(battery.voltage_v < 8.0, "{battery:?}");
}

#[test]
fn without_a_capacity_the_voltage_is_what_is_set() {
    let airframe = Airframe::default();
    let mut battery = Battery::charged(&airframe, 12.6);
    for _ in 0..100_000 {
        battery.step(400.0, 12.6, &airframe);
    }
    assert!((battery.voltage_v - 12.6).abs() < 1e-9);
    battery.step(400.0, 10.4, &airframe);
    assert!((battery.voltage_v - 10.4).abs() < 1e-9);
}

#[test]
fn setting_a_voltage_drains_a_battery_with_a_capacity() {
    let airframe = small();
    let mut battery = Battery::charged(&airframe, 12.6);
    assert!((battery.left_ah - 1.2).abs() < 1e-9);
    battery.step(0.0, 10.0, &airframe);
    let left = battery.left_ah;
    assert!((0.1..0.2).contains(&left), "{left}");
    for _ in 0..100 {
        battery.step(0.0, 10.0, &airframe);
    }
    assert!((battery.voltage_v - 10.0).abs() < 0.01, "{battery:?}");
}

proptest! {
    #[test]
    fn the_charge_only_falls(
        capacity in 0.0..5.0_f64,
        resistance in 0.0..10.0_f64,
        volts in 0.0..600.0_f64,
        power in proptest::collection::vec(0.0..5000.0_f64, 1..300),
    ) {
        let text = format!("{{\"battCapacityAh\": {capacity}, \"refBatRes\": {resistance}}}");
        let airframe = Airframe::from_json(&text).expect("valid").0;
        let mut battery = Battery::charged(&airframe, volts);
        for power_w in power {
            let before = battery;
            battery.step(power_w, volts, &airframe);
            prop_assert!(battery.left_ah <= before.left_ah && battery.left_ah >= 0.0);
            prop_assert!(battery.consumed_mah >= before.consumed_mah);
            prop_assert!(battery.consumed_wh >= before.consumed_wh);
            prop_assert!(battery.voltage_v.is_finite() && battery.voltage_v >= 0.0);
            prop_assert!(battery.current_a.is_finite());
        }
    }
}
