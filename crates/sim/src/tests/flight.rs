//! Flights compared with figures that were measured on the real vehicle.

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::*;
use sortie_geo::maths;

/// Checks that `got` is within `share` of the measured figure.
pub(super) fn close(what: &str, got: f64, measured: f64, share: f64) {
    println!("{what}: {got:.2}, measured {measured:.2}");
    assert!(
        (got - measured).abs() <= share * measured.abs(),
        "{what}: {got:.2}, measured {measured:.2}"
    );
}

fn height(truth: &Truth) -> f64 {
    -truth.position_ned_m[2]
}

#[test]
fn a_takeoff_takes_as_long_as_the_real_one() {
    let mut ground = Ground::armed();
    // Sooner after arming, a takeoff would wait.
    ground.run(3.0);
    ground.takeoff(20.0);
    let mut elapsed = 0.0;
    for (share, measured_s) in [
        (0.02, 2.2),
        (0.1, 3.30),
        (0.5, 6.54),
        (0.9, 10.10),
        (0.99, 11.86),
    ] {
        elapsed += ground.until(30.0, |truth| height(truth) >= 20.0 * share);
        close(&format!("takeoff to {share}"), elapsed, measured_s, 0.05);
    }
    ground.run(5.0);
    close("height", height(&ground.truth()), 20.0, 0.002);

    let mut ground = Ground::armed();
    ground.run(3.0);
    ground.takeoff(30.0);
    let elapsed = ground.until(30.0, |truth| height(truth) > 29.5);
    close("takeoff to 29.5 of 30 m", elapsed, 15.2, 0.05);
}

#[test]
fn a_leg_of_100_m_is_flown_like_the_real_one() {
    let mut ground = Ground::hovering(20.0);
    ground.goto([100.0, 0.0, -20.0]);
    let mut peak: f64 = 0.0;
    let mut farthest: f64 = 0.0;
    let ninety = ground.until(20.0, |t| t.velocity_ned_m_s[0] >= 0.9 * 10.16);
    close("90 % of the top speed", ninety, 4.6, 0.05);
    let arrived = ninety
        + ground.until(20.0, |t| {
            peak = peak.max(t.velocity_ned_m_s[0]);
            t.position_ned_m[0] >= 99.7
        });
    close("top speed", peak, 10.16, 0.02);
    close("within 0.3 m", arrived, 14.5, 0.05);
    for _ in 0..1000 {
        ground.step();
        farthest = farthest.max(ground.truth().position_ned_m[0]);
    }
    close("farthest", farthest, 100.84, 0.01);
}

#[test]
fn velocity_steps_rise_and_fall_like_the_real_ones() {
    for (speed, rise_s, stop_m) in [(5.0, 2.40, 6.8), (10.0, 4.62, 23.3)] {
        let mut ground = Ground::hovering(20.0);
        let mut elapsed = 0.0;
        let mut rise = None;
        while elapsed < 10.0 {
            ground.fly([0.0, speed, 0.0]);
            ground.run(0.1);
            elapsed += 0.1;
            if rise.is_none() && ground.truth().velocity_ned_m_s[1] >= 0.9 * f64::from(speed) {
                rise = Some(elapsed);
            }
        }
        close("rise", rise.expect("rises"), rise_s, 0.06);
        close(
            "speed",
            ground.truth().velocity_ned_m_s[1],
            f64::from(speed),
            0.03,
        );
        let from = ground.truth().position_ned_m[1];
        ground.fly([0.0; 3]);
        ground.until(10.0, |t| t.velocity_ned_m_s[1] < 0.05);
        close(
            "stopping distance",
            ground.truth().position_ned_m[1] - from,
            stop_m,
            0.1,
        );
    }
}

#[test]
fn a_velocity_ends_three_seconds_after_the_last_word() {
    let mut ground = Ground::hovering(20.0);
    for _ in 0..50 {
        ground.run(0.2);
        ground.fly([5.0, 0.0, 0.0]);
    }
    ground.run(3.0);
    assert!(ground.truth().velocity_ned_m_s[0] > 4.9);
    let stopped = 3.0 + ground.until(10.0, |t| t.velocity_ned_m_s[0] < 0.4);
    close("stopped", stopped, 5.4, 0.05);
}

#[test]
fn climbs_and_descents_keep_the_real_times() {
    let mut ground = Ground::hovering(20.0);
    ground.goto([0.0, 0.0, -30.0]);
    let ninety = ground.until(20.0, |t| height(t) >= 29.0);
    close("climb 90 %", ninety, 5.7, 0.05);
    close(
        "climb 99 %",
        ninety + ground.until(20.0, |t| height(t) >= 29.9),
        6.9,
        0.05,
    );
    ground.run(10.0);
    ground.goto([0.0, 0.0, -20.0]);
    close(
        "descent 90 %",
        ground.until(20.0, |t| height(t) <= 21.0),
        7.0,
        0.05,
    );
}

#[test]
fn a_turn_of_180_degrees_takes_as_long_as_the_real_one() {
    let mut ground = Ground::hovering(10.0);
    ground.long(MavCmd::MAV_CMD_CONDITION_YAW, [180.0, 0.0, 1.0, 0.0]);
    close(
        "180 degrees",
        ground.until(10.0, |t| (t.heading_deg - 180.0).abs() < 2.0),
        3.17,
        0.08,
    );
    ground.long(MavCmd::MAV_CMD_CONDITION_YAW, [90.0, 20.0, -1.0, 0.0]);
    close(
        "90 degrees at 20/s",
        ground.until(10.0, |t| (t.heading_deg - 90.0).abs() < 2.0),
        4.7,
        0.08,
    );
}

/// The flight from 168 m north and 140 m west at 17.9 m takes 64.5 s until the vehicle disarms.
#[test]
fn a_return_takes_as_long_as_the_real_one() {
    let mut ground = Ground::hovering(17.86);
    ground.goto([168.0, -140.0, -17.86]);
    ground.run(60.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    let home = ground.until(60.0, |t| {
        maths::hypot(t.position_ned_m[0], t.position_ned_m[1]) < 3.2
    });
    close("over home", home, 26.8, 0.05);
    let descending = home + ground.until(60.0, |t| t.velocity_ned_m_s[2] > 0.5);
    close("descends", descending, 35.5, 0.05);
    let low = descending + ground.until(60.0, |t| height(t) < 10.0);
    close("at 10 m", low, 41.7, 0.05);
    let touched = low + ground.until(60.0, |t| t.on_ground);
    close("touches", touched, 61.8, 0.05);
    let disarmed = touched + ground.until(60.0, |t| !t.armed);
    close("disarmed", disarmed, 64.5, 0.05);
    close("touch to disarm", disarmed - touched, 2.1, 0.05);
    assert_eq!(ground.truth().mode, 6);
    let texts = ground.texts();
    assert!(
        texts
            .iter()
            .any(|t| t.starts_with("SIM Hit ground at 0.5")
                || t.starts_with("SIM Hit ground at 0.4")),
        "{texts:?}"
    );
    assert!(texts.iter().any(|t| t == "Disarming motors"));
    let off = ground.truth().position_ned_m;
    assert!(maths::hypot(off[0], off[1]) < 0.3, "{off:?}");
}

#[test]
fn a_landing_from_10_m_takes_as_long_as_the_real_one() {
    let mut ground = Ground::hovering(10.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_NAV_LAND, [0.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    close(
        "landed and disarmed",
        ground.until(60.0, |t| !t.armed),
        22.5,
        0.05,
    );
}

#[test]
fn braking_from_8_and_a_half_metres_per_second_takes_17_m() {
    let mut ground = Ground::hovering(20.0);
    ground.fly([8.5, 0.0, 0.0]);
    ground.run(2.5);
    ground.fly([8.5, 0.0, 0.0]);
    ground.until(10.0, |t| t.velocity_ned_m_s[0] > 8.2);
    ground.fly([8.5, 0.0, 0.0]);
    ground.run(2.0);
    let from = ground.truth().position_ned_m[0];
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 17.0]);
    ground.run(8.0);
    close(
        "braking distance",
        ground.truth().position_ned_m[0] - from,
        17.0,
        0.1,
    );
}

#[test]
fn drag_limits_the_speed_and_the_wind_leans_the_vehicle() {
    let mut ground = Ground::hovering(30.0);
    for _ in 0..60 {
        ground.fly([20.0, 0.0, 0.0]);
        ground.run(0.5);
    }
    close(
        "top speed at 30 degrees",
        ground.truth().velocity_ned_m_s[0],
        10.3,
        0.02,
    );

    let mut ground = Ground::hovering(30.0);
    ground.set("SIM_WIND_SPD", 10.0);
    ground.set("SIM_WIND_DIR", 90.0);
    ground.run(20.0);
    let truth = ground.truth();
    close(
        "lean in 10 m/s of wind",
        maths::hypot(truth.roll_deg, truth.pitch_deg),
        18.7,
        0.1,
    );
    assert!(truth.position_ned_m[1].abs() < 0.3, "{truth:?}");
}

#[test]
fn the_battery_drains_like_the_real_one() {
    let mut ground = Ground::hovering(20.0);
    close(
        "hover current",
        ground.truth().battery_current_a,
        28.1,
        0.02,
    );
    let before = ground.truth().battery_consumed_mah;
    ground.run(60.0);
    close(
        "per minute",
        ground.truth().battery_consumed_mah - before,
        468.0,
        0.02,
    );
    close("voltage", ground.truth().battery_voltage_v, 12.6, 1e-6);
}

#[test]
fn a_vehicle_disarmed_in_the_air_falls() {
    let mut ground = Ground::hovering(40.0);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 0.0]),
        MavResult::MAV_RESULT_FAILED
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21196.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
    close("falls", ground.until(10.0, |t| t.on_ground), 3.5, 0.06);
    ground.run(1.0);
    assert!(
        ground
            .texts()
            .iter()
            .any(|t| t.starts_with("SIM Hit ground at 1"))
    );
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        MavResult::MAV_RESULT_ACCEPTED
    );
}

#[test]
fn parameters_change_the_flight() {
    let mut ground = Ground::hovering(20.0);
    ground.set("ANGLE_MAX", 4500.0);
    ground.set("WPNAV_SPEED", 1500.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 17.0]);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    ground.goto([300.0, 0.0, -20.0]);
    let mut peak: f64 = 0.0;
    for _ in 0..2000 {
        ground.step();
        peak = peak.max(ground.truth().velocity_ned_m_s[0]);
    }
    close("top speed", peak, 15.08, 0.03);
}

#[test]
fn a_silent_ground_station_brings_the_vehicle_home_if_asked() {
    let mut ground = Ground::hovering(20.0);
    ground.set("FS_GCS_ENABLE", 1.0);
    ground.heartbeat();
    close("failsafe", ground.until(20.0, |t| t.mode == 6), 5.2, 0.05);
    ground.heartbeat();
    ground.run(0.5);
    assert_eq!(ground.truth().mode, 6, "the mode stays");
    let texts = ground.texts();
    assert!(
        texts.contains(&"GCS Failsafe".to_owned())
            && texts.contains(&"GCS Failsafe Cleared".to_owned())
    );
}

#[test]
fn a_low_battery_acts_after_its_delay_and_forbids_arming() {
    let mut ground = Ground::hovering(10.0);
    ground.set("BATT_FS_LOW_ACT", 2.0);
    ground.set("BATT_CRT_VOLT", 9.8);
    ground.set("BATT_FS_CRT_ACT", 1.0);
    ground.set("SIM_BATT_VOLTAGE", 10.4);
    close("low", ground.until(20.0, |t| t.mode == 6), 10.2, 0.05);
    ground.set("SIM_BATT_VOLTAGE", 9.6);
    close("critical", ground.until(20.0, |t| t.mode == 9), 10.1, 0.05);
    ground.until(60.0, |t| !t.armed);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0]);
    assert_eq!(
        ground.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
        MavResult::MAV_RESULT_FAILED
    );
    let texts = ground.texts();
    for start in [
        "Battery 1 is low 10.40V used ",
        "Battery 1 is critical 9.60V",
        "Arm: Battery failsafe",
    ] {
        assert!(
            texts.iter().any(|text| text.starts_with(start)),
            "{texts:?}"
        );
    }
}

#[test]
fn loiter_without_a_transmitter_sinks_and_an_override_holds_it() {
    let mut ground = Ground::hovering(20.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 5.0]);
    ground.run(3.0);
    close("sinks", ground.truth().velocity_ned_m_s[2], 2.5, 0.05);
    for _ in 0..10 {
        ground.sticks(1500);
        ground.run(0.5);
    }
    assert!(ground.truth().velocity_ned_m_s[2].abs() < 0.1);
    ground.run(10.0);
    assert!(ground.truth().on_ground, "the override runs out");
}

#[test]
fn a_circle_keeps_its_radius() {
    let mut ground = Ground::hovering(20.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 7.0]);
    ground.run(20.0);
    let mut most: f64 = 0.0;
    for _ in 0..2000 {
        ground.step();
        let at = ground.truth().position_ned_m;
        most = most.max((maths::hypot(at[0] - 10.0, at[1]) - 10.0).abs());
    }
    assert!(most < 1.5, "{most}");
}

#[test]
fn slanted_legs_take_as_long_as_the_real_ones() {
    let mut ground = Ground::hovering(30.0);
    let away = |t: &Truth, goal: [f64; 3]| {
        let off = [0, 1, 2].map(|axis| t.position_ned_m[axis] - goal[axis]);
        maths::hypot(maths::hypot(off[0], off[1]), off[2])
    };
    ground.goto([100.0, 50.0, -40.0]);
    let first = ground.until(40.0, |t| away(t, [100.0, 50.0, -40.0]) < 1.0);
    close("up and away", first, 15.3, 0.05);
    ground.run(8.0);
    ground.goto([0.0, -50.0, -20.0]);
    let second = ground.until(40.0, |t| away(t, [0.0, -50.0, -20.0]) < 1.5);
    close("down and back", second, 18.5, 0.05);
}

#[test]
fn a_low_return_climbs_to_its_altitude_first_and_near_home_stays_under_the_cone() {
    for (away_m, altitude_m) in [(60.0, 15.0), (2.0, 6.0)] {
        let mut ground = Ground::hovering(5.0);
        ground.goto([away_m, 0.0, -5.0]);
        ground.run(20.0);
        ground.long(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0]);
        let mut highest: f64 = 0.0;
        ground.until(120.0, |t| {
            highest = highest.max(height(t));
            !t.armed
        });
        close("highest", highest, altitude_m, 0.03);
    }
}
