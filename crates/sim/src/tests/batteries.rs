//! A flight of the standard drone until its battery ends it.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::*;

/// `ArduCopter`'s mode numbers.
const GUIDED: u8 = 4;
const RTL: u8 = 6;
const LAND: u8 = 9;

fn hovering() -> Ground {
    Ground::flying(Airframe::shared_standard()).hover(10.0)
}

fn says(ground: &Ground, words: &str) -> bool {
    ground.texts().iter().any(|text| text.starts_with(words))
}

/// Hovers until a charge has been drawn, for at most 600 s, which is longer than a battery lasts.
fn hover_until_drawn(ground: &mut Ground, mah: f64) {
    ground.until(600.0, |truth| truth.battery_consumed_mah > mah);
}

#[test]
fn the_voltage_sags_with_the_charge_and_recovers_without_the_load() {
    let mut ground = hovering();
    for (drawn_mah, volts) in [(500.0, 11.97), (2000.0, 10.97), (3000.0, 10.17)] {
        hover_until_drawn(&mut ground, drawn_mah);
        let truth = ground.truth();
        assert!(
            (truth.battery_voltage_v - volts).abs() < 0.05,
            "{drawn_mah} mAh: {truth:?}"
        );
        let watts = truth.battery_voltage_v * truth.battery_current_a;
        assert!((watts - 354.0).abs() < 4.0, "the load stays: {truth:?}");
    }
    ground.long(MavCmd::MAV_CMD_NAV_LAND, []);
    ground.until(60.0, |truth| truth.position_ned_m[2] > -0.5);
    let loaded_v = ground.truth().battery_voltage_v;
    ground.until(60.0, |truth| !truth.armed);
    ground.run(1.0);
    let rested_v = ground.truth().battery_voltage_v;
    assert!(rested_v > loaded_v + 0.1, "{loaded_v} {rested_v}");
}

#[test]
fn the_battery_ends_the_flight_by_its_failsafes() {
    let mut ground = hovering();
    // It hovers over its home: going there needs no climb.
    ground.set("RTL_ALT", 0.0);
    hover_until_drawn(&mut ground, 3190.0);
    assert_eq!(ground.truth().mode, GUIDED, "{:?}", ground.texts());
    let left_s = ground.until(120.0, |truth| !truth.armed);
    assert!(left_s < 60.0, "{left_s}");
    let truth = ground.truth();
    assert_eq!((truth.mode, truth.on_ground), (RTL, true));
    assert!(
        says(&ground, "Battery 1 is low 9.89V used 3200 mAh"),
        "{:?}",
        ground.texts()
    );
    assert!(says(&ground, "Battery Failsafe"), "{:?}", ground.texts());
}

#[test]
fn a_critical_battery_is_landed_where_it_is() {
    let mut ground = hovering();
    ground.set("BATT_FS_LOW_ACT", 0.0);
    hover_until_drawn(&mut ground, 3590.0);
    assert_eq!(ground.truth().mode, GUIDED, "{:?}", ground.texts());
    ground.until(60.0, |truth| !truth.armed);
    assert_eq!(ground.truth().mode, LAND);
    assert!(
        says(&ground, "Battery 1 is critical 9."),
        "{:?}",
        ground.texts()
    );
}

#[test]
fn a_battery_that_nobody_minds_lets_the_vehicle_fall() {
    let mut ground = hovering();
    ground.set("BATT_FS_LOW_ACT", 0.0);
    ground.set("BATT_FS_CRT_ACT", 0.0);
    ground.until(900.0, |truth| truth.on_ground);
    let truth = ground.truth();
    assert!(
        (3900.0..4000.0).contains(&truth.battery_consumed_mah),
        "{truth:?}"
    );
    assert!(truth.battery_voltage_v < 8.0, "{truth:?}");
    ground.run(0.1);
    assert!(says(&ground, "SIM Hit ground at"), "{:?}", ground.texts());
}
