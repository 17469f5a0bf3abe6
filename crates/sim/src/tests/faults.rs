//! Faults of sensors, compared with measurements of the real vehicle section by section.

use mavlink::dialects::ardupilotmega::MavMessage;

use super::Ground;
use super::timeline::Timeline;
use sortie_geo::maths;

/// The tolerance against measured times: telemetry at 10 Hz, GPS samples and heartbeats.
const TOLERANCE_S: f64 = 0.35;
/// 0.001 degrees of latitude, in metres.
const GLITCH_M: f64 = 111.3;

fn hovering(height_m: f32) -> Timeline {
    Timeline::of(Ground::hovering(height_m))
}

#[test]
fn without_gps_the_vehicle_lands_and_finds_itself_again() {
    let mut seen = hovering(20.0);
    seen.ground.set("SIM_GPS_DISABLE", 1.0);
    seen.run(7.0);
    let (north, east) = seen.error_m();
    assert!(maths::hypot(north, east) > 0.1 && maths::hypot(north, east) < 1.5);
    seen.run(35.0);
    seen.must_say(
        TOLERANCE_S,
        &[
            (0.4, "fix 1 3"),
            (7.2, "flags 0025"),
            (8.1, "mode 9 status 5"),
            (8.1, "EKF variance"),
            (8.1, "EKF Failsafe: changed to LAND Mode"),
            (15.15, "EKF3 IMU0 stopped aiding"),
            (15.15, "EKF3 IMU1 stopped aiding"),
            (15.2, "flags 00a7"),
            (22.1, "SmartRTL deactivated: bad position"),
        ],
    );
    assert!(seen.asked(32).is_none(), "no local position any more");
    let landed_s = seen
        .lines
        .iter()
        .find(|(_, line)| line.contains("Hit ground"))
        .expect("landed")
        .0;
    assert!((landed_s - 40.0).abs() < 2.5, "{landed_s}");
    let drift = seen.ground.truth().position_ned_m;
    let drift_m = maths::hypot(drift[0], drift[1]);
    assert!((2.0..9.0).contains(&drift_m), "{drift_m}");
    seen.mark();
    seen.ground.set("SIM_GPS1_ENABLE", 1.0);
    seen.run(3.0);
    seen.must_say(
        TOLERANCE_S,
        &[
            (0.3, "EKF3 IMU0 is using GPS"),
            (0.3, "EKF3 IMU1 is using GPS"),
            (0.4, "flags 033f"),
            (1.3, "EKF Failsafe Cleared"),
        ],
    );
    let (north, east) = seen.error_m();
    assert!(maths::hypot(north, east) < 0.1, "{north} {east}");
}

#[test]
fn six_seconds_without_gps_at_5_m_s_do_nothing() {
    let mut seen = hovering(20.0);
    let fly = |seen: &mut Timeline, seconds: usize| {
        for _ in 0..seconds {
            seen.ground.fly([5.0, 0.0, 0.0]);
            seen.run(1.0);
        }
    };
    fly(&mut seen, 6);
    seen.mark();
    seen.ground.set("SIM_GPS_DISABLE", 1.0);
    fly(&mut seen, 6);
    seen.ground.set("SIM_GPS_DISABLE", 0.0);
    fly(&mut seen, 10);
    seen.must_say(TOLERANCE_S, &[(0.4, "fix 1 3"), (6.3, "fix 6 10")]);
    seen.must_not_say(&["EKF", "flags", "mode", "Glitch"]);
    assert!((seen.ground.truth().velocity_ned_m_s[0] - 5.0).abs() < 0.2);
}

#[test]
fn a_glitch_is_rejected_for_ten_seconds_and_then_believed() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_GPS_GLITCH_X", 0.001);
    seen.run(9.3);
    assert!(seen.error_m().0.abs() < 1.0, "not believed yet");
    seen.run(1.2);
    assert!((seen.error_m().0 - GLITCH_M).abs() < 1.0);
    seen.run(9.8);
    let north_m = seen.ground.truth().position_ned_m[0];
    assert!(north_m.abs() < 1.0, "held after a takeoff: {north_m}");
    seen.must_say(
        TOLERANCE_S,
        &[
            (0.3, "EKF3 lane switch 1"),
            (0.3, "EKF primary changed:1"),
            (1.3, "GPS Glitch or Compass error"),
            (1.3, "flags 833f"),
            (20.0, "Glitch cleared"),
        ],
    );
    seen.must_not_say(&["mode"]);
    seen.mark();
    seen.ground.set("SIM_GPS1_GLTCH_X", 0.0);
    seen.run(20.5);
    seen.must_say(
        TOLERANCE_S,
        &[
            (0.3, "EKF3 lane switch 0"),
            (1.3, "GPS Glitch or Compass error"),
            (20.1, "Glitch cleared"),
        ],
    );
    assert!(seen.error_m().0.abs() < 0.1);
}

#[test]
fn a_target_is_flown_to_where_the_glitch_says_it_is() {
    let mut seen = hovering(15.0);
    seen.ground.goto([20.0, 0.0, -15.0]);
    seen.run(15.0);
    seen.ground.set("SIM_GPS_GLITCH_Y", 0.0005);
    seen.run(40.0);
    let [north_m, east_m, _] = seen.ground.truth().position_ned_m;
    assert!((north_m - 20.0).abs() < 1.0, "{north_m}");
    assert!((east_m + 45.4).abs() < 1.0, "{east_m}");
}

#[test]
fn a_small_glitch_pulls_the_vehicle_away_without_a_word() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_GPS_GLITCH_X", 0.000_03);
    seen.run(20.0);
    let north_m = seen.ground.truth().position_ned_m[0];
    assert!((north_m + 3.3).abs() < 0.3, "{north_m}");
    seen.must_not_say(&["EKF", "Glitch", "flags", "mode"]);
}

#[test]
fn heights_and_satellites_of_the_gps_alone_change_nothing_but_its_report() {
    for (name, value) in [
        ("SIM_GPS_GLITCH_Z", 20.0),
        ("SIM_GPS_ALT_OFS", 20.0),
        ("SIM_GPS_NUMSATS", 4.0),
        ("SIM_GPS_NOISE", 3.0),
    ] {
        let mut seen = hovering(15.0);
        seen.ground.set(name, value);
        seen.run(15.0);
        seen.must_not_say(&["EKF", "Glitch", "flags", "mode"]);
        let down_m = seen.ground.truth().position_ned_m[2];
        assert!((down_m + 15.0).abs() < 0.2, "{name}: {down_m}");
        let Some(MavMessage::GPS_RAW_INT(report)) = seen.asked(24) else {
            panic!("no report");
        };
        if name == "SIM_GPS_NUMSATS" {
            assert_eq!(report.satellites_visible, 4);
        } else {
            let off_m = f64::from(report.alt) / 1000.0 - 599.0;
            assert!(off_m.abs() > 0.01, "{name}: {off_m}");
        }
    }
}

#[test]
fn a_jammed_receiver_ends_in_a_landing() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_GPS_JAM", 1.0);
    seen.run(15.0);
    seen.must_say(
        4.0,
        &[
            (7.0, "EKF variance"),
            (7.0, "EKF Failsafe: changed to LAND Mode"),
        ],
    );
    assert!(seen.lines.iter().any(|(_, line)| line == "fix 1 3"));
    assert_eq!(seen.ground.truth().mode, 9);
}

#[test]
fn failing_compasses_are_left_for_the_next() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_MAG1_FAIL", 1.0);
    seen.run(8.0);
    seen.ground.set("SIM_MAG2_FAIL", 1.0);
    seen.run(5.0);
    seen.must_say(
        TOLERANCE_S,
        &[
            (0.6, "health 5221fc2b"),
            (10.0, "EKF3 IMU0 switching to compass 2"),
            (10.0, "EKF3 IMU1 switching to compass 2"),
        ],
    );
    seen.mark();
    seen.ground.set("SIM_MAG3_FAIL", 1.0);
    seen.run(20.0);
    seen.must_not_say(&["EKF", "mode", "flags"]);
    seen.mark();
    seen.ground.set("SIM_MAG1_FAIL", 0.0);
    seen.run(1.0);
    seen.must_say(TOLERANCE_S, &[(0.1, "EKF3 IMU0 switching to compass 0")]);
}

#[test]
fn a_stuck_accelerometer_costs_a_lane_and_a_metre() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_ACCEL1_FAIL", 20.0);
    let mut most_m: f64 = 0.0;
    for _ in 0..500 {
        seen.run(0.01);
        let [north_m, east_m, _] = seen.ground.truth().position_ned_m;
        most_m = most_m.max(maths::hypot(north_m, east_m));
    }
    seen.must_say(
        0.1,
        &[
            (0.35, "EKF3 lane switch 1"),
            (0.35, "EKF primary changed:1"),
        ],
    );
    assert!((1.0..1.8).contains(&most_m), "measured 1.4: {most_m}");
}

#[test]
fn a_barometer_that_errs_moves_the_vehicle_and_one_that_fails_does_not() {
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_BARO_GLITCH", 10.0);
    seen.run(4.4);
    let early_m = -seen.ground.truth().position_ned_m[2];
    assert!((early_m - 9.0).abs() < 1.5, "measured 9.0: {early_m}");
    seen.run(15.6);
    let late_m = -seen.ground.truth().position_ned_m[2];
    assert!((late_m - 5.0).abs() < 0.5, "measured 5.0: {late_m}");
    let mut seen = hovering(15.0);
    seen.ground.set("SIM_BARO_DISABLE", 1.0);
    seen.run(5.0);
    seen.must_say(TOLERANCE_S, &[(0.1, "health 5221fc27")]);
    seen.ground.set("SIM_BAR2_DISABLE", 1.0);
    seen.mark();
    seen.run(11.0);
    seen.must_say(TOLERANCE_S, &[(10.2, "flags 031f")]);
    assert!((seen.ground.truth().position_ned_m[2] + 15.0).abs() < 0.3);
}

#[test]
fn a_barometer_that_drifts_freezes_or_shakes_takes_the_vehicle_along() {
    let height_m = |seen: &Timeline| -seen.ground.truth().position_ned_m[2];
    let mut drifting = hovering(15.0);
    drifting.ground.set("SIM_BARO_DRIFT", 0.2);
    drifting.run(20.0);
    // The altitude has drifted by 4 m; the estimate lags by 4 s.
    assert!((height_m(&drifting) - 11.8).abs() < 0.5);

    let mut frozen = hovering(15.0);
    frozen.ground.set("SIM_BARO_FREEZE", 1.0);
    frozen.ground.goto([0.0, 0.0, -18.0]);
    frozen.run(8.0);
    assert!(height_m(&frozen) > 18.5, "climbs past its height");

    let mut shaking = hovering(15.0);
    shaking.ground.set("SIM_BARO_RND", 5.0);
    let mut off_m: f64 = 0.0;
    for _ in 0..100 {
        shaking.run(0.1);
        off_m = off_m.max((height_m(&shaking) - 15.0).abs());
    }
    assert!((0.01..1.0).contains(&off_m), "{off_m}");
}

#[test]
fn what_is_over_leaves_the_belief_as_the_truth() {
    let mut seen = hovering(10.0);
    for name in ["SIM_GPS_GLITCH_X", "SIM_BARO_GLITCH", "SIM_MAG1_FAIL"] {
        let value = if name.ends_with('X') { 0.000_02 } else { 1.0 };
        seen.ground.set(name, value);
        seen.run(3.0);
        seen.ground.set(name, 0.0);
        seen.run(60.0);
        let estimator = &seen.ground.world.slots[0].autopilot.vehicle.estimator;
        assert!(estimator.fix().is_none(), "{name} still costs something");
    }
}

/// As on the real one, whose checks had passed before.
#[test]
fn a_lower_threshold_is_a_failsafe_in_flight() {
    let mut ground = Ground::hovering(10.0);
    ground.set("FS_EKF_THRESH", 0.001);
    ground.run(3.0);
    let texts = ground.texts();
    assert!(texts.contains(&"EKF variance".to_owned()), "{texts:?}");
}
