use super::*;

fn rules(set: &[(&str, f32)]) -> WindRules {
    let mut all = Parameters::new(crate::VehicleKind::Copter, 1);
    for (name, value) in set {
        all.set(name, *value).expect("known");
    }
    WindRules::read(&all)
}

#[test]
fn a_calm_costs_no_random_numbers() {
    let mut wind = Wind::new(1, 0);
    let mut untouched = wind.clone();
    assert_eq!(wind.step(30.0, &rules(&[])), DVec3::ZERO);
    assert_eq!(wind.board_id(), untouched.board_id());
}

#[test]
fn the_mean_wind_follows_its_profile_and_direction() {
    let speed = ("SIM_WIND_SPD", 10.0);
    for (set, height, towards) in [
        (&[("SIM_WIND_DIR", 90.0)][..], 60.0, [0.0, -10.0, 0.0]),
        (&[("SIM_WIND_DIR", 0.0)][..], 15.0, [-5.0, 0.0, 0.0]),
        (
            &[("SIM_WIND_DIR", 0.0), ("SIM_WIND_T", 1.0)][..],
            1.0,
            [-10.0, 0.0, 0.0],
        ),
        (
            &[
                ("SIM_WIND_DIR", 180.0),
                ("SIM_WIND_T", 2.0),
                ("SIM_WIND_T_COEF", 0.1),
            ][..],
            80.0,
            [12.0, 0.0, 0.0],
        ),
        (
            &[("SIM_WIND_DIR", 0.0), ("SIM_WIND_DIR_Z", 90.0)][..],
            60.0,
            [0.0, 0.0, -10.0],
        ),
    ] {
        let mut all = vec![speed];
        all.extend_from_slice(set);
        let got = Wind::new(1, 0).step(height, &rules(&all));
        assert!(
            (got - DVec3::from_array(towards)).length() < 1e-6,
            "{set:?}: {got}"
        );
    }
}

#[test]
fn gusts_have_the_deviation_that_was_asked() {
    let rules = rules(&[("SIM_WIND_TURB", 3.0)]);
    let mut squares = DVec3::ZERO;
    let mut mean = DVec3::ZERO;
    let steps = 600_000;
    let mut wind = Wind::new(7, 3);
    for _ in 0..steps {
        let gust = wind.step(20.0, &rules);
        squares += gust * gust;
        mean += gust;
    }
    let deviation = squares / f64::from(steps);
    let (flat, up) = (deviation.x.sqrt(), deviation.z.sqrt());
    assert!((0.8..1.3).contains(&flat), "{flat}");
    assert!((0.8..1.3).contains(&deviation.y.sqrt()), "{deviation}");
    assert!((0.42..0.74).contains(&up), "weaker near the ground: {up}");
    assert!((mean / f64::from(steps)).length() < 0.2);
}

#[test]
fn equal_seeds_blow_alike_and_others_do_not() {
    let rules = rules(&[("SIM_WIND_TURB", 3.0)]);
    let gusts = |seed, vehicle| {
        let mut wind = Wind::new(seed, vehicle);
        (0..50).map(|_| wind.step(20.0, &rules)).collect::<Vec<_>>()
    };
    assert_eq!(gusts(1, 0), gusts(1, 0));
    assert_ne!(gusts(1, 0), gusts(1, 1));
    assert_ne!(gusts(1, 0), gusts(2, 0));
}
