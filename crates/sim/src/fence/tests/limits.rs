//! Velocities that the fence limits.

use proptest::prelude::*;

use super::*;
use sortie_geo::maths;

#[test]
fn a_vehicle_that_flies_at_a_corner_stays_inside_as_the_real_one_did() {
    let mut ground = fenced(pentagon_with_a_hole());
    let mut track = Vec::new();
    push(&mut ground, [5.0, 0.0, 0.0], 35.0, |ground| {
        track.push(ground.truth().position_ned_m);
        false
    });
    let at = |seconds: usize| track[seconds * 100 - 1][0];
    // Measured: N 76.5 after 16.6 s, 81.2 after 17.6 s, 87.3 after 19.6 s.
    for (seconds, measured_m, off_m) in [(17, 78.5, 1.0), (18, 82.8, 1.0), (20, 87.6, 1.0)] {
        let north_m = at(seconds);
        println!("N {north_m:.2} after {seconds} s, measured {measured_m}");
        assert!(
            (north_m - measured_m).abs() < off_m,
            "{seconds} s: {north_m}"
        );
    }
    // After that, the measured position varied between 87.1 and 89.8.
    let late = track[2200..].iter().map(|place| place[0]);
    let (least, most) = late.fold((f64::MAX, f64::MIN), |(a, b), n| (a.min(n), b.max(n)));
    println!("between {least:.2} and {most:.2}, measured 87.1 and 89.8");
    assert!(least > 86.5 && most < 90.0, "{least} {most}");
    let told = status(&ground).expect("a status");
    assert_eq!((told.breach_status, told.breach_count), (0, 0));
    assert_eq!(
        told.breach_mitigation,
        FenceMitigate::FENCE_MITIGATE_VEL_LIMIT
    );
    // Without setpoints it backs away to the margin: measured N 86.0.
    ground.run(12.0);
    let north_m = ground.truth().position_ned_m[0];
    println!("left alone: N {north_m:.2}, measured 86.0");
    assert!((north_m - 86.0).abs() < 0.7, "{north_m}");
    let told = status(&ground).expect("a status");
    assert_eq!(told.breach_mitigation, FenceMitigate::FENCE_MITIGATE_NONE);
}

#[test]
fn a_climb_creeps_through_the_ceiling_and_brakes_there_as_the_real_one_did() {
    let mut ground = fenced(Vec::new());
    ground.set("FENCE_ALT_MAX", 30.0);
    ground.set("FENCE_ACTION", 4.0);
    let mut heights = Vec::new();
    push(&mut ground, [0.0, 0.0, -2.0], 40.0, |ground| {
        heights.push(-ground.truth().position_ned_m[2]);
        ground.truth().mode == BRAKE
    });
    // Measured: 26.7 after 4.5 s, 27.9 after 6.5 s, 30.05 and BRAKE after 17.8 s.
    println!(
        "{:.2} {:.2}, BRAKE after {} steps",
        heights[450],
        heights[650],
        heights.len()
    );
    assert!((heights[450] - 26.7).abs() < 0.5 && (heights[650] - 27.9).abs() < 0.3);
    assert!((1200..2600).contains(&heights.len()), "{}", heights.len());
    let told = status(&ground).expect("a status");
    assert_eq!((told.breach_status, told.breach_count), (1, 1));
    assert_eq!(told.breach_type, FenceBreach::FENCE_BREACH_MAXALT);
    assert_eq!(said(&ground, "Fence Breached"), 1);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    #[test]
    // At higher speeds, the real vehicle also crosses the edge.
    fn whatever_velocities_are_asked_a_vehicle_stays_inside(
        asked in proptest::collection::vec((-2.5f32..2.5, -2.5f32..2.5, 1usize..8), 5..15),
        stops: bool,
        hole: bool,
    ) {
        let mut items = square(20.0);
        if hole {
            items.push(item(5004, 5.0, (12.0, 0.0)));
        }
        let mut ground = fenced(items);
        ground.set("AVOID_BEHAVE", f32::from(u8::from(stops)));
        for (north, east, fifths) in asked {
            for _ in 0..fifths * 4 {
                ground.fly([north, east, 0.0]);
                ground.run(0.2);
                let at = ground.truth().position_ned_m;
                prop_assert!(at[0].abs() < 20.0 && at[1].abs() < 20.0, "{at:?}");
                prop_assert!(!hole || maths::hypot(at[0] - 12.0, at[1]) > 5.0, "{at:?}");
            }
        }
        prop_assert_eq!(ground.truth().mode, 4);
    }
}

/// A component of a velocity, from plausible to absurd.
fn wild() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0f32),
        Just(-1.0),
        Just(1e-30),
        Just(3.0e38),
        Just(-3.0e38),
        -300.0f32..300.0,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    #[test]
    fn no_parameters_make_the_flight_senseless(
        values in proptest::collection::vec((0usize..13, wild()), 1..10),
        v in [-10.0f32..10.0, -10.0..10.0, -3.0..3.0],
    ) {
        const NAMES: [&str; 13] = [
            "FENCE_TYPE", "FENCE_ACTION", "FENCE_ALT_MAX", "FENCE_ALT_MIN", "FENCE_RADIUS",
            "FENCE_MARGIN", "AVOID_ENABLE", "AVOID_BEHAVE", "AVOID_BACKUP_SPD", "AVOID_BACKZ_SPD",
            "AVOID_ACCEL_MAX", "RALLY_LIMIT_KM", "WPNAV_ACCEL",
        ];
        let mut items = pentagon_with_a_hole();
        items.push(item(5003, 1e30, (0.0, 0.0)));
        items.extend(polygon(5002, &[(20.0, 0.0); 3]));
        let mut ground = fenced(items);
        for (name, value) in values {
            ground.set(NAMES[name], value);
        }
        push(&mut ground, v, 6.0, |_| false);
        ground.long(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0]);
        ground.run(5.0);
        let truth = ground.truth();
        let numbers = [truth.position_ned_m, truth.velocity_ned_m_s].concat();
        prop_assert!(numbers.iter().all(|v| v.is_finite() && v.abs() < 1e3), "{truth:?}");
    }
}

#[test]
fn a_pilots_climb_ends_under_the_ceiling() {
    let mut ground = fenced(Vec::new());
    ground.set("FENCE_ALT_MAX", 30.0);
    ground.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 5.0]);
    for _ in 0..100 {
        ground.sticks(1900);
        ground.run(0.2);
    }
    let height_m = -ground.truth().position_ned_m[2];
    assert!((height_m - 28.0).abs() < 0.3, "{height_m}");
    assert_eq!(ground.truth().mode, 5);
}
